# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Open a simulated robot, and film it."""

from __future__ import annotations

from collections.abc import Callable, Collection
from os import PathLike

import numpy as np

from hri.core.errors import InvalidArgument
from hri.media import write_image, write_video
from hri.robot.control.backend import Robot
from hri.robot.control.filming import Image
from hri.robot.model.joints import HOAP2, JointTable
from hri.robot.model.physics import Physics
from hri.robot.motion.checks import require_safe
from hri.robot.motion.trajectory import Trajectory

BACKENDS = ("pybullet", "kinematic")


def open_robot(
    backend: str = "pybullet",
    gui: bool = False,
    fixed_base: bool = True,
    locked: Collection[str] = (),
    physics: Physics | None = None,
    table: JointTable = HOAP2,
) -> Robot:
    """Start a simulated robot, standing at rest.

    Parameters
    ----------
    backend : "pybullet" or "kinematic"
        With physics, or without (which needs no PyBullet).
    gui : bool
        Show a window and move in real time; only pybullet can.
    fixed_base : bool
        Hold the torso, as for gestures of the arms; kinematic always does.
    locked : collection of joint names
        Held rigidly at rest, which makes pybullet quicker; kinematic takes no notice.
    physics : Physics, optional
        Friction, masses and the like, for pybullet.
    table : JointTable

    Returns
    -------
    Robot
        A context manager; close it when done.

    Raises
    ------
    InvalidArgument
        For another backend, or what the backend cannot do.
    ImportError
        When PyBullet is needed and not installed.
    """
    if backend == "pybullet":
        from hri.robot.simulation.pybullet_backend import PyBulletRobot

        return PyBulletRobot(gui, fixed_base, locked, physics, table)
    if backend == "kinematic":
        if gui:
            raise InvalidArgument("the kinematic backend has no window; use pybullet for gui")
        if not fixed_base:
            raise InvalidArgument("the kinematic backend cannot stand on its feet; use pybullet")
        from hri.robot.simulation.kinematic_backend import KinematicRobot

        return KinematicRobot(table)
    raise InvalidArgument(f"backend is {backend!r}, must be one of {', '.join(BACKENDS)}")


def render_video(
    trajectory: Trajectory,
    path: str | PathLike[str],
    backend: str = "pybullet",
    fps: float = 12.0,
    size: tuple[int, int] = (480, 360),
    progress: Callable[[int, int], None] | None = None,
    table: JointTable = HOAP2,
    fixed_base: bool = True,
) -> int:
    """Film a motion, from its first row on.

    Parameters
    ----------
    trajectory : Trajectory
    path : path-like
        The suffix chooses the format, see `hri.media.write_video`.
    backend : "pybullet" or "kinematic"
    fps : float
    size : width and height in pixels
    progress : callable of (frames made, frames in all), optional
    table : JointTable
    fixed_base : bool
        The torso is held; else the robot stands on its feet, as for walking.

    Returns
    -------
    int
        Number of frames.

    Raises
    ------
    TrajectoryError
        When the check finds errors; nothing is written.
    InvalidArgument, IoError
        As `open_robot` and `hri.media.write_video` do.
    """
    require_safe(trajectory, table)
    frames: list[Image] = []

    def keep(image: Image, time_s: float) -> None:
        frames.append(np.ascontiguousarray(image[:, :, ::-1]))
        if progress is not None:
            progress(len(frames), max(total, len(frames)))

    with open_robot(backend, fixed_base=fixed_base, table=table) as robot:
        total = int(trajectory.duration_s * fps + 1e-6) + 1
        first = trajectory.positions_rad[0].tolist()
        robot.reset(dict(zip(trajectory.joint_names, first, strict=True)), None if fixed_base else "standing")
        robot.perform(trajectory, keep, fps, size)
    write_video(path, frames, fps)
    return len(frames)


def render_still(
    trajectory: Trajectory,
    path: str | PathLike[str],
    at_s: float,
    backend: str = "pybullet",
    size: tuple[int, int] = (480, 360),
    table: JointTable = HOAP2,
) -> None:
    """Take one picture of a motion, the torso held.

    Parameters
    ----------
    trajectory : Trajectory
    path : path-like
        The suffix chooses the format, see `hri.media.write_image`.
    at_s : float
        Time from the motion's first row, within the motion.
    backend : "pybullet" or "kinematic"
    size : width and height in pixels
    table : JointTable

    Raises
    ------
    TrajectoryError
        When the check finds errors; nothing is written.
    InvalidArgument, IoError
        As `open_robot` and `hri.media.write_image` do, and for a time outside the motion.
    """
    if not 0.0 <= at_s <= trajectory.duration_s + 1e-9:
        raise InvalidArgument(f"at_s is {at_s:g}, must be 0 to {trajectory.duration_s:g}, where the motion ends")
    require_safe(trajectory, table)
    with open_robot(backend, table=table) as robot:
        first = trajectory.positions_rad[0].tolist()
        robot.reset(dict(zip(trajectory.joint_names, first, strict=True)))
        images: list[Image] = []

        def keep(image: Image, time_s: float) -> None:
            images.append(image)
            if time_s >= at_s - 1e-9:
                robot.stop()

        robot.perform(trajectory, keep, 1.0 / max(at_s, robot.step_s), size)
    write_image(path, np.ascontiguousarray(images[-1][:, :, ::-1]))
