# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Isolated signs and gestures from images or clips: train, save, load, recognise."""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri import _native
from hri.recognition.base import Recognizer
from hri.recognition.decision import Decision
from hri.recognition.inputs import ClipInput, as_clips, as_frames
from hri.recognition.loading import load_native
from hri.vision.hands import LEAST_QUALITY, find_landmarks, find_silhouettes, landmark_features

_log = logging.getLogger(__name__)


class GestureRecognizer(Recognizer):
    """Recognise one signed gesture at a time, from a still (one frame) or a clip.

    Parameters
    ----------
    silhouette : hri._native_vision.SilhouetteOptions, optional
        How the hand is found in every picture by itself. Without it, a clip of 8 frames or more tells the colours of
        its hand and its background; see `hri.vision.hands.find_silhouettes`.
    **options
        Fields of ``hri.GestureRecognizerOptions``, for example ``model="svm"`` for still signs, ``model="path"`` for
        movements (the training clips decide by default), or ``source="landmarks"`` for the joints of the hand, as
        MediaPipe finds them, instead of silhouettes. Defaults are the C++ library's.

    Attributes
    ----------
    classes_ : ndarray of str
        The labels, sorted; set by `fit` and `load`.
    """

    mode = "gesture"
    _native_class = _native.GestureRecognizer
    _options_class = _native.GestureRecognizerOptions

    def __init__(self, silhouette: Any = None, **options: Any) -> None:
        super().__init__(**options)
        self._silhouette = silhouette

    def features(self, clip: ClipInput) -> NDArray[np.float32]:
        """Features of every frame that shows a hand, float32, shape (num_frames_with_hand, num_features).

        Parameters
        ----------
        clip : path, Clip, picture or sequence of pictures
            As `recognise` takes it.
        """
        frames = as_frames(clip)
        if self.options.source == _native.GestureSource.landmarks:
            size = (frames[0].shape[1], frames[0].shape[0]) if frames else (1, 1)
            return landmark_features(find_landmarks(frames), size)
        return self.silhouette_features(find_silhouettes(frames, self._silhouette))

    def silhouette_features(self, silhouettes: Sequence[Any]) -> NDArray[np.float32]:
        """Features as `features` gives them, of hands that are found already (`hri._native_vision.Silhouette`).

        Unless they were found in a way that was asked for (`silhouette`), those of a quality below
        `hri.vision.hands.LEAST_QUALITY` are left out.
        """
        least = LEAST_QUALITY if self._silhouette is None else 0.0
        trusted = [s for s in silhouettes if s.quality >= least]
        return np.asarray(
            _native.GestureRecognizer.features(
                [s.grey for s in trusted], [s.mask for s in trusted], self.options.features
            )
        )

    @property
    def model(self) -> Any:
        """The `hri.GestureModel` that training came to."""
        return self._trained.options.model

    @property
    def knows_movements(self) -> bool:
        """Whether it was trained on whole movements; frames of still signs vote, each by itself."""
        return self.model in (_native.GestureModel.path, _native.GestureModel.hmm, _native.GestureModel.ptbhmm)

    @property
    def starts_at_rest(self) -> bool:
        """Whether most gestures trained on began with a hand that rested in view (model `path`).

        Then a hand that comes into view and rests has shown nothing yet.
        """
        return bool(self._trained.starts_at_rest)

    @property
    def pauses(self) -> bool:
        """Whether most gestures trained on were made of several movements with pauses between them (model `path`)."""
        return bool(self._trained.pauses)

    def fit(
        self,
        X: Sequence[ClipInput],
        y: Sequence[str],
        *,
        groups: Sequence[str] | None = None,
        progress: Callable[[int, int], None] | None = None,
    ) -> GestureRecognizer:
        """Train on labelled clips.

        Parameters
        ----------
        X : sequence of clips
            Each as `recognise` takes it; a still is a clip of one frame.
        y : sequence of str
        groups : sequence of str, optional
            The signer of each clip; calibration then holds out whole signers.
        progress : callable, optional
            Called with (done, total), first for the clips, then for the training steps.

        Raises
        ------
        InvalidArgument
            For lengths that differ, or a label without a single hand in view.
        Interrupted
            When Ctrl-C is pressed; the recogniser is left as it was.
        """
        if len(X) != len(y):
            raise _native.InvalidArgument(f"X and y differ in length: {len(X)}, {len(y)}")
        rows = []
        for done, clip in enumerate(as_clips(X)):
            rows.append(self.features(clip))
            if progress is not None:
                progress(done + 1, len(X))
        return self.fit_features(rows, y, groups=groups, progress=progress)

    def fit_features(
        self,
        rows: Sequence[NDArray[np.float32]],
        y: Sequence[str],
        *,
        groups: Sequence[str] | None = None,
        progress: Callable[[int, int], None] | None = None,
    ) -> GestureRecognizer:
        """Train on what `features` returned, so that clips are read once for several trainings."""
        signers = [""] * len(rows) if groups is None else [str(g) for g in groups]
        if not len(rows) == len(y) == len(signers):
            raise _native.InvalidArgument(
                f"features, y and groups differ in length: {len(rows)}, {len(y)}, {len(signers)}"
            )
        _log.info("training on %d clips of %d labels", len(rows), len(set(y)))
        self._native = self._native_class.train(
            list(rows), [str(label) for label in y], signers, self.options, progress
        )
        return self

    def recognise(self, clip: ClipInput) -> Decision:
        """Recognise one sign.

        Parameters
        ----------
        clip : path, Clip, picture or sequence of pictures
            A picture, a video or a folder of pictures; what `hri.read_frames` gives; or uint8 BGR arrays of shape
            (height, width, 3), one for a still.

        Raises
        ------
        InvalidArgument
            For arrays of another shape or type; names the argument, and says what would work.
        FormatError, IoError
            For a file that is neither a picture nor a video.

        Examples
        --------
        >>> signs.recognise("seven.jpg").label  # doctest: +SKIP
        >>> signs.recognise(picture).label      # doctest: +SKIP
        """
        return self.recognise_features(self.features(clip))

    def recognise_features(self, rows: NDArray[np.float32]) -> Decision:
        """Recognise what `features` returned."""
        return Decision.from_native(self.mode, self._trained.recognise_features(rows))

    def decide(self, X: Sequence[ClipInput]) -> list[Decision]:
        """The decision for every item of `X`, each as `recognise` takes it."""
        return [self.recognise(clip) for clip in as_clips(X)]

    @classmethod
    def load(cls, path: str | PathLike[str]) -> GestureRecognizer:
        """Read a model that `save` wrote, in Python or C++. Raises FormatError for anything else."""
        return cls._wrap(load_native(_native.GestureRecognizer, path, "gesture_recognizer"))
