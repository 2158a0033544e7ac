# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Whether links would touch one another in a motion, by their boxes and spheres alone; needs no simulator."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from hri.robot.model.joints import HOAP2, JointTable, Shape
from hri.robot.motion.trajectory import Trajectory

Floats = NDArray[np.float64]
ShapePair = tuple[tuple[str, Shape], tuple[str, Shape]]
_LOOK_EVERY_RAD = 0.08  # of the joint with the largest displacement
_TOLERANCE_M = 0.001
_ROWS_AT_ONCE = 256


@dataclass(frozen=True)
class Touch:
    """Two links that overlap in a row of a motion, counted from 0, and by how much; the base is never the first.

    Of links that are only near, the depth is the negative of their distance, or a little more.
    """

    row: int
    link: str
    other: str
    depth_m: float

    @property
    def overlaps(self) -> bool:
        """By more than a millimetre; otherwise they are near."""
        return self.depth_m > _TOLERANCE_M


def self_collisions(
    trajectory: Trajectory,
    table: JointTable = HOAP2,
    others_rad: Mapping[str, float] | None = None,
    legs_nearer_than_m: float = 0.0,
    moved_alone: bool = False,
) -> list[Touch]:
    """Pairs of links whose solid shapes overlap by more than a millimetre.

    Joints that the motion does not name are at `others_rad`, and rest where that does not name them either. Links that
    adjoin (`JointTable.adjoining`) are left out. A row is looked at whenever a joint has moved by 0.08 rad; a row with
    an unknown position is passed over. `legs_nearer_than_m` above 0 also finds links of different legs that come that
    near, in motions of the legs. With `moved_alone`, links that the motion does not move against one another are left
    out.

    Returns
    -------
    list of Touch
        By row; of every pair that stays in touch only the deepest.
    """
    rows = _rows_to_look_at(trajectory.positions_rad)
    if not len(rows):
        return []
    places = _link_frames(trajectory, rows, table, table.rest_rad | dict(others_rad or {}))
    touches: list[Touch] = []
    pairs = _moved_pairs(table, frozenset(trajectory.joint_names)) if moved_alone else _shape_pairs(table)
    leg_of = _legs(table) if legs_nearer_than_m > 0.0 and _moves_legs(trajectory, table) else {}
    for (first, a), (second, b) in _near_pairs(places, pairs, legs_nearer_than_m):
        two_legs = first in leg_of and second in leg_of and leg_of[first] != leg_of[second]
        margin_m = legs_nearer_than_m if two_legs else 0.0
        depths = _depths(a, places[first], b, places[second], margin_m)
        least = -margin_m if two_legs else _TOLERANCE_M
        runs = np.flatnonzero(np.diff(np.concatenate(([False], depths > least, [False])).astype(np.int8)))
        for begin, end in runs.reshape(-1, 2).tolist():
            deepest = begin + int(np.argmax(depths[begin:end]))
            link, other = sorted((first, second), key=lambda name: (name == table.base.name, name))
            touches.append(Touch(int(rows[deepest]), link, other, float(depths[deepest])))
    return sorted(touches, key=lambda touch: (touch.row, touch.link, touch.other))


@lru_cache(maxsize=8)
def _legs(table: JointTable) -> dict[str, str]:
    """The foot of every link that is part of one leg alone."""
    carriers = {joint.child: joint.parent for joint in table.joints}
    found: dict[str, list[str]] = {}
    for foot in table.feet:
        link = foot
        while link in carriers:
            found.setdefault(link, []).append(foot)
            link = carriers[link]
    return {link: feet[0] for link, feet in found.items() if len(feet) == 1}


def _moves_legs(trajectory: Trajectory, table: JointTable) -> bool:
    legs = _legs(table)
    return any(table[name].child in legs for name in trajectory.joint_names)


def _rows_to_look_at(positions: Floats) -> NDArray[np.intp]:
    known = np.flatnonzero(np.isfinite(positions).all(axis=1))
    if len(known) < 2:
        return known
    moved = np.cumsum(np.abs(np.diff(positions[known], axis=0)).max(axis=1))
    step = np.floor(np.concatenate(([0.0], moved)) / _LOOK_EVERY_RAD)
    chosen = np.flatnonzero(np.diff(step, prepend=-1.0, append=np.inf)[:-1] > 0)
    return known[np.union1d(chosen, [len(known) - 1])]


def _link_frames(
    trajectory: Trajectory, rows: NDArray[np.intp], table: JointTable, others_rad: Mapping[str, float]
) -> dict[str, tuple[Floats, Floats]]:
    """Rotations, shape (rows, 3, 3), and origins, (rows, 3), of all links in the base's frame."""
    count = len(rows)
    places = {table.base.name: (np.tile(np.eye(3), (count, 1, 1)), np.zeros((count, 3)))}
    columns = {name: column for column, name in enumerate(trajectory.joint_names)}
    for joint in table.joints:
        turn, origin = places[joint.parent]
        place = origin + turn @ np.array(joint.origin_m)
        column = columns.get(joint.name)
        angle = trajectory.positions_rad[rows, column] if column is not None else np.full(count, others_rad[joint.name])
        x, y, z = joint.axis
        cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        sine, cosine = np.sin(angle)[:, None, None], np.cos(angle)[:, None, None]
        places[joint.child] = (turn @ (np.eye(3) + sine * cross + (1.0 - cosine) * (cross @ cross)), place)
    return places


@lru_cache(maxsize=8)
def _shape_pairs(table: JointTable) -> list[ShapePair]:
    shapes = [(name, shape) for name, link in table.links.items() for shape in link.solid]
    pairs = []
    for first, second in combinations(shapes, 2):
        names = frozenset((first[0], second[0]))
        if len(names) == 2 and names not in table.adjoining:
            pairs.append((first, second) if first[1].kind == "box" else (second, first))
    return pairs


@lru_cache(maxsize=8)
def _moved_pairs(table: JointTable, moving: frozenset[str]) -> list[ShapePair]:
    """Pairs with a moving joint between them."""
    carried: dict[str, frozenset[str]] = {table.base.name: frozenset()}
    for joint in table.joints:
        carried[joint.child] = carried[joint.parent] | ({joint.name} & moving)
    return [pair for pair in _shape_pairs(table) if carried[pair[0][0]] != carried[pair[1][0]]]


def _near_pairs(places: dict[str, tuple[Floats, Floats]], pairs: list[ShapePair], margin_m: float) -> list[ShapePair]:
    """Pairs whose balls around them come within the margin in any row: few of hundreds."""
    if not pairs:
        return []
    shapes = list(dict.fromkeys(one for pair in pairs for one in pair))
    centres = np.stack([places[name][1] + places[name][0] @ np.array(shape.start) for name, shape in shapes])
    reaches = np.array([_reach(shape) for _, shape in shapes])
    number = {one: place for place, one in enumerate(shapes)}
    first, second = (np.array([number[pair[side]] for pair in pairs]) for side in range(2))
    nearest = np.full(len(pairs), np.inf)
    for begin in range(0, centres.shape[1], _ROWS_AT_ONCE):
        part = centres[:, begin : begin + _ROWS_AT_ONCE]
        nearest = np.minimum(nearest, np.linalg.norm(part[first] - part[second], axis=2).min(axis=1))
    return [pairs[place] for place in np.flatnonzero(nearest < reaches[first] + reaches[second] + margin_m)]


def _depths(a: Shape, at: tuple[Floats, Floats], b: Shape, bt: tuple[Floats, Floats], margin_m: float) -> Floats:
    """By how much two shapes overlap in every row; below 0 where they do not, -1 where they are further apart."""
    centre_a, centre_b = at[1] + at[0] @ np.array(a.start), bt[1] + bt[0] @ np.array(b.start)
    between = centre_b - centre_a
    near = np.linalg.norm(between, axis=1) < _reach(a) + _reach(b) + margin_m
    depths = np.full(len(between), -1.0)
    if not near.any():
        return depths
    turn_a, turn_b, between = at[0][near], bt[0][near], between[near]
    if a.kind != "box":
        depths[near] = a.radius + b.radius - np.linalg.norm(between, axis=1)
    elif b.kind != "box":
        depths[near] = _sphere_in_box(np.einsum("nij,ni->nj", turn_a, between), np.array(a.size) / 2.0, b.radius)
    else:
        depths[near] = _box_in_box(turn_a, np.array(a.size) / 2.0, turn_b, np.array(b.size) / 2.0, between)
    return depths


def _reach(shape: Shape) -> float:
    return float(np.linalg.norm(shape.size)) / 2.0 + shape.radius


def _sphere_in_box(centre: Floats, half: Floats, radius: float) -> Floats:
    """Depth of a sphere whose centre is given in the box's frame."""
    outside = np.abs(centre) - half
    distance = np.linalg.norm(np.maximum(outside, 0.0), axis=1) + np.minimum(outside.max(axis=1), 0.0)
    return radius - distance


def _box_in_box(turn_a: Floats, half_a: Floats, turn_b: Floats, half_b: Floats, between: Floats) -> Floats:
    """Least overlap over the 15 axes that can part two boxes (Gottschalk, Lin and Manocha, 1996)."""
    cosines = np.einsum("nki,nkj->nij", turn_a, turn_b)
    sizes = np.abs(cosines)
    along_a = np.einsum("nki,nk->ni", turn_a, between)
    along_b = np.einsum("nki,nk->ni", turn_b, between)
    depth = np.minimum(
        (half_a + sizes @ half_b - np.abs(along_a)).min(axis=1),
        (half_b + np.einsum("nij,i->nj", sizes, half_a) - np.abs(along_b)).min(axis=1),
    )
    for i in range(3):
        i1, i2 = (i + 1) % 3, (i + 2) % 3
        for j in range(3):
            j1, j2 = (j + 1) % 3, (j + 2) % 3
            length = np.sqrt(np.maximum(1.0 - cosines[:, i, j] ** 2, 0.0))
            reach = half_a[i1] * sizes[:, i2, j] + half_a[i2] * sizes[:, i1, j]
            reach += half_b[j1] * sizes[:, i, j2] + half_b[j2] * sizes[:, i, j1]
            apart = np.abs(along_a[:, i2] * cosines[:, i1, j] - along_a[:, i1] * cosines[:, i2, j])
            parallel = length < 1e-6  # then the axes of the faces suffice
            depth = np.where(parallel, depth, np.minimum(depth, (reach - apart) / np.maximum(length, 1e-6)))
    return depth
