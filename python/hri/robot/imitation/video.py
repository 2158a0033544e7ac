# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The track and the robot side by side."""

from __future__ import annotations

from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.optional import import_opencv
from hri.media import write_video
from hri.robot.imitation.body import NOSE_ABOVE_SHOULDERS, SHOULDER_WIDTH
from hri.robot.imitation.imitate import Imitation
from hri.robot.imitation.tracks import HandTrack, bridge
from hri.robot.model.arm import SIDES
from hri.robot.simulation import scene
from hri.robot.simulation.run import open_robot

Image = NDArray[np.uint8]
Floats = NDArray[np.float64]

_HAND_COLOURS = ((45, 125, 240), (210, 120, 35))  # BGR: left, right
_PALE = (215, 205, 195)
_INK = (90, 80, 70)
_TRAIL_FRAMES = 12
_HEAD = 0.045  # radius as a share of the height
_VIEW = 0.70  # of the person's height fits into the picture's height
_SMOOTH = 16  # lines are drawn to 1/16 px
_LINE_AA = 16


def film_imitation(
    track: HandTrack,
    imitation: Imitation,
    path: str | PathLike[str],
    backend: str = "kinematic",
    fps: float = 15.0,
    size: tuple[int, int] = (360, 360),
) -> int:
    """Film the track's hands, as the camera sees the person, beside the robot seen from the front.

    Both are at the same place of the track at all times: where the robot is slower, the person is shown slower.

    Parameters
    ----------
    track, imitation : what was imitated and what came of it
    path : path-like
        See `hri.media.write_video` for its suffixes.
    backend : "kinematic" or "pybullet"
    fps : float
    size : width and height of each half in pixels

    Returns
    -------
    int
        Number of frames.
    """
    scene.check_size(*size)
    frames: list[Image] = []
    person = _Person(track, imitation, size)

    def keep(image: Image, time_s: float) -> None:
        frame = float(np.interp(time_s, imitation.frame_times_s, np.arange(len(track))))
        frames.append(np.hstack((person.draw(frame), image[:, :, ::-1])))

    with open_robot(backend) as robot:
        names = imitation.trajectory.joint_names
        robot.reset(dict(zip(names, imitation.trajectory.positions_rad[0].tolist(), strict=True)))
        robot.perform(imitation.trajectory, keep, fps, size)
    write_video(path, frames, fps)
    return len(frames)


class _Person:
    """Draws a person of whom only the hands and the nose or shoulders are known."""

    def __init__(self, track: HandTrack, imitation: Imitation, size: tuple[int, int]) -> None:
        self._cv2: Any = import_opencv("to draw the track")
        height = imitation.targets.height_px
        if track.nose is not None:
            nose, _ = bridge(track.nose, "nose")
            centre = nose + np.array((0.0, NOSE_ABOVE_SHOULDERS * height))
        else:
            assert track.shoulders is not None  # a track has one of both
            centre = bridge(track.shoulders, "shoulders")[0].mean(axis=1)
        self._size = size
        self._zoom = size[1] / (_VIEW * height)
        self._height = height
        self._centre = centre
        middle = np.median(centre, axis=0)
        self._corner = middle - (0.5 * size[0] / self._zoom, 0.34 * _VIEW * height)
        self._hands = [getattr(track, side) for side in SIDES]

    def draw(self, frame: float) -> Image:
        cv2 = self._cv2
        image = np.ascontiguousarray(scene.backdrop(*self._size)[:, :, ::-1])
        index = min(round(frame), len(self._centre) - 1)
        centre, height = self._centre[index], self._height
        half = np.array([0.5 * SHOULDER_WIDTH * height, 0.0])
        head = centre - (0.0, (NOSE_ABOVE_SHOULDERS + 0.01) * height)
        radius = round(_HEAD * height * self._zoom * _SMOOTH)
        body = np.array([centre - half, centre + half, centre + (0.4 * half) + (0, 0.3 * height)])
        outline = np.vstack((body, centre - (0.4 * half) + (0, 0.3 * height)))
        cv2.fillPoly(image, [self._points(outline)], _PALE, _LINE_AA, 4)
        cv2.circle(image, self._points(head[np.newaxis])[0].tolist(), round(1.35 * radius), _PALE, -1, _LINE_AA, 4)
        for points, colour in zip(self._hands, _HAND_COLOURS, strict=True):
            trail = points[max(0, index - _TRAIL_FRAMES) : index + 1]
            trail = trail[np.isfinite(trail).all(axis=1)]
            if len(trail) > 1:
                cv2.polylines(image, [self._points(trail)], False, colour, 2, _LINE_AA, 4)
            if np.isfinite(points[index]).all():
                spot = self._points(points[index][np.newaxis])[0].tolist()
                cv2.circle(image, spot, round(0.9 * radius), colour, -1, _LINE_AA, 4)
                cv2.circle(image, spot, round(0.9 * radius), _INK, 1, _LINE_AA, 4)
        return image

    def _points(self, pixels: Floats) -> NDArray[np.int32]:
        return np.rint((pixels - self._corner) * self._zoom * _SMOOTH).astype(np.int32)
