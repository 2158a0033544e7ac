# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A robot as strokes that a page draws: far cheaper than a picture, and a few hundred bytes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.robot import JointTable, link_poses
from hri.robot.model.joints import Shape


def figure(positions_rad: Mapping[str, float], table: JointTable) -> dict[str, Any]:
    """Joints, and the robot from the front.

    Returns
    -------
    dict
        "joints": name to degrees; "height": of the robot in metres; "strokes": from the most distant to the nearest,
        each [x1, y1, x2, y2, width, colour, round], x to the right and y up, in metres from the middle of the floor.
    """
    poses = link_poses(positions_rad, table=table)
    strokes = [
        _stroke(shape, poses[link.name])
        for link in (table.base, *(joint.link for joint in table.joints))
        for shape in link.shapes
    ]
    return {
        "joints": {name: round(float(np.degrees(angle)), 1) for name, angle in positions_rad.items()},
        "height": round(1.35 * table.standing_height_m, 3),
        "strokes": [stroke for _, stroke in sorted(strokes, key=lambda pair: pair[0])],
    }


def _stroke(shape: Shape, pose: NDArray[np.float64]) -> tuple[float, list[Any]]:
    """How near the shape is, and its stroke."""
    if shape.kind == "box":
        centre, half = np.array(shape.start), np.array(shape.size) / 2.0
        along = np.array([0.0, 0.0, half[2]])
        ends, width = (centre - along, centre + along), 2.0 * half[1]
    else:
        ends, width = (np.array(shape.start), np.array(shape.end)), 2.0 * shape.radius
    first, last = (pose[:3, :3] @ end + pose[:3, 3] for end in ends)
    colour = "#" + "".join(f"{round(255 * min(1.0, max(0.0, part))):02x}" for part in shape.colour[:3])
    flat = [round(float(value), 4) for value in (first[1], first[2], last[1], last[2], width)]
    return float(first[0] + last[0]) / 2.0, [*flat, colour, shape.kind != "box"]
