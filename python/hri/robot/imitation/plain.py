# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Arm poses from plain angles: the arm turned towards the hand with atan2, the upper arm not twisted.

It takes a few lines, and is what the other form is measured against. Without twist the elbow stays below the line from
shoulder to hand, and as HOAP-2's upper arm cannot point inwards, the hand cannot come before the chest.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hri.robot.imitation.search import DEPTH_M, Path
from hri.robot.model.arm import Arm, arm_points

Floats = NDArray[np.float64]


def plain_path(arm: Arm, targets_m: Floats, smooth_m: Floats) -> Path:
    """Poses with the hand a fixed distance before the shoulder; angles beyond a limit are put to the limit.

    Parameters
    ----------
    targets_m : ndarray, shape (frames, 2)
        Outwards and up from the shoulder; reached where no angle had to be put to its limit.
    smooth_m : ndarray, shape (frames, 2)
        The same, smoothed: where the hand is to go.
    """
    _, reached = _angles(arm, targets_m)
    angles, _ = _angles(arm, smooth_m)
    return Path(angles, arm_points(arm, angles)[1], reached)


def _angles(arm: Arm, targets_m: Floats) -> tuple[Floats, NDArray[np.bool_]]:
    y, z = targets_m[:, 0], targets_m[:, 1]
    distance = np.sqrt(DEPTH_M**2 + y**2 + z**2)
    cosine = (distance**2 - arm.upper_m**2 - arm.fore_m**2) / (2.0 * arm.upper_m * arm.fore_m)
    bend = np.arctan2(np.sqrt(np.maximum(0.0, 1.0 - cosine**2)), cosine)
    along = arm.upper_m + arm.fore_m * np.cos(bend)
    up = arm.fore_m * np.sin(bend)
    forward = np.sqrt(np.maximum(along**2 - y**2, 0.0))
    out = np.arctan2(y, forward)
    pitch = np.arctan2(up, forward) - np.arctan2(z, DEPTH_M)
    angles = np.stack((pitch, out, np.zeros_like(y), -bend), axis=1)
    reached = arm.within(angles) & (np.abs(cosine) <= 1.0) & (along >= np.abs(y))
    return np.clip(angles, arm.limits_rad[:, 0], arm.limits_rad[:, 1]), reached
