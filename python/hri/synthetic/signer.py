# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Drawn people who show the digits 0 to 9 with one hand, for demos and tests without recordings.

Drawn signs vary far less than filmed ones: figures measured on them say that a chain works, not
how well.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import partial
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument
from hri.core.optional import import_opencv
from hri.datasets.dataset import Dataset
from hri.datasets.manifest import Manifest, SampleRow
from hri.media import write_image, write_video
from hri.synthetic.corpus import make_corpus
from hri.synthetic.drawing.hand import draw_hand
from hri.synthetic.drawing.hand_pose import (
    DIGIT_POSES,
    RELAXED,
    HandPose,
    blend,
    make_skeleton,
    rotation,
    varied,
)
from hri.synthetic.drawing.height_field import HeightField, View
from hri.synthetic.drawing.light import cast_shadow, over, photograph, shade
from hri.synthetic.drawing.options import SignerOptions, num_clip_frames
from hri.synthetic.drawing.room import draw_room, draw_wall
from hri.synthetic.drawing.scene import RAISED_ELBOW, Scene, arm_look
from hri.synthetic.drawing.signer import Signer, make_signer

SIGNS = tuple(DIGIT_POSES)
"""The labels that can be drawn."""

CLIP_FPS = SignerOptions.fps
_STILL_PX = 200
_STILL_DRAWN_PX = 360
_CLIP_S = 2.4

Frame = NDArray[np.uint8]


def draw_still(signer: Signer, label: str, take: int = 0, seed: int = 0) -> Frame:
    """A close-up of the sign, uint8 BGR, shape (200, 200, 3); equal arguments give equal pixels.

    Parameters
    ----------
    signer : Signer
        From `make_signer`.
    label : str
        One of `SIGNS`.
    take : int
        Repetitions differ in pose, place, size and noise.
    seed : int

    Raises
    ------
    InvalidArgument
        For a label that cannot be drawn.
    """
    cv2 = import_opencv("to draw signs")
    rng = _generator(signer, label, take, seed, 1)
    size = _STILL_DRAWN_PX
    view = View(
        (size * rng.uniform(0.42, 0.54), size * rng.uniform(0.80, 0.87)),
        size * rng.uniform(0.62, 0.70),
    )
    yaw, pitch, roll = rng.normal(0, (6.0, 5.0, 5.0))
    skeleton = make_skeleton(varied(_pose(label), rng), signer.hand_shape)
    skeleton = skeleton.rotated(rotation(yaw, pitch, roll))
    field = HeightField(size, size)
    draw_hand(field, view, skeleton, signer.hand_shape, arm_look(signer), cv2)
    lamp = signer.light.direction
    offset = (-0.045 * size * np.sign(lamp[0]) * abs(lamp[0]), 0.03 * size)
    if signer.options.background is None:
        wall = draw_wall(size, size, signer.wall, rng)
    else:
        wall = draw_room(size, size, signer.wall, signer.background, rng, cv2)
    picture = over(
        cast_shadow(wall, field.part > 0, offset, cv2),
        shade(field, signer.light, 0.02 * view.scale, cv2),
        field.part > 0,
    )
    picture = cv2.resize(picture, (_STILL_PX, _STILL_PX), interpolation=cv2.INTER_AREA)
    return photograph(picture, signer.camera, rng, cv2)


def draw_clip(
    signer: Signer,
    label: str,
    take: int = 0,
    seed: int = 0,
    size_px: tuple[int, int] = (320, 240),
    num_frames: int | None = None,
) -> list[Frame]:
    """The signer raises the hand, shows the sign, and lowers it again.

    Parameters
    ----------
    signer, label, take, seed
        As for `draw_still`.
    size_px : (int, int)
        Width and height, at least 64 each; 4:3 looks best.
    num_frames : int, optional
        At least 3, at the signer's rate; by default 2.4 s at the usual tempo. The hand is still for the middle half.

    Returns
    -------
    list of ndarray of uint8, shape (height, width, 3), BGR

    Raises
    ------
    InvalidArgument
        For a label that cannot be drawn, or a size or length too small.
    """
    width, height = size_px
    fps = signer.options.fps
    if num_frames is None:
        num_frames = num_clip_frames(_CLIP_S, signer.options)
    if width < 64 or height < 64 or num_frames < 3:
        raise InvalidArgument(f"size_px is {size_px} and num_frames {num_frames}, must be at least (64, 64) and 3")
    cv2 = import_opencv("to draw signs")
    rng = _generator(signer, label, take, seed, 2)
    sharp = 2 if height <= 300 else 1
    scene = Scene(signer, height * sharp, width * sharp, rng, cv2)
    sign = make_skeleton(varied(_pose(label), rng), signer.hand_shape)
    relaxed = make_skeleton(RELAXED, signer.hand_shape)
    sway = rng.uniform(0, 2 * np.pi, size=4)
    lean = rng.normal(0, (4.0, 3.0, 4.0))
    frames = []
    for index in range(num_frames):
        raised = _raised(index / (num_frames - 1))
        wobble = np.sin(2 * np.pi * 0.6 * index / fps + sway)
        turn = rotation(
            lean[0] + 2.0 * wobble[0],
            lean[1] + 1.5 * wobble[1] + 38.0 * (1 - raised),
            lean[2] + 1.5 * wobble[2] - 24.0 * (1 - raised),
        )
        skeleton = blend(relaxed, sign, float(np.clip(1.6 * raised - 0.4, 0, 1))).rotated(turn)
        elbow = RAISED_ELBOW * (signer.build, 1, 1) + (0.02 * wobble[3], -1.7 * (1 - raised), 0.0)
        picture = scene.with_arm(skeleton, elbow, turn)
        if sharp > 1:
            picture = cv2.resize(picture, size_px, interpolation=cv2.INTER_AREA)
        frames.append(photograph(picture, signer.camera, rng, cv2))
    return frames


def make_gesture_corpus(
    directory: str | PathLike[str],
    labels: Iterable[str] = SIGNS,
    num_persons: int = 8,
    takes: int = 1,
    kind: str = "still",
    seed: int = 0,
    progress: Callable[[int, int], None] | None = None,
    options: SignerOptions | None = None,
    first_person: int = 0,
    replace: bool = False,
) -> Dataset:
    """Write drawn signs, ``{label}/{person}_{take}.jpg`` or ``.mp4``, and a manifest that says so.

    Parameters
    ----------
    directory : path-like
        Made if needed. One that is not empty must hold what an equal call made, see `replace`.
    labels : iterable of str
        Out of `SIGNS`.
    num_persons : int
        At least 1.
    takes : int
        Of every sign by every person, at least 1.
    kind : "still" or "clip"
        Close-ups of the hand, or clips of the whole person.
    seed : int
        The same people appear in stills and clips of one seed.
    progress : callable, optional
        Called with (done, total) after every file.
    options : SignerOptions, optional
        Skin, sleeve, light, background, camera and tempo, where they are asked for.
    first_person : int
        Number of the first person, at least 0: others than those of another corpus.
    replace : bool
        Whether signs that another call made there give way. Nothing else ever does, as pictures of people.

    Raises
    ------
    InvalidArgument
        For an unknown label or kind, no labels, counts below 1, a first person below 0, or a folder that holds
        something else.
    IoError
        When a file cannot be written.
    ImportError
        When OpenCV is not installed.
    """
    labels = list(dict.fromkeys(labels))
    if not labels or num_persons < 1 or takes < 1:
        raise InvalidArgument(f"labels is {labels}, num_persons {num_persons}, takes {takes}; need at least one each")
    if first_person < 0:
        raise InvalidArgument(f"first_person is {first_person}, must be at least 0")
    if kind not in ("still", "clip"):
        raise InvalidArgument(f"kind is {kind!r}, must be 'still' or 'clip'")
    for label in labels:
        _pose(label)
    import_opencv("to draw signs")
    asked = options or SignerOptions()
    suffix = "jpg" if kind == "still" else "mp4"
    made = [
        (signer, label, take)
        for signer in (make_signer(index, seed, options) for index in range(first_person, first_person + num_persons))
        for label in labels
        for take in range(takes)
    ]
    rows = [
        SampleRow(f"{label}/{signer.name}_{kind}{take + 1}.{suffix}", label, signer.name, f"{kind}{take + 1}")
        for signer, label, take in made
    ]
    manifest = Manifest(
        "gesture",
        "synthetic signs",
        "Drawn people who show digits with one hand; no recordings of people.",
        synthetic=True,
        made_by={
            "program": "hri.synthetic.signer",
            "seed": seed,
            "num_persons": num_persons,
            "takes": takes,
            "kind": kind,
            **({"first_person": first_person} if first_person else {}),
            **asked.asked_for(),
        },
        rows=rows,
    )

    def writers() -> Iterator[Callable[[Path], None]]:
        for done, (signer, label, take) in enumerate(made, start=1):
            if kind == "still":
                yield partial(write_image, image=draw_still(signer, label, take, seed))
            else:
                yield partial(write_video, frames=draw_clip(signer, label, take, seed), fps=asked.fps)
            if progress is not None:
                progress(done, len(rows))

    return make_corpus(directory, manifest, replace, writers())


def _generator(signer: Signer, label: str, take: int, seed: int, use: int) -> np.random.Generator:
    return np.random.default_rng([seed, take, use, *signer.name.encode(), *label.encode()])


def _pose(label: str) -> HandPose:
    if label not in DIGIT_POSES:
        raise InvalidArgument(f"label {label!r} cannot be drawn; known are {', '.join(SIGNS)}")
    return DIGIT_POSES[label]


def _raised(moment: float) -> float:
    """How far the arm is up, 0..1, at a moment 0..1 of the clip."""
    rise = float(np.clip(min(moment, 1.0 - moment) / 0.25, 0.0, 1.0))
    return rise * rise * (3.0 - 2.0 * rise)


__all__ = [
    "CLIP_FPS",
    "SIGNS",
    "Signer",
    "SignerOptions",
    "draw_clip",
    "draw_still",
    "make_gesture_corpus",
    "make_signer",
]
