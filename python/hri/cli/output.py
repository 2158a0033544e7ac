# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What commands write: tables, JSON, and files whose place is checked before the work begins."""

from __future__ import annotations

import codecs
import io
import json
import os
import re
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click

from hri.core import files

_STREAMS = re.compile(r"/dev/fd|/proc/\d+(/task/\d+)?/fd")


class OutputFile(click.Path):
    """A file to write; a wrong suffix or a folder that cannot be written is said at once, not after the work.

    Parameters
    ----------
    suffixes : sequence of str
        Those allowed, such as (".png",); any if empty.
    allow_dash : bool
        Whether "-" means standard output, as then /dev/stdout does; other streams are refused, for a file takes the
        place of another by its name, which would be that of the file that a shell has opened.
    replaces : sequence of str
        Parameters whose file it may be, as of a model that is written anew; no other file that is read.
    path_type : str or Path
    """

    def __init__(
        self,
        suffixes: Sequence[str] = (),
        allow_dash: bool = False,
        replaces: Sequence[str] = (),
        path_type: type[str] | type[Path] = str,
    ) -> None:
        super().__init__(dir_okay=False, allow_dash=allow_dash)
        self._suffixes = tuple(suffixes)
        self._kind = path_type
        self.replaces = tuple(replaces)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        text = os.fsdecode(super().convert(value, param, ctx))
        if text == "-" and self.allow_dash:
            return text
        path = Path(text)
        stream = _stream_named(path)
        if stream == "1" and self.allow_dash:
            return "-"
        if stream is not None:
            instead = ", or - for standard output" if self.allow_dash else ""
            self.fail(f"'{path}' cannot be written: it is a stream; name a file{instead}", param, ctx)
        if self._suffixes and path.suffix.lower() not in self._suffixes:
            self.fail(f"'{path}' must end in one of {' '.join(self._suffixes)}", param, ctx)
        fault = why_not_writable(path)
        if fault is not None:
            self.fail(f"'{path}' cannot be written: {fault}", param, ctx)
        return self._kind(text)


def why_not_writable(path: Path) -> str | None:
    """What is wrong with the place of a file to write; None where nothing is. Folders that are missing can be made."""
    folder = path.absolute().parent
    while not folder.exists():
        folder = folder.parent
    if not folder.is_dir() or not os.access(folder, os.W_OK):
        return f"'{folder}' is not a folder where you may write"
    if path.exists() and not path.is_file():
        return "it is not a regular file"
    return None


def _stream_named(path: Path) -> str | None:
    """Which open stream of a process, this one or another, a path like /dev/stdout and /dev/fd/3 means; None: a file.

    What a stream leads to is not looked at: where that is a regular file, its path would look like any other.
    """
    own = os.path.realpath("/dev/fd")
    for _ in range(40):  # links, as many as systems follow
        folder = os.path.realpath(path.parent)
        if folder == own:
            return path.name
        if _STREAMS.fullmatch(folder):
            return f"{folder}/{path.name}"
        if not path.is_symlink():
            break
        path = path.parent / path.readlink()
    return None


json_option = click.option(
    "--json",
    "json_path",
    type=OutputFile(allow_dash=True),
    metavar="FILE",
    help="Also write everything as JSON to this file; - is standard output, and then nothing else goes there.",
)


def write_json(path: str | None, value: Any) -> None:
    """Write `value` to `path`; an old file stays whole if this fails. None writes nothing."""
    if path is None:
        return
    text = json.dumps(value, indent=2, ensure_ascii=False, default=str) + "\n"
    if path == "-":
        click.echo(text.encode("utf-8", "backslashreplace"), nl=False)
    else:
        write_text(Path(path), text)


def in_a_folder(path: str | Path) -> Path:
    """The path of a file that is written piece by piece, in a folder that is made if need be."""
    target = Path(path)
    files.make_folder(target.parent)
    return target


def write_text(target: Path, text: str) -> None:
    """Write `text` to `target`, in a folder that is made if need be; an old file stays whole if this fails."""
    files.make_folder(target.parent)
    files.write_text(target, text)


def write_bytes(target: Path, content: bytes) -> None:
    """Write `content` to `target`, in a folder that is made if need be; an old file stays whole if this fails."""
    files.make_folder(target.parent)
    files.write_bytes(target, content)


def print_any_name() -> None:
    """Let names of files go to standard output as the bytes that they are, whatever the locale."""
    codecs.register_error("hri", _bytes_of_names)
    if isinstance(sys.stdout, io.TextIOWrapper):
        ascii_only = codecs.lookup(sys.stdout.encoding).name == "ascii"  # as of LC_ALL=C, which means nothing by it
        sys.stdout.reconfigure(encoding="utf-8" if ascii_only else None, errors="hri")


def _bytes_of_names(error: UnicodeError) -> tuple[str | bytes, int]:
    """A byte that is no text in the name of a file, as it is; an escape for what the locale has no character for."""
    if isinstance(error, UnicodeEncodeError) and 0xDC80 <= ord(error.object[error.start]) <= 0xDCFF:
        return bytes([ord(error.object[error.start]) - 0xDC00]), error.start + 1
    return codecs.backslashreplace_errors(error)


def say(text: str, json_path: str | None) -> None:
    """Print `text` for people, unless standard output is taken by JSON."""
    if json_path != "-":
        click.echo(text)


def say_table(rows: Sequence[Sequence[str]], json_path: str | None) -> None:
    """Print rows of equal length: columns aligned on a terminal, tab-separated for programs."""
    if not sys.stdout.isatty():
        lines = ["\t".join(row) for row in rows]
    else:
        widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
        lines = ["  ".join(map(str.ljust, row, widths)).rstrip() for row in rows]
    for line in lines:
        say(line, json_path)
