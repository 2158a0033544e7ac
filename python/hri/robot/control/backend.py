# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What every robot can do, whichever backend moves it."""

from __future__ import annotations

import threading
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from types import TracebackType
from typing import Self

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import Error, InvalidArgument
from hri.robot.control.braking import brake
from hri.robot.control.filming import Film, Image, OnFrame
from hri.robot.control.playing import Playback, approach_to
from hri.robot.control.state import Contact, Event, MotionLog, RobotState, SelfContact, SelfContacts
from hri.robot.control.stopping import StopLatch
from hri.robot.control.straining import PATIENCE_S, Straining
from hri.robot.model.joints import HOAP2, JointTable
from hri.robot.model.postures import require_posture
from hri.robot.motion.checks import LIMIT_TOLERANCE_RAD, require_safe, require_safe_approach, require_within
from hri.robot.motion.trajectory import Trajectory

FALL_TILT_DEG = 60.0
UPRIGHT_TILT_DEG = 20.0
_UPRIGHT_S = 0.5
_HOLD_AFTER_FALL_S = 1.0
_LOOK_S = 0.01
_FEEL_S = 0.005
_SAME_RAD = 1e-9
_MOST_PREPARED = 256
_TOLERANCES_RAD = np.array([-LIMIT_TOLERANCE_RAD, LIMIT_TOLERANCE_RAD])


class Robot(ABC):
    """A robot that carries out trajectories; `hri.robot.open_robot` makes one.

    STOP latches: after `stop` no motion begins until `resume`. Any thread, `on_frame` and a signal handler may call
    these two; everything else is for one thread at a time, and a second motion during one is refused. A robot is a
    context manager that closes itself. A robot of one's own is a subclass with the abstract methods.

    Parameters
    ----------
    table : JointTable

    Attributes
    ----------
    step_s : float
        Time from one command to the next.
    events : list of Event
        What ended motions, and joints that could not follow, oldest first.
    on_command : callable of (time_s, positions_rad), optional
        Called before every command with the robot's time and where all joints are sent, in the thread that moves; must
        not raise. It may wait: the command is sent when it returns.
    """

    step_s: float = 0.001

    def __init__(self, table: JointTable = HOAP2) -> None:
        self.table = table
        self.events: list[Event] = []
        self.on_command: Callable[[float, Mapping[str, float]], None] | None = None
        self._prepared: dict[Trajectory, NDArray[np.float64]] = {}
        self._touched = SelfContacts()
        self._strain = Straining()
        self._stop = StopLatch()
        self._moves = threading.Lock()
        self._mover: int | None = None
        self._closed = False
        self._link_lost = False
        self._commanded: dict[str, float] = {}
        self._upright_s = 0.0
        self._steps = 0

    @property
    def time_s(self) -> float:
        """The robot's own time since it was opened."""
        return self._steps * self.step_s

    @property
    def stopped(self) -> bool:
        """Whether `stop` was called, and `resume` not since."""
        return self._stop.engaged

    @property
    def self_contacts(self) -> list[SelfContact]:
        """Pairs of links that touched one another in motions and while the robot held, looked at every 5 ms."""
        return self._touched.found()

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
            False when `stop` or a fall ended it, and, with nothing moved, when the robot was stopped before: `events`
            says which. The joints then hold. They also come to rest before an exception of `on_frame` goes on.

        Raises
        ------
        TrajectoryError
            When the check finds errors in the motion or on the way to its first row, the joints that it does not name
            being where they are; the robot has not moved.
        InvalidArgument
            When this robot cannot make the motion, as one of its joints is locked; it has not moved.
        Error
            When the robot is closed, or carries out another motion. What the link to a robot raises when it fails in
            mid-motion comes through; the robot is then stopped.
        """
        film = Film(on_frame, fps, size)
        stops = self._stop.mark()  # before the check, which takes a while: a stop during it concerns this motion
        with self._one_at_a_time():
            if self._stop.engaged:
                self._event("stop", "not begun: stopped until resume()", log)
                return False
            why_not = self._why_not(trajectory)
            if why_not:
                raise InvalidArgument(why_not)
            if self._link_lost:
                self._commanded.update(self._joint_positions())
                self._link_lost = False
            begin, approach = self._checked(trajectory)
            return self._play(Playback(begin, approach, trajectory), stops, film, log)

    def prepare(self, trajectory: Trajectory) -> None:
        """Check a motion, so that `perform` begins it at once where all joints are still where they are now.

        Parameters
        ----------
        trajectory : Trajectory

        Raises
        ------
        TrajectoryError, InvalidArgument, Error
            As of `perform`.
        """
        with self._one_at_a_time():
            why_not = self._why_not(trajectory)
            if why_not:
                raise InvalidArgument(why_not)
            self._checked(trajectory)

    def hold(self, duration_s: float, log: MotionLog | None = None) -> bool:
        """Keep the joints where they were sent for a time, also when stopped; False when the robot falls meanwhile.

        Parameters
        ----------
        duration_s : float
            0 or more, finite.
        log : MotionLog, optional

        Raises
        ------
        Error
            When the robot is closed, or carries out a motion.
        """
        if not 0.0 <= duration_s < np.inf:
            raise InvalidArgument(f"duration_s is {duration_s}, must be 0 or more and finite")
        with self._one_at_a_time():
            return self._hold(duration_s, log)

    def stop(self) -> None:
        """Stop, and stay stopped until `resume`.

        The joints of a motion under way slow down within their limits, then hold. Motions that are asked for afterwards
        do not begin, and `reset` is refused. May be called at any time, by any thread and by signal handlers.
        """
        self._stop.engage()

    def end_motion(self) -> None:
        """End the motion under way as `stop` does; others may begin, unless the robot is stopped. By any thread."""
        self._stop.interrupt()

    def resume(self) -> None:
        """Allow new motions; the one that `stop` ended does not go on. May be called by any thread."""
        self._stop.release()

    def reset(self, positions_rad: Mapping[str, float], posture: str | None = None) -> None:
        """Put joints into a position at once, without moving there; a simulation can.

        Parameters
        ----------
        positions_rad : mapping of joint name to float
            Within the joints' limits.
        posture : "standing", "back" or "front", optional
            Also put a robot that is not held onto the floor, on its soles or lying, and let it settle for a second.

        Raises
        ------
        InvalidArgument
            For a joint that the robot does not have, a position that is not finite or not within the joint's limits,
            and another posture; nothing has moved.
        Error
            When the robot is stopped, closed, or carries out a motion.
        """
        for name, position in positions_rad.items():
            require_within(self.table[name], position)
        if posture is not None:
            require_posture(posture)
        with self._one_at_a_time():
            if self._stop.engaged:
                raise Error("the robot is stopped until resume()")
            before = dict(self._commanded)
            self._commanded.update(positions_rad)
            try:
                self._place(positions_rad, posture)
            except BaseException:
                self._commanded = before
                raise
            self._upright_s = 0.0

    def render(self, width: int = 480, height: int = 360) -> Image:
        """Take a picture from the front: RGB, uint8, shape (height, width, 3)."""
        self._require_open()
        return self._render(width, height)

    def state(self) -> RobotState:
        """What the robot is doing now."""
        self._require_open()
        return self._state()

    def joint_positions_rad(self) -> dict[str, float]:
        """Where the joints are, by name."""
        self._require_open()
        return self._joint_positions()

    def close(self) -> None:
        """Let go of the robot, which cannot be used any more; a motion of another thread is stopped first.

        May be called twice.

        Raises
        ------
        Error
            When `on_frame` calls it.
        """
        if self._mover == threading.get_ident():
            raise Error("a robot cannot be closed during its motion: stop it")
        self._stop.engage()
        with self._moves:
            if not self._closed:
                self._closed = True
                self._close()

    @abstractmethod
    def _command(self, positions_rad: Mapping[str, float]) -> None:
        """Send joints to positions, the others as before, and let `step_s` go by."""

    @abstractmethod
    def _state(self) -> RobotState:
        """Do what `state` says."""

    @abstractmethod
    def _place(self, positions_rad: Mapping[str, float], posture: str | None) -> None:
        """Do what `reset` says; names, positions and posture are known to be valid."""

    @abstractmethod
    def _render(self, width: int, height: int) -> Image:
        """Do what `render` says."""

    @abstractmethod
    def _close(self) -> None:
        """Do what `close` says; called once."""

    def _joint_positions(self) -> dict[str, float]:
        """Do what `joint_positions_rad` says."""
        return self._state().positions_rad

    def _why_not(self, trajectory: Trajectory) -> str:
        """Why this robot cannot make a motion that its table allows; "" when it can."""
        return ""

    def _tilt_deg(self) -> float:
        """Angle between the base's z axis and the vertical; 0 for a robot that cannot fall or has no such sensor."""
        return 0.0

    def _on_feet_alone(self) -> bool:
        """Whether nothing but feet touches the floor; True for a robot without contact sensors."""
        return True

    def _touching(self) -> Iterable[Contact]:
        """Links that touch one another now; none for a robot without physics or such sensors."""
        return ()

    def _straining(self) -> Iterable[str]:
        """Joints at their greatest torque that are not where they were sent; none without such sensors."""
        return ()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()

    def _require_open(self) -> None:
        if self._closed:
            raise Error("the robot is closed")

    @contextmanager
    def _one_at_a_time(self) -> Iterator[None]:
        """Keep a second motion, of this thread or another, from sending joints elsewhere."""
        if not self._moves.acquire(blocking=False):
            raise Error("the robot carries out a motion: one at a time")
        try:
            self._mover = threading.get_ident()
            self._require_open()
            yield
        finally:
            self._mover = None
            self._moves.release()

    def _checked(self, trajectory: Trajectory) -> tuple[NDArray[np.float64], Trajectory | None]:
        """Where the motion's joints are, and the way to its first row; raises TrajectoryError for what is not safe."""
        positions = self._positions_sent(self.table.names)
        others = dict(zip(self.table.names, positions.tolist(), strict=True))
        begin = np.array([others.get(name, np.nan) for name in trajectory.joint_names])
        before = self._prepared.get(trajectory)
        safe = before is not None and bool(np.abs(before - positions).max() <= _SAME_RAD)
        if not safe:
            require_safe(trajectory, self.table, others_rad=others)
        approach = approach_to(trajectory, begin, self.table)
        if not safe:
            if approach is not None:
                require_safe_approach(approach, self.table, others)
            self._prepared.pop(trajectory, None)
            if len(self._prepared) >= _MOST_PREPARED:
                del self._prepared[next(iter(self._prepared))]
            self._prepared[trajectory] = positions
        return begin, approach

    def _play(self, playback: Playback, stops: object, film: Film, log: MotionLog | None) -> bool:
        names = playback.trajectory.joint_names
        before = now = playback.begin_rad.tolist()
        fallen = False
        try:
            for step, row in enumerate(playback.rows(self.step_s)):
                film.show(self._render, step * self.step_s - playback.lead_s, playback.duration_s)
                fallen = self._fallen()
                if fallen or self._stop.since(stops):
                    break
                before, now = now, row
                self._send(dict(zip(names, row, strict=True)), log)
            else:
                return True
        except BaseException:
            if not self._link_lost:
                self._brake(names, before, now, log)
            raise
        if fallen:
            self._event("fall", f"the base leans by {self._tilt_deg():.0f} degrees", log)
            self._upright_s = 0.0
        else:
            self._event("stop", "stopped on request", log)
        self._brake(names, before, now, log)
        if fallen:
            self._hold(_HOLD_AFTER_FALL_S, log)
        return False

    def _brake(self, names: tuple[str, ...], before: list[float], now: list[float], log: MotionLog | None) -> None:
        """Bring joints to rest that were sent to these two positions, a step apart."""
        limits = self.table.limits_rad[[self.table.index(name) for name in names]] + _TOLERANCES_RAD
        positions = np.array(now)
        speeds = (positions - np.array(before)) / self.step_s
        most = self.table.max_acceleration_rad_s2
        for row in brake(positions, speeds, limits, self.table.max_speed_rad_s, most, self.step_s).tolist():
            self._send(dict(zip(names, row, strict=True)), log)

    def _hold(self, duration_s: float, log: MotionLog | None) -> bool:
        for _ in range(round(duration_s / self.step_s)):
            if self._fallen():
                self._event("fall", "fell while holding", log)
                return False
            self._send({}, log)
        return True

    def _send(self, positions_rad: dict[str, float], log: MotionLog | None) -> None:
        self._commanded.update(positions_rad)
        if self.on_command is not None:
            self.on_command(self.time_s, self._commanded)
        try:
            self._command(positions_rad)
        except Exception as error:
            self._link_lost = True
            self._stop.engage()
            self._event("fault", f"stopped, as the robot does not take commands: {error}", log)
            raise
        self._steps += 1
        if self._steps % max(1, round(_FEEL_S / self.step_s)) == 0:
            for contact in self._touching():
                self._touched.add(contact, self.time_s)
                if log is not None:
                    log.touched.add(contact, self.time_s)
            for name in self._strain.late(self._straining(), self.time_s):
                self._event("lag", f"{name} has not followed for {PATIENCE_S:g} s, at its greatest torque", log)
        if log is not None and self._steps % max(1, round(log.period_s / self.step_s)) == 0:
            log.states.append(self._state())

    def _positions_sent(self, names: tuple[str, ...]) -> NDArray[np.float64]:
        missing = [name for name in names if name not in self._commanded]
        if missing:
            there = self._joint_positions()
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

    def _event(self, kind: str, message: str, log: MotionLog | None) -> None:
        event = Event(self.time_s, kind, message)
        self.events.append(event)
        if log is not None:
            log.events.append(event)
