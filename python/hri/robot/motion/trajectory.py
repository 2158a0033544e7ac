# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Motions: joint positions at a fixed rate, and what a check finds wrong with one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hri.core.errors import FormatError, InvalidArgument
from hri.core.files import write_text

_PERIODS_S = (1e-6, 3600.0)


class Trajectory:
    """Positions of some joints at a fixed rate; immutable.

    Parameters
    ----------
    joint_names : sequence of str
        At least one, without repeats; joints not named are not commanded.
    period_s : float
        From one row to the next, a microsecond to an hour.
    positions_rad : array_like of float64, shape (rows, joints)
        At least one row. NaN means that the joint's position is unknown in that row; a check
        reports it as an error.

    Raises
    ------
    InvalidArgument
        When the above does not hold.
    """

    joint_names: tuple[str, ...]
    period_s: float
    positions_rad: NDArray[np.float64]

    def __init__(self, joint_names: Sequence[str], period_s: float, positions_rad: ArrayLike) -> None:
        self.joint_names = tuple(joint_names)
        self.period_s = float(period_s)
        if isinstance(joint_names, str) or not all(isinstance(name, str) for name in self.joint_names):
            raise InvalidArgument(f"joint_names is {joint_names!r}, must be a sequence of names")
        if not self.joint_names:
            raise InvalidArgument("joint_names names no joint")
        if len(set(self.joint_names)) != len(self.joint_names):
            raise InvalidArgument("joint_names names a joint twice")
        if not _PERIODS_S[0] <= self.period_s <= _PERIODS_S[1]:
            raise InvalidArgument(f"period_s is {period_s}, must be {_PERIODS_S[0]:g} to {_PERIODS_S[1]:g}")
        try:
            self.positions_rad = np.array(positions_rad, dtype=np.float64)
        except (TypeError, ValueError) as error:
            raise InvalidArgument(f"positions_rad is no array of numbers: {error}") from error
        self.positions_rad.setflags(write=False)
        shape = self.positions_rad.shape
        if len(shape) != 2 or shape[0] == 0 or shape[1] != len(self.joint_names):
            raise InvalidArgument(
                f"positions_rad has shape {shape}, must be (rows, {len(self.joint_names)}), with at least one row"
            )

    def __len__(self) -> int:
        return len(self.positions_rad)

    def __repr__(self) -> str:
        joints = len(self.joint_names)
        return f"Trajectory({joints} joints, {len(self)} rows, {self.duration_s:g} s)"

    @property
    def duration_s(self) -> float:
        """From the first row to the last."""
        return (len(self) - 1) * self.period_s

    def at(self, time_s: float | NDArray[np.float64]) -> NDArray[np.float64]:
        """Positions at a time, between rows by a straight line, outside held; shape (joints,), or (times, joints)."""
        place = np.clip(np.asarray(time_s, dtype=np.float64) / self.period_s, 0.0, len(self) - 1.0)
        near = np.rint(place)
        place = np.where(np.abs(place - near) < 1e-9 * np.maximum(near, 1.0), near, place)  # rows as they are
        row = np.minimum(place.astype(np.intp), max(len(self) - 2, 0))
        part = (place - row)[..., np.newaxis]
        positions: NDArray[np.float64] = (1.0 - part) * self.positions_rad[row]
        return positions + part * self.positions_rad[np.minimum(row + 1, len(self) - 1)]

    def write_tsv(self, path: str | PathLike[str]) -> None:
        """Write a table for `read_short_csv`: a header, then seconds and degrees of each joint; IoError if it fails."""
        lines = ["\t".join(("time_s", *(f"{name}_deg" for name in self.joint_names)))]
        for row, degrees in enumerate(np.degrees(self.positions_rad).tolist()):
            cells = (f"{value:.4f}" for value in degrees)
            lines.append("\t".join((f"{row * self.period_s:.9g}", *cells)))
        write_text(path, "\n".join(lines) + "\n")


MOST_FINDINGS = 1000
"""Of the cells of a file; one that says that there may be more is the last then."""


@dataclass(frozen=True)
class Finding:
    """Something amiss in a motion.

    Attributes
    ----------
    row : int
        From 1, as an editor counts lines.
    column : str
        Letter of the column in a pulse CSV, "" when it concerns the whole row.
    joint : str
        "" when it concerns none.
    value : str
        As the file has it, or with its unit.
    message : str
    severity : "error" or "warning"
        The robot refuses a motion with an error.
    """

    row: int
    column: str
    joint: str
    value: str
    message: str
    severity: str = "error"

    def __str__(self) -> str:
        place = f"row {self.row}" + (f", column {self.column}" if self.column else "")
        joint = f" ({self.joint})" if self.joint else ""
        return f"{place}{joint}: {self.message}"


class TrajectoryError(FormatError):
    """A motion that the robot must not carry out; `findings` says why."""

    findings: list[Finding]

    def __init__(self, findings: Sequence[Finding], source: str = "") -> None:
        self.findings = list(findings)
        shown = [str(finding) for finding in self.findings[:5]]
        if len(self.findings) > len(shown):
            shown.append(f"and {len(self.findings) - len(shown)} more")
        super().__init__((f"{source}: " if source else "") + "; ".join(shown))
