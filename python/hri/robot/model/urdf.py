# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The robot as URDF text, for simulators and ROS; PyBullet fails on a URDF in one long line."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

import numpy as np

from hri.robot.model.joints import HOAP2, JointTable, Link, Shape, Vector
from hri.robot.model.kinematics import roll_pitch_yaw, rotation_about


def urdf_text(table: JointTable = HOAP2, locked: Collection[str] = (), capsules: bool = True) -> str:
    """The robot as URDF: joints with axes and limits, links with masses, inertias and simple shapes.

    Parameters
    ----------
    table : JointTable
    locked : collection of joint names
        Fixed where they rest.
    capsules : bool
        False writes a capsule as a cylinder and two spheres: PyBullet knows capsules, URDF as ROS reads it does not.
    """
    lines = ['<?xml version="1.0"?>', f'<robot name="{table.name}">']
    lines += _link(table.base, capsules)
    motor = f'effort="{table.max_torque_n_m}" velocity="{table.max_speed_rad_s}"'
    for joint in table.joints:
        lines += _link(joint.link, capsules)
        if joint.name in locked:
            turn = rotation_about(np.array(joint.axis), joint.rest_rad)
            lines += [
                f'  <joint name="{joint.name}" type="fixed">',
                f'    <parent link="{joint.parent}"/>',
                f'    <child link="{joint.child}"/>',
                f'    <origin xyz="{_text(joint.origin_m)}" rpy="{_text(roll_pitch_yaw(turn))}"/>',
                "  </joint>",
            ]
            continue
        lines += [
            f'  <joint name="{joint.name}" type="revolute">',
            f'    <parent link="{joint.parent}"/>',
            f'    <child link="{joint.child}"/>',
            f'    <origin xyz="{_text(joint.origin_m)}" rpy="0 0 0"/>',
            f'    <axis xyz="{_text(joint.axis)}"/>',
            f'    <limit lower="{joint.lower_rad}" upper="{joint.upper_rad}" {motor}/>',
            '    <dynamics damping="0" friction="0"/>',
            "  </joint>",
        ]
    return "\n".join([*lines, "</robot>"]) + "\n"


def _link(link: Link, capsules: bool) -> list[str]:
    ixx, iyy, izz, ixy, ixz, iyz = link.inertia_kg_m2
    lines = [
        f'  <link name="{link.name}">',
        "    <inertial>",
        f'      <origin xyz="{_text(link.com_m)}" rpy="0 0 0"/>',
        f'      <mass value="{link.mass_kg}"/>',
        f'      <inertia ixx="{ixx}" ixy="{ixy}" ixz="{ixz}" iyy="{iyy}" iyz="{iyz}" izz="{izz}"/>',
        "    </inertial>",
    ]
    shapes = link.shapes if capsules else tuple(part for shape in link.shapes for part in _plain(shape))
    for shape in shapes:
        lines += ["    <visual>", *_geometry(shape)]
        red, green, blue = shape.colour
        name = f"rgb_{red:g}_{green:g}_{blue:g}"
        lines += [
            f'      <material name="{name}"><color rgba="{red} {green} {blue} 1"/></material>',
            "    </visual>",
        ]
        if shape.solid:
            lines += ["    <collision>", *_geometry(shape), "    </collision>"]
    return [*lines, "  </link>"]


def _plain(shape: Shape) -> tuple[Shape, ...]:
    """A capsule as a cylinder and the spheres at its ends; other shapes as they are."""
    if shape.kind != "capsule":
        return (shape,)
    ends = (replace(shape, kind="sphere", start=end, end=end) for end in (shape.start, shape.end))
    return replace(shape, kind="cylinder"), *ends


def _geometry(shape: Shape) -> list[str]:
    start, end = np.array(shape.start), np.array(shape.end)
    roll_pitch_yaw = (0.0, 0.0, 0.0)
    if shape.kind == "box":
        form = f'<box size="{_text(shape.size)}"/>'
    elif shape.kind == "sphere":
        form = f'<sphere radius="{shape.radius}"/>'
    else:
        axis = end - start
        length = float(np.linalg.norm(axis))
        form = f'<{shape.kind} radius="{shape.radius}" length="{length:.9g}"/>'
        pitch = np.arctan2(np.hypot(axis[0], axis[1]), axis[2])
        roll_pitch_yaw = (0.0, float(pitch), float(np.arctan2(axis[1], axis[0])))
    centre = _text(tuple((start + end) / 2.0))
    return [
        f'      <origin xyz="{centre}" rpy="{_text(roll_pitch_yaw)}"/>',
        f"      <geometry>{form}</geometry>",
    ]


def _text(vector: Vector | tuple[float, ...]) -> str:
    return " ".join(f"{value:.9g}" for value in vector)
