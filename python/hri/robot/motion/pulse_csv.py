# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The factory's pulse CSV: one row a sample, 27 columns, A to AA, without a header.

A is the sampling period in ms, B is 2, C..W are 21 counts of motor pulses, X..AA hold ``R`` or
``60``. A cell of ``R``, or of ``60`` from X on, means "no command".
"""

from __future__ import annotations

import re
from os import PathLike, fspath

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import FormatError
from hri.core.files import read_bytes, split_lines, write_text
from hri.robot.model.joints import HOAP2, JointTable
from hri.robot.motion.trajectory import MOST_FINDINGS, Finding, Trajectory, TrajectoryError

COLUMNS = 27
_COUNT = re.compile(r"[ \t]*(-?[0-9]{1,9}|R)[ \t]*")
_WHOLE = re.compile(r"[ \t]*[0-9]{1,4}[ \t]*")
_MOST_MS = 9999
_IDLE = re.compile(r"[ \t]*(60|R)[ \t]*")


def column_letter(index: int) -> str:
    """Name a column as a spreadsheet does: 0 is A, 26 is AA."""
    letters = ""
    index += 1
    while index:
        index, rest = divmod(index - 1, 26)
        letters = chr(ord("A") + rest) + letters
    return letters


def parse_count(cell: str) -> int | str | None:
    """The count in a cell, "R" for no command, None for anything else."""
    if not _COUNT.fullmatch(cell):
        return None
    return "R" if "R" in cell else int(cell)


def read_pulse_csv(path: str | PathLike[str], table: JointTable = HOAP2) -> Trajectory:
    """Read a motion; joints without any command are not in it.

    A joint without a command in some row keeps its last one; before its first it is NaN.

    Raises
    ------
    FormatError
        Names the file, the row, the column and the cell; `findings` of it holds all such cells.
    IoError
        When the file cannot be read.
    """
    period_s, counts, findings = parse_pulse_csv(path, table)
    if findings:
        raise TrajectoryError(findings, fspath(path))
    if np.isnan(counts).all():
        raise FormatError(f"{fspath(path)}: commands no joint")
    return trajectory_from_counts(period_s, counts, table)


def write_pulse_csv(path: str | PathLike[str], trajectory: Trajectory, table: JointTable = HOAP2) -> tuple[str, ...]:
    """Write a motion; with a period of no 1 to 9999 whole milliseconds it is resampled to 1 ms rows by straight lines.

    Returns
    -------
    tuple of str
        Joints of the motion that the format has no count for (head and hands); they are left out.

    Raises
    ------
    TrajectoryError
        For a position that is not finite.
    IoError
        When the file cannot be written.
    """
    period_ms = round(trajectory.period_s * 1000.0)
    if not 1 <= period_ms <= _MOST_MS or abs(period_ms / 1000.0 - trajectory.period_s) > 1e-9:
        times_s = np.arange(int(trajectory.duration_s * 1000.0 + 1e-6) + 1) / 1000.0
        rows = np.array([trajectory.at(time_s) for time_s in times_s])
        period_ms = 1
    else:
        rows = trajectory.positions_rad
    cells: list[list[str]] = []
    for joint in table.counted:
        if joint.name not in trajectory.joint_names:
            cells.append(["R"] * len(rows))
            continue
        assert joint.pulses_per_degree is not None
        positions = rows[:, trajectory.joint_names.index(joint.name)]
        for row in np.flatnonzero(~np.isfinite(positions))[:1]:
            message = "the position is not known"
            raise TrajectoryError([Finding(row + 1, joint.column, joint.name, "nan", message)])
        counts = np.rint(np.degrees(positions) * joint.pulses_per_degree).astype(np.int64)
        cells.append([str(count) for count in counts])
    lines = [f"{period_ms},2,{','.join(row)},60,R,R,R\n" for row in zip(*cells, strict=True)]
    write_text(path, "".join(lines))
    counted = {joint.name for joint in table.counted}
    return tuple(name for name in trajectory.joint_names if name not in counted)


def parse_pulse_csv(
    path: str | PathLike[str], table: JointTable = HOAP2
) -> tuple[float, NDArray[np.float64], list[Finding]]:
    """Read the cells of a file.

    Returns
    -------
    period_s : float
    counts : ndarray of float64, shape (rows, 21)
        Columns C..W; NaN where there is no command.
    findings : list of Finding
        What is wrong with its cells, all of it errors; if any, the rest is of no use.
    """
    data = read_bytes(path)
    plain = _plain_counts(data, table)
    if plain is not None:
        return *plain, []
    return _parse_lines(split_lines(data.decode("ascii", errors="replace")), table)


def _plain_counts(data: bytes, table: JointTable) -> tuple[float, NDArray[np.float64]] | None:
    """Read a file at once in which every row has the same ends and plain counts between; None for any other."""
    first, last = _counted_range(table)
    head = data[: data.find(b"\n") + 1].rstrip(b"\r\n").split(b",")
    if len(head) != COLUMNS:
        return None
    start = b",".join(head[:first]) + b","
    end = b"," + b",".join(head[last:])
    plain_head = head[:first] + [b"0"] * (last - first) + head[last:]
    cells = [cell.decode("ascii", errors="replace") for cell in plain_head]
    if _faults(1, cells, cells[0].strip(), table):
        return None
    row_end = end + (b"\r\n" if b"\r" in data else b"\n")
    if not data.startswith(start) or not data.endswith(row_end):
        return None
    rows = data.count(b"\n")
    between = row_end + start
    if data.count(between) != rows - 1:
        return None
    body = data[len(start) : -len(row_end)].replace(between, b",")
    if not _are_plain_counts(np.frombuffer(body, dtype=np.uint8), rows * (last - first)):
        return None
    counts = np.fromstring(body, dtype=np.int64, sep=",")
    if len(counts) != rows * (last - first):
        return None
    return float(head[0]) / 1000.0, counts.astype(np.float64).reshape(rows, last - first)


def _are_plain_counts(text: NDArray[np.uint8], cells: int) -> bool:
    """Whether a text is that many whole numbers with commas between, of 1 to 9 digits, "-" before some."""
    comma, minus = text == ord(","), text == ord("-")
    digit = (text - np.uint8(ord("0"))) < 10
    places = np.flatnonzero(comma)
    if len(places) != cells - 1 or not (comma | minus | digit).all():
        return False
    starts = np.concatenate(([0], places + 1))
    ends = np.concatenate((places, [len(text)]))
    signed = np.zeros(cells, dtype=bool)
    filled = starts < ends
    signed[filled] = minus[starts[filled]]
    digits = ends - starts - signed
    return bool(np.count_nonzero(minus) == np.count_nonzero(signed) and digits.min() >= 1 and digits.max() <= 9)


def _parse_lines(lines: list[str], table: JointTable) -> tuple[float, NDArray[np.float64], list[Finding]]:
    """Read row by row, to name the faulty cells."""
    while lines and not lines[-1].strip():
        lines.pop()
    first, last = _counted_range(table)
    findings: list[Finding] = []
    counts = np.full((len(lines), last - first), np.nan)
    period = lines[0].split(",")[0].strip() if lines else ""
    if not lines:
        findings.append(Finding(1, "", "", "", "the file is empty"))
    for number, line in enumerate(lines, start=1):
        cells = line.split(",")
        faults = _faults(number, cells, period, table)
        if faults:
            findings += faults
            if len(findings) >= MOST_FINDINGS:
                findings.append(Finding(number, "", "", "", "the rest of the file was not looked at"))
                break
            continue
        counts[number - 1] = [np.nan if "R" in cell else int(cell) for cell in cells[first:last]]
    return float(period) / 1000.0 if not findings else 1.0, counts, findings


def trajectory_from_counts(period_s: float, counts: NDArray[np.float64], table: JointTable = HOAP2) -> Trajectory:
    """Turn counts of `parse_pulse_csv` into radians; a joint without a command keeps its last."""
    first, _ = _counted_range(table)
    names, columns = [], []
    for joint in table.counted:
        column = counts[:, joint.column_index - first]
        given = np.isfinite(column)
        if not given.any():
            continue
        assert joint.pulses_per_degree is not None
        latest = np.maximum.accumulate(np.where(given, np.arange(len(column)), -1))
        held = np.where(latest < 0, np.nan, column[latest])
        names.append(joint.name)
        columns.append(np.radians(held / joint.pulses_per_degree))
    if not names:
        raise FormatError("the file commands no joint")
    return Trajectory(names, period_s, np.stack(columns, axis=1))


def _counted_range(table: JointTable) -> tuple[int, int]:
    return table.counted[0].column_index, table.counted[-1].column_index + 1


def _faults(row: int, cells: list[str], period: str, table: JointTable) -> list[Finding]:
    if len(cells) != COLUMNS:
        message = f"has {len(cells)} columns, must have {COLUMNS} (A to AA)"
        column = column_letter(min(len(cells), COLUMNS))
        return [Finding(row, column, "", str(len(cells)), message)]
    first, last = _counted_range(table)
    faults = []

    def fault(index: int, message: str) -> None:
        letter = column_letter(index)
        joint = next((joint.name for joint in table.joints if joint.column == letter), "")
        cell = cells[index]
        faults.append(Finding(row, letter, joint, cell, f"{cell[:40]!r} {message}"))

    if not _WHOLE.fullmatch(cells[0]) or int(cells[0]) == 0:
        fault(0, "is no sampling period in ms (1 to 9999)")
    elif cells[0].strip() != period:
        fault(0, f"differs from the sampling period {period} of row 1")
    if not _WHOLE.fullmatch(cells[1]):
        fault(1, "is not a whole number")
    for index in range(first, last):
        if not _COUNT.fullmatch(cells[index]):
            fault(index, "is neither a count of pulses nor R")
    for index in range(last, COLUMNS):
        if not _IDLE.fullmatch(cells[index]):
            fault(index, "is neither R nor 60")
    return faults
