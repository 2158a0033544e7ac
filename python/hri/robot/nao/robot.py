# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""NAO moved by ALMotion, and speaking by ALTextToSpeech."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import Error, InvalidArgument, IoError
from hri.robot.control.backend import Robot
from hri.robot.control.filming import Image
from hri.robot.control.state import MotionLog, RobotState
from hri.robot.model.joints import NAO, Joint, JointTable
from hri.robot.motion.checks import LIMIT_TOLERANCE_RAD
from hri.robot.motion.trajectory import Trajectory, TrajectoryError
from hri.robot.nao.couplings import COUPLED_JOINTS, coupling_findings
from hri.robot.nao.link import NaoqiLink

MAX_TEXT_LENGTH = 1000
_POSTURE_S = 60.0  # NAO stands up within 20 s
_POLL_S = 0.02
_SLOWEST_S = 0.5  # a character


class NaoqiRobot(Robot):
    """A real NAO H25, or what behaves like one.

    It gets the positions of the checked and smoothed motion one by one, 50 times a second, which is ALMotion's own
    cycle, by `ALMotion.setAngles`. So STOP acts at the next of them, and a robot that hears no more from us is sent
    nowhere but to the last one. Limits are the stricter of NAO's table and of what the robot itself reports
    (`ALMotion.getLimits`). Its motors are switched on joint by joint as motions need them; `wake_up` makes it stand.

    Where the link breaks in mid-motion, `perform` raises IoError and the robot is stopped. After `resume` the next
    motion connects again, and begins where the joints then are.

    Parameters
    ----------
    url : str
        tcp://HOST or tcp://HOST:PORT; the port is 9559 unless named.
    timeout_s : float
        Within which NAO has to answer each call; above 0.
    stiffness : float
        Of the joints that are moved, above 0 and at most 1.

    Raises
    ------
    InvalidArgument
        For another address or value.
    IoError
        When no NAO answers there.
    Error
        When what answers has no ALMotion, or not NAO's joints.
    ImportError
        Without qi: the extra "nao".
    """

    step_s = 0.02

    def __init__(self, url: str, timeout_s: float = 2.0, stiffness: float = 1.0) -> None:
        super().__init__(NAO)
        if not 0.0 < stiffness <= 1.0:
            raise InvalidArgument(f"stiffness is {stiffness}, must be above 0 and at most 1")
        self._stiffness = stiffness
        self._stiff: set[str] = set()
        self._due_s = time.monotonic()
        self._link = NaoqiLink(url, timeout_s)
        try:
            self.table = _own_table(self._link)
            self._commanded.update(self._joint_positions())
        except BaseException:
            self._link.close()
            raise

    @property
    def url(self) -> str:
        """Where the robot is."""
        return self._link.url

    def follow(
        self,
        joint_names: Sequence[str],
        target_at: Callable[[float], NDArray[np.float64] | None],
        log: MotionLog | None = None,
    ) -> bool:
        """As of `Robot`; joints whose limits depend on one another, of head and hips, are refused.

        Raises
        ------
        InvalidArgument
            Also for these; nothing has moved.
        """
        coupled = sorted(COUPLED_JOINTS.intersection(joint_names))
        if coupled:
            raise InvalidArgument(f"{', '.join(coupled)}: the limits depend on other joints; perform checks these")
        return super().follow(joint_names, target_at, log)

    def say(self, text: str, language: str | None = None) -> None:
        """Say a text by ALTextToSpeech, and return when it has been said.

        May be called by any thread, also during a motion and when stopped.

        Parameters
        ----------
        text : str
            1 to 1000 printable characters, without backslashes, which would be commands to the voice.
        language : str, optional
            As NAO names it ("English"); that which is set on the robot by default.

        Raises
        ------
        InvalidArgument
            For another text.
        IoError, Error
            When NAO does not answer, or has no voice for the language.
        """
        if not isinstance(text, str) or not 0 < len(text.strip()) <= len(text) <= MAX_TEXT_LENGTH:
            raise InvalidArgument(f"a text to say has 1 to {MAX_TEXT_LENGTH} characters")
        if text != _speakable(text):
            raise InvalidArgument("a text to say has no backslashes and control characters")
        self._require_open()
        future = self._link.start("ALTextToSpeech", "say", *((text,) if language is None else (text, language)))
        self._link.finish(future, "ALTextToSpeech.say", self._link.timeout_s + _SLOWEST_S * len(text))

    def say_later(self, text: str) -> None:
        """Begin to say a text and return at once, as `hri.Session(on_say=...)` needs it.

        What no voice can say is left out, and all after 1000 characters. Failures go to `events`.

        Parameters
        ----------
        text : str
        """
        try:
            self._require_open()
            future = self._link.start("ALTextToSpeech", "say", _speakable(text)[:MAX_TEXT_LENGTH])
        except Error as error:
            self._event("fault", f"not said: {error}", None)
        else:
            future.addCallback(self._said)

    def say_cleaned(self, text: str) -> None:
        """Say a text, as `say`, without what no voice can say and all after 1000 characters.

        As `hri.session.Voice` needs it; a text of which nothing is left is not said.

        Raises
        ------
        IoError, Error
            When NAO does not answer.
        """
        text = _speakable(text)[:MAX_TEXT_LENGTH]
        if text.strip():
            self.say(text)

    def wake_up(self) -> bool:
        """Switch all motors on and stand up as NAO does it by itself; False when `stop` ended or prevented it.

        Raises
        ------
        IoError, Error
            When NAO does not answer, or refuses.
        """
        return self._by_itself("wakeUp", self._all_stiff)

    def rest(self) -> bool:
        """Crouch and switch all motors off as NAO does it by itself; False when `stop` ended or prevented it.

        Raises
        ------
        IoError, Error
            When NAO does not answer, or refuses.
        """
        return self._by_itself("rest", self._stiff.clear)

    def _by_itself(self, method: str, done: Callable[[], None]) -> bool:
        stops = self._stop.mark()
        with self._one_at_a_time():
            if self._stop.engaged:
                self._event("stop", "not begun: stopped until resume()", None)
                return False
            try:
                self._find_again()
                future = self._link.start("ALMotion", method)
                ends_s = time.monotonic() + _POSTURE_S
                while not self._link.wait(future, _POLL_S) and time.monotonic() < ends_s:
                    if self._stop.since(stops):
                        self._link.call("ALMotion", "killAll")
                        self._event("stop", "stopped on request", None)
                        self._stiff.clear()  # which of them are on is not known
                        self._commanded.update(self._joint_positions())
                        return False
                self._link.finish(future, f"ALMotion.{method}", _POLL_S)
                done()
                self._commanded.update(self._joint_positions())
            except Error as error:
                self._lose(error)
                raise
        return True

    def _all_stiff(self) -> None:
        self._stiff.update(self.table.names)

    def _lose(self, error: Error) -> None:
        self._link_lost = True
        self._stop.engage()
        self._event("fault", f"stopped, as the robot does not take commands: {error}", None)

    def _said(self, future: Any) -> None:
        """In a thread of qi."""
        if future.hasError(0):
            self._event("fault", f"not said: {future.error(0)}", None)

    def _positions_sent(self, names: tuple[str, ...]) -> NDArray[np.float64]:
        if not self._stiff.issuperset(self.table.names):
            # A joint without power hangs, or was turned by hand.
            there = self._joint_positions()
            self._commanded.update((name, there[name]) for name in there if name not in self._stiff)
        return super()._positions_sent(names)

    def _checked(self, trajectory: Trajectory) -> tuple[NDArray[np.float64], Trajectory | None]:
        begin, approach = super()._checked(trajectory)
        for part in (approach, trajectory):
            findings = [] if part is None else coupling_findings(part, self._commanded)
            if findings:
                raise TrajectoryError(findings)
        return begin, approach

    def _command(self, positions_rad: Mapping[str, float]) -> None:
        limp = [name for name in positions_rad if name not in self._stiff]
        if limp:
            self._link.call("ALMotion", "setStiffnesses", limp, [self._stiffness] * len(limp))
            self._stiff.update(limp)
        sent = None
        if positions_rad:
            names, angles = list(positions_rad), [float(angle) for angle in positions_rad.values()]
            # At full speed the robot is at each position when the next one comes: these keep the limits themselves.
            sent = self._link.start("ALMotion", "setAngles", names, angles, 1.0)
        elif not self._link.connected:
            raise IoError(f"NAO at {self.url} is no longer connected: is it switched off?")
        self._due_s = max(self._due_s + self.step_s, time.monotonic())
        time.sleep(max(0.0, self._due_s - time.monotonic()))
        if sent is not None:
            self._link.finish(sent, "ALMotion.setAngles")

    def _joint_positions(self) -> dict[str, float]:
        if self._link_lost or not self._link.connected:
            self._link.reconnect()
            self._stiff.clear()  # it may have been switched off meanwhile
        return self._angles()

    def _angles(self) -> dict[str, float]:
        names = list(self.table.names)
        angles = self._link.call("ALMotion", "getAngles", names, True)
        return dict(zip(names, _numbers(angles, len(names), "ALMotion.getAngles"), strict=True))

    def _state(self) -> RobotState:
        nowhere = (0.0, 0.0, 0.0)  # NAO does not know where it is
        return RobotState(self.time_s, nowhere, nowhere, self._angles())

    def _place(self, positions_rad: Mapping[str, float], posture: str | None) -> None:
        raise Error("a real robot cannot be put anywhere at once; use perform")

    def _render(self, width: int, height: int) -> Image:
        raise Error("a real robot has no picture of itself; hri.session.NaoCamera is what it sees")

    def _close(self) -> None:
        self._link.close()


def _speakable(text: str) -> str:
    """Spaces for characters that are no text to a voice."""
    return "".join(" " if c == "\\" or not (c.isprintable() or c in "\n\t") else c for c in text)


def _own_table(link: NaoqiLink) -> JointTable:
    """NAO's table with the limits that this robot reports, where they are stricter."""
    names = [str(name) for name in link.call("ALMotion", "getBodyNames", "Body")]
    missing = [name for name in NAO.names if name not in names]
    if missing:
        raise Error(f"the robot at {link.url} is no NAO H25: it has no {', '.join(missing)}")
    rows = link.call("ALMotion", "getLimits", "Body")
    if not isinstance(rows, list | tuple) or len(rows) != len(names):
        raise Error("NAO answers ALMotion.getLimits with something else than a row for each joint")
    own = {name: _numbers(row, 4, "ALMotion.getLimits") for name, row in zip(names, rows, strict=True)}
    slowest = min(own[name][2] for name in NAO.names)
    if not slowest > 0.0:
        raise Error("NAO reports a joint that cannot move")
    joints = tuple(_stricter(joint, *own[joint.name][:2]) for joint in NAO.joints)
    return replace(NAO, joints=joints, max_speed_rad_s=min(NAO.max_speed_rad_s, slowest))


def _stricter(joint: Joint, lower_rad: float, upper_rad: float) -> Joint:
    # What differs by no more than its rounding is the same.
    lower_rad = lower_rad if lower_rad > joint.lower_rad + LIMIT_TOLERANCE_RAD else joint.lower_rad
    upper_rad = upper_rad if upper_rad < joint.upper_rad - LIMIT_TOLERANCE_RAD else joint.upper_rad
    if not lower_rad < upper_rad:
        raise Error(f"NAO reports limits of {joint.name} that leave no room")
    return replace(joint, lower_rad=lower_rad, upper_rad=upper_rad)


def _numbers(values: Any, count: int, what: str) -> list[float]:
    """So many finite numbers, which a robot answered."""
    try:
        found = [float(value) for value in values]
    except (TypeError, ValueError):
        found = []
    if len(found) != count or not all(map(math.isfinite, found)):
        raise Error(f"NAO answers {what} with something else than {count} numbers")
    return found
