# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What is sent to a robot, step by step, and what it feels meanwhile: falls, and links that touch."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument
from hri.robot.control.braking import brake
from hri.robot.control.following import JointFollower
from hri.robot.control.state import Contact, Event, MotionLog, RobotState, SelfContact, SelfContacts
from hri.robot.control.stopping import StopLatch
from hri.robot.control.straining import PATIENCE_S, Straining
from hri.robot.model.joints import HOAP2, JointTable
from hri.robot.motion.checks import LIMIT_TOLERANCE_RAD

FALL_TILT_DEG = 60.0
UPRIGHT_TILT_DEG = 20.0
_UPRIGHT_S = 0.5
_LOOK_S = 0.01
_FEEL_S = 0.005
HOLD_AFTER_FALL_S = 1.0
_TOLERANCES_RAD = np.array([-LIMIT_TOLERANCE_RAD, LIMIT_TOLERANCE_RAD])


class CommandedJoints(ABC):
    """The part of `Robot` that talks to the robot itself; for one thread at a time.

    Parameters
    ----------
    table : JointTable

    Attributes
    ----------
    step_s, events, on_command
        As of `Robot`.
    """

    step_s: float = 0.001

    def __init__(self, table: JointTable = HOAP2) -> None:
        self.table = table
        self.events: list[Event] = []
        self.on_command: Callable[[float, Mapping[str, float]], None] | None = None
        self._touched = SelfContacts()
        self._strain = Straining()
        self._stop = StopLatch()
        self._link_lost = False
        self._commanded: dict[str, float] = {}
        self._upright_s = 0.0
        self._steps = 0

    @property
    def time_s(self) -> float:
        """The robot's own time since it was opened."""
        return self._steps * self.step_s

    @property
    def self_contacts(self) -> list[SelfContact]:
        """Pairs of links that touched one another in motions and while the robot held, looked at every 5 ms."""
        return self._touched.found()

    @abstractmethod
    def _command(self, positions_rad: Mapping[str, float]) -> None:
        """Send joints to positions, the others as before, and let `step_s` go by."""

    @abstractmethod
    def _state(self) -> RobotState:
        """Do what `state` says."""

    def _joint_positions(self) -> dict[str, float]:
        """Do what `joint_positions_rad` says."""
        return self._state().positions_rad

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

    def _brake(self, names: tuple[str, ...], before: list[float], now: list[float], log: MotionLog | None) -> None:
        """Bring joints to rest that were sent to these two positions, a step apart."""
        limits = self.table.limits_rad[[self.table.index(name) for name in names]] + _TOLERANCES_RAD
        positions = np.array(now)
        speeds = (positions - np.array(before)) / self.step_s
        most = self.table.max_acceleration_rad_s2
        for row in brake(positions, speeds, limits, self.table.max_speed_rad_s, most, self.step_s).tolist():
            self._send(dict(zip(names, row, strict=True)), log)

    def _follow(
        self,
        follower: JointFollower,
        names: tuple[str, ...],
        target_at: Callable[[float], NDArray[np.float64] | None],
        stops: object,
        log: MotionLog | None,
    ) -> bool:
        """Until the targets, a stop or a fall end it; the way to rest is always one that was found clear."""
        ended = fallen = False
        failure: BaseException | None = None
        while not (ended and follower.rests):
            target: NDArray[np.float64] | None = None
            if not ended:
                fallen = self._fallen()
                ended = fallen or self._stop.since(stops)
                if ended:
                    self._report_end(fallen, log)
                else:
                    try:
                        target = _target(target_at(self.time_s), len(names))
                    except BaseException as error:  # raised once the joints rest
                        failure = error
                    ended = target is None
            rows = iter(follower.tick(target).tolist())
            try:
                for row in rows:
                    self._send(dict(zip(names, row, strict=True)), log)
            except BaseException:  # an interrupt, mostly while it sleeps
                if not self._link_lost:
                    self._rest(follower, names, rows, log)
                raise
        if failure is not None:
            raise failure
        if fallen:
            self._hold(HOLD_AFTER_FALL_S, log)
        return not (fallen or self._stop.since(stops))

    def _rest(
        self, follower: JointFollower, names: tuple[str, ...], rows: Iterator[list[float]], log: MotionLog | None
    ) -> None:
        """Send what is left of a tick, and bring the joints to rest."""
        for row in rows:
            self._send(dict(zip(names, row, strict=True)), log)
        while not follower.rests:
            for row in follower.tick(None).tolist():
                self._send(dict(zip(names, row, strict=True)), log)

    def _report_end(self, fallen: bool, log: MotionLog | None) -> None:
        if fallen:
            self._event("fall", f"the base leans by {self._tilt_deg():.0f} degrees", log)
            self._upright_s = 0.0
        else:
            self._event("stop", "stopped on request", log)

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


def _target(positions_rad: NDArray[np.float64] | None, count: int) -> NDArray[np.float64] | None:
    """What `Robot.follow` was given; raises InvalidArgument for anything but one finite number a joint."""
    if positions_rad is None:
        return None
    target = np.asarray(positions_rad, dtype=np.float64)
    if target.shape != (count,) or not np.isfinite(target).all():
        raise InvalidArgument(f"a target to follow must be {count} finite positions, got {positions_rad!r}")
    return target
