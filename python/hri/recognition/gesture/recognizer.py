# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Isolated signs and gestures from images or clips: train, save, load, recognise."""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from dataclasses import replace
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any, Unpack

import numpy as np
from numpy.typing import NDArray

from hri import _native
from hri.core.errors import FormatError, InvalidArgument
from hri.core.labels import as_text, as_texts
from hri.recognition.base import Recognizer
from hri.recognition.decision import Decision
from hri.recognition.held_out_report import HeldOutReport
from hri.recognition.inputs import ClipInput, as_frames, as_labels, each_clip
from hri.recognition.keywords import GestureRecognizerKeywords
from hri.recognition.loading import load_native
from hri.recognition.quality import mask_quality
from hri.vision.faces import face_finder
from hri.vision.landmarks import (
    find_landmark_pairs,
    find_landmarks,
    landmark_features,
    landmark_pair_features,
)

if TYPE_CHECKING:
    from typing import Self

    from hri._native_vision import GestureStream, GestureStreamOptions

_log = logging.getLogger(__name__)

_MOST_NAMED = 5


class GestureRecognizer(Recognizer):
    """Recognise one signed gesture at a time, from a still (one frame) or a clip.

    Parameters
    ----------
    **options
        Fields of ``hri.GestureRecognizerOptions``, for example ``model="svm"`` for still signs, ``model="trajectory"``
        for dynamic gestures (the training clips decide by default), ``num_hands=2`` for gestures of both hands, or
        ``source="landmarks"`` for the joints of the hand, as MediaPipe finds them, instead of silhouettes. The colours
        of hand and background are learned from a clip of eight frames or more; ``hands={"learning": "never"}`` looks
        for the hand in every picture by itself. All are saved with the model. Defaults are the C++ library's.

    Attributes
    ----------
    classes_ : ndarray of str
        The labels, sorted; set by `fit` and `load`.
    held_out : HeldOutReport or None
        What training saw on people held out; None where nothing could be (see `is_calibrated`).
    faces : str or None
        Whether hands are those of the person whose face is seen, where one is: "auto", "never" or the path of a cascade
        (`hri.vision.faces.face_finder`). None, as at first: as the option ``use_faces`` says, without which there is no
        going on if nothing finds faces. It is of this computer, and not saved with the model.

    Examples
    --------
    >>> signs = GestureRecognizer(model="svm").fit(pictures, labels)
    >>> signs.recognise(picture).label
    'seven'
    """

    mode = "gesture"
    _native_class = _native.GestureRecognizer
    _options_class = _native.GestureRecognizerOptions
    options: _native.GestureRecognizerOptions

    def __init__(self, **options: Unpack[GestureRecognizerKeywords]) -> None:
        super().__init__(**options)
        self.faces: str | None = None

    def untrained(self) -> Self:
        """Another recogniser of the same options and `faces`, which is not trained."""
        other = super().untrained()
        other.faces = self.faces
        return other

    def __getstate__(self) -> dict[str, Any]:
        return {**super().__getstate__(), "faces": self.faces}

    def __setstate__(self, state: dict[str, Any]) -> None:
        faces = state.get("faces", 0) if isinstance(state, dict) else None
        if not isinstance(faces, str | None):
            raise FormatError(f"the state of {type(self).__name__} must have faces, a text or None")
        own = {name: value for name, value in state.items() if name != "faces"} if isinstance(state, dict) else state
        super().__setstate__(own)
        self.faces = faces

    def features(self, clip: ClipInput) -> NDArray[np.float32]:
        """Features of every frame that shows a hand, float32, shape (num_frames_with_hand, num_features).

        They are those of the options that were trained with, and before training of the options given. For training
        anew after `set_params`, take those of `untrained`.

        Parameters
        ----------
        clip : path, Clip, picture or sequence of pictures
            As `recognise` takes it.
        """
        return self._features(clip, self._options_in_use)

    def _features(self, clip: ClipInput, options: _native.GestureRecognizerOptions) -> NDArray[np.float32]:
        frames = [np.ascontiguousarray(frame) for frame in as_frames(clip)]
        if options.source == "landmarks":
            return _landmark_rows(frames, options)
        from hri import _native_vision

        return np.asarray(_native_vision.gesture_features(frames, options, self._face_finder(options)))

    def features_and_quality(self, clip: ClipInput) -> tuple[NDArray[np.float32], float | None]:
        """What `features` gives, and beside it the quality that `recognise` gives the decision; hands are found once.

        Parameters
        ----------
        clip : path, Clip, picture or sequence of pictures
            As `recognise` takes it.
        """
        return self._seen(clip, self._options_in_use)

    def _seen(
        self, clip: ClipInput, options: _native.GestureRecognizerOptions
    ) -> tuple[NDArray[np.float32], float | None]:
        frames = [np.ascontiguousarray(frame) for frame in as_frames(clip)]
        if options.source == "landmarks":
            return _landmark_rows(frames, options), None
        from hri import _native_vision

        finder = _native_vision.HandFinder(options.hands, faces=self._face_finder(options))
        sides = finder.find_pair(frames) if options.num_hands == 2 else [finder.find(frames)]
        surer = [max(hands, key=lambda hand: float(hand.quality)) for hands in zip(*sides, strict=True)]
        return _observation_rows(sides, options), mask_quality(surer)

    def observation_features(self, hands: Sequence[Any], right: Sequence[Any] | None = None) -> NDArray[np.float32]:
        """Features as `features` gives them, of hands that are found already (`HandObservation`).

        Those of a quality below the option ``min_quality`` show no hand. With ``num_hands=2``, `hands` are the left
        hand of the picture in every frame and `right` the right one, as `hri.vision.find_hands` gives them.

        Raises
        ------
        InvalidArgument
            For one hand where two are wanted, or two where one is.
        """
        options = self._options_in_use
        num_hands = options.num_hands
        if (right is not None) != (num_hands == 2):
            raise InvalidArgument(f"num_hands is {num_hands}: right must be given where it is 2, and only there")
        return _observation_rows([hands] if right is None else [hands, right], options)

    @property
    def _options_in_use(self) -> _native.GestureRecognizerOptions:
        """Those that were trained with, which `set_params` leaves alone; before training, those given."""
        return self.options if self._native is None else self._native.options

    @property
    def model(self) -> Any:
        """The `hri.GestureModel` that training came to."""
        return self._trained.options.model

    @property
    def is_calibrated(self) -> bool:
        """Whether training could hold anything out. If not, nothing is rejected, and confidences say nothing."""
        return bool(self._trained.is_calibrated)

    @property
    def held_out(self) -> HeldOutReport | None:
        """What training saw on people held out, of the gestures it had then; None where nothing could be held out."""
        return HeldOutReport.of(self._trained)

    @property
    def is_dynamic(self) -> bool:
        """Whether it was trained on dynamic gestures, scored whole; frames of still signs vote, each by itself."""
        return bool(self._trained.is_dynamic)

    @property
    def starts_at_rest(self) -> bool:
        """Whether most gestures trained on began with a hand that rested in view (model `trajectory`).

        Then a hand that comes into view and rests has shown nothing yet.
        """
        return bool(self._trained.starts_at_rest)

    @property
    def pauses(self) -> bool:
        """Whether most gestures trained on had several strokes with pauses between them (model `trajectory`)."""
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

        Notes
        -----
        Clips without a hand in view are left out; a warning of the log names them.
        """
        labels, signers = as_labels(X, y, groups)  # refused before an hour of reading
        rows, empty = [], []
        for done, (given, clip) in enumerate(zip(X, each_clip(X), strict=True)):
            rows.append(self._features(clip, self.options))
            if len(rows[-1]) == 0:
                empty.append(_place_of(given, done))
            if progress is not None:
                progress(done + 1, len(X))
        if empty:
            few = ", ".join(empty[:_MOST_NAMED]) + (", ..." if len(empty) > _MOST_NAMED else "")
            _log.warning("clips without a hand in view are left out, %d of %d: %s", len(empty), len(rows), few)
        return self.fit_features(rows, labels, groups=signers, progress=progress)

    def fit_features(
        self,
        rows: Sequence[NDArray[np.float32]],
        y: Sequence[str],
        *,
        groups: Sequence[str] | None = None,
        progress: Callable[[int, int], None] | None = None,
    ) -> GestureRecognizer:
        """Train on what `features` returned, so that clips are read once for several trainings.

        The options given are saved with the model as those of the rows: they must be the ones `features` went by.
        """
        signers = [""] * len(rows) if groups is None else as_texts(groups, "groups")
        if not len(rows) == len(y) == len(signers):
            raise InvalidArgument(f"features, y and groups differ in length: {len(rows)}, {len(y)}, {len(signers)}")
        _log.info("training on %d clips of %d labels", len(rows), len(set(y)))
        self._native = self._native_class.train(list(rows), as_texts(y, "y"), signers, self.options, progress)
        return self

    def add_gesture(self, label: str, clips: Sequence[ClipInput]) -> GestureRecognizer:
        """Add a gesture from few clips; three suffice. Rejection and calibration stay as they are, and so
        does `held_out`, which knows nothing of it.

        Models that keep what they were trained on (``rbf``, ``knn``) are trained anew on that and the clips. For
        ``trajectory`` the mean of every other gesture stands for its clips, and what separates it from the others moves
        as little as the new clips ask for. ``hmm`` and ``ptbhmm`` leave the models of the others as they are. To take a
        gesture back, keep a copy (`copy.copy`) from before. Options are those that were trained with, whatever
        `set_params` has changed for the next `fit`.

        Parameters
        ----------
        label : str
            A gesture that is not in the vocabulary; an integer counts as its digits, as in `fit`.
        clips : sequence of clips
            Each as `recognise` takes it, one or more, with a hand in view.

        Raises
        ------
        InvalidArgument
            For a label that is no text, empty, reserved or in the vocabulary already, no clip, one without a hand in
            view (names it, as in ``samples[0]``), a dynamic gesture of fewer than 8 frames with a hand, and the models
            ``svm`` and ``bayes``, which keep too little of what they were trained on; the recogniser is left as it was.

        Examples
        --------
        >>> from copy import copy
        >>> more = copy(signs).add_gesture("eight", [picture])
        >>> "eight" in more.classes_, "eight" in signs.classes_
        (True, False)
        """
        options = self._trained.options
        text = as_text(label, "label")
        return self.add_gesture_features(text, [self._features(clip, options) for clip in each_clip(clips)])

    def add_gesture_features(self, label: str, rows: Sequence[NDArray[np.float32]]) -> GestureRecognizer:
        """Add a gesture by what `features` returned for its clips; as `add_gesture`."""
        self._native = self._trained.with_gesture(as_text(label, "label"), list(rows))
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
        >>> signs.recognise("seven.jpg").label
        'seven'
        >>> signs.recognise(picture).label
        'seven'
        """
        rows, quality = self._seen(clip, self._trained.options)
        return replace(self.recognise_features(rows), quality=quality)

    def recognise_features(self, rows: NDArray[np.float32]) -> Decision:
        """Recognise what `features` returned."""
        return Decision.from_native(self.mode, self._trained.recognise_features(rows))

    def stream_options(self) -> GestureStreamOptions:
        """How `stream` finds gestures by default: as suits the recogniser's options and what it was trained on."""
        from hri import _native_vision

        return _native_vision.GestureStream.options_for(self._trained)

    def stream(self, options: GestureStreamOptions | None = None) -> GestureStream:
        """Decisions on pictures as they come; `hri.live.Watcher` takes care of cameras and events on top.

        Parameters
        ----------
        options : GestureStreamOptions, optional
            By default `stream_options`.

        Examples
        --------
        >>> stream = signs.stream()
        >>> [event.kind for event in stream.push(picture, 0.0)]
        []
        """
        from hri import _native_vision

        return _native_vision.GestureStream(self._trained, options, self.face_finder())

    def face_finder(self) -> Any:
        """The `hri.vision.FaceFinder` that says whose hands are looked for; None where hands are found without faces.

        Raises
        ------
        InvalidArgument
            With the option ``use_faces``, where nothing on this computer finds faces.
        """
        return self._face_finder(self._options_in_use)

    def _face_finder(self, options: _native.GestureRecognizerOptions) -> Any:
        if options.source == "landmarks":
            return None
        if self.faces is not None:
            return face_finder(self.faces)
        return face_finder(required=True) if options.use_faces else None

    def decide(self, X: Sequence[ClipInput]) -> list[Decision]:
        """The decision for every item of `X`, each as `recognise` takes it."""
        return [self.recognise(clip) for clip in each_clip(X)]

    @classmethod
    def load(cls, path: str | PathLike[str]) -> GestureRecognizer:
        """Read a model that `save` wrote, in Python or C++. Raises FormatError for anything else."""
        return cls._wrap(load_native(_native.GestureRecognizer.from_model_file, path, "gesture_recognizer"))


def _place_of(clip: ClipInput, number: int) -> str:
    """Where a clip of `X` stands, and of what file it is, if it is of one."""
    path = clip if isinstance(clip, str | PathLike) else getattr(clip, "path", None)
    return f"X[{number}]" if path is None else f"X[{number}] ({fspath(path)})"


def _landmark_rows(frames: list[NDArray[np.uint8]], options: _native.GestureRecognizerOptions) -> NDArray[np.float32]:
    """Rows of one hand, or of both, by their joints."""
    size = (frames[0].shape[1], frames[0].shape[0]) if frames else (1, 1)
    if options.num_hands == 2:
        return landmark_pair_features(find_landmark_pairs(frames), size, options.relation_weight)
    return landmark_features(find_landmarks(frames), size)


def _observation_rows(sides: Sequence[Sequence[Any]], options: _native.GestureRecognizerOptions) -> NDArray[np.float32]:
    """Rows of one hand, or of the left and the right one, by what was found in every frame."""
    computer = _native.GestureFeatureComputer(options.features, options.min_quality)
    if len(sides) == 1:
        return np.asarray(computer.compute(list(sides[0])))
    left, right = (computer.compute_every(list(side)) for side in sides)
    return np.asarray(_native.pair_rows(left, right, options.relation_weight))
