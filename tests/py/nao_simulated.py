# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""PyBullet's NAO behind the services of `nao_services`: its joints have weight, its camera sees a screen."""

from __future__ import annotations

import threading

import cv2
import numpy as np
import qi

from hri.robot import NAO, Screen
from hri.robot.simulation.pybullet_backend import PyBulletRobot
from nao_services import Motion, Nao, VideoDevice

LEGS = tuple(name for name in NAO.names if any(part in name for part in ("Hip", "Knee", "Ankle")))
CYCLE_S = 0.02


@qi.multiThreaded()
class SimulatedMotion(Motion):
    """ALMotion with the joints of the simulation: a cycle goes by with every call, on a slow computer, too."""

    def __init__(self, robot, busy):
        super().__init__()
        self._robot, self._busy = robot, busy
        self.positions |= robot.joint_positions_rad()
        self.targets = dict(self.positions)

    def _move(self):
        stiff = (name for name in NAO.names if self.stiffness[name] > 0.0 and name not in LEGS)
        targets = {name: self.targets[name] for name in stiff}
        with self._busy:
            for _ in range(round(CYCLE_S / self._robot.step_s)):
                self._robot._send(targets, None)
            self.positions |= self._robot.joint_positions_rad()


@qi.multiThreaded()
class SimulatedVideo(VideoDevice):
    """ALVideoDevice of the simulated camera; `frames`, BGR, are shown on the screen one by one."""

    CAMERAS = ("CameraTop", "CameraBottom")

    def __init__(self, robot, busy, screen):
        super().__init__()
        self._robot, self._busy, self._screen = robot, busy, screen

    def picture(self, camera, width, height):
        if self.frames:
            self._screen.show(self.frames[self.number][..., ::-1])
        with self._busy:
            seen = self._robot.see(self.CAMERAS[camera])
        return cv2.resize(np.ascontiguousarray(seen[..., ::-1]), (width, height), interpolation=cv2.INTER_AREA)


class SimulatedNao(Nao):
    """NAO in the simulation, its legs held, with a screen of 0.8 x 0.6 m before its eyes."""

    def __init__(self, **fields):
        busy = threading.Lock()
        self.robot = PyBulletRobot(table=NAO, locked=LEGS)
        self.screen = Screen()
        self.robot.put_screen(self.screen)
        super().__init__(
            motion=SimulatedMotion(self.robot, busy), video=SimulatedVideo(self.robot, busy, self.screen), **fields
        )

    def close(self):
        super().close()
        with self.motion._busy:
            self.robot.close()
