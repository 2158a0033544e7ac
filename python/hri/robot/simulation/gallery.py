# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A page that shows every gesture: a strip of pictures of its key poses."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator, Mapping
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hri.core.files import make_folder, write_text
from hri.media import write_image, write_video
from hri.robot.control.backend import Robot
from hri.robot.motion.gestures import GESTURE_JOINTS, Gesture, load_gestures
from hri.robot.simulation.run import open_robot

PAGE = "gallery.md"
IMAGES = "images/gallery"
_MOST_POSES = 5
_SIZE_PX = (230, 230)
_ROWS = (0.04, 0.70)  # of the picture: raised hands to hips
_VIDEO_FPS = 12.0
_HEAD = """# Gestures

What HOAP-2 shows for a digit or a word, as `hri robot play NAME` carries it out; the pictures follow one another from
left to right, the robot seen from the front. The poses are in `hri/robot/motion/gestures.toml`;
`hri robot gallery docs` makes this page anew.

HOAP-2 has no fingers and one joint for each hand, so a sign is shown by where the hands are and how they move. Digits,
which people show with fingers, are an alphabet of arms. The last column says what else of a sign is missing.

| name | what the robot does | pictures | not shown |
|---|---|---|---|
"""


def write_gallery(
    directory: str | PathLike[str],
    videos: bool = False,
    backend: str = "kinematic",
    progress: Callable[[int, int], None] | None = None,
) -> Path:
    """Write gallery.md and a picture of every gesture, in images/gallery, below a folder.

    Parameters
    ----------
    directory : path-like
        Made if it is not there.
    videos : bool
        Also write a video of each gesture beside its picture (.webm).
    backend : "kinematic" or "pybullet"
    progress : callable of (gestures done, gestures in all), optional

    Returns
    -------
    Path
        Of the page.
    """
    gestures = load_gestures()
    page = Path(directory) / PAGE
    images = make_folder(Path(directory) / IMAGES)
    with open_robot(backend) as robot:
        for done, gesture in enumerate(gestures.values(), start=1):
            strip = [_picture(robot, pose) for pose in shown_poses(gesture)]
            write_image(images / f"{gesture.name}.jpg", np.hstack(strip))
            if videos:
                write_video(images / f"{gesture.name}.webm", _film(robot, gesture), _VIDEO_FPS)
            if progress is not None:
                progress(done, len(gestures))
    write_text(page, gallery_page(gestures))
    return page


def gallery_page(gestures: Mapping[str, Gesture]) -> str:
    """Text of the page; its last line holds a digest of all motions, so that a stale page can be detected."""
    rows = [
        f"| `{gesture.name}` | {gesture.meaning} | ![{gesture.name}]({IMAGES}/{gesture.name}.jpg) | {gesture.lacks} |\n"
        for gesture in gestures.values()
    ]
    return _HEAD + "".join(rows) + f"\n<!-- motions: {motions_digest(gestures)} -->\n"


def motions_digest(gestures: Mapping[str, Gesture]) -> str:
    """Of all key poses to a tenth of a degree and their times."""
    digest = hashlib.sha256()
    for name, gesture in gestures.items():
        tenths = np.rint(np.degrees(gesture.poses_rad) * 10.0).astype("<i4")
        digest.update(name.encode() + tenths.tobytes() + np.rint(gesture.times_s * 100.0).astype("<i4").tobytes())
    return digest.hexdigest()[:16]


def shown_poses(gesture: Gesture) -> NDArray[np.float64]:
    """The first five key poses at most, the rest at begin and end left out; shape (poses, joints)."""
    poses = gesture.poses_rad
    changed = np.append(True, np.abs(np.diff(poses, axis=0)).max(axis=1) > 1e-9)
    poses = poses[changed]
    inner = poses[1:-1] if len(poses) > 2 else poses[:1]
    return inner[:_MOST_POSES]


def _picture(robot: Robot, pose: NDArray[np.float64]) -> NDArray[np.uint8]:
    robot.reset(dict(zip(GESTURE_JOINTS, pose.tolist(), strict=True)))
    image = robot.render(*_SIZE_PX)
    rows = slice(round(_ROWS[0] * len(image)), round(_ROWS[1] * len(image)))
    return np.ascontiguousarray(image[rows, :, ::-1])


def _film(robot: Robot, gesture: Gesture) -> Iterator[NDArray[np.uint8]]:
    trajectory = gesture.trajectory()
    for frame in range(int(trajectory.duration_s * _VIDEO_FPS + 1e-6) + 1):
        yield _picture(robot, trajectory.at(frame / _VIDEO_FPS))
