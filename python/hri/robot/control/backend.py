# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What every robot can do, whichever backend moves it."""

from __future__ import annotations

import threading
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping
from types import TracebackType
from typing import Self

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument
from hri.robot.control.braking import brake
from hri.robot.control.state import Event, MotionLog, RobotState
from hri.robot.model.joints import HOAP2, JointTable
from hri.robot.motion.checks import SPEED_WINDOW_S, require_safe
from hri.robot.motion.gestures import minimum_jerk
from hri.robot.motion.trajectory import Trajectory

Image = NDArray[np.uint8]
OnFrame = Callable[[Image, float], None]

FALL_TILT_DEG = 60.0
UPRIGHT_TILT_DEG = 20.0
_UPRIGHT_S = 0.5
_HOLD_AFTER_FALL_S = 1.0
_LOOK_S = 0.01
_NEAR_RAD = 0.01
_CHUNK = 512


class Robot(ABC):
    """A robot that carries out trajectories; `hri.robot.open_robot` makes one.

    One thread uses it, except for `stop`, which any thread, and `on_frame`, may call. It is a
    context manager that closes itself. A robot of one's own is a subclass with the abstract methods.

    Parameters
    ----------
    table : JointTable

    Attributes
    ----------
    step_s : float
        Time from one command to the next.
    events : list of Event
        What ended motions, oldest first.
    """

    step_s: float = 0.001

    def __init__(self, table: JointTable = HOAP2) -> None:
        self.table = table
        self.events: list[Event] = []
        self._stop = threading.Event()
        self._commanded: dict[str, float] = {}
        self._upright_s = 0.0
        self._steps = 0

    @property
    def time_s(self) -> float:
        """The robot's own time since it was opened."""
        return self._steps * self.step_s

    def perform(
        self,
        trajectory: Trajectory,
        on_frame: OnFrame | None = None,
        fps: float = 12.0,
        size: tuple[int, int] = (480, 360),
        log: MotionLog | None = None,
    ) -> bool:
        """Carry out a trajectory; from where it was last sent the robot first goes to its first row.

        Parameters
        ----------
        trajectory : Trajectory
            Checked as a whole before anything moves.
        on_frame : callable of (image, time_s), optional
            Gets a picture, as `render` gives it, `fps` times per second of simulated time.
        fps : float
            Above 0.
        size : width and height of the pictures in pixels
        log : MotionLog, optional
            Gets states and events.

        Returns
        -------
        bool
            False when `stop` or a fall ended it: `events` says which. The joints then hold.

        Raises
        ------
        TrajectoryError
            When the check finds errors; the robot has not moved.
        """
        if not 0.0 < fps < np.inf:
            raise InvalidArgument(f"fps is {fps}, must be above 0 and finite")
        self._stop.clear()  # before the check, which takes a while: a stop during it concerns this motion
        require_safe(trajectory, self.table)
        names = trajectory.joint_names
        begin = self._positions_sent(names)
        approach = self._approach(trajectory, begin)
        approach_s = approach.duration_s if approach else 0.0

        def positions_at(times_s: NDArray[np.float64]) -> NDArray[np.float64]:
            after = trajectory.at(times_s - approach_s)
            if approach is None or times_s[0] >= approach_s:
                return after
            return np.where((times_s < approach_s)[:, np.newaxis], approach.at(times_s), after)

        steps = round((approach_s + trajectory.duration_s) / self.step_s) + 1
        frames = 0
        start = self._steps
        for row in _rows(positions_at, steps, self.step_s):
            time_s = (self._steps - start) * self.step_s
            if on_frame is not None and time_s * fps >= frames - 1e-9:
                on_frame(self.render(*size), time_s)
                frames += 1
            fallen = self._fallen()
            if fallen or self._stop.is_set():
                now = self._positions_sent(names)
                window_s = min(SPEED_WINDOW_S, time_s)
                before = positions_at(np.array([time_s - self.step_s - window_s]))[0] if window_s > 0.0 else now
                speeds = (now - before) / max(window_s, self.step_s)
                self._end(names, now, speeds, fallen, log)
                return False
            self._send(dict(zip(names, row, strict=True)), log)
        return True

    def hold(self, duration_s: float, log: MotionLog | None = None) -> bool:
        """Keep the joints where they were sent for a time; False when the robot falls meanwhile."""
        for _ in range(round(duration_s / self.step_s)):
            if self._fallen():
                self._event("fall", "fell while holding", log)
                return False
            self._send({}, log)
        return True

    def stop(self) -> None:
        """End the motion under way: the joints slow down within their limits, then hold."""
        self._stop.set()

    def reset(self, positions_rad: Mapping[str, float], posture: str | None = None) -> None:
        """Put joints into a position at once, without moving there; a simulation can.

        Parameters
        ----------
        positions_rad : mapping of joint name to float
        posture : "standing", "back" or "front", optional
            Also put a robot that is not held onto the floor, on its soles or lying, and let it settle for a second.
        """
        for name in positions_rad:
            self.table.index(name)
        self._commanded.update(positions_rad)
        self._upright_s = 0.0
        self._place(positions_rad, posture)

    @abstractmethod
    def render(self, width: int = 480, height: int = 360) -> Image:
        """Take a picture from the front: RGB, uint8, shape (height, width, 3)."""

    @abstractmethod
    def state(self) -> RobotState:
        """What the robot is doing now."""

    @abstractmethod
    def close(self) -> None:
        """Let go of the robot, which cannot be used any more. May be called twice."""

    def joint_positions_rad(self) -> dict[str, float]:
        """Where the joints are, by name."""
        return self.state().positions_rad

    @abstractmethod
    def _command(self, positions_rad: Mapping[str, float]) -> None:
        """Send joints to positions, the others as before, and let `step_s` go by."""

    @abstractmethod
    def _place(self, positions_rad: Mapping[str, float], posture: str | None) -> None:
        """Do what `reset` says; the names are known to be joints."""

    def _tilt_deg(self) -> float:
        """Angle between the base's z axis and the vertical; 0 for a robot that cannot fall or has no such sensor."""
        return 0.0

    def _on_feet_alone(self) -> bool:
        """Whether nothing but feet touches the floor; True for a robot without contact sensors."""
        return True

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()

    def _send(self, positions_rad: dict[str, float], log: MotionLog | None) -> None:
        self._commanded.update(positions_rad)
        self._command(positions_rad)
        self._steps += 1
        if log is not None and self._steps % max(1, round(log.period_s / self.step_s)) == 0:
            log.states.append(self.state())

    def _positions_sent(self, names: tuple[str, ...]) -> NDArray[np.float64]:
        missing = [name for name in names if name not in self._commanded]
        if missing:
            there = self.joint_positions_rad()
            self._commanded.update((name, there[name]) for name in missing)
        return np.array([self._commanded[name] for name in names])

    def _fallen(self) -> bool:
        """Whether a robot that has stood upright for a while does so no more."""
        every = max(1, round(_LOOK_S / self.step_s))
        if self._steps % every != 0:
            return False
        tilt, on_feet = self._tilt_deg(), self._on_feet_alone()
        if self._upright_s < _UPRIGHT_S:
            upright = tilt < UPRIGHT_TILT_DEG and on_feet
            self._upright_s = self._upright_s + every * self.step_s if upright else 0.0
            return False
        return tilt > FALL_TILT_DEG or (tilt > UPRIGHT_TILT_DEG and not on_feet)

    def _end(
        self,
        names: tuple[str, ...],
        positions: NDArray[np.float64],
        speeds: NDArray[np.float64],
        fallen: bool,
        log: MotionLog | None,
    ) -> None:
        if fallen:
            self._event("fall", f"the base leans by {self._tilt_deg():.0f} degrees", log)
            self._upright_s = 0.0
        else:
            self._event("stop", "stopped on request", log)
        limits = self.table.limits_rad[[self.table.index(name) for name in names]]
        acceleration = self.table.max_acceleration_rad_s2
        for row in brake(positions, speeds, limits, self.table.max_speed_rad_s, acceleration, self.step_s).tolist():
            self._send(dict(zip(names, row, strict=True)), log)
        if fallen:
            self.hold(_HOLD_AFTER_FALL_S, log)

    def _event(self, kind: str, message: str, log: MotionLog | None) -> None:
        event = Event(self.time_s, kind, message)
        self.events.append(event)
        if log is not None:
            log.events.append(event)

    def _approach(self, trajectory: Trajectory, begin: NDArray[np.float64]) -> Trajectory | None:
        """Go to the first row at no more than half the motors' speed and acceleration."""
        keys = np.stack((begin, trajectory.positions_rad[0]))
        distance = float(np.abs(keys[1] - keys[0]).max())
        if distance < _NEAR_RAD:
            return None
        fastest_s = 1.875 * distance / (0.5 * self.table.max_speed_rad_s)
        gentlest_s = np.sqrt(5.78 * distance / (0.5 * self.table.max_acceleration_rad_s2))
        duration_s = max(0.2, fastest_s, gentlest_s)
        times_s = 0.01 * np.arange(int(duration_s / 0.01) + 2, dtype=np.float64)
        positions = minimum_jerk(np.array([0.0, times_s[-1]]), keys, times_s)
        return Trajectory(trajectory.joint_names, 0.01, positions)


def _rows(
    positions_at: Callable[[NDArray[np.float64]], NDArray[np.float64]], steps: int, step_s: float
) -> Iterator[list[float]]:
    """Positions at every step, worked out in chunks: long motions need no memory, short ones no time."""
    for first in range(0, steps, _CHUNK):
        times_s = step_s * np.arange(first, min(first + _CHUNK, steps), dtype=np.float64)
        yield from positions_at(times_s).tolist()
