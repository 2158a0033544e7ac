# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""How far an arm stays from the body and from the other arm, for many poses at once.

The forearm and the hand are taken as balls along a line that hold their solid boxes; the body is the solid shapes of
the base, the thighs and the head, legs straight. Places are relative to a left arm's shoulder, as in `arm`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hri.robot.model.arm import Arm
from hri.robot.model.joints import HOAP2, JointTable
from hri.robot.model.kinematics import link_poses

Floats = NDArray[np.float64]

# From the elbow along the forearm, and the radius there.
_BALLS_M = ((0.01, 0.027), (0.035, 0.027), (0.06, 0.027), (0.085, 0.026), (0.11, 0.018), (0.135, 0.018))
_BODY_LINKS = ("base_link", "body_link_1", "lleg_link_2", "rleg_link_2", "head_link_2")


@dataclass(frozen=True)
class Body:
    """Boxes and balls of the trunk: `centres` (shapes, 3), `halves` (shapes, 3) and `radii` (shapes,)."""

    centres_m: Floats
    halves_m: Floats
    radii_m: Floats


def body_of(arm: Arm, table: JointTable = HOAP2) -> Body:
    """The body as the left arm of this pair sees it; HOAP-2 is its own mirror image."""
    poses = link_poses({}, base=np.eye(4), table=table)
    links = {table.base.name: table.base, **{joint.child: joint.link for joint in table.joints}}
    centres, halves, radii = [], [], []
    for name in _BODY_LINKS:
        for shape in links[name].shapes:
            if shape.solid:
                centres.append(poses[name][:3, 3] + np.array(shape.start) - np.abs(arm.shoulder_m) * _SIGNS)
                halves.append(np.array(shape.size) / 2.0)
                radii.append(shape.radius)
    return Body(np.array(centres), np.array(halves), np.array(radii))


_SIGNS = np.array([-1.0, 1.0, 1.0])  # of the left shoulder's place


def forearm_balls(arm: Arm, elbow_m: Floats, hand_m: Floats) -> tuple[Floats, Floats]:
    """Centres, shape (..., balls, 3), and radii, shape (balls,), for elbows and hands of shape (..., 3)."""
    along = np.array([place for place, _ in _BALLS_M]) / arm.fore_m
    centres = elbow_m[..., np.newaxis, :] + along[:, np.newaxis] * (hand_m - elbow_m)[..., np.newaxis, :]
    return centres, np.array([radius for _, radius in _BALLS_M])


def body_clearance(body: Body, balls_m: Floats, radii_m: Floats) -> Floats:
    """Distance of the nearest ball from the body, below 0 inside; the last two axes go."""
    nearest = np.full(balls_m.shape[:-1], np.inf)
    for centre, half, radius in zip(body.centres_m, body.halves_m, body.radii_m, strict=True):
        x, y, z = (np.abs(balls_m[..., i] - centre[i]) - half[i] for i in range(3))
        outside = np.sqrt(np.maximum(x, 0.0) ** 2 + np.maximum(y, 0.0) ** 2 + np.maximum(z, 0.0) ** 2)
        inside = np.minimum(np.maximum(np.maximum(x, y), z), 0.0)
        nearest = np.minimum(nearest, outside + inside - radius)
    return np.asarray((nearest - radii_m).min(axis=-1))


def arms_clearance(balls_m: Floats, radii_m: Floats, others_m: Floats) -> Floats:
    """Distance between balls of two forearms, in one frame; shapes (..., balls, 3) broadcast, the last two axes go."""
    apart = np.linalg.norm(balls_m[..., :, np.newaxis, :] - others_m[..., np.newaxis, :, :], axis=-1)
    return (apart - radii_m[:, np.newaxis] - radii_m).min(axis=(-2, -1))


def mirrored_to_other(arm: Arm, points_m: Floats) -> Floats:
    """Points of one arm as the other arm, mirrored to a left one, sees them."""
    return points_m * (1.0, -1.0, 1.0) - (0.0, 2.0 * abs(arm.shoulder_m[1]), 0.0)
