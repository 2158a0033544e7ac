# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Load and centre of pressure of each sole, from its touch sensors."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hri.robot.model.joints import JointTable

Floats = NDArray[np.float64]

_SMOOTH_S = 0.02  # a force on a sole chatters: what counts is its mean over about this time
_TOUCHING = 0.04  # share of the weight below which the centre of pressure is not known


class Soles:
    """Loads and their centres, smoothed.

    Parameters
    ----------
    table : JointTable
        A foot's sole is its lowest solid shape, a box.

    Attributes
    ----------
    loads_n : ndarray, shape (feet,)
    off_middle : list of two floats for each foot
        Of the centre of pressure, along x and y: 0 in the sole's middle, 1 and -1 at its edges.
    """

    def __init__(self, table: JointTable) -> None:
        self._touching_n = _TOUCHING * 9.81 * sum(link.mass_kg for link in table.links.values())
        soles = [
            min(table.links[foot].solid, key=lambda shape: shape.start[2] - shape.size[2] / 2.0) for foot in table.feet
        ]
        self._middles = [sole.start[:2] for sole in soles]
        self._halves = [(sole.size[0] / 2.0, sole.size[1] / 2.0) for sole in soles]
        self.start()

    def start(self) -> None:
        """Forget everything."""
        self.loads_n = np.zeros(len(self._middles))
        self._moments = [[0.0, 0.0] for _ in self._middles]
        self.off_middle = [[0.0, 0.0] for _ in self._middles]

    def feel(self, pressures: Floats, elapsed_s: float) -> None:
        """Take the readings of the sensors.

        Parameters
        ----------
        pressures : ndarray, shape (feet, 3)
            Force in newtons, and x and y of its centre in the frame of the foot's link.
        elapsed_s : float
            Since the last call.
        """
        part = 1.0 - float(np.exp(-elapsed_s / _SMOOTH_S))
        for foot, (force, *centre) in enumerate(pressures.tolist()):
            load = float(self.loads_n[foot])
            load += part * (force - load)
            self.loads_n[foot] = load
            moments, shape = self._moments[foot], zip(centre, self._middles[foot], self._halves[foot], strict=True)
            for axis, (at, middle, half) in enumerate(shape):
                moments[axis] += part * (force * (at - middle) / half - moments[axis])
            known = load > self._touching_n
            self.off_middle[foot] = [min(max(moment / load, -1.0), 1.0) if known else 0.0 for moment in moments]
