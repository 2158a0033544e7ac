# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Isolated spoken words: train, save, load, recognise."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from os import PathLike, fspath
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri import _native
from hri.recognition.base import Recognizer
from hri.recognition.decision import Decision
from hri.recognition.word.background import BackgroundWord, background_words

Audio = NDArray[np.float32]


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
        X: Sequence[Audio],
        y: Sequence[str],
        *,
        sample_rate_hz: int | Sequence[int],
        groups: Sequence[str] | None = None,
        background: Sequence[BackgroundWord] | None = None,
        progress: Callable[[int, int], None] | None = None,
    ) -> WordRecognizer:
        """Train one model a label.

        Parameters
        ----------
        X : sequence of float32 arrays, shape (num_samples,)
            Mono audio in -1..1.
        y : sequence of str
            The word spoken in each clip.
        sample_rate_hz : int or sequence of int
            One rate for all clips, or one for each.
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
        rates = _rates(sample_rate_hz, len(X))
        speakers = [""] * len(X) if groups is None else [str(g) for g in groups]
        if not len(X) == len(y) == len(rates) == len(speakers):
            raise _native.InvalidArgument(
                f"X, y, sample_rate_hz and groups differ in length: {len(X)}, {len(y)}, {len(rates)}, {len(speakers)}"
            )
        clips = _as_clips(X, "X")
        others = background_words() if background is None else background
        self._native = self._native_class.train(
            clips,
            rates,
            [str(label) for label in y],
            speakers,
            self.options,
            progress,
            [_as_audio(word.samples, f"background[{i}].samples") for i, word in enumerate(others)],
            [word.sample_rate_hz for word in others],
            [word.label for word in others],
        )
        return self

    def add_word(self, label: str, clips: Sequence[Audio], sample_rate_hz: int | Sequence[int]) -> WordRecognizer:
        """Learn one word more from few recordings; three do. The models of the other words stay as they are.

        How far a word varies is taken from the words that the recogniser knows; so is the rejection threshold.

        Parameters
        ----------
        label : str
            A word that the recogniser does not have.
        clips : sequence of float32 arrays, shape (num_samples,)
            Recordings of the word, one or more, each with speech in it.
        sample_rate_hz : int or sequence of int
            One rate for all clips, or one for each.

        Raises
        ------
        InvalidArgument
            For a label that is there already, no clip, or one that is silent or broken (names it); the recogniser
            is left as it was.
        """
        self._native = self._trained.with_word(label, _as_clips(clips, "clips"), _rates(sample_rate_hz, len(clips)))
        return self

    def remove_word(self, label: str) -> WordRecognizer:
        """Forget a word. Raises InvalidArgument for one that is not known, or where fewer than two would be left."""
        self._native = self._trained.without_word(label)
        return self

    def recognise(self, audio: Audio, sample_rate_hz: int) -> Decision:
        """Recognise one clip.

        Parameters
        ----------
        audio : float32 array, shape (num_samples,)
        sample_rate_hz : int
            Another rate than the model's is resampled, and said so in ``Decision.notes``.
        """
        return Decision.from_native(self.mode, self._trained.recognise(_as_audio(audio, "audio"), sample_rate_hz))

    def scores(self, audio: Audio, sample_rate_hz: int) -> NDArray[np.float32]:
        """Raw score of every class (natural log), shape (num_classes,), in the order of `classes_`."""
        return np.asarray(self._trained.scores(_as_audio(audio, "audio"), sample_rate_hz))

    def decide(self, X: Sequence[Audio], sample_rate_hz: int | Sequence[int]) -> list[Decision]:
        """The decision for every clip of `X`."""
        rates = _rates(sample_rate_hz, len(X))
        return [self.recognise(x, rate) for x, rate in zip(X, rates, strict=True)]

    @property
    def threshold(self) -> float:
        """Score from which a word is recognised."""
        return float(self._trained.threshold)

    @classmethod
    def load(cls, path: str | PathLike[str]) -> WordRecognizer:
        """Read a model that `save` wrote, in Python or C++. Raises FormatError for anything else."""
        return cls._wrap(_native.WordRecognizer.load(fspath(path)))


def _rates(sample_rate_hz: int | Sequence[int], count: int) -> list[int]:
    return [sample_rate_hz] * count if isinstance(sample_rate_hz, int) else list(sample_rate_hz)


def _as_clips(clips: Sequence[Audio], name: str) -> list[Audio]:
    return [_as_audio(clip, f"{name}[{i}]") for i, clip in enumerate(clips)]


def _as_audio(samples: Any, name: str) -> Audio:
    array = np.ascontiguousarray(samples, dtype=np.float32)
    if array.ndim != 1:
        raise _native.InvalidArgument(f"{name} must be one-dimensional (mono), got shape {array.shape}")
    return array
