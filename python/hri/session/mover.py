# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Motions beside the streams: a robot moves in a thread of its own, in step with the session's time."""

from __future__ import annotations

import math
import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument
from hri.core.phrases import phrase, phrase_of
from hri.robot import Robot, Trajectory, TrajectoryError

_CLOSE_S = 5.0
_FIRST_TARGET_S = 3.0


@dataclass(frozen=True)
class Guided:
    """A motion that is not known in advance: these joints go where `target_at` says at every time of the session.

    Attributes
    ----------
    joint_names : tuple of str
    target_at : callable of time_s
        As of `hri.robot.Robot.follow`, whose time is the session's here. None before the first target: the joints wait
        for it for 3 s.
    """

    joint_names: tuple[str, ...]
    target_at: Callable[[float], NDArray[np.float64] | None]


Motion = Trajectory | Guided
OnJoints = Callable[[float, Mapping[str, float]], None]


@dataclass(frozen=True)
class Cause:
    """What a motion or a stop answers.

    Attributes
    ----------
    last_s : float
        End of the word or sign, in the session's time.
    time_s : float
        When it was decided on, in the session's time.
    computed_s : float
        Of `time.perf_counter` when the samples or pictures that decided it were there; earlier by what recognising that
        which waited had taken before.
    """

    last_s: float
    time_s: float
    computed_s: float


@dataclass(frozen=True)
class Moved:
    """Something that a robot did.

    Attributes
    ----------
    kind : str
        "motion_start", "motion_end", or "halt": a motion that is being stopped.
    label : str
        Of the motion.
    time_s : float
        Of the first command, the last, or the first of stopping, in the session's time.
    number : int
        Which motion of the session it is, from 1; those that never began count.
    message : str
        Why a motion did not end as it should; "" when it did, or was stopped.
    fault : bool
        The robot takes no commands.
    completed : bool
        The motion was carried out to its end.
    wait_ms, compute_ms : float
        From the end of the word or sign to this command: the session's time until it is decided on and until the
        robot's next step, and the computer's time for that.
    """

    kind: str
    label: str
    time_s: float
    number: int
    message: str = ""
    fault: bool = False
    completed: bool = False
    wait_ms: float = 0.0
    compute_ms: float = 0.0


@dataclass
class _Job:
    label: str
    motion: Motion
    begin_s: float
    cause: Cause
    number: int
    steps: int = 0
    num_events: int = 0
    rest: bool = False
    halted_by: Cause | None = None
    halting: bool = False


class Mover:
    """Carries out one motion after the other.

    The robot gets its next command when the session's time has come to it: that of `clock`, or, without one, the time
    that was last given to `advance`, which returns when the robot has come there. So a session over files gives the
    robot the same commands at the same times whenever it is played.

    Parameters
    ----------
    robot : Robot
        Left open by `close`. Its `on_command` is used until then.
    motions : mapping of label to Trajectory or Guided
    clock : callable, optional
        The session's time in seconds, where that goes on by itself.
    on_joints : callable of (time_s, positions_rad), optional
        Called before every command, in the thread that moves.

    Raises
    ------
    InvalidArgument
        For a robot that another session moves.
    """

    def __init__(
        self,
        robot: Robot,
        motions: Mapping[str, Motion],
        clock: Callable[[], float] | None = None,
        on_joints: OnJoints | None = None,
    ) -> None:
        if robot.on_command is not None:
            raise InvalidArgument("the robot is in use: another session moves it")
        self._robot = robot
        self._motions = motions
        self._clock = clock
        self._on_joints = on_joints
        self._jobs: deque[_Job] = deque()
        self._job: _Job | None = None
        self._num_begun = 0
        self._results: deque[Moved] = deque()
        self._allowed_s = -math.inf
        self._next_s = -math.inf
        self._ended_s = -math.inf
        self._closed = False
        self._turn = threading.Condition()
        robot.on_command = self._step
        self._thread = threading.Thread(target=self._run, daemon=True, name="hri-mover")
        self._thread.start()

    @property
    def busy(self) -> bool:
        """Whether a motion is under way or about to begin."""
        with self._turn:
            return self._job is not None or len(self._jobs) > 0

    def begin(self, label: str, cause: Cause) -> None:
        """Carry out the motion of this label, after the one that is under way; nothing once it is closed."""
        with self._turn:
            if self._closed:
                return
            self._num_begun += 1
            self._jobs.append(_Job(label, self._motions[label], cause.time_s, cause, self._num_begun))
            self._turn.notify_all()

    def stop(self, cause: Cause) -> None:
        """STOP: the motion under way ends within its limits, what waits is dropped, and none begins until `resume`."""
        with self._turn:
            self._jobs.clear()
            if self._job is not None and self._job.halted_by is None:
                self._job.halted_by = cause
        self._robot.stop()

    def rest(self, cause: Cause) -> None:
        """End the motion under way; others may begin."""
        with self._turn:
            self._jobs.clear()
            if self._job is not None and self._job.halted_by is None:
                self._job.halted_by, self._job.rest = cause, True

    def resume(self) -> None:
        """End STOP."""
        self._robot.resume()

    def advance(self, time_s: float) -> list[Moved]:
        """Let the robot come to this time; what it did since the last call."""
        with self._turn:
            self._allowed_s = max(self._allowed_s, time_s)
            self._turn.notify_all()
            if self._clock is None:
                self._turn.wait_for(self._has_come)
            found = list(self._results)
            self._results.clear()
            return found

    def close(self) -> None:
        """Stop what moves and let go of the robot; returns in bounded time."""
        if self._closed:
            return
        if self.busy:
            self._robot.stop()
        with self._turn:
            self._closed = True
            self._jobs.clear()
            self._turn.notify_all()
        self._thread.join(_CLOSE_S)
        self._robot.on_command = None

    def _has_come(self) -> bool:
        return (self._job is None and not self._jobs) or self._next_s > self._allowed_s

    def _run(self) -> None:
        while True:
            with self._turn:
                self._turn.wait_for(lambda: self._jobs or self._closed)
                if self._closed:
                    return
                self._job = job = self._jobs.popleft()
                job.begin_s = max(job.begin_s, self._ended_s)
            job.num_events = len(self._robot.events)
            ended = self._carry_out(job)
            with self._turn:
                self._results.append(ended)
                self._job, self._ended_s = None, ended.time_s
                self._turn.notify_all()

    def _carry_out(self, job: _Job) -> Moved:
        message, fault, completed = "", False, False
        try:
            completed, message = self._perform(job)
            fell = [event for event in self._robot.events[job.num_events :] if event.kind == "fall"]
            message = phrase("fallen") if fell else message
        except (TrajectoryError, InvalidArgument) as error:
            message = phrase("cannot_do", detail=phrase_of(error))
        except Exception as error:  # a link of a caller's own may raise anything; the session goes on
            message, fault = phrase("does_not_obey", detail=phrase_of(error)), True
        end_s = job.begin_s + max(0, job.steps - 1) * self._robot.step_s
        return Moved("motion_end", job.label, end_s, job.number, message, fault, completed)

    def _perform(self, job: _Job) -> tuple[bool, str]:
        if isinstance(job.motion, Trajectory):
            return self._robot.perform(job.motion), ""
        return self._follow(job, job.motion)

    def _follow(self, job: _Job, motion: Guided) -> tuple[bool, str]:
        where = self._robot.joint_positions_rad()
        still = np.array([where[self._robot.table[name].name] for name in motion.joint_names])
        led = False

        def target_at(_: float) -> NDArray[np.float64] | None:
            nonlocal led
            target = motion.target_at(self._at_s(job))
            led = led or target is not None
            waits = not led and job.steps * self._robot.step_s < _FIRST_TARGET_S
            return still if waits else target

        completed = self._robot.follow(motion.joint_names, target_at)
        return completed and led, phrase("nothing_to_follow") if completed and not led else ""

    def _at_s(self, job: _Job) -> float:
        """When the job's next command is due."""
        return job.begin_s + job.steps * self._robot.step_s

    def _step(self, time_s: float, positions_rad: Mapping[str, float]) -> None:
        """Before every command, in the thread that moves: wait for its time, and note what it begins."""
        job = self._job
        if job is None:
            return
        at_s = self._at_s(job)
        self._wait(at_s)
        if job.rest:
            job.rest = False
            self._robot.end_motion()
        if job.steps == 0:
            self._note("motion_start", job, at_s, job.cause)
        elif not job.halting and any(event.ended_motion for event in self._robot.events[job.num_events :]):
            job.halting = True
            if job.halted_by is not None:
                self._note("halt", job, at_s, job.halted_by)
        job.steps += 1
        if self._on_joints is not None:
            self._on_joints(at_s, positions_rad)

    def _wait(self, at_s: float) -> None:
        with self._turn:
            self._next_s = at_s
            self._turn.notify_all()
            if self._clock is None:
                self._turn.wait_for(lambda: self._allowed_s >= at_s or self._closed)
                self._next_s = -math.inf
                return
            while not self._closed and (left_s := at_s - self._clock()) > 0:
                self._turn.wait(left_s)

    def _note(self, kind: str, job: _Job, at_s: float, cause: Cause) -> None:
        compute_ms = 1000 * (time.perf_counter() - cause.computed_s)
        # Where the session's time goes on by itself, that of the computer is part of it.
        wait_ms = 1000 * ((at_s if self._clock is None else cause.time_s) - cause.last_s)
        with self._turn:
            self._results.append(Moved(kind, job.label, at_s, job.number, wait_ms=wait_ms, compute_ms=compute_ms))
