# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A word recogniser that gets used to who speaks, and where."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from hri import _native
from hri.core.suggest import did_you_mean
from hri.recognition.decision import Decision
from hri.recognition.inputs import AudioInput, as_audio
from hri.recognition.word.recognizer import WordRecognizer


class SpeakerAdapter:
    """Recognise words and learn from them, named or not.

    Every word is decided by what was learned before it. The models are adapted in two steps: one linear change of all
    means and variances together (Leggetter and Woodland 1995, diagonal), for the voice, the microphone and the room;
    then, once `words_per_label` words a label were heard, each word's model by maximum a posteriori estimation
    (Gauvain and Lee 1994). Words that nobody named count as what they are recognised as, if they are accepted and among
    the clearest.

    Parameters
    ----------
    recognizer : WordRecognizer
        Trained, of the model "hmm"; stays as it is.
    **options
        Fields of ``hri.SpeakerAdapterOptions``; defaults are the C++ library's.

    Raises
    ------
    InvalidArgument
        For an untrained recogniser, models that do not adapt ("ptbhmm"), or options out of range.

    Examples
    --------
    >>> adapter = SpeakerAdapter(WordRecognizer.load("words.hri"))  # doctest: +SKIP
    >>> adapter.recognise(clip, 16000).label                         # doctest: +SKIP
    'seven'
    >>> adapter.recognizer.save("words-of-asha.hri")                 # doctest: +SKIP
    """

    def __init__(self, recognizer: WordRecognizer, **options: Any) -> None:
        self.options = _native.SpeakerAdapterOptions(**options)
        self._labels = [str(known) for known in recognizer.classes_]
        self._native = _native.SpeakerAdapter(recognizer._trained, self.options)

    def recognise(self, audio: AudioInput, sample_rate_hz: int | None = None, *, update: bool = True) -> Decision:
        """Recognise one clip, then learn from it.

        Parameters
        ----------
        audio : path, Audio, or array of shape (num_samples,)
        sample_rate_hz : int, optional
            Of an array; as for `WordRecognizer.recognise`.
        update : bool
            False leaves the learning to a call of `update`, for whoever has to answer at once.
        """
        heard = as_audio(audio, sample_rate_hz)
        decision = Decision.from_native("speech", self._native.recognise(heard.samples, heard.sample_rate_hz))
        if heard.notes:
            decision = replace(decision, notes=(*heard.notes, *decision.notes))
        if update and self.update_due:
            self.update()
        return decision

    def learn(self, audio: AudioInput, label: str, sample_rate_hz: int | None = None) -> None:
        """Remember a word that somebody named; `update` learns from it.

        Raises
        ------
        InvalidArgument
            For a label that the recogniser does not have, or audio in which nobody speaks.
        """
        heard = as_audio(audio, sample_rate_hz)
        if label not in self._labels:
            raise _native.InvalidArgument(f"no word {label!r}; {did_you_mean(label, self._labels, 'it has')}")
        self._native.learn(heard.samples, heard.sample_rate_hz, label)

    @property
    def update_due(self) -> bool:
        """Whether enough new words were heard since the last update: one in eight."""
        return bool(self._native.update_due)

    def update(self) -> None:
        """Adapt to the words remembered; takes some milliseconds a word. Ctrl-C leaves the adapter as it was."""
        self._native.update()

    def reset(self) -> None:
        """Forget the speaker."""
        self._native.reset()

    @property
    def num_words(self) -> int:
        """Words remembered."""
        return int(self._native.num_words)

    @property
    def num_learned(self) -> int:
        """Words that the last update learned from: those named, and those trusted."""
        return int(self._native.num_learned)

    @property
    def recognizer(self) -> WordRecognizer:
        """The recogniser as adapted at the last update."""
        return WordRecognizer._wrap(self._native.recognizer)
