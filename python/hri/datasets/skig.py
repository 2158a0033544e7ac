# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The Sheffield Kinect Gesture data set (SKIG), as it is published: folders and file names hold all metadata.

``subject1_rgb/M_person_1_backgroud_1_illumination_1_pose_1_actionType_1.avi`` (sic) is the colour video of what
``subject1_dep/K_person_1_...avi`` shows in depth.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from hri.core.errors import FormatError, InvalidArgument
from hri.media import VIDEO_SUFFIXES

GESTURES = ("circle", "triangle", "up-down", "right-left", "wave", "z", "cross", "come-here", "turn-around", "pat")
BACKGROUNDS = ("wooden board", "white paper", "paper with characters")
ILLUMINATIONS = ("light", "dark")
POSES = ("fist", "index", "flat")
STREAMS = {"rgb": "M", "dep": "K"}
"""Folder endings, and the letter that file names begin with."""

_FOLDER = re.compile(r"subject([1-9][0-9]?)_(rgb|dep)")
_NAME = re.compile(
    r"([A-Z])_person_([0-9]{1,2})_backgroun?d_([0-9]{1,2})_illumination_([0-9]{1,2})"
    r"_pose_([0-9]{1,2})_actionType_([0-9]{1,2})"
)


@dataclass(frozen=True)
class SkigClip:
    """What a file's name says; conditions by their names."""

    path: Path
    label: str
    person: str
    take: str
    conditions: dict[str, str]


def is_skig(root: Path) -> bool:
    """Whether a folder has a subject's folder of SKIG in it."""
    return any(_FOLDER.fullmatch(path.name) and path.is_dir() for path in root.iterdir())


def skig_clips(root: Path, stream: str = "rgb") -> list[SkigClip]:
    """The clips of one stream in the order of persons, gestures and conditions.

    Parameters
    ----------
    root : Path
        The folder that holds ``subject1_rgb`` and its like; some of them may be missing.
    stream : "rgb" or "dep"

    Raises
    ------
    InvalidArgument
        For another stream.
    FormatError
        For a video whose name does not follow SKIG's, is out of its range, names another person than its folder, or
        says the same as another one; for a folder without videos of the stream. The file is named.
    """
    if stream not in STREAMS:
        raise InvalidArgument(f"stream is {stream!r}, must be one of {tuple(STREAMS)}")
    found: dict[tuple[int, ...], SkigClip] = {}
    for folder in sorted(root.iterdir()):
        named = _FOLDER.fullmatch(folder.name)
        if named is None or named[2] != stream or not folder.is_dir():
            continue
        for path in sorted(folder.iterdir()):
            if path.suffix.lower() not in VIDEO_SUFFIXES or path.name.startswith(".") or not path.is_file():
                continue
            numbers = _numbers(path, stream, int(named[1]))
            if numbers in found:
                raise FormatError(f"{path}: says the same as {found[numbers].path.name}")
            found[numbers] = _clip(path, numbers)
    if not found:
        raise FormatError(f"{root}: no videos in folders such as subject1_{stream}")
    return [found[numbers] for numbers in sorted(found)]


def _numbers(path: Path, stream: str, subject: int) -> tuple[int, ...]:
    """Person, gesture, background, illumination and pose."""
    named = _NAME.fullmatch(path.stem)
    if named is None or named[1] != STREAMS[stream]:
        wanted = f"{STREAMS[stream]}_person_1_backgroud_1_illumination_1_pose_1_actionType_1"
        raise FormatError(f"{path}: not named as SKIG names its clips, such as {wanted}")
    person, background, illumination, pose, gesture = (int(number) for number in named.groups()[1:])
    if person != subject:
        raise FormatError(f"{path}: shows person {person}, in the folder of subject {subject}")
    for what, number, known in (
        ("background", background, BACKGROUNDS),
        ("illumination", illumination, ILLUMINATIONS),
        ("pose", pose, POSES),
        ("actionType", gesture, GESTURES),
    ):
        _require_known(path, what, number, known)
    return person, gesture, background, illumination, pose


def _require_known(path: Path, what: str, number: int, known: Sequence[str]) -> None:
    if not 1 <= number <= len(known):
        raise FormatError(f"{path}: {what} is {number}, must lie in 1..{len(known)}")


def _clip(path: Path, numbers: tuple[int, ...]) -> SkigClip:
    person, gesture, background, illumination, pose = numbers
    return SkigClip(
        path,
        GESTURES[gesture - 1],
        f"person{person}",
        f"background{background}_illumination{illumination}_pose{pose}",
        {
            "background": BACKGROUNDS[background - 1],
            "illumination": ILLUMINATIONS[illumination - 1],
            "pose": POSES[pose - 1],
        },
    )
