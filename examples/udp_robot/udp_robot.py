# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A robot whose controller listens on a UDP port: checks, approach, stop and log are those of the simulated ones.

Every `step_s` one datagram goes out, ``{"step": n, "positions_rad": {joint: angle}}``, all joints in each, so that a
lost one does no harm; one without joints commands none. The controller answers with where its joints are, in a datagram
of the same form and number. One that is not answered is sent again. When that does not help before the timeout, the
motion ends with an error and the robot is stopped until `resume`; a controller must itself hold its joints then.
"""

from __future__ import annotations

import json
import math
import socket
import threading
import time
from collections.abc import Mapping

from hri.core.errors import Error, IoError
from hri.robot import HOAP2, Robot, RobotState
from hri.robot.control.filming import Image


class UdpRobot(Robot):
    """Talks to a controller; begins by asking where the joints are."""

    step_s = 0.02

    def __init__(self, host: str, port: int, timeout_s: float = 0.5) -> None:
        super().__init__(HOAP2)
        self._timeout_s = timeout_s
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._asking = threading.Lock()  # a page may ask before the first motion, in a thread of its own
        self._number = 0
        self._due_s = time.monotonic()
        try:
            self._socket.connect((host, port))
            self._positions = self._ask({})
        except OSError as error:
            self._socket.close()
            raise IoError(f"{host}: {error}") from error
        except Error:
            self._socket.close()
            raise

    def _state(self) -> RobotState:
        nowhere = (0.0, 0.0, 0.0)  # this controller does not report where its base is
        return RobotState(self.time_s, nowhere, nowhere, dict(self._positions))

    def _render(self, width: int, height: int) -> Image:
        raise Error("a real robot has no picture to render")

    def _close(self) -> None:
        self._socket.close()

    def _command(self, positions_rad: Mapping[str, float]) -> None:
        self._positions = self._ask(self._commanded)
        self._due_s = max(self._due_s + self.step_s, time.monotonic())
        time.sleep(max(0.0, self._due_s - time.monotonic()))

    def _place(self, positions_rad: Mapping[str, float], posture: str | None) -> None:
        raise Error("a real robot cannot be put anywhere at once; use perform")

    def _joint_positions(self) -> dict[str, float]:
        self._positions = self._ask({})
        return dict(self._positions)

    def _ask(self, sent: Mapping[str, float]) -> dict[str, float]:
        with self._asking:
            return self._asked(sent)

    def _asked(self, sent: Mapping[str, float]) -> dict[str, float]:
        self._number += 1
        message = json.dumps({"step": self._number, "positions_rad": sent}).encode("ascii")
        ends_s = time.monotonic() + self._timeout_s
        try:
            while (left_s := ends_s - time.monotonic()) > 0.0:
                self._socket.send(message)
                found = self._answer(min(left_s, max(self._timeout_s / 4, self.step_s)))
                if found is not None:
                    return found
        except OSError as error:
            raise IoError(f"the robot's controller does not answer: {error}") from error
        except (ValueError, KeyError, TypeError, OverflowError, RecursionError) as error:
            raise IoError(f"the robot's controller answers nonsense: {error!r}") from error
        raise IoError(f"the robot's controller does not answer within {self._timeout_s:g} s")

    def _answer(self, within_s: float) -> dict[str, float] | None:
        """Where the joints are; None where no answer to the last datagram comes in time, whatever else does."""
        ends_s = time.monotonic() + within_s
        while (left_s := ends_s - time.monotonic()) > 0.0:
            self._socket.settimeout(left_s)
            try:
                answer = json.loads(self._socket.recv(65536))
            except TimeoutError:
                return None
            if answer["step"] == self._number:  # an older one came late
                found = {name: float(answer["positions_rad"][name]) for name in self.table.names}
                if not all(map(math.isfinite, found.values())):
                    raise ValueError("a position is not finite")
                return found
        return None
