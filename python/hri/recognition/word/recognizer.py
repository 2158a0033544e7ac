# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Isolated spoken words: train, save, load, recognise."""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from dataclasses import replace
from os import PathLike

import numpy as np
from numpy.typing import NDArray

from hri import _native
from hri.core.suggest import did_you_mean
from hri.recognition.base import Recognizer
from hri.recognition.decision import Decision
from hri.recognition.inputs import AudioInput, as_audio, as_audios
from hri.recognition.loading import load_native
from hri.recognition.word.background import BackgroundWord, background_words

_log = logging.getLogger(__name__)


class WordRecognizer(Recognizer):
    """Recognise one spoken word at a time.

    Parameters
    ----------
    **options
        Fields of ``hri.WordRecognizerOptions``, for example ``model="ptbhmm"`` or ``num_states=10``.
        ``cepstra`` and ``activity`` take an options object of their own. Defaults are the C++ library's.

    Attributes
    ----------
    classes_ : ndarray of str
        The labels, sorted; set by `fit` and `load`.
    threshold : float
        ``Decision.score`` from which a word is recognised: what training found to reject the share
        ``false_reject_rate`` of right words.

    Examples
    --------
    >>> recognizer = WordRecognizer(model="hmm")            # doctest: +SKIP
    >>> recognizer.fit(clips, labels, sample_rate_hz=16000)  # doctest: +SKIP
    >>> recognizer.recognise(clip, 16000).label              # doctest: +SKIP
    'seven'
    """

    mode = "speech"
    _native_class = _native.WordRecognizer
    _options_class = _native.WordRecognizerOptions

    def fit(
        self,
        X: Sequence[AudioInput],
        y: Sequence[str],
        *,
        sample_rate_hz: int | Sequence[int] | None = None,
        groups: Sequence[str] | None = None,
        background: Sequence[BackgroundWord] | None = None,
        progress: Callable[[int, int], None] | None = None,
    ) -> WordRecognizer:
        """Train one model a label.

        Parameters
        ----------
        X : sequence of paths, Audio, or arrays of shape (num_samples,)
            Each as `recognise` takes it.
        y : sequence of str
            The word spoken in each clip.
        sample_rate_hz : int or sequence of int, optional
            Of arrays: one rate for all, or one for each.
        groups : sequence of str, optional
            The speaker of each clip; calibration then holds out whole speakers.
        background : sequence of BackgroundWord, optional
            Words outside the vocabulary, which the model "hmm" learns to tell `unknown` by. By default those that come
            with the package (`background_words`); an empty sequence turns them off. They may sound like a word of the
            vocabulary, but should not be one.
        progress : callable, optional
            Called with (done, total) training steps.

        Raises
        ------
        InvalidArgument
            For lengths that differ, audio with NaN (names the clip and the sample), or a label without speech.
        Interrupted
            When Ctrl-C is pressed; the recogniser is left as it was.
        """
        speakers = [""] * len(X) if groups is None else [str(g) for g in groups]
        if not len(X) == len(y) == len(speakers):
            raise _native.InvalidArgument(f"X, y and groups differ in length: {len(X)}, {len(y)}, {len(speakers)}")
        clips = as_audios(X, sample_rate_hz)
        _log.info("training on %d utterances of %d words", len(clips), len(set(y)))
        others = background_words() if background is None else background
        self._native = self._native_class.train(
            [clip.samples for clip in clips],
            [clip.sample_rate_hz for clip in clips],
            [str(label) for label in y],
            speakers,
            self.options,
            progress,
            [np.ascontiguousarray(word.samples, dtype=np.float32) for word in others],
            [word.sample_rate_hz for word in others],
            [word.label for word in others],
        )
        return self

    def add_word(
        self, label: str, clips: Sequence[AudioInput], sample_rate_hz: int | Sequence[int] | None = None
    ) -> WordRecognizer:
        """Learn one word more from few recordings; three do. The models of the other words stay as they are.

        How far a word varies is taken from the words that the recogniser knows; so is the rejection threshold.

        Parameters
        ----------
        label : str
            A word that the recogniser does not have.
        clips : sequence of paths, Audio, or arrays of shape (num_samples,)
            Recordings of the word, one or more, each with speech in it.
        sample_rate_hz : int or sequence of int, optional
            Of arrays: one rate for all, or one for each.

        Raises
        ------
        InvalidArgument
            For a label that is there already, no clip, or one that is silent or broken (names it); the recogniser
            is left as it was.
        """
        read = as_audios(clips, sample_rate_hz, "clips")
        self._native = self._trained.with_word(
            label, [clip.samples for clip in read], [clip.sample_rate_hz for clip in read]
        )
        return self

    def remove_word(self, label: str) -> WordRecognizer:
        """Forget a word. Raises InvalidArgument for one that is not known, or where fewer than two would be left."""
        if label not in self.classes_:
            raise _native.InvalidArgument(f"no word {label!r}; {did_you_mean(label, self.classes_, 'it has')}")
        self._native = self._trained.without_word(label)
        return self

    def recognise(self, audio: AudioInput, sample_rate_hz: int | None = None) -> Decision:
        """Recognise one word.

        Parameters
        ----------
        audio : path, Audio, or array of shape (num_samples,)
            A recording; what `hri.read_audio` gives; or mono samples, floats in -1..1 or int16.
        sample_rate_hz : int, optional
            Of an array. Another rate than the model's is resampled, and said so in ``Decision.notes``.

        Raises
        ------
        InvalidArgument
            For an array without a rate, or of several channels; names the argument, and says what would work.
        FormatError, IoError
            For a file that is no recording.

        Examples
        --------
        >>> words.recognise("seven.wav").label     # doctest: +SKIP
        >>> words.recognise(samples, 16000).label  # doctest: +SKIP
        """
        heard = as_audio(audio, sample_rate_hz)
        decision = Decision.from_native(self.mode, self._trained.recognise(heard.samples, heard.sample_rate_hz))
        return replace(decision, notes=(*heard.notes, *decision.notes)) if heard.notes else decision

    def scores(self, audio: AudioInput, sample_rate_hz: int | None = None) -> NDArray[np.float32]:
        """Raw score of every class (natural log), shape (num_classes,), in the order of `classes_`."""
        heard = as_audio(audio, sample_rate_hz)
        return np.asarray(self._trained.scores(heard.samples, heard.sample_rate_hz))

    def decide(self, X: Sequence[AudioInput], sample_rate_hz: int | Sequence[int] | None = None) -> list[Decision]:
        """The decision for every item of `X`, each as `recognise` takes it."""
        return [self.recognise(audio) for audio in as_audios(X, sample_rate_hz)]

    @property
    def threshold(self) -> float:
        """Score from which a word is recognised."""
        return float(self._trained.threshold)

    @classmethod
    def load(cls, path: str | PathLike[str]) -> WordRecognizer:
        """Read a model that `save` wrote, in Python or C++. Raises FormatError for anything else."""
        return cls._wrap(load_native(_native.WordRecognizer, path, "word_recognizer"))
