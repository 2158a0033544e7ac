# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A robot whose controller listens on a UDP port: checks, approach, stop and log are those of the simulated ones.

Every `step_s` one datagram goes out, ``{"step": n, "positions_rad": {joint: angle}}``, all joints in each, so that a
lost one does no harm; one without joints commands none. The controller answers with where its joints are, in a datagram
of the same form and number. When it is silent for longer than the timeout, the motion ends with an error and the robot
is stopped until `resume`; a controller must itself hold its joints then.
"""

from __future__ import annotations

import json
import math
import socket
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
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.settimeout(timeout_s)
        self._socket.connect((host, port))
        self._number = 0
        self._due_s = time.monotonic()
        self._positions = self._ask({})

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
        self._number += 1
        message = json.dumps({"step": self._number, "positions_rad": sent})
        try:
            self._socket.send(message.encode("ascii"))
            while True:
                answer = json.loads(self._socket.recv(65536))
                if answer["step"] == self._number:  # an older one came late
                    found = {name: float(answer["positions_rad"][name]) for name in self.table.names}
                    if not all(map(math.isfinite, found.values())):
                        raise ValueError("a position is not finite")
                    return found
        except OSError as error:
            raise IoError(f"the robot's controller does not answer: {error}") from error
        except (ValueError, KeyError, TypeError) as error:
            raise IoError(f"the robot's controller answers nonsense: {error!r}") from error
