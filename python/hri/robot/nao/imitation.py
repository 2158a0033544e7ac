# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Where NAO's arms should be for where a person's hands are: as HOAP-2's, with the hands in NAO's own proportions."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument
from hri.robot.imitation.live import LiveImitation
from hri.robot.model.joints import NAO, JointTable
from hri.robot.nao.arms import NAO_LEFT_ARM, nearest

Floats = NDArray[np.float64]

_MIRROR = np.array([1.0, -1.0, -1.0, -1.0])
_ARM = NAO_LEFT_ARM[:4]


class NaoImitation(LiveImitation):
    """Poses of NAO's shoulders and elbows for a person who moves before a camera.

    HOAP-2's arms are found for the person as `LiveImitation` finds them. NAO's take their hands to the same places from
    the shoulders, in proportion to the arm's length, and their forearms in the same direction as far as its elbows bend
    (`hri.robot.nao.arms`). Hands keep 10 cm apart, middle to middle. Whether links would touch is decided by
    `Robot.follow` at every step.

    Parameters
    ----------
    table : JointTable
        Of a NAO; its limits may be stricter than those of `hri.robot.NAO`.

    Attributes
    ----------
    joint_names : tuple of str
        Of both arms: shoulder pitch and roll, elbow yaw and roll.

    Raises
    ------
    InvalidArgument
        For another robot.
    """

    def __init__(self, table: JointTable = NAO) -> None:
        if table.names != NAO.names:
            raise InvalidArgument(f"{table.name} is no NAO")
        self._own_limits = table.limits_rad[[table.index(name) for name in _names()]]
        super().__init__()
        self.joint_names = _names()

    def reset(self) -> None:
        """Forget all pictures; there is no target until the next one."""
        self._angles = np.array([[NAO[name].rest_rad for name in _ARM]] * 2)
        super().reset()

    def _pose(self) -> Floats:
        poses = np.stack([finder.angles_rad for finder in self._finders])
        self._angles = nearest(poses, self._angles)
        both = np.concatenate((self._angles[0], self._angles[1] * _MIRROR))
        return np.clip(both, self._own_limits[:, 0], self._own_limits[:, 1])


def live_imitation(table: JointTable) -> LiveImitation:
    """What imitates a person by the arms of this robot. Raises InvalidArgument where its arms are of another kind."""
    return NaoImitation(table) if table.names == NAO.names else LiveImitation(table)


def _names() -> tuple[str, ...]:
    return (*_ARM, *(f"R{name[1:]}" for name in _ARM))
