# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The robots as URDF that ROS reads: what is in it is what the joint tables say, as others read it."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from hri.robot import ROBOTS, JointTable, link_poses, urdf_text

robots = pytest.mark.parametrize("table", ROBOTS.values(), ids=ROBOTS)


def vector(text: str | None) -> tuple[float, ...]:
    assert text is not None
    return tuple(map(float, text.split()))


def attributes(element: ElementTree.Element, name: str) -> dict[str, str]:
    found = element.find(name)
    assert found is not None, name
    return dict(found.attrib)


@robots
def test_joints_limits_axes_and_masses_are_the_tables(table: JointTable) -> None:
    root = ElementTree.fromstring(urdf_text(table, capsules=False))
    joints = {joint.get("name"): joint for joint in root.findall("joint")}
    assert tuple(joints) == table.names
    for joint in table.joints:
        found = joints[joint.name]
        assert found.get("type") == "revolute"
        assert (attributes(found, "parent"), attributes(found, "child")) == (
            {"link": joint.parent},
            {"link": joint.child},
        )
        assert vector(attributes(found, "axis")["xyz"]) == joint.axis
        assert vector(attributes(found, "origin")["xyz"]) == pytest.approx(joint.origin_m, abs=1e-9)
        limit = {name: float(value) for name, value in attributes(found, "limit").items()}
        assert (limit["lower"], limit["upper"]) == (joint.lower_rad, joint.upper_rad)
        assert (limit["velocity"], limit["effort"]) == (table.max_speed_rad_s, table.max_torque_n_m)
    links = {link.get("name"): link for link in root.findall("link")}
    assert list(links) == list(table.links)
    for name, link in table.links.items():
        inertial = links[name].find("inertial")
        assert inertial is not None and float(attributes(inertial, "mass")["value"]) == link.mass_kg
        held = attributes(inertial, "inertia")
        assert tuple(float(held[f"i{axes}"]) for axes in ("xx", "yy", "zz", "xy", "xz", "yz")) == link.inertia_kg_m2


@robots
def test_capsules_become_cylinders_with_round_ends(table: JointTable) -> None:
    root = ElementTree.fromstring(urdf_text(table, capsules=False))
    kinds = {element.tag for geometry in root.iter("geometry") for element in geometry}
    assert kinds <= {"box", "cylinder", "sphere"}
    for name, link in table.links.items():
        found = root.find(f"link[@name='{name}']")
        assert found is not None
        for tag, shapes in (("visual", link.shapes), ("collision", link.solid)):
            capsules = [shape for shape in shapes if shape.kind == "capsule"]
            parts = found.findall(tag)
            assert len(parts) == len(shapes) + 2 * len(capsules)
            spheres = [vector(attributes(p, "origin")["xyz"]) for p in parts if p.find("geometry/sphere") is not None]
            lengths = [float(c.attrib["length"]) for c in found.findall(f"{tag}/geometry/cylinder")]
            for capsule, length in zip(capsules, lengths, strict=True):
                assert length == pytest.approx(np.linalg.norm(np.subtract(capsule.end, capsule.start)), abs=1e-9)
                for end in (capsule.start, capsule.end):
                    assert any(np.allclose(end, sphere, atol=1e-9) for sphere in spheres)


@robots
@pytest.mark.skipif(shutil.which("check_urdf") is None, reason="liburdfdom-tools is not installed")
def test_check_urdf_finds_one_tree_without_faults(table: JointTable, tmp_path: Path) -> None:
    def checked(capsules: bool) -> subprocess.CompletedProcess[str]:
        path = tmp_path / "robot.urdf"
        path.write_text(urdf_text(table, capsules=capsules))
        return subprocess.run(["check_urdf", str(path)], capture_output=True, text=True, check=False)

    done = checked(capsules=False)
    assert done.returncode == 0 and done.stderr == "", done.stderr
    assert f"robot name is: {table.name}" in done.stdout and f"root Link: {table.base.name} has" in done.stdout
    assert set(re.findall(r"child\(\d+\):\s+(\S+)", done.stdout)) == {joint.child for joint in table.joints}
    assert "capsule" in checked(capsules=True).stderr, "it refuses what URDF does not know"


@robots
def test_pybullet_has_the_links_where_forward_kinematics_has_them(table: JointTable, tmp_path: Path) -> None:
    bullet = pytest.importorskip("pybullet")
    path = tmp_path / "robot.urdf"
    path.write_text(urdf_text(table, capsules=False))
    client = bullet.connect(bullet.DIRECT)
    try:
        flags = bullet.URDF_USE_INERTIA_FROM_FILE
        body = bullet.loadURDF(str(path), useFixedBase=True, flags=flags, physicsClientId=client)
        infos = [bullet.getJointInfo(body, i, physicsClientId=client) for i in range(bullet.getNumJoints(body, client))]
        assert [info[1].decode() for info in infos] == list(table.names)
        indices, (low, high) = list(range(len(infos))), table.limits_rad.T
        poses = np.random.default_rng(0).uniform(low, high, (100, len(table)))
        for positions in poses:
            for index, position in zip(indices, positions.tolist(), strict=True):
                bullet.resetJointState(body, index, position, physicsClientId=client)
            states = bullet.getLinkStates(body, indices, computeForwardKinematics=1, physicsClientId=client)
            ours = link_poses(dict(zip(table.names, positions.tolist(), strict=True)), np.eye(4), table)
            expected = np.array([ours[info[12].decode()] for info in infos])
            turns = np.reshape([bullet.getMatrixFromQuaternion(state[5]) for state in states], (-1, 3, 3))
            np.testing.assert_allclose([state[4] for state in states], expected[:, :3, 3], rtol=0, atol=1e-6)
            np.testing.assert_allclose(turns, expected[:, :3, :3], rtol=0, atol=1e-6)
    finally:
        bullet.disconnect(client)
