# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a simulation with masses assumes of the world and of how well the robot is built."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from hri.core.errors import InvalidArgument

_MOST_OFFSET_RAD = 1.0


@dataclass(frozen=True)
class Physics:
    """Settings with which the robot's factory motions succeed.

    Attributes
    ----------
    friction : float
        Of soles and floor, above 0: forces pass with the square of it, as both surfaces have it.
    mass_scale : float
        Multiplies all masses and inertias, above 0.
    joint_offsets_rad : mapping of joint name to float
        By how much a joint is off from where its motor believes it to be, as after a poor calibration; up to 1.
    balance : bool
        A robot on its feet keeps upright and on its course by what its gyroscope and soles feel (`Balance`).
    solver_iterations : int
        1 to 1000: with 10 the robot's factory walk ends in a fall.
    """

    friction: float = 0.9
    mass_scale: float = 1.0
    joint_offsets_rad: Mapping[str, float] = field(default_factory=dict)
    balance: bool = True
    solver_iterations: int = 50

    def __post_init__(self) -> None:
        for name in ("friction", "mass_scale"):
            value = getattr(self, name)
            if not 0.0 < value < float("inf"):
                raise InvalidArgument(f"{name} is {value}, must be above 0 and finite")
        for name, offset in self.joint_offsets_rad.items():
            if not abs(offset) <= _MOST_OFFSET_RAD:
                raise InvalidArgument(f"joint_offsets_rad of {name} is {offset}, must be at most {_MOST_OFFSET_RAD}")
        if not 1 <= self.solver_iterations <= 1000:
            raise InvalidArgument(f"solver_iterations is {self.solver_iterations}, must be 1 to 1000")
