# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What every robot can do, whichever backend moves it."""

from __future__ import annotations

import threading
from abc import abstractmethod
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from types import TracebackType
from typing import Self

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import Error, InvalidArgument
from hri.robot.control.commanding import HOLD_AFTER_FALL_S, CommandedJoints
from hri.robot.control.filming import Film, Image, OnFrame
from hri.robot.control.following import JointFollower, clear_of_itself
from hri.robot.control.playing import Playback, approach_to
from hri.robot.control.state import MotionLog, RobotState
from hri.robot.model.joints import HOAP2, JointTable
from hri.robot.model.postures import require_posture
from hri.robot.motion.checks import require_safe, require_safe_approach, require_within
from hri.robot.motion.trajectory import Trajectory

_SAME_RAD = 1e-9
_MOST_PREPARED = 256
_SHARE = 0.99  # of speed and acceleration; the rest is for rounding


class Robot(CommandedJoints):
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

    def __init__(self, table: JointTable = HOAP2) -> None:
        super().__init__(table)
        self._prepared: dict[Trajectory, NDArray[np.float64]] = {}
        self._moves = threading.Lock()
        self._mover: int | None = None
        self._closed = False

    @property
    def stopped(self) -> bool:
        """Whether `stop` was called, and `resume` not since."""
        return self._stop.engaged

    @property
    def on_feet(self) -> bool:
        """Whether it stands on its feet, free to walk and to fall; False where its torso is held."""
        return False

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
        with self._begun(log) as may_move:
            if not may_move:
                return False
            why_not = self._why_not(trajectory)
            if why_not:
                raise InvalidArgument(why_not)
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

    def follow(
        self,
        joint_names: Sequence[str],
        target_at: Callable[[float], NDArray[np.float64] | None],
        log: MotionLog | None = None,
    ) -> bool:
        """Go towards targets that come one by one, as those of a person who is imitated, until there are no more.

        What will come is not known, so it cannot be checked as a whole: the joints keep their limits of position,
        speed and acceleration, and rest before links would overlap (`control.following`).

        Parameters
        ----------
        joint_names : sequence of str
            The joints that move; the others stay where they are.
        target_at : callable of time_s
            Called about every 10 ms with the robot's time. Gives positions in rad, shape (joints,); beyond a joint's
            limits the limit is meant. None: there are no more targets, the joints come to rest.
        log : MotionLog, optional

        Returns
        -------
        bool
            As of `perform`.

        Raises
        ------
        InvalidArgument
            For a joint that the robot does not have or cannot move; nothing has moved. For a target of another shape or
            that is not finite; the joints have come to rest.
        TrajectoryError
            When links overlap where the joints are; nothing has moved.
        Error
            As of `perform`.
        """
        stops = self._stop.mark()
        with self._begun(log) as may_move:
            if not may_move:
                return False
            positions = self._positions_sent(self.table.names)
            others = dict(zip(self.table.names, positions.tolist(), strict=True))
            begin = np.array([others[self.table[name].name] for name in joint_names])
            still = Trajectory(tuple(joint_names), self.step_s, np.stack((begin, begin)))
            why_not = self._why_not(still)
            if why_not:
                raise InvalidArgument(why_not)
            require_safe(still, self.table, others_rad=others)
            limits = self.table.limits_rad[[self.table.index(name) for name in joint_names]]
            most = _SHARE * self.table.max_speed_rad_s, _SHARE * self.table.max_acceleration_rad_s2
            clear = clear_of_itself(still.joint_names, self.table, others)
            follower = JointFollower(begin, limits, *most, self.step_s, clear)
            return self._follow(follower, still.joint_names, target_at, stops, log)

    def hold(self, duration_s: float, log: MotionLog | None = None) -> bool:
        """Keep the joints where they were sent for a time, also when stopped; False when the robot falls meanwhile.

        After the link to a robot was lost they are kept where they are found: they may have moved.

        Parameters
        ----------
        duration_s : float
            0 or more, finite.
        log : MotionLog, optional

        Raises
        ------
        Error
            When the robot is closed, or carries out a motion; as of `perform` for the link to a robot.
        """
        if not 0.0 <= duration_s < np.inf:
            raise InvalidArgument(f"duration_s is {duration_s}, must be 0 or more and finite")
        with self._one_at_a_time():
            self._find_again()
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

    def known_positions_rad(self) -> dict[str, float]:
        """Where the joints are, as far as that is known at once: where they were last sent, if they were.

        Any thread may ask, also during a motion.
        """
        self._require_open()
        return dict(self._commanded) or self.joint_positions_rad()

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
    def _place(self, positions_rad: Mapping[str, float], posture: str | None) -> None:
        """Do what `reset` says; names, positions and posture are known to be valid."""

    @abstractmethod
    def _render(self, width: int, height: int) -> Image:
        """Do what `render` says."""

    @abstractmethod
    def _close(self) -> None:
        """Do what `close` says; called once."""

    def _why_not(self, trajectory: Trajectory) -> str:
        """Why this robot cannot make a motion that its table allows; "" when it can."""
        return ""

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

    @contextmanager
    def _begun(self, log: MotionLog | None) -> Iterator[bool]:
        """As of `_one_at_a_time`, from where the joints really are; False for a robot that is stopped."""
        with self._one_at_a_time():
            if self._stop.engaged:
                self._event("stop", "not begun: stopped until resume()", log)
                yield False
                return
            self._find_again()
            yield True

    def _find_again(self) -> None:
        """Where the joints are, after the link to them was lost."""
        if self._link_lost:
            self._commanded.update(self._joint_positions())
            self._link_lost = False

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
        self._report_end(fallen, log)
        self._brake(names, before, now, log)
        if fallen:
            self._hold(HOLD_AFTER_FALL_S, log)
        return False
