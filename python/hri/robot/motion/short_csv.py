# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The short form of a motion, made for people: named columns, degrees, one row a sample, "#" before remarks.

The header is ``time_s`` and names of joints; only joints that move need a column.
"""

from __future__ import annotations

from os import PathLike
from pathlib import Path

import numpy as np

from hri.core.errors import IoError
from hri.robot.model.joints import HOAP2, JointTable
from hri.robot.motion.trajectory import Finding, Trajectory, TrajectoryError


def read_short_csv(path: str | PathLike[str], table: JointTable = HOAP2) -> Trajectory:
    """Read a motion in the short form; times must rise from 0 in even steps.

    Raises
    ------
    TrajectoryError
        With all findings: unknown or repeated joints, missing cells, cells that are no numbers, uneven times.
    IoError
        When the file cannot be read.
    """
    try:
        lines = Path(path).read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError as error:
        raise IoError(f"{path}: {error.strerror or error}") from error
    numbered = [(row, line) for row, line in enumerate(lines, start=1) if line.strip() and not line.startswith("#")]
    header = [cell.strip() for cell in numbered[0][1].split(",")] if numbered else []
    findings = _header_faults(numbered[0][0] if numbered else 1, header, table)
    values: list[list[float]] = []
    for row, line in numbered[1:] if not findings else []:
        cells = line.split(",")
        if len(cells) != len(header):
            message = f"has {len(cells)} columns, the header has {len(header)}"
            findings.append(Finding(row, "", "", str(len(cells)), message))
            continue
        values.append([_number(row, name, cell, findings) for name, cell in zip(header, cells, strict=True)])
    if not findings and len(values) < 2:
        findings.append(Finding(len(lines), "", "", "", "there must be at least two rows of positions"))
    if not findings:
        findings = _uneven_times([row for row, _ in numbered[1:]], values)
    if findings:
        raise TrajectoryError(findings, str(path))
    rows = np.array(values)
    return Trajectory(header[1:], float(rows[-1, 0]) / (len(rows) - 1), np.radians(rows[:, 1:]))


def write_short_csv(path: str | PathLike[str], trajectory: Trajectory) -> None:
    """Write a motion in the short form, to a 10000th of a degree; IoError if it fails."""
    lines = [",".join(("time_s", *trajectory.joint_names))]
    for row, degrees in enumerate(np.degrees(trajectory.positions_rad).tolist()):
        lines.append(",".join((f"{row * trajectory.period_s:.9g}", *(f"{value:.4f}" for value in degrees))))
    try:
        Path(path).write_text("\n".join(lines) + "\n", encoding="ascii", newline="\n")
    except OSError as error:
        raise IoError(f"{path}: {error.strerror or error}") from error


def is_short_csv(path: str | PathLike[str]) -> bool:
    """Whether a file's first line that is no remark begins with ``time_s``."""
    try:
        with Path(path).open(encoding="utf-8", errors="replace") as file:
            first = next((line for line in file if line.strip() and not line.startswith("#")), "")
    except OSError as error:
        raise IoError(f"{path}: {error.strerror or error}") from error
    return first.split(",")[0].strip() == "time_s"


def _header_faults(row: int, header: list[str], table: JointTable) -> list[Finding]:
    if not header or header[0] != "time_s" or len(header) < 2:
        return [Finding(row, "", "", "", "the header must be time_s and names of joints")]
    unknown = [name for name in header[1:] if name not in table.names]
    twice = [name for place, name in enumerate(header) if name in header[:place]]
    faults = [Finding(row, "", name, name, f"{table.name} has no joint {name!r}") for name in unknown]
    return faults + [Finding(row, "", name, name, "is there twice") for name in twice]


def _number(row: int, name: str, cell: str, findings: list[Finding]) -> float:
    try:
        value = float(cell)
    except ValueError:
        value = float("nan")
    if not np.isfinite(value):
        joint = "" if name == "time_s" else name
        findings.append(Finding(row, name, joint, cell.strip(), f"{cell.strip()[:40]!r} is no number"))
    return value


def _uneven_times(rows: list[int], values: list[list[float]]) -> list[Finding]:
    times = [value[0] for value in values]
    period_s = times[-1] / (len(times) - 1)
    if period_s <= 0.0:
        return [Finding(rows[-1], "time_s", "", f"{times[-1]:g}", "times must rise from 0")]
    return [
        Finding(row, "time_s", "", f"{time_s:g}", f"{time_s:g} is off even steps of {period_s:g} s from 0")
        for row, place, time_s in zip(rows, range(len(rows)), times, strict=True)
        if abs(time_s - place * period_s) > 1e-6 * max(1.0, times[-1])
    ]
