# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What every robot can do, whichever backend moves it."""

from __future__ import annotations

import threading
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from types import TracebackType
from typing import Self

import numpy as np
from numpy.typing import NDArray

from hri.errors import InvalidArgument
from hri.robot.checks import require_safe
from hri.robot.gestures import minimum_jerk
from hri.robot.joints import HOAP2, JointTable
from hri.robot.trajectory import Trajectory

Image = NDArray[np.uint8]
OnFrame = Callable[[Image, float], None]

BRAKE_S = 0.15
_NEAR_RAD = 0.01


class Robot(ABC):
    """A robot that carries out trajectories; `hri.robot.open_robot` makes one.

    One thread uses it, except for `stop`, which any thread, and `on_frame`, may call. It is a
    context manager that closes itself.
    """

    table: JointTable = HOAP2
    step_s: float = 0.001

    def __init__(self) -> None:
        self._stop = threading.Event()

    def perform(
        self,
        trajectory: Trajectory,
        on_frame: OnFrame | None = None,
        fps: float = 12.0,
        size: tuple[int, int] = (480, 360),
    ) -> bool:
        """Carry out a trajectory; from where it stands the robot first goes to its first row.

        Parameters
        ----------
        trajectory : Trajectory
            Checked as a whole before anything moves.
        on_frame : callable of (image, time_s), optional
            Gets a picture, as `render` gives it, `fps` times per second of simulated time.
        fps : float
            Above 0.
        size : width and height of the pictures in pixels

        Returns
        -------
        bool
            False when `stop` ended it.

        Raises
        ------
        TrajectoryError
            When the check finds errors; the robot has not moved.
        """
        if not 0.0 < fps < np.inf:
            raise InvalidArgument(f"fps is {fps}, must be above 0 and finite")
        require_safe(trajectory, self.table)
        self._stop.clear()
        names = trajectory.joint_names
        approach = self._approach(trajectory)
        approach_s = approach.duration_s if approach else 0.0
        steps = round((approach_s + trajectory.duration_s) / self.step_s)
        frames = 0
        previous = target = self._positions_of(names)
        for step in range(steps + 1):
            time_s = step * self.step_s
            if on_frame is not None and time_s * fps >= frames - 1e-9:
                on_frame(self.render(*size), time_s)
                frames += 1
            if self._stop.is_set():
                self._brake(names, target, (target - previous) / self.step_s)
                return False
            previous = target
            target = approach.at(time_s) if approach and time_s < approach_s else trajectory.at(time_s - approach_s)
            self._command(dict(zip(names, target.tolist(), strict=True)))
        return True

    def stop(self) -> None:
        """End the motion under way: the joints slow down within 0.15 s, then hold."""
        self._stop.set()

    @abstractmethod
    def reset(self, positions_rad: Mapping[str, float]) -> None:
        """Put joints into a position at once, without moving there; a simulation can."""

    @abstractmethod
    def render(self, width: int = 480, height: int = 360) -> Image:
        """Take a picture from the front: RGB, uint8, shape (height, width, 3)."""

    @abstractmethod
    def joint_positions_rad(self) -> dict[str, float]:
        """Where the joints are, by name."""

    @abstractmethod
    def close(self) -> None:
        """Let go of the simulation; the robot cannot be used any more. May be called twice."""

    @abstractmethod
    def _command(self, positions_rad: Mapping[str, float]) -> None:
        """Send joints to positions and let `step_s` go by."""

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()

    def _positions_of(self, names: tuple[str, ...]) -> NDArray[np.float64]:
        positions = self.joint_positions_rad()
        return np.array([positions[name] for name in names])

    def _approach(self, trajectory: Trajectory) -> Trajectory | None:
        """Go to the first row at no more than half the motors' speed."""
        keys = np.stack((self._positions_of(trajectory.joint_names), trajectory.positions_rad[0]))
        distance = float(np.abs(keys[1] - keys[0]).max())
        if distance < _NEAR_RAD:
            return None
        duration_s = max(0.2, 1.875 * distance / (0.5 * self.table.max_speed_rad_s))
        times_s = 0.01 * np.arange(int(duration_s / 0.01) + 2, dtype=np.float64)
        positions = minimum_jerk(np.array([0.0, times_s[-1]]), keys, times_s)
        return Trajectory(trajectory.joint_names, 0.01, positions)

    def _brake(
        self,
        names: tuple[str, ...],
        positions: NDArray[np.float64],
        speeds: NDArray[np.float64],
    ) -> None:
        """Bring the commanded speed to 0 evenly, inside the limits."""
        limits = self.table.limits_rad[[self.table.index(name) for name in names]]
        most = self.table.max_speed_rad_s
        speeds = np.clip(speeds, -most, most)
        low = np.minimum(limits[:, 0], positions)
        high = np.maximum(limits[:, 1], positions)
        for step in range(1, round(BRAKE_S / self.step_s) + 1):
            time_s = step * self.step_s
            target = positions + speeds * (time_s - time_s**2 / (2.0 * BRAKE_S))
            target = np.clip(target, low, high)
            self._command(dict(zip(names, target.tolist(), strict=True)))
