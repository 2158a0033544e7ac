# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The robot without physics: joints are where they are sent. Needs numpy, and OpenCV to draw."""

from __future__ import annotations

from collections.abc import Mapping

from hri.robot.control.backend import Robot
from hri.robot.control.filming import Image
from hri.robot.control.state import RobotState
from hri.robot.model.joints import HOAP2, JointTable
from hri.robot.model.kinematics import link_poses
from hri.robot.simulation.drawing import draw_robot


class KinematicRobot(Robot):
    """A robot with its torso held, moved in steps of 10 ms as fast as the computer can."""

    step_s = 0.01

    def __init__(self, table: JointTable = HOAP2) -> None:
        super().__init__(table)
        self._positions = table.rest_rad
        self._commanded.update(self._positions)

    def known_positions_rad(self) -> dict[str, float]:
        """Where the joints are."""
        return self.joint_positions_rad()

    def _render(self, width: int, height: int) -> Image:
        return draw_robot(link_poses(self._positions, table=self.table), self.table, width, height)

    def _state(self) -> RobotState:
        return RobotState(
            self.time_s,
            base_position_m=(0.0, 0.0, self.table.standing_height_m),
            base_rpy_rad=(0.0, 0.0, 0.0),
            positions_rad=dict(self._positions),
        )

    def _close(self) -> None:
        """Do nothing: there is nothing to let go of."""

    def _command(self, positions_rad: Mapping[str, float]) -> None:
        self._positions.update(positions_rad)

    def _place(self, positions_rad: Mapping[str, float], posture: str | None) -> None:
        self._positions.update(positions_rad)
