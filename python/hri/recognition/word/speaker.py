# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Adaptation of a word recogniser to a speaker, a microphone or a room."""

from __future__ import annotations

from dataclasses import replace
from typing import Unpack

from hri import _native
from hri.core.labels import as_text
from hri.core.suggest import did_you_mean
from hri.media import naming_file
from hri.recognition.decision import Decision
from hri.recognition.inputs import AudioInput, as_audio
from hri.recognition.keywords import SpeakerAdapterKeywords
from hri.recognition.quality import speech_snr_db
from hri.recognition.word.recognizer import WordRecognizer


class SpeakerAdapter:
    """Recognise words and adapt to them, supervised (with labels) or unsupervised.

    Every decision uses the models adapted to the words before it, in two steps: one linear transform of all means and
    variances (Leggetter and Woodland 1995, diagonal), for the voice, the microphone and the room; then, from
    `words_per_label` words a label on, maximum a posteriori estimation of each word's model (Gauvain and Lee 1994).
    Without a label, a word counts as what it is recognised as, if it is accepted and its margin is among the largest.

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
    >>> adapter = SpeakerAdapter(WordRecognizer.load("words.hri"))
    >>> adapter.recognise(samples, 16000).label
    'seven'
    >>> adapter.recognizer.save("words-of-asha.hri")
    """

    def __init__(self, recognizer: WordRecognizer, **options: Unpack[SpeakerAdapterKeywords]) -> None:
        self.options = _native.SpeakerAdapterOptions(**options)
        self._labels = [str(known) for known in recognizer.classes_]
        self._native = _native.SpeakerAdapter(recognizer._trained, self.options)
        self._embedding = recognizer._embedding

    def recognise(self, audio: AudioInput, sample_rate_hz: int | None = None, *, update: bool = True) -> Decision:
        """Recognise one clip, then adapt to it.

        Parameters
        ----------
        audio : path, Audio, or array of shape (num_samples,)
        sample_rate_hz : int, optional
            Of an array; as for `WordRecognizer.recognise`.
        update : bool
            False leaves adaptation to a call of `update`, where the answer must not wait for it.
        """
        clip = as_audio(audio, sample_rate_hz)
        with naming_file(clip.path):
            decision = Decision.from_native("speech", self._native.recognise(clip.samples, clip.sample_rate_hz))
        quality = speech_snr_db(clip.samples, clip.sample_rate_hz)
        decision = replace(decision, notes=(*clip.notes, *decision.notes), quality=quality)
        if update and self.update_due:
            self.update()
        return decision

    def learn(self, audio: AudioInput, label: str, sample_rate_hz: int | None = None) -> None:
        """Remember a word with its label (supervised); `update` learns from it.

        Raises
        ------
        InvalidArgument
            For a label that is not in the vocabulary, or audio without speech.
        """
        clip = as_audio(audio, sample_rate_hz)
        label = as_text(label, "label")
        if label not in self._labels:
            raise _native.InvalidArgument(f"no word {label!r}; {did_you_mean(label, self._labels, 'it has')}")
        with naming_file(clip.path):
            self._native.learn(clip.samples, clip.sample_rate_hz, label)

    @property
    def update_due(self) -> bool:
        """Whether one remembered word in eight is newer than the last update."""
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
        """Words that the last update learned from: those with a label, and those trusted."""
        return int(self._native.num_learned)

    @property
    def recognizer(self) -> WordRecognizer:
        """The recogniser as adapted at the last update."""
        adapted = WordRecognizer._wrap(self._native.recognizer)
        adapted._embedding = self._embedding
        return adapted
