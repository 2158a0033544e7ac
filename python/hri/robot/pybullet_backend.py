# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The robot in PyBullet, with masses, motors and gravity; the only module that imports it."""

from __future__ import annotations

import os
import sys
import tempfile
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from hri.errors import Error, InvalidArgument
from hri.media.optional import import_optional
from hri.robot import scene
from hri.robot.backend import Image, Robot
from hri.robot.gestures import rest_positions
from hri.robot.urdf import urdf_text

# A base that stands on its feet needs soft joints; arms on a held base follow better with stiff.
_GAIN_FREE_PER_S = 10.0
_GAIN_FIXED_PER_S = 100.0
_SOLVER_ITERATIONS = 50
_FRICTION = 0.9
_SETTLE_S = 1.0


class PyBulletRobot(Robot):
    """HOAP-2 simulated with steps of 1 ms.

    Parameters
    ----------
    gui : bool
        Show PyBullet's window and move in real time.
    fixed_base : bool
        Hold the torso, as for gestures of the arms; without, it stands on its feet.

    Raises
    ------
    ImportError
        When PyBullet is not installed; the message says how to get it.
    InvalidArgument
        For a window where there is no display.
    """

    def __init__(self, gui: bool = False, fixed_base: bool = True) -> None:
        super().__init__()
        self._bullet = import_optional("pybullet", "robot", "to simulate the robot")
        if gui and sys.platform == "linux" and not os.environ.get("DISPLAY"):
            raise InvalidArgument("there is no display for the robot's window: DISPLAY is not set")  # else it exits
        self._client = self._bullet.connect(self._bullet.GUI if gui else self._bullet.DIRECT)
        if self._client < 0:
            raise Error("PyBullet gives no simulation")
        self._gui = gui
        self._wall_s = time.monotonic()
        self._gain = (_GAIN_FIXED_PER_S if fixed_base else _GAIN_FREE_PER_S) * self.step_s
        try:
            self._build(fixed_base)
        except BaseException:
            self.close()
            raise

    def reset(self, positions_rad: Mapping[str, float]) -> None:
        for name, position in positions_rad.items():
            self._bullet.resetJointState(self._body, self._joints[name], position, physicsClientId=self._client)
        self._targets.update(positions_rad)

    def joint_positions_rad(self) -> dict[str, float]:
        states = self._bullet.getJointStates(self._body, list(self._joints.values()), physicsClientId=self._client)
        return {name: state[0] for name, state in zip(self._joints, states, strict=True)}

    def link_positions_m(self) -> dict[str, tuple[float, float, float]]:
        """Origins of the links' frames in the world, by name of the joint that carries them."""
        states = self._bullet.getLinkStates(
            self._body,
            list(self._joints.values()),
            computeForwardKinematics=1,
            physicsClientId=self._client,
        )
        return {name: state[4] for name, state in zip(self._joints, states, strict=True)}

    def self_contacts(self, margin_m: float = 0.0) -> list[tuple[str, str]]:
        """Pairs of solid links nearer than a margin that no joint, or joint with a dummy, joins."""
        names = {index: name for name, index in self._joints.items()}
        points = self._bullet.getClosestPoints(self._body, self._body, margin_m, physicsClientId=self._client)
        pairs = set()
        for point in points:
            first, second = sorted((point[3], point[4]))
            if first != second and frozenset((first, second)) not in self._neighbours:
                pairs.add((names.get(first, "base"), names.get(second, "base")))
        return sorted(pairs)

    def render(self, width: int = 480, height: int = 360) -> Image:
        scene.check_size(width, height)
        bullet = self._bullet
        view = bullet.computeViewMatrix(scene.EYE_M, scene.TARGET_M, scene.UP)
        projection = bullet.computeProjectionMatrixFOV(scene.FIELD_OF_VIEW_DEG, width / height, 0.1, 5.0)
        _, _, pixels, _, mask = bullet.getCameraImage(
            width,
            height,
            view,
            projection,
            lightDirection=scene.TO_LIGHT,
            lightDistance=2.0,
            lightAmbientCoeff=0.68,
            lightDiffuseCoeff=0.40,
            lightSpecularCoeff=0.06,
            shadow=1,
            renderer=bullet.ER_TINY_RENDERER,
            physicsClientId=self._client,
        )
        image = np.asarray(pixels, dtype=np.uint8).reshape(height, width, 4)[:, :, :3]
        nothing = np.asarray(mask).reshape(height, width, 1) < 0
        return np.where(nothing, scene.backdrop(width, height), image)

    def close(self) -> None:
        if self._client >= 0:
            client, self._client = self._client, -1
            self._bullet.disconnect(client)

    def _build(self, fixed_base: bool) -> None:
        bullet, client = self._bullet, self._client
        bullet.setGravity(0, 0, -9.81, physicsClientId=client)
        bullet.setPhysicsEngineParameter(
            fixedTimeStep=self.step_s,
            numSolverIterations=_SOLVER_ITERATIONS,
            physicsClientId=client,
        )
        self._add_floor()
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "hoap2.urdf"
            path.write_text(urdf_text(self.table), encoding="ascii")
            self._body = bullet.loadURDF(
                str(path),
                (0, 0, self.table.standing_height_m),
                useFixedBase=fixed_base,
                flags=bullet.URDF_USE_INERTIA_FROM_FILE,
                physicsClientId=client,
            )
        self._joints = self._joint_indices()
        self._neighbours = self._near_links()
        for index in range(-1, len(self._joints)):
            bullet.changeDynamics(
                self._body,
                index,
                lateralFriction=_FRICTION,
                linearDamping=0,
                angularDamping=0,
                jointDamping=0,
                physicsClientId=client,
            )
        self._targets: dict[str, float] = {}
        self.reset(rest_positions())
        if not fixed_base:
            for _ in range(round(_SETTLE_S / self.step_s)):
                self._command({})

    def _add_floor(self) -> None:
        bullet, client = self._bullet, self._client
        ground = bullet.createCollisionShape(bullet.GEOM_PLANE, physicsClientId=client)
        board = bullet.createVisualShape(
            bullet.GEOM_BOX,
            halfExtents=(scene.FLOOR_HALF_M, scene.FLOOR_HALF_M, 0.01),
            rgbaColor=(*scene.FLOOR_COLOUR, 1.0),
            visualFramePosition=(0, 0, -0.011),
            physicsClientId=client,
        )
        body = bullet.createMultiBody(0, ground, board, physicsClientId=client)
        bullet.changeDynamics(body, -1, lateralFriction=_FRICTION, physicsClientId=client)

    def _joint_indices(self) -> dict[str, int]:
        indices: dict[str, int] = {}
        for index in range(self._bullet.getNumJoints(self._body, physicsClientId=self._client)):
            info: Any = self._bullet.getJointInfo(self._body, index, physicsClientId=self._client)
            indices[info[1].decode()] = index
        return {name: indices[name] for name in self.table.names}

    def _near_links(self) -> set[frozenset[int]]:
        """Pairs of solid links with nothing solid between them: their boxes may overlap."""
        parents = {joint.child: joint for joint in self.table.joints}
        pairs = set()
        for joint in self.table.joints:
            above = joint.parent
            while above in parents and not any(s.solid for s in parents[above].link.shapes):
                above = parents[above].parent
            index = self._joints[parents[above].name] if above in parents else -1
            pairs.add(frozenset((self._joints[joint.name], index)))
        return pairs

    def _command(self, positions_rad: Mapping[str, float]) -> None:
        bullet = self._bullet
        for name in positions_rad:
            if name not in self._joints:
                raise InvalidArgument(f"{self.table.name} has no joint {name!r}")
        self._targets.update(positions_rad)
        count = len(self._joints)
        bullet.setJointMotorControlArray(
            self._body,
            list(self._joints.values()),
            bullet.POSITION_CONTROL,
            targetPositions=[self._targets[name] for name in self._joints],
            targetVelocities=[0.0] * count,
            forces=[self.table.max_torque_n_m] * count,
            positionGains=[self._gain] * count,
            velocityGains=[1.0] * count,
            physicsClientId=self._client,
        )
        bullet.stepSimulation(physicsClientId=self._client)
        if self._gui:
            self._wall_s = max(self._wall_s + self.step_s, time.monotonic() - 0.1)
            time.sleep(max(0.0, self._wall_s - time.monotonic()))
