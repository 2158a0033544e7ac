# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The short form of a motion, made for people: named columns, degrees, one row a sample, "#" before remarks.

The header is ``time_s`` and names of joints; only joints that move need a column. Tabs may stand for the commas, and
``_deg`` behind the names of joints, as `Trajectory.write_tsv` writes them.
"""

from __future__ import annotations

import re
from dataclasses import replace
from os import PathLike, fspath

import numpy as np

from hri.core.errors import InvalidArgument
from hri.core.files import parse_number, read_bytes, split_lines, write_text
from hri.robot.model.joints import HOAP2, JointTable
from hri.robot.motion.checks import check_trajectory
from hri.robot.motion.pulse_csv import column_letter
from hri.robot.motion.trajectory import MOST_FINDINGS, Finding, Trajectory, TrajectoryError

_HEAD_BYTES = 1 << 16  # of remarks before a header
_TO_ROW = re.compile(r"\bto row ([0-9]+)")


def read_short_csv(path: str | PathLike[str], table: JointTable = HOAP2) -> Trajectory:
    """Read a motion in the short form; times must rise from 0 in even steps.

    Raises
    ------
    TrajectoryError
        With all findings: unknown or repeated joints, missing cells, cells that are no numbers, uneven times. Rows
        and columns are those of the file, remarks and all; columns have letters, as in a spreadsheet.
    IoError
        When the file cannot be read.
    """
    return _read(path, table)[0]


def check_short_csv(path: str | PathLike[str], table: JointTable = HOAP2) -> list[Finding]:
    """Look over a motion in the short form, first its cells, then, if they can be read, its motion.

    Returns
    -------
    list of Finding
        Of `check_trajectory`, with the rows and columns of the file.

    Raises
    ------
    IoError
        When the file cannot be read.
    """
    try:
        trajectory, rows = _read(path, table)
    except TrajectoryError as error:
        return error.findings
    return [_placed(finding, trajectory, rows) for finding in check_trajectory(trajectory, table)]


def require_safe_short_csv(path: str | PathLike[str], table: JointTable = HOAP2) -> None:
    """Raise TrajectoryError, with the rows and columns of the file, when a motion has errors."""
    errors = [finding for finding in check_short_csv(path, table) if finding.severity == "error"]
    if errors:
        raise TrajectoryError(errors, fspath(path))


def _placed(finding: Finding, trajectory: Trajectory, rows: list[int]) -> Finding:
    """A finding about a trajectory, where it stands in the file."""
    named = finding.joint in trajectory.joint_names
    column = column_letter(1 + trajectory.joint_names.index(finding.joint)) if named else ""
    message = _TO_ROW.sub(lambda found: f"to row {rows[min(int(found[1]), len(rows)) - 1]}", finding.message)
    return replace(finding, row=rows[finding.row - 1], column=column, message=message)


def _read(path: str | PathLike[str], table: JointTable) -> tuple[Trajectory, list[int]]:
    """The motion, and the line of the file that each row of it stands in."""
    lines = split_lines(read_bytes(path).decode("utf-8-sig", errors="replace"))
    numbered = [(row, line) for row, line in enumerate(lines, start=1) if line.strip() and not line.startswith("#")]
    separator = _separator(numbered[0][1]) if numbered else ","
    header = [cell.strip() for cell in numbered[0][1].split(separator)] if numbered else []
    if separator == "\t":
        header = [name.removesuffix("_deg") for name in header]
    findings = _header_faults(numbered[0][0] if numbered else 1, header, table)
    values: list[list[float]] = []
    for row, line in numbered[1:] if not findings else []:
        cells = line.split(separator)
        if len(cells) != len(header):
            message = f"has {len(cells)} columns, the header has {len(header)}"
            findings.append(Finding(row, "", "", str(len(cells)), message))
            continue
        values.append([_number(row, place, header, cell, findings) for place, cell in enumerate(cells)])
        if len(findings) >= MOST_FINDINGS:
            findings.append(Finding(row, "", "", "", "the rest of the file was not looked at"))
            break
    if not findings and len(values) < 2:
        findings.append(Finding(max(1, len(lines)), "", "", "", "there must be at least two rows of positions"))
    if not findings:
        findings = _uneven_times([row for row, _ in numbered[1:]], values)
    if findings:
        raise TrajectoryError(findings, fspath(path))
    rows = np.array(values)
    period_s = float(rows[-1, 0]) / (len(rows) - 1)
    try:
        trajectory = Trajectory(header[1:], period_s, np.radians(rows[:, 1:]))
    except InvalidArgument as error:
        last = numbered[-1][0]
        raise TrajectoryError([Finding(last, "A", "", f"{rows[-1, 0]:g}", str(error))], fspath(path)) from error
    return trajectory, [row for row, _ in numbered[1:]]


def write_short_csv(path: str | PathLike[str], trajectory: Trajectory) -> None:
    """Write a motion in the short form, to a 10000th of a degree.

    Raises
    ------
    TrajectoryError
        For a position that is not finite.
    IoError
        When the file cannot be written.
    """
    for row, place in np.argwhere(~np.isfinite(trajectory.positions_rad))[:1].tolist():
        name = trajectory.joint_names[place]
        raise TrajectoryError([Finding(row + 1, column_letter(1 + place), name, "nan", "the position is not known")])
    lines = [",".join(("time_s", *trajectory.joint_names))]
    for row, degrees in enumerate(np.degrees(trajectory.positions_rad).tolist()):
        lines.append(",".join((f"{row * trajectory.period_s:.9g}", *(f"{value:.4f}" for value in degrees))))
    write_text(path, "\n".join(lines) + "\n")


def is_short_csv(path: str | PathLike[str]) -> bool:
    """Whether a file's first line that is no remark begins with ``time_s``."""
    lines = split_lines(read_bytes(path)[:_HEAD_BYTES].decode("utf-8-sig", errors="replace"))
    first = next((line for line in lines if line.strip() and not line.startswith("#")), "")
    return first.split(_separator(first))[0].strip() == "time_s"


def _separator(header: str) -> str:
    return "\t" if "\t" in header and "," not in header else ","


def _header_faults(row: int, header: list[str], table: JointTable) -> list[Finding]:
    if not header or header[0] != "time_s" or len(header) < 2:
        return [Finding(row, "", "", "", "the header must be time_s and names of joints")]
    faults = []
    for place, name in enumerate(header):
        letter = column_letter(place)
        if place > 0 and name not in table.names:
            faults.append(Finding(row, letter, name, name, f"{table.name} has no joint {name[:40]!r}"))
        elif name in header[:place]:
            faults.append(Finding(row, letter, name, name, "is there twice"))
    return faults


def _number(row: int, place: int, header: list[str], cell: str, findings: list[Finding]) -> float:
    value = parse_number(cell)
    if value is None:
        joint = "" if place == 0 else header[place]
        findings.append(Finding(row, column_letter(place), joint, cell.strip(), f"{cell.strip()[:40]!r} is no number"))
    return float("nan") if value is None else value


def _uneven_times(rows: list[int], values: list[list[float]]) -> list[Finding]:
    times = [value[0] for value in values]
    period_s = times[-1] / (len(times) - 1)
    if not 0.0 < period_s < float("inf"):
        return [Finding(rows[-1], "A", "", f"{times[-1]:g}", "times must rise from 0")]
    return [
        Finding(row, "A", "", f"{time_s:g}", f"{time_s:g} is off even steps of {period_s:g} s from 0")
        for place, (row, time_s) in enumerate(zip(rows, times, strict=True))
        if abs(time_s - place * period_s) > 1e-6 * max(1.0, times[-1])
    ]
