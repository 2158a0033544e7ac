# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Repairs single cells of a pulse CSV file, and reports every cell that it changed."""

from __future__ import annotations

from dataclasses import dataclass
from os import PathLike, fspath

import numpy as np

from hri.core.errors import FormatError
from hri.core.files import read_bytes, split_lines, write_text
from hri.robot.model.joints import HOAP2, Joint, JointTable
from hri.robot.motion.pulse_csv import COLUMNS, parse_count


@dataclass(frozen=True)
class Change:
    """A cell before and after, and why it was changed."""

    row: int
    column: str
    joint: str
    before: str
    after: str
    reason: str


def repair_pulse_csv(path: str | PathLike[str], out: str | PathLike[str], table: JointTable = HOAP2) -> list[Change]:
    """Write a file in which odd cells of counted joints lie between their neighbours, and counts within limits.

    A count beyond its joint's limit becomes that limit; an odd or missing cell becomes what lies on a straight line
    between the counts before and after it, or the only one of them. Rows with other than 27 columns, other columns and
    motions that are too fast stay as they are: check what was written.

    Returns
    -------
    list of Change
        By column, then by row; empty when the file is written as it was.

    Raises
    ------
    FormatError
        When a joint's column holds no count at all but odd cells; names the file.
    IoError
        When a file cannot be read or written.
    """
    lines = split_lines(read_bytes(path).decode("ascii", errors="replace"))
    rows = [line.split(",") for line in lines]
    whole = [number for number, cells in enumerate(rows) if len(cells) == COLUMNS]
    changes = [change for joint in table.counted for change in _repair_column(joint, rows, whole, fspath(path))]
    write_text(out, "".join(",".join(cells) + "\n" for cells in rows))
    return changes


def _repair_column(joint: Joint, rows: list[list[str]], whole: list[int], source: str) -> list[Change]:
    assert joint.pulses_per_degree is not None
    place = joint.column_index
    limits = np.degrees((joint.lower_rad, joint.upper_rad)) * joint.pulses_per_degree
    low, high = int(np.ceil(limits.min() - 1.0)), int(np.floor(limits.max() + 1.0))
    parsed = [parse_count(rows[number][place]) for number in whole]
    known = [(number, value) for number, value in zip(whole, parsed, strict=True) if isinstance(value, int)]
    changes = []
    for number, value in zip(whole, parsed, strict=True):
        before = rows[number][place]
        if value is None:
            if not known:
                raise FormatError(f"{source}: column {joint.column} ({joint.name}) holds no count to repair it with")
            found = float(np.interp(number, [at for at, _ in known], [count for _, count in known]))
            after, reason = min(max(round(found), low), high), "no count, taken from its neighbours"
        elif isinstance(value, int) and not low <= value <= high:
            after, reason = min(max(value, low), high), "beyond the joint's limit"
        else:
            continue
        rows[number][place] = str(after)
        changes.append(Change(number + 1, joint.column, joint.name, before.strip(), str(after), reason))
    return changes
