# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The robot in PyBullet, with masses, motors and gravity; the only module that imports it."""

from __future__ import annotations

import os
import sys
import tempfile
import time
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import Error, InvalidArgument
from hri.core.files import write_text
from hri.core.optional import import_pybullet
from hri.robot.control.backend import Robot
from hri.robot.control.balance import Balance
from hri.robot.control.filming import Image
from hri.robot.control.state import FLOOR, Contact, RobotState
from hri.robot.model.joints import HOAP2, JointTable
from hri.robot.model.kinematics import Pose
from hri.robot.model.physics import Physics
from hri.robot.model.postures import base_pose
from hri.robot.model.urdf import urdf_text
from hri.robot.motion.trajectory import Trajectory
from hri.robot.simulation import scene
from hri.robot.simulation.eyesight import Screen, Shot, Sight, camera_of

# A base that stands on its feet needs soft joints; arms on a held base follow better with stiff.
_GAIN_FREE_PER_S = 10.0
_GAIN_FIXED_PER_S = 100.0
_SETTLE_S = 1.0
_BALANCE_STEPS = 5
# Of a joint that cannot follow: the share of its torque that it uses, and how far it is from where it was sent.
_STRAINING_SHARE = 0.98
_STRAINING_RAD = 0.1


class PyBulletRobot(Robot):
    """A robot simulated with steps of 1 ms; the same commands give the same motion to the last bit.

    Parameters
    ----------
    gui : bool
        Show PyBullet's window and move in real time.
    fixed_base : bool
        Hold the torso, as for gestures of the arms; without, it stands on its feet.
    locked : collection of joint names
        Held rigidly at rest, which makes the simulation quicker; they cannot be sent anywhere.
    physics : Physics, optional
    table : JointTable

    Raises
    ------
    ImportError
        When PyBullet is not installed; the message says how to get it.
    InvalidArgument
        For a window where there is no display, or names that are no joints.
    """

    def __init__(
        self,
        gui: bool = False,
        fixed_base: bool = True,
        locked: Collection[str] = (),
        physics: Physics | None = None,
        table: JointTable = HOAP2,
    ) -> None:
        super().__init__(table)
        self._physics = physics or Physics()
        for name in (*locked, *self._physics.joint_offsets_rad):
            table.index(name)
        self._bullet = import_pybullet()
        if gui and sys.platform == "linux" and not os.environ.get("DISPLAY"):
            raise InvalidArgument("there is no display for the robot's window: DISPLAY is not set")  # else it exits
        self._client = self._bullet.connect(self._bullet.GUI if gui else self._bullet.DIRECT)
        if self._client < 0:
            raise Error("PyBullet gives no simulation")
        self._gui = gui
        self._wall_s = time.monotonic()
        self._fixed_base = fixed_base
        self._locked = frozenset(locked)
        self._balance = Balance(table, _GAIN_FREE_PER_S) if self._physics.balance and not fixed_base else None
        self._since_balance = 0
        self._sight = Sight(self._bullet, self._client)
        try:
            self._build()
        except BaseException:
            self.close()
            raise

    @property
    def on_feet(self) -> bool:
        """As of `Robot`."""
        return not self._fixed_base

    def _state(self) -> RobotState:
        bullet = self._bullet
        position, turn = self._base()
        states = bullet.getJointStates(self._body, self._moving, physicsClientId=self._client)
        forces: dict[tuple[str, str], float] = {}
        for point in bullet.getContactPoints(self._body, physicsClientId=self._client):
            ours = self._links[point[3]]
            other = self._links[point[4]] if point[2] == self._body else FLOOR
            first, second = (ours, other) if other == FLOOR else sorted((ours, other))
            forces[first, second] = forces.get((first, second), 0.0) + point[9]
        return RobotState(
            self.time_s,
            position,
            bullet.getEulerFromQuaternion(turn),
            self._by_name(states, 0, self._offsets),
            self._by_name(states, 3, None),
            tuple(Contact(*pair, force) for pair, force in sorted(forces.items())),
        )

    def _joint_positions(self) -> dict[str, float]:
        states = self._bullet.getJointStates(self._body, self._moving, physicsClientId=self._client)
        return self._by_name(states, 0, self._offsets)

    def link_positions_m(self) -> dict[str, tuple[float, float, float]]:
        """Origins of the links' frames in the world, by name of the joint that carries them."""
        self._require_open()
        indices = [self._indices[name] for name in self.table.names]
        states = self._bullet.getLinkStates(
            self._body, indices, computeForwardKinematics=1, physicsClientId=self._client
        )
        return {name: state[4] for name, state in zip(self.table.names, states, strict=True)}

    def links_nearer_than(self, margin_m: float = 0.0) -> list[tuple[str, str]]:
        """Pairs of solid links nearer than a margin, by joint, but for those that adjoin (`JointTable.adjoining`)."""
        self._require_open()
        joints = {joint.child: joint.name for joint in self.table.joints}
        points = self._bullet.getClosestPoints(self._body, self._body, margin_m, physicsClientId=self._client)
        pairs = {frozenset((self._links[point[3]], self._links[point[4]])) for point in points}
        far = (sorted(pair) for pair in pairs if len(pair) == 2 and pair not in self.table.adjoining)
        return sorted((joints.get(first, "base"), joints.get(second, "base")) for first, second in far)

    def put_screen(self, screen: Screen) -> None:
        """Put a screen before the robot, in place of another one; nothing collides with it.

        Parameters
        ----------
        screen : Screen
        """
        self._require_open()
        self._sight.put(screen)

    def see(self, camera: str) -> Image:
        """What a camera of the robot sees: the floor, its own arms, and a screen.

        Parameters
        ----------
        camera : str
            As the table names it: NAO's are "CameraTop" and "CameraBottom".

        Returns
        -------
        ndarray of uint8, shape (height, width, 3)
            RGB, of the camera's own size and angles of view.

        Raises
        ------
        InvalidArgument
            For a camera that the robot does not have.
        """
        self._require_open()
        entry = camera_of(self.table, camera)
        # A robot that holds its torso sees the same while its joints are where they were.
        still = tuple(self._joint_positions().values()) if self._fixed_base else None
        return self._sight.look(entry, self._link_pose(entry.link), still, self._picture)

    def _link_pose(self, name: str) -> Pose:
        """Of the link's frame in the world."""
        index = next(index for index, link in self._links.items() if link == name)
        if index == -1:
            position, turn = self._base()
        else:
            position, turn = self._bullet.getLinkState(
                self._body, index, computeForwardKinematics=1, physicsClientId=self._client
            )[4:6]
        pose = np.eye(4)
        pose[:3, :3] = np.array(self._bullet.getMatrixFromQuaternion(turn)).reshape(3, 3)
        pose[:3, 3] = position
        return pose

    def known_positions_rad(self) -> dict[str, float]:
        """Where the joints are."""
        return self.joint_positions_rad()

    def _render(self, width: int, height: int) -> Image:
        scene.check_size(width, height)
        bullet = self._bullet
        eye, target = scene.camera(self._base()[0] if not self._fixed_base else None)
        view = bullet.computeViewMatrix(eye.tolist(), target.tolist(), scene.UP)
        projection = bullet.computeProjectionMatrixFOV(scene.FIELD_OF_VIEW_DEG, width / height, 0.1, 5.0)
        return self._picture(width, height, view, projection)[0]

    def _picture(self, width: int, height: int, view: Any, projection: Any) -> Shot:
        """A picture, and the number of the body that each pixel shows, below 0 for none."""
        bullet = self._bullet
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
        bodies = np.asarray(mask, dtype=np.int32).reshape(height, width)
        return np.where(bodies[..., np.newaxis] < 0, scene.backdrop(width, height), image), bodies

    def _close(self) -> None:
        if self._client >= 0:
            client, self._client = self._client, -1
            self._bullet.disconnect(client)

    def _build(self) -> None:
        bullet, client = self._bullet, self._client
        bullet.setGravity(0, 0, -9.81, physicsClientId=client)
        bullet.setPhysicsEngineParameter(
            fixedTimeStep=self.step_s,
            numSolverIterations=self._physics.solver_iterations,
            physicsClientId=client,
        )
        self._add_floor()
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "robot.urdf"
            write_text(path, urdf_text(self.table, self._locked))
            self._body = bullet.loadURDF(
                str(path),
                (0, 0, self.table.standing_height_m),
                useFixedBase=self._fixed_base,
                flags=bullet.URDF_USE_INERTIA_FROM_FILE | bullet.URDF_USE_SELF_COLLISION,
                physicsClientId=client,
            )
        self._index_joints()
        self._set_dynamics()
        self.reset(self.table.rest_rad, None if self._fixed_base else "standing")

    def _add_floor(self) -> None:
        bullet, client = self._bullet, self._client
        ground = bullet.createCollisionShape(bullet.GEOM_PLANE, physicsClientId=client)
        half = scene.FLOOR_HALF_M if self._fixed_base else scene.WALK_HALF_M
        board = bullet.createVisualShape(
            bullet.GEOM_BOX,
            halfExtents=(half, half, 0.01),
            rgbaColor=(*scene.FLOOR_COLOUR, 1.0),
            visualFramePosition=(0, 0, -0.011),
            physicsClientId=client,
        )
        self._floor = bullet.createMultiBody(0, ground, board, physicsClientId=client)
        bullet.changeDynamics(self._floor, -1, lateralFriction=self._physics.friction, physicsClientId=client)

    def _index_joints(self) -> None:
        bullet, client = self._bullet, self._client
        self._indices: dict[str, int] = {}
        for index in range(bullet.getNumJoints(self._body, physicsClientId=client)):
            info: Any = bullet.getJointInfo(self._body, index, physicsClientId=client)
            self._indices[info[1].decode()] = index
        self._links = {self._indices[joint.name]: joint.child for joint in self.table.joints}
        self._links[-1] = self.table.base.name
        self._feet = [next(i for i, link in self._links.items() if link == foot) for foot in self.table.feet]
        self._names = tuple(name for name in self.table.names if name not in self._locked)
        self._moving = [self._indices[name] for name in self._names]
        self._offsets = [self._physics.joint_offsets_rad.get(name, 0.0) for name in self._names]
        self._corrections = [0.0] * len(self._names)  # of the balance, to what is sent
        gain = _GAIN_FIXED_PER_S if self._fixed_base else _GAIN_FREE_PER_S
        count = len(self._names)
        self._motors = {
            "targetVelocities": [0.0] * count,
            "forces": [self.table.max_torque_n_m] * count,
            "positionGains": [gain * self.step_s] * count,
            "velocityGains": [1.0] * count,
        }

    def _set_dynamics(self) -> None:
        bullet, client, scale = self._bullet, self._client, self._physics.mass_scale
        for index in self._links:
            found = bullet.getDynamicsInfo(self._body, index, physicsClientId=client)
            if index == -1:  # PyBullet's base frame is that of its inertia
                self._inertia_to_base = bullet.invertTransform(found[3], found[4])
                self._base_to_inertia = found[3:5]
            heavier = {}
            if scale != 1.0:
                heavier = {"mass": found[0] * scale, "localInertiaDiagonal": [value * scale for value in found[2]]}
            bullet.changeDynamics(
                self._body,
                index,
                lateralFriction=self._physics.friction,
                linearDamping=0,
                angularDamping=0,
                jointDamping=0,
                physicsClientId=client,
                **heavier,
            )
        by_link = {link: index for index, link in self._links.items()}
        for first, second in sorted(sorted(pair) for pair in self.table.adjoining):  # its order changes the last bits
            bullet.setCollisionFilterPair(
                self._body, self._body, by_link[first], by_link[second], 0, physicsClientId=client
            )

    def _place(self, positions_rad: Mapping[str, float], posture: str | None) -> None:
        bullet, client = self._bullet, self._client
        for name in self._locked.intersection(positions_rad):
            if abs(positions_rad[name] - self.table[name].rest_rad) > 1e-9:
                raise InvalidArgument(f"joint {name} is locked")
        for name, index, offset in zip(self._names, self._moving, self._offsets, strict=True):
            if name in positions_rad:
                bullet.resetJointState(self._body, index, positions_rad[name] + offset, physicsClientId=client)
        if posture is None or self._fixed_base:
            return
        base = base_pose(self._commanded, posture, self.table)
        position, turn = bullet.multiplyTransforms(base[:3, 3].tolist(), _quaternion(base), *self._base_to_inertia)
        bullet.resetBasePositionAndOrientation(self._body, position, turn, physicsClientId=client)
        bullet.resetBaseVelocity(self._body, (0, 0, 0), (0, 0, 0), physicsClientId=client)
        self._corrections = [0.0] * len(self._names)
        balance, self._balance = self._balance, None
        for _ in range(round(_SETTLE_S / self.step_s)):
            self._command({})
        self._balance = balance
        if balance is not None:
            balance.start(self._commanded)

    def _command(self, positions_rad: Mapping[str, float]) -> None:
        bullet = self._bullet
        if self._balance is not None:
            self._keep_balance(self._balance)
        sent = self._commanded
        bullet.setJointMotorControlArray(
            self._body,
            self._moving,
            bullet.POSITION_CONTROL,
            targetPositions=[
                sent[name] + more + offset
                for name, more, offset in zip(self._names, self._corrections, self._offsets, strict=True)
            ],
            physicsClientId=self._client,
            **self._motors,
        )
        bullet.stepSimulation(physicsClientId=self._client)
        if self._gui:
            self._wall_s = max(self._wall_s + self.step_s, time.monotonic() - 0.1)
            time.sleep(max(0.0, self._wall_s - time.monotonic()))

    def _keep_balance(self, balance: Balance) -> None:
        self._since_balance += 1
        if self._since_balance < _BALANCE_STEPS:
            return
        elapsed_s = self._since_balance * self.step_s
        self._since_balance = 0
        bullet, client = self._bullet, self._client
        turn = np.array(bullet.getMatrixFromQuaternion(self._base()[1])).reshape(3, 3)
        rate = np.array(bullet.getBaseVelocity(self._body, physicsClientId=client)[1])
        joints = self._joint_positions() if balance.rising else None
        found = balance.corrections(self._commanded, turn, rate, self._pressures(), elapsed_s, joints)
        self._corrections = [found.get(name, 0.0) for name in self._names]

    def _pressures(self) -> NDArray[np.float64]:
        """Of every foot the force of the floor, and x and y of its centre in the foot's frame."""
        bullet, client = self._bullet, self._client
        sums = {foot: [0.0, 0.0, 0.0, 0.0] for foot in self._feet}
        for point in bullet.getContactPoints(self._body, self._floor, physicsClientId=client):
            if point[3] in sums:
                total, force = sums[point[3]], point[9]
                total[0] += force
                for axis, value in enumerate(point[5], start=1):
                    total[axis] += force * value
        found = np.zeros((len(self._feet), 3))
        states = bullet.getLinkStates(self._body, self._feet, computeForwardKinematics=1, physicsClientId=client)
        for row, state, (force, *moment) in zip(found, states, sums.values(), strict=True):
            if force > 0.0:
                turn = np.array(bullet.getMatrixFromQuaternion(state[5])).reshape(3, 3)
                row[:] = force, *((np.array(moment) / force - state[4]) @ turn)[:2]
        return found

    def _why_not(self, trajectory: Trajectory) -> str:
        for name, positions in zip(trajectory.joint_names, trajectory.positions_rad.T, strict=True):
            if name in self._locked and not (np.abs(positions - self.table[name].rest_rad) <= 1e-9).all():
                return f"joint {name} is locked"
        return ""

    def _tilt_deg(self) -> float:
        if self._fixed_base:
            return 0.0
        x, y, _, _ = self._base()[1]
        return float(np.degrees(np.arccos(np.clip(1.0 - 2.0 * (x * x + y * y), -1.0, 1.0))))

    def _touching(self) -> Iterator[Contact]:
        points = self._bullet.getContactPoints(self._body, self._body, physicsClientId=self._client)
        for point in points:
            if point[9] > 0.0:
                first, second = sorted((self._links[point[3]], self._links[point[4]]))
                yield Contact(first, second, point[9])

    def _straining(self) -> list[str]:
        states = self._bullet.getJointStates(self._body, self._moving, physicsClientId=self._client)
        most = _STRAINING_SHARE * self.table.max_torque_n_m
        joints = zip(self._names, states, self._corrections, self._offsets, strict=True)
        return [
            name
            for name, state, more, offset in joints
            if abs(state[3]) >= most and abs(self._commanded[name] + more + offset - state[0]) > _STRAINING_RAD
        ]

    def _on_feet_alone(self) -> bool:
        points = self._bullet.getContactPoints(self._body, self._floor, physicsClientId=self._client)
        return all(point[3] in self._feet for point in points)

    def _base(self) -> tuple[tuple[float, float, float], tuple[float, float, float, float]]:
        """Position and quaternion (x, y, z, w) of the base link's frame."""
        pose = self._bullet.getBasePositionAndOrientation(self._body, physicsClientId=self._client)
        found: Any = self._bullet.multiplyTransforms(*pose, *self._inertia_to_base)
        return found

    def _by_name(self, states: Any, place: int, offsets: list[float] | None) -> dict[str, float]:
        """One value of every joint's state, in the order of the table; locked joints rest."""
        moving = (state[place] for state in states)
        if offsets is not None:
            moving = (value - offset for value, offset in zip(moving, offsets, strict=True))
        found = dict(zip(self._names, moving, strict=True))
        return {name: found.get(name, self.table[name].rest_rad if place == 0 else 0.0) for name in self.table.names}


def _quaternion(pose: Pose) -> list[float]:
    """Of a rotation by less than half a turn, as x, y, z, w."""
    m = pose[:3, :3]
    w = 0.5 * np.sqrt(max(1.0 + np.trace(m), 1e-12))
    return [(m[2, 1] - m[1, 2]) / (4 * w), (m[0, 2] - m[2, 0]) / (4 * w), (m[1, 0] - m[0, 1]) / (4 * w), w]
