# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Sentences of signs, from tracks of both hands."""

from __future__ import annotations

import logging
import operator
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass
from os import PathLike
from typing import Any, Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hri import _native
from hri.core.display import shown
from hri.core.errors import InvalidArgument
from hri.core.labels import as_text, as_texts
from hri.language import WordErrors, count_word_errors
from hri.recognition.base import Recognizer
from hri.recognition.inputs import require_sequence
from hri.recognition.keywords import ConnectedDecoderKeywords, SentenceRecognizerKeywords
from hri.recognition.loading import load_native

_log = logging.getLogger(__name__)


@dataclass(frozen=True)
class RecognisedSign:
    """One word of a signed sentence.

    Attributes
    ----------
    label : str
    first_frame, last_frame : int
        Its first frame, and the frame after its last.
    log_score : float
        What it adds to the sentence's.
    """

    label: str
    first_frame: int
    last_frame: int
    log_score: float


@dataclass(frozen=True)
class RecognisedSentence:
    """The words of a signed sentence.

    Attributes
    ----------
    words : tuple of RecognisedSign
        In the order of time; empty where nothing but rest was found.
    log_score : float
        Natural log, of the best path.
    """

    words: tuple[RecognisedSign, ...]
    log_score: float = 0.0

    @property
    def labels(self) -> tuple[str, ...]:
        """The words alone."""
        return tuple(word.label for word in self.words)

    @property
    def text(self) -> str:
        """The words, with spaces between."""
        return " ".join(self.labels)

    def to_dict(self) -> dict[str, Any]:
        """As plain values that can be written as JSON."""
        return {"text": self.text, **asdict(self)}


class SentenceRecognizer(Recognizer):
    """Recognise the words of a signed sentence from tracks of both hands and of the head, or from rows of features.

    HMMs, or possibility-theory HMMs (``model="ptbhmm"``), of words, a variant for each recording of a word, one of
    what lies between words (rest, and the movement from one sign to the next), and a language model of the sentences
    trained on. The weight of the language model and the insertion penalty are chosen on sentences held out in training.

    Parameters
    ----------
    **options
        Fields of ``hri.recognition.SentenceRecognizerOptions``.

    Attributes
    ----------
    classes_ : ndarray of str
        The words, sorted; set by `fit` and `load`.
    """

    mode = "signs"
    _native_class = _native.SentenceRecognizer
    _options_class = _native.SentenceRecognizerOptions
    options: _native.SentenceRecognizerOptions

    def __init__(self, **options: Unpack[SentenceRecognizerKeywords]) -> None:
        super().__init__(**options)

    def fit(
        self,
        X: Sequence[ArrayLike],
        y: Sequence[Sequence[tuple[str, int, int]]],
        *,
        scales_px: Sequence[float] | None = None,
        groups: Sequence[str] | None = None,
        progress: Callable[[int, int], None] | None = None,
    ) -> SentenceRecognizer:
        """Train on sentences whose words are known.

        Parameters
        ----------
        X : sequence of array_like, shape (num_frames, 3, 2) or (num_frames, 6)
            Left hand, right hand, head (such as the nose): x and y in pixels, NaN where a point is out of sight. With
            ``input="rows"``, shape (num_frames, num_features): features of any kind, NaN in frames without a hand.
        y : sequence of sequences of (label, first_frame, last_frame)
            The words of each sentence in the order of time; the last frame is excluded.
        scales_px : sequence of float, optional
            By what lengths in pixels places are divided, such as `hri.features.hand_scale_px` of other recordings of
            the signer; by default that of the recording itself.
        groups : sequence of str, optional
            Signers or sessions: what is chosen is chosen on groups held out; by default on every fourth sentence.
        progress : callable, optional
            Called with (done, total) training steps.

        Raises
        ------
        InvalidArgument
            Names the sentence: lengths that differ, tracks without hands or head or not finite, words that are not
            (label, first_frame, last_frame) or whose frames are no integers, beyond the frames or not in the order of
            time; fewer than two labels, no frame outside the words.
        Interrupted
            When Ctrl-C is pressed; the recogniser is left as it was.
        """
        signers = [""] * len(X) if groups is None else as_texts(groups, "groups")
        scales = [0.0] * len(X) if scales_px is None else [float(scale) for scale in scales_px]
        if not len(X) == len(y) == len(signers) == len(scales):
            lengths = f"{len(X)}, {len(y)}, {len(signers)}, {len(scales)}"
            raise InvalidArgument(f"X, y, groups and scales_px differ in length: {lengths}")
        tracks = [_frames(one, f"X[{i}]", self.options) for i, one in enumerate(X)]
        words = [_words(spans, f"y[{i}]") for i, spans in enumerate(y)]
        _log.info("training on %d sentences", len(tracks))
        self._native = self._native_class.train(tracks, words, scales, signers, self.options, progress)
        return self

    def set_decoder(self, **options: Unpack[ConnectedDecoderKeywords]) -> SentenceRecognizer:
        """Change options of the decoder after training, such as ``insertion_penalty`` or ``language_scale``."""
        current = self._trained.options.decoder.as_dict()
        self._native = self._trained.with_decoder(_native.ConnectedDecoderOptions(**{**current, **options}))
        return self

    @property
    def trained_options(self) -> _native.SentenceRecognizerOptions:
        """The options with what training chose: ``frames_per_state``, weights and the insertion penalty."""
        options: _native.SentenceRecognizerOptions = self._trained.options
        return options

    def recognise(self, tracks: ArrayLike, *, scale_px: float = 0.0) -> RecognisedSentence:
        """Recognise a sentence.

        Parameters
        ----------
        tracks : array_like, shape (num_frames, 3, 2) or (num_frames, 6)
            Or what `fit` was given in their place.
        scale_px : float
            As in training; 0: that of the recording.

        Raises
        ------
        InvalidArgument
            As in training.
        """
        return _as_sentence(self._trained.recognise(self._frames(tracks, "tracks"), scale_px))

    def recognise_n_best(self, tracks: ArrayLike, count: int, *, scale_px: float = 0.0) -> list[RecognisedSentence]:
        """The sentences that come nearest, which differ in their words, the best first.

        Parameters
        ----------
        tracks : array_like, shape (num_frames, 3, 2) or (num_frames, 6)
            Or what `fit` was given in their place.
        count : int
            How many at most, 1 to 1000.
        scale_px : float
            As in training; 0: that of the recording.

        Raises
        ------
        InvalidArgument
            For another `count`, more than 64 million states times frames, and as in training.
        """
        most = _as_integer(count, "count")
        found = self._trained.recognise_n_best(self._frames(tracks, "tracks"), most, scale_px)
        return [_as_sentence(sentence) for sentence in found]

    def recognise_spans(
        self,
        tracks: ArrayLike,
        spans: Sequence[tuple[int, int]],
        *,
        scale_px: float = 0.0,
        use_language: bool = True,
    ) -> RecognisedSentence:
        """Recognise words whose frames are known.

        Parameters
        ----------
        tracks : array_like, shape (num_frames, 3, 2) or (num_frames, 6)
            Or what `fit` was given in their place.
        spans : sequence of (first_frame, last_frame)
            Of each word in the order of time; the last frame is excluded.
        scale_px : float
            As in training; 0: that of the recording.
        use_language : bool
            False: each word by itself.

        Raises
        ------
        InvalidArgument
            For spans that are no pairs of integers, beyond the frames or not in the order of time, and as in training.
        """
        pairs = _spans(spans)
        frames = self._frames(tracks, "tracks")
        return _as_sentence(self._trained.recognise_spans(frames, pairs, scale_px, use_language))

    def score_spans(
        self, tracks: ArrayLike, spans: Sequence[tuple[int, int]], *, scale_px: float = 0.0
    ) -> NDArray[np.float64]:
        """Log scores of every word for frames that are known.

        Parameters
        ----------
        tracks, spans, scale_px
            As of `recognise_spans`.

        Returns
        -------
        scores : ndarray of float64, shape (num_spans, num_classes)
            Of the best path through each word of `classes_`, without language model.

        Raises
        ------
        InvalidArgument
            As `recognise_spans` does.
        """
        pairs = _spans(spans)
        scores: NDArray[np.float64] = self._trained.score_spans(self._frames(tracks, "tracks"), pairs, scale_px)
        return scores

    def count_errors(
        self, X: Sequence[ArrayLike], y: Sequence[Sequence[str]], scales_px: Sequence[float] | None = None
    ) -> WordErrors:
        """Word errors over sentences whose words are known.

        Parameters
        ----------
        X, scales_px
            As of `fit`.
        y : sequence of sequences of str
            The words of each sentence, without their frames.

        Raises
        ------
        InvalidArgument
            For lengths that differ and words that are no text, before anything is recognised; then as `recognise` does.
        """
        require_sequence(X, "X")
        require_sequence(y, "y")
        words = [as_texts(sentence, f"y[{i}]") for i, sentence in enumerate(y)]
        scales = [0.0] * len(X) if scales_px is None else [float(scale) for scale in scales_px]
        if not len(X) == len(words) == len(scales):
            raise InvalidArgument(f"X, y and scales_px differ in length: {len(X)}, {len(words)}, {len(scales)}")
        found = [self.recognise(one, scale_px=scale).labels for one, scale in zip(X, scales, strict=True)]
        return count_word_errors(words, found)

    def _frames(self, values: ArrayLike, name: str) -> NDArray[np.float32]:
        return _frames(values, name, self._trained.options)  # `set_params` is for the next `fit`

    @classmethod
    def load(cls, path: str | PathLike[str]) -> SentenceRecognizer:
        """Read a model that `save` wrote, in Python or C++. Raises FormatError for anything else."""
        return cls._wrap(load_native(_native.SentenceRecognizer.from_model_file, path, "sentence_recognizer"))


def as_tracks(values: ArrayLike, name: str) -> NDArray[np.float32]:
    """Tracks as the core takes them, shape (num_frames, 6); InvalidArgument names what has another shape."""
    array = _as_array(values, name)
    if array.shape[1:] not in ((6,), (3, 2)):
        raise InvalidArgument(f"{name} has shape {array.shape}, must be (num_frames, 3, 2) or (num_frames, 6)")
    return np.ascontiguousarray(array.reshape(len(array), 6))


def as_rows(values: ArrayLike, name: str) -> NDArray[np.float32]:
    """Rows of features as the core takes them; InvalidArgument names what has another shape."""
    array = _as_array(values, name)
    if array.ndim != 2:
        raise InvalidArgument(f"{name} has shape {array.shape}, must be (num_frames, num_features)")
    return np.ascontiguousarray(array)


def _frames(values: ArrayLike, name: str, options: _native.SentenceRecognizerOptions) -> NDArray[np.float32]:
    return as_rows(values, name) if options.input == "rows" else as_tracks(values, name)


def _as_array(values: ArrayLike, name: str) -> NDArray[np.float32]:
    try:
        return np.asarray(values, np.float32)
    except (TypeError, ValueError) as error:  # texts, and lists of different lengths
        raise InvalidArgument(f"{name} must be an array of numbers: {error}") from error


def _as_integer(value: object, name: str) -> int:
    """An integer of 32 bits, as the core takes it: nothing is cut or rounded."""
    try:
        number = operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        raise InvalidArgument(f"{name} must be an integer, got {shown(value)}") from None
    if abs(number) > np.iinfo(np.int32).max:
        raise InvalidArgument(f"{name} is {shown(number)}, which is too large")
    return number


def _items(values: object, fields: str, name: str) -> list[tuple[Any, ...]]:
    """The tuples of `fields` that `values` are, each as long; InvalidArgument names what is none."""
    form = f"({fields})"
    if isinstance(values, str) or not isinstance(values, Iterable):
        raise InvalidArgument(f"{name} must be a sequence of {form}, got {shown(values)}")
    items = list(values)
    for i, item in enumerate(items):
        if isinstance(item, str) or not isinstance(item, Sequence | np.ndarray) or len(item) != fields.count(",") + 1:
            raise InvalidArgument(f"{name}[{i}] must be {form}, got {shown(item)}")
    return [tuple(item) for item in items]


def _words(words: Sequence[tuple[str, int, int]], name: str) -> list[tuple[str, int, int]]:
    return [
        (
            as_text(label, f"{name}[{i}]"),
            _as_integer(first, f"first_frame of {name}[{i}]"),
            _as_integer(last, f"last_frame of {name}[{i}]"),
        )
        for i, (label, first, last) in enumerate(_items(words, "label, first_frame, last_frame", name))
    ]


def _spans(spans: Sequence[tuple[int, int]]) -> list[tuple[int, int]]:
    return [
        (_as_integer(first, f"first_frame of spans[{i}]"), _as_integer(last, f"last_frame of spans[{i}]"))
        for i, (first, last) in enumerate(_items(spans, "first_frame, last_frame", "spans"))
    ]


def _as_sentence(found: Any) -> RecognisedSentence:
    words = tuple(RecognisedSign(w.label, w.first_frame, w.last_frame, w.log_score) for w in found.words)
    return RecognisedSentence(words, found.log_score)
