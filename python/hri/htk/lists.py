# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""HTK's script files, which hold arguments, and its lists of models or labels."""

from __future__ import annotations

import shlex
from os import PathLike, fspath

from hri.core.errors import FormatError
from hri.core.files import read_text, split_lines


def read_script(path: str | PathLike[str]) -> list[str]:
    """The arguments in a script file, between blanks and ends of lines; one may stand in quotation marks.

    Raises
    ------
    IoError, FormatError
        Of reading; also for a quotation that does not end (names the line).
    """
    return [argument for row in _rows(path) for argument in row]


def read_list(path: str | PathLike[str]) -> dict[str, str]:
    """The names in a list, each with the physical model that it stands for: itself where the list names none.

    Raises
    ------
    IoError, FormatError
        As of `read_script`; also for a line of more than two names, and a name twice.
    """
    names: dict[str, str] = {}
    for number, row in enumerate(_rows(path), 1):
        if not row:
            continue
        if len(row) > 2:
            raise FormatError(f"{fspath(path)}: line {number}: expected a name, and perhaps another that it stands for")
        if row[0] in names:
            raise FormatError(f"{fspath(path)}: line {number}: {row[0]!r} stands here again")
        names[row[0]] = row[-1]
    return names


def _rows(path: str | PathLike[str]) -> list[list[str]]:
    rows = []
    for number, line in enumerate(split_lines(read_text(path)), 1):
        try:
            rows.append(shlex.split(line))
        except ValueError:
            raise FormatError(f"{fspath(path)}: line {number}: a quotation does not end") from None
    return rows
