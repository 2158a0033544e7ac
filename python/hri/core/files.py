# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Files in and out, the one way for all of hri: read whole and bounded, or piece by piece; written whole or not at all.

Only regular files are read: a pipe or a device in place of one is refused, and not waited for. What is wrong with a
file is an `IoError` or a `FormatError` that names it; a path with a NUL character is an `InvalidArgument`.
"""

from __future__ import annotations

import csv
import io
import json
import os
import re
import stat
import tempfile
import tomllib
from collections.abc import Iterator
from contextlib import contextmanager
from os import PathLike, fspath
from pathlib import Path
from typing import IO, Any

from hri import _native
from hri.core.errors import FormatError, InvalidArgument, IoError

AtomicFile = _native.AtomicFile

MAX_BYTES = 1 << 28
"""Of a table or another text."""
MAX_MODEL_BYTES = 1 << 31
MAX_TOML_BYTES = 1 << 24
"""Of settings; Python's reader of TOML takes seconds for more."""

_LINE_END = re.compile(r"\r\n|\n|\r")
_WHOLE = re.compile(r"[+-]?[0-9]{1,18}")
_BLANKS = " \t"
_OF_NUMBERS = f"0123456789.+-eE{_BLANKS}"
_INFINITY = float("inf")


def read_bytes(path: str | PathLike[str], max_bytes: int = MAX_BYTES) -> bytes:
    """The bytes of a regular file.

    Raises
    ------
    IoError
        For a file that cannot be read, a folder, a pipe or a device.
    FormatError
        For more than `max_bytes`.
    """
    return bytes(_native.read_file(path, max_bytes))


@contextmanager
def regular_file(path: str | PathLike[str]) -> Iterator[IO[bytes]]:
    """A regular file to be read piece by piece; for what may be larger than memory.

    Raises
    ------
    IoError
        For a file that cannot be opened, a folder, a pipe or a device.
    InvalidArgument
        For a path that no file can have.
    """
    # O_NONBLOCK: a pipe without a writer would be waited for before it can be seen to be one.
    flags = os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC | os.O_NOCTTY
    try:
        descriptor = os.open(path, flags)
    except OSError as error:
        raise IoError(f"{fspath(path)}: cannot open: {error.strerror}") from error
    except ValueError as error:  # a NUL character, or what is no character
        raise InvalidArgument(f"{fspath(path)}: {error}") from error
    mode = os.fstat(descriptor).st_mode
    if not stat.S_ISREG(mode):
        os.close(descriptor)
        raise IoError(f"{fspath(path)}: {'is a folder' if stat.S_ISDIR(mode) else 'not a regular file'}")
    with os.fdopen(descriptor, "rb") as file:
        yield file


def read_text(path: str | PathLike[str], max_bytes: int = MAX_BYTES) -> str:
    """The text of a UTF-8 file without its byte order mark; errors as of `read_bytes`, FormatError with the row."""
    data = read_bytes(path, max_bytes)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        row = data[: error.start].count(b"\n") + 1
        raise FormatError(f"{fspath(path)}: row {row}: not UTF-8 at byte {error.start}") from error


def split_lines(text: str) -> list[str]:
    """Lines as editors count them; `str.splitlines` also ends them at separators that are part of a cell."""
    lines = _LINE_END.split(text)
    return lines[:-1] if lines[-1] == "" else lines


def read_toml(path: str | PathLike[str]) -> dict[str, Any]:
    """The tables of a TOML file; errors as of `read_text` and `parse_toml`."""
    return parse_toml(read_text(path, MAX_TOML_BYTES), fspath(path))


def parse_toml(text: str, name: str) -> dict[str, Any]:
    """The tables of a TOML text; FormatError, with `name` before it, for what is none."""
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise FormatError(f"{name}: not a TOML file: brackets within brackets, too deep") from None
    except ValueError as error:  # besides TOMLDecodeError: a date that is none, an integer of thousands of digits
        raise FormatError(f"{name}: not a TOML file: {error}") from error


def read_json(path: str | PathLike[str]) -> Any:
    """The value in a JSON file; errors as of `read_text` and `parse_json`."""
    return parse_json(read_text(path), fspath(path))


def parse_json(text: str, name: str, finite: bool = True) -> Any:
    """The value of a JSON text; FormatError, with `name` before it, for what is none, such as NaN where `finite`."""

    def refuse(word: str) -> None:
        raise ValueError(f"{word} is no number")

    try:
        return json.loads(text, parse_constant=refuse if finite else None)
    except RecursionError:
        raise FormatError(f"{name}: not a JSON file: brackets within brackets, too deep") from None
    except ValueError as error:
        raise FormatError(f"{name}: not a JSON file: {error}") from error


def read_csv(path: str | PathLike[str]) -> list[list[str]]:
    """The cells of a comma-separated file, row by row; errors as of `read_text` and `parse_csv`."""
    return parse_csv(read_text(path), fspath(path))


def parse_csv(text: str, name: str) -> list[list[str]]:
    """The cells of a comma-separated text, some in quotes; FormatError with `name` and the row for what is none."""
    rows: list[list[str]] = []
    try:
        for row in csv.reader(io.StringIO(text, newline=""), strict=True):
            rows.append(row)
    except csv.Error as error:
        raise FormatError(f"{name}: row {len(rows) + 1}: {error}") from error
    return rows


def parse_number(cell: str) -> float | None:
    """The finite decimal number in a cell, blanks around it aside; None for anything else.

    `float` takes more than a table should hold: 1_000, digits of every script, infinity, blanks of every kind.
    """
    if cell.strip(_OF_NUMBERS):  # a character of another kind is left
        return None
    try:
        value = float(cell)
    except ValueError:
        return None
    return value if -_INFINITY < value < _INFINITY else None


def parse_seen(cell: str) -> float | None:
    """The finite number in a cell of a track, NaN for an empty one or ``nan``: not seen; None for anything else."""
    return float("nan") if cell.strip().lower() in ("", "nan") else parse_number(cell)


def parse_whole(cell: str) -> int | None:
    """The whole number of at most 18 digits in a cell, blanks around it aside; None for anything else."""
    text = cell.strip(_BLANKS)
    return int(text) if _WHOLE.fullmatch(text) else None


@contextmanager
def atomic_file(path: str | PathLike[str]) -> Iterator[AtomicFile]:
    """A file that takes its name at the end of the block, and is gone after an exception.

    It is written by `write`, or as ``temporary_path`` by a library that wants a name. One that is replaced keeps its
    permissions, a symbolic link stays one; what killed processes left in the folder is removed.

    Raises
    ------
    IoError
        For a place that cannot be written, or holds something other than a regular file.
    """
    file = AtomicFile(path)
    try:
        yield file
        file.commit()
    finally:
        file.discard()


def write_bytes(path: str | PathLike[str], data: bytes) -> None:
    """Write a file; it appears whole or not at all. Raises IoError."""
    with atomic_file(path) as file:
        file.write(data)


def write_text(path: str | PathLike[str], text: str) -> None:
    """Write a UTF-8 file with ``\\n`` at the ends of lines; it appears whole or not at all.

    Raises IoError. What is no character (a byte of a file's name that is not UTF-8) is written as JSON escapes it.
    """
    write_bytes(path, text.encode("utf-8", "backslashreplace"))


def make_folder(path: str | PathLike[str]) -> Path:
    """Make a folder and those above it that are missing. Raises IoError."""
    folder = Path(path)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as error:  # ValueError: a NUL character
        raise IoError(f"{folder}: {getattr(error, 'strerror', None) or error}") from error
    return folder


@contextmanager
def utf8_name(path: str | PathLike[str]) -> Iterator[str]:
    """A name of the file for libraries that take UTF-8 only: its own, or else that of a link, within the block."""
    name = fspath(path)
    try:
        name.encode()
    except UnicodeEncodeError:
        with tempfile.TemporaryDirectory() as folder:
            suffix = Path(name).suffix
            link = Path(folder, f"link{suffix if suffix.isascii() else ''}")
            link.symlink_to(Path(name).absolute())
            yield str(link)
    else:
        yield str(Path(name).absolute())  # "http:a.avi" in this folder is a file
