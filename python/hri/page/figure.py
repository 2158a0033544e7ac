# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A robot as strokes that a page draws: far cheaper than a picture, and a few hundred bytes."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.robot import JointTable, link_poses
from hri.robot.model.joints import Shape

_ROOM = 1.3  # above the head, for raised arms


def figure(positions_rad: Mapping[str, float], table: JointTable) -> dict[str, Any]:
    """Joints, and the robot from the front.

    Returns
    -------
    dict
        "joints": name to degrees; "height": of the robot in metres; "strokes": from the most distant to the nearest,
        each [x1, y1, x2, y2, width, colour, round], x to the right and y up, in metres from the middle of the floor.
    """
    strokes = _strokes(positions_rad, table)
    return {
        "joints": {name: round(float(np.degrees(angle)), 1) for name, angle in positions_rad.items()},
        "height": round(_ROOM * _height(table), 3),
        "strokes": [stroke for _, stroke in sorted(strokes, key=lambda pair: pair[0])],
    }


@lru_cache(maxsize=8)
def _height(table: JointTable) -> float:
    return float(max(max(stroke[1], stroke[3]) for _, stroke in _strokes(table.rest_rad, table)))


def _strokes(positions_rad: Mapping[str, float], table: JointTable) -> list[tuple[float, list[Any]]]:
    """How near each shape is, and its stroke."""
    poses = link_poses(positions_rad, table=table)
    links = (table.base, *(joint.link for joint in table.joints))
    return [_stroke(shape, poses[link.name]) for link in links for shape in link.shapes]


def _stroke(shape: Shape, pose: NDArray[np.float64]) -> tuple[float, list[Any]]:
    turn, place = pose[:3, :3], pose[:3, 3]
    if shape.kind == "box":
        sides = turn * np.array(shape.size)  # columns: the edges in the world
        seen = sides[1:]
        longest = int(np.argmax(np.linalg.norm(seen, axis=0)))
        across = np.array([-seen[1, longest], seen[0, longest]]) / np.linalg.norm(seen[:, longest])
        width = float(np.abs(across @ np.delete(seen, longest, axis=1)).max())
        centre = turn @ np.array(shape.start) + place
        first, last = centre - sides[:, longest] / 2.0, centre + sides[:, longest] / 2.0
    else:
        first, last = (turn @ np.array(end) + place for end in (shape.start, shape.end))
        width = 2.0 * shape.radius
    colour = "#" + "".join(f"{round(255 * min(1.0, max(0.0, part))):02x}" for part in shape.colour[:3])
    flat = [round(float(value), 4) for value in (first[1], first[2], last[1], last[2], width)]
    return float(first[0] + last[0]) / 2.0, [*flat, colour, shape.kind != "box"]
