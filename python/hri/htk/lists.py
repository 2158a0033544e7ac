# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""HTK's script files, which hold arguments, and its lists of models or labels."""

from __future__ import annotations

from os import PathLike, fspath

from hri.core.errors import FormatError
from hri.core.files import read_text, split_lines


def read_script(path: str | PathLike[str]) -> list[str]:
    """The arguments in a script file, between blanks and ends of lines.

    One that begins with a quotation mark, " or ', ends with the next; what stands between is taken as it is.

    Raises
    ------
    IoError, FormatError
        Of reading; also for a quotation that does not end (names the line).
    """
    return [argument for row in script_rows(path) for argument in row]


def script_rows(path: str | PathLike[str]) -> list[list[str]]:
    """The arguments in every line of a script file; errors as of `read_script`."""
    return _rows(path, escapes=False)


def read_list(path: str | PathLike[str]) -> dict[str, str]:
    """The names in a list, each with the physical model that it stands for: itself where the list names none.

    Quotation marks are as in `read_script`. As in labels a backslash takes the next character as it is, or three octal
    digits for a byte of UTF-8.

    Raises
    ------
    IoError, FormatError
        As of `read_script`; also for a line of more than two names, and a name twice.
    """
    names: dict[str, str] = {}
    for number, row in enumerate(_rows(path, escapes=True), 1):
        if not row:
            continue
        if len(row) > 2:
            raise FormatError(f"{fspath(path)}: line {number}: expected a name, and perhaps another that it stands for")
        if row[0] in names:
            raise FormatError(f"{fspath(path)}: line {number}: {row[0]!r} stands here again")
        names[row[0]] = row[-1]
    return names


def _rows(path: str | PathLike[str], escapes: bool) -> list[list[str]]:
    rows = []
    for number, line in enumerate(split_lines(read_text(path)), 1):
        try:
            rows.append(_fields(line.encode(), escapes))
        except ValueError as error:
            raise FormatError(f"{fspath(path)}: line {number}: {error}") from None
    return rows


def _fields(line: bytes, escapes: bool) -> list[str]:
    """Between blanks; raises ValueError with what is wrong."""
    fields: list[str] = []
    at = 0
    while True:
        while line[at : at + 1].isspace():
            at += 1
        if at == len(line):
            return fields
        quote = line[at : at + 1] if line[at] in b"\"'" else b""
        at += len(quote)
        field = bytearray()
        while at < len(line) and (line[at : at + 1] != quote if quote else not line[at : at + 1].isspace()):
            if escapes and line[at : at + 1] == b"\\":
                byte, at = _escaped(line, at + 1)
                field.append(byte)
            else:
                field.append(line[at])
                at += 1
        if quote and at == len(line):
            raise ValueError("a quotation does not end")
        at += len(quote)
        try:
            fields.append(field.decode())
        except UnicodeDecodeError:
            raise ValueError("the bytes that backslashes name are not UTF-8") from None


def _escaped(line: bytes, at: int) -> tuple[int, int]:
    """The byte that stands behind a backslash, and where the text goes on."""
    digits = line[at : at + 3]
    if len(digits) == 3 and all(digit in b"01234567" for digit in digits) and int(digits, 8) < 256:
        return int(digits, 8), at + 3
    if at == len(line):
        raise ValueError("a backslash ends it")
    return line[at], at + 1
