# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Where the centre of mass is over the soles, from joint angles, gyroscope and the masses of the table."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hri.robot.model.joints import JointTable

Floats = NDArray[np.float64]


class MassCentre:
    """Centre of mass and soles for given joint positions.

    Parameters
    ----------
    table : JointTable
        A foot's sole is the underside of its lowest solid shape, a box.
    """

    def __init__(self, table: JointTable) -> None:
        places = {table.base.name: 0} | {joint.child: row for row, joint in enumerate(table.joints, start=1)}
        self._parents = [places[joint.parent] for joint in table.joints]
        self._origins = np.array([joint.origin_m for joint in table.joints])
        x, y, z = np.array([joint.axis for joint in table.joints], dtype=np.float64).T
        none = np.zeros_like(x)
        self._crosses = np.stack((none, -z, y, z, none, -x, -y, x, none), axis=-1).reshape(-1, 3, 3)
        self._squares = self._crosses @ self._crosses
        links = (table.base, *(joint.link for joint in table.joints))
        masses = np.array([link.mass_kg for link in links])
        self._shares = masses / masses.sum()
        self._centres = np.array([link.com_m for link in links])
        self._feet = [places[foot] for foot in table.feet]
        self._corners = np.array([_corners(table, foot) for foot in table.feet])

    def soles_from_it(self, positions_rad: Floats, turn: Floats) -> Floats:
        """Corners of every sole as the centre of mass sees them, along the axes of the world.

        Parameters
        ----------
        positions_rad : ndarray, shape (joints,)
            In the order of the table.
        turn : ndarray, shape (3, 3)
            From the base's frame to the world.

        Returns
        -------
        ndarray, shape (feet, 4, 3)
        """
        angles = positions_rad[:, np.newaxis, np.newaxis]
        locals_ = np.eye(3) + np.sin(angles) * self._crosses + (1.0 - np.cos(angles)) * self._squares
        turns, places = [turn], [np.zeros(3)]
        for parent, local, origin in zip(self._parents, locals_, self._origins, strict=True):
            places.append(places[parent] + turns[parent] @ origin)
            turns.append(turns[parent] @ local)
        every_turn, every_place = np.array(turns), np.array(places)
        centres = every_place + (every_turn @ self._centres[:, :, np.newaxis])[:, :, 0]
        corners = self._corners @ every_turn[self._feet].transpose(0, 2, 1) + every_place[self._feet][:, np.newaxis]
        found: Floats = corners - self._shares @ centres
        return found


def _corners(table: JointTable, foot: str) -> Floats:
    sole = min(table.links[foot].solid, key=lambda shape: shape.start[2] - shape.size[2] / 2.0)
    signs = np.array([(x, y, -1.0) for x in (-1.0, 1.0) for y in (-1.0, 1.0)])
    return np.array(sole.start) + signs * np.array(sole.size) / 2.0
