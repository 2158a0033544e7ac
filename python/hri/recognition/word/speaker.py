# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A word recogniser that gets used to who speaks, and where."""

from __future__ import annotations

from typing import Any

import numpy as np

from hri import _native
from hri.recognition.decision import Decision
from hri.recognition.word.recognizer import Audio, WordRecognizer


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
        self._native = _native.SpeakerAdapter(recognizer._trained, self.options)

    def recognise(self, audio: Audio, sample_rate_hz: int, *, update: bool = True) -> Decision:
        """Recognise one clip, then learn from it.

        Parameters
        ----------
        audio : float32 array, shape (num_samples,)
            Mono, -1..1.
        sample_rate_hz : int
        update : bool
            False leaves the learning to a call of `update`, for whoever has to answer at once.
        """
        samples = np.ascontiguousarray(audio, dtype=np.float32)
        decision = Decision.from_native("speech", self._native.recognise(samples, sample_rate_hz))
        if update and self.update_due:
            self.update()
        return decision

    def learn(self, audio: Audio, sample_rate_hz: int, label: str) -> None:
        """Remember a word that somebody named; `update` learns from it.

        Raises
        ------
        InvalidArgument
            For a label that the recogniser does not have, or audio in which nobody speaks.
        """
        self._native.learn(np.ascontiguousarray(audio, dtype=np.float32), sample_rate_hz, label)

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
