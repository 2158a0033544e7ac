# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The robot without physics: joints are where they are sent. Needs numpy, and OpenCV to draw."""

from __future__ import annotations

from collections.abc import Mapping

from hri.errors import InvalidArgument
from hri.robot.backend import Image, Robot
from hri.robot.drawing import draw_robot
from hri.robot.gestures import rest_positions
from hri.robot.kinematics import link_poses


class KinematicRobot(Robot):
    """HOAP-2 with its torso held, moved in steps of 10 ms as fast as the computer can."""

    step_s = 0.01

    def __init__(self) -> None:
        super().__init__()
        self._positions = rest_positions()

    def reset(self, positions_rad: Mapping[str, float]) -> None:
        for name in positions_rad:
            if name not in self._positions:
                raise InvalidArgument(f"{self.table.name} has no joint {name!r}")
        self._positions.update(positions_rad)

    def render(self, width: int = 480, height: int = 360) -> Image:
        return draw_robot(link_poses(self._positions, table=self.table), self.table, width, height)

    def joint_positions_rad(self) -> dict[str, float]:
        return dict(self._positions)

    def close(self) -> None:
        """Do nothing: there is nothing to let go of."""

    def _command(self, positions_rad: Mapping[str, float]) -> None:
        self.reset(positions_rad)
