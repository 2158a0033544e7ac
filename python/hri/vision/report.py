# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What is found of the hand in every frame of a clip, as a table; no trained model is needed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from hri.core.display import short_repr
from hri.core.errors import InvalidArgument
from hri.features.hand import hand_column_names, hand_features
from hri.media import Clip
from hri.vision.hands import find_hands, hand_place
from hri.vision.landmarks import find_landmarks, landmark_column_names, landmark_features

Source = Literal["silhouettes", "landmarks"]
Progress = Callable[[int, int], None]
SOURCES: tuple[Source, ...] = ("silhouettes", "landmarks")

_PLACE = ("quality", "repaired", "centre_x", "centre_y", "area")


@dataclass(frozen=True)
@short_repr
class FrameHand:
    """What was found of the hand in one frame.

    Attributes
    ----------
    quality : float
        0 (no hand) .. 1.
    repaired : bool
        The frames around it made the mask, because it jumped (`hri.vision.smooth_masks`).
    x, y, area : float or None
        Its middle and what it covers, in shares of the picture; None without a hand.
    features : ndarray of float32, or None
    grey, mask : ndarray of uint8, or None
        Of silhouettes: the picture and the hand in it, at the working size.
    joints : ndarray of float32, shape (21, 2), or None
        Of landmarks, in pixels.
    """

    quality: float
    repaired: bool = False
    x: float | None = None
    y: float | None = None
    area: float | None = None
    features: NDArray[np.float32] | None = None
    grey: NDArray[np.uint8] | None = None
    mask: NDArray[np.uint8] | None = None
    joints: NDArray[np.float32] | None = None

    @property
    def found(self) -> bool:
        """Whether there is a hand."""
        return self.features is not None


@dataclass(frozen=True)
@short_repr
class HandReport:
    """A clip and what was found in it, frame by frame; `inspect_hands` makes one.

    Attributes
    ----------
    clip : Clip
    source : "silhouettes" or "landmarks"
    kind : str
        Of the features.
    names : list of str
        Of the features.
    hands : dict of str to list of FrameHand
        One for every frame of the clip: of "hand", or of "left" and "right" where two were looked for.
    """

    clip: Clip
    source: Source
    kind: str
    names: list[str]
    hands: dict[str, list[FrameHand]]

    @property
    def columns(self) -> list[str]:
        """Names of what `rows` gives; "hand" is among them where two were looked for."""
        return ["frame", "time_s", *(["hand"] if len(self.hands) > 1 else []), *_PLACE, *self.names]

    def rows(self) -> Iterator[list[float | str | None]]:
        """A row for every hand of every frame; None for what a frame without it has not."""
        for number, time_s in enumerate(self.clip.times_s):
            for side, frames in self.hands.items():
                hand = frames[number]
                features = [None] * len(self.names) if hand.features is None else hand.features.tolist()
                place = [hand.quality, int(hand.repaired), hand.x, hand.y, hand.area]
                yield [number, time_s, *([side] if len(self.hands) > 1 else []), *place, *features]

    def table(self, separator: str = ",") -> str:
        """The rows as text below a line of names; empty cells where there is no hand."""
        lines = [self.columns, *([_cell(value) for value in row] for row in self.rows())]
        return "".join(separator.join(line) + "\n" for line in lines)

    def as_dict(self) -> dict[str, Any]:
        """The same for JSON."""
        frames = []
        for row in self.rows():
            cells = dict(zip(self.columns, row, strict=True))
            features = {name: cells.pop(name) for name in self.names}
            frames.append({**cells, "features": None if cells["area"] is None else features})
        return {"clip": str(self.clip.path), "source": self.source, "kind": self.kind, "frames": frames}


def _cell(value: float | str | None) -> str:
    if value is None:
        return ""
    return value if isinstance(value, str) else f"{value:.9g}"


def inspect_hands(
    clip: Clip,
    source: Source = "silhouettes",
    kind: Any = "track",
    silhouette: Any = None,
    progress: Progress | None = None,
    max_hands: int = 1,
    smooth: bool = True,
    background: Any = None,
    faces: Any = "auto",
    **options: Any,
) -> HandReport:
    """Find the hand, or both, in every frame of a clip, and their features.

    Parameters
    ----------
    clip : Clip
        From `hri.read_frames` or `hri.media.read_pictures`; held in memory whole.
    source : "silhouettes" or "landmarks"
        Landmarks need the extra `mediapipe`.
    kind : str
        Of silhouettes, one of `hri.features.hand.HAND_KINDS`; landmarks have but one kind of features, those of
        `hri.vision.landmarks.landmark_features`.
    silhouette : hri.vision.SilhouetteOptions, optional
        As for `hri.vision.hands.find_silhouettes`.
    progress : callable, optional
        Called with (done, total) frames.
    max_hands : int
        1, or 2 for the left and the right hand of the picture, of silhouettes: see `hri.vision.hands.find_hands`.
    smooth : bool
        Repair masks that jump for a frame or two.
    background : uint8 array of the frames' shape, optional
        The place without a person, of silhouettes: see `hri.vision.hands.find_silhouettes`.
    faces : "auto", "never", a path of a cascade, or hri.vision.FaceFinder
        The same, of silhouettes.
    **options
        Fields of the kind's options; tracks get the rate of the clip.

    Raises
    ------
    InvalidArgument
        For a source or kind that there is not, or an option out of range.
    TypeError
        For an option that the kind has not.
    """
    if source not in SOURCES:
        raise InvalidArgument(f"source must be one of {', '.join(SOURCES)}, got {source!r}")
    if source == "landmarks":
        if options:
            raise TypeError(f"landmarks have no options, got {', '.join(options)}")
        if max_hands != 1:
            raise InvalidArgument(f"max_hands is {max_hands}, must be 1 for landmarks")
        if background is not None:
            raise InvalidArgument("background is for silhouettes, not for landmarks")
        return HandReport(clip, source, source, landmark_column_names(), {"hand": _joints(clip, progress)})
    if kind == "track":
        options.setdefault("frames_per_second", clip.fps)
    names = hand_column_names(kind, **options)
    hands = {}
    sides = find_hands(clip.frames, max_hands, silhouette, progress, smooth=smooth, background=background, faces=faces)
    for side, found in sides.items():
        rows = iter(hand_features([s.grey for s in found], [s.mask for s in found], kind, **options))
        hands[side] = [_outlined(shape, rows) for shape in found]
    return HandReport(clip, source, kind, names, hands)


def _outlined(shape: Any, rows: Any) -> FrameHand:
    grey, mask = np.asarray(shape.grey), np.asarray(shape.mask)
    place = hand_place(mask)
    if place is None:
        return FrameHand(0.0, bool(shape.repaired), grey=grey, mask=mask)
    x, y, area = place
    return FrameHand(float(shape.quality), bool(shape.repaired), x, y, area, next(rows), grey, mask)


def _joints(clip: Clip, progress: Progress | None) -> list[FrameHand]:
    height, width = clip.frames[0].shape[:2]
    found = find_landmarks(clip.frames, progress)
    rows = iter(landmark_features(found, (width, height)))
    hands = []
    for joints in found:
        if joints is None:
            hands.append(FrameHand(0.0))
            continue
        shares = joints / np.array([width, height], np.float32)
        inside = float(np.mean(np.all((shares >= 0) & (shares <= 1), axis=1)))
        x, y = shares.mean(axis=0).tolist()
        area = float(np.ptp(shares, axis=0).prod())
        hands.append(FrameHand(inside, x=x, y=y, area=area, features=next(rows), joints=joints))
    return hands
