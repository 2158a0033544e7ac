# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Tables of what was said in recordings."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from hri.core.errors import FormatError
from hri.core.files import read_text, split_lines
from hri.htk import MasterLabelFile, Transcription
from hri.media import AUDIO_SUFFIXES

_MASTER = "#!MLF!#"
_ANYWHERE = "*/"
_LABEL_SUFFIXES = (".lab", ".rec")
_SUFFIXES = (*_LABEL_SUFFIXES, *AUDIO_SUFFIXES)
"""What may stand behind the name of a recording, of which a dot may be part."""


@dataclass(frozen=True)
class Said:
    """What was said in one recording, or in each of those that a pattern matches.

    Attributes
    ----------
    name : str
        Of the recording, as a table has it.
    words : list of str
    places : list of str
        Where each of the words stands, for messages.
    place : str
        Where the recording stands.
    row : int
        The same, as the number of a line.
    in_master : bool
        Whether the table is a master label file.
    """

    name: str
    words: list[str]
    places: list[str]
    place: str
    row: int = 0
    in_master: bool = False

    @property
    def is_pattern(self) -> bool:
        """Whether the name is meant for several recordings; ``*/`` before it is any folder, as of every name."""
        return self.in_master and not set(self.name.removeprefix(_ANYWHERE)).isdisjoint("*?")

    @property
    def key(self) -> tuple[list[str], str]:
        """The same for names that differ only in how they are written."""
        return (_folders(self.name), self.name if self.is_pattern else _without_suffix(Path(self.name).name))


@dataclass(frozen=True)
class Recording:
    """A recording of a table, by the name that its results have, and what was said there; or why that is not known."""

    name: str
    said: Said | None = None
    fault: str = ""


def read_said(path: str) -> list[Said]:
    """What a table says of each of its recordings.

    Parameters
    ----------
    path : str
        A master label file of HTK, or lines of words with the name of their recording behind them in brackets (trn).

    Raises
    ------
    FormatError
        For a line of another form, a pattern that stands for a folder of label files, and a table without recordings.
    """
    text = read_text(path)
    said = list(_entries_of(text, path) if text.startswith(_MASTER) else _lines_of(text, path))
    if not said:
        raise FormatError(f"{path}: names no recording")
    return said


def _entries_of(text: str, path: str) -> Iterator[Said]:
    entries = MasterLabelFile.parse(text, path).entries
    for (name, transcription), (row, is_folder) in zip(entries, _rows_of_entries(text), strict=True):
        place = f"{path}: row {row}"
        if is_folder:
            raise FormatError(f"{place}: {name!r} names a folder of label files; what was said has to stand here")
        places = [f"{path}: row {label.line}" for label in transcription.labels]
        yield Said(name, [label.name for label in transcription.labels], places, place, row, True)


def _rows_of_entries(text: str) -> Iterator[tuple[int, bool]]:
    """Where the entries of a master label file without faults begin, and whether they name a folder."""
    in_labels = False
    for row, line in enumerate(text.split("\n")[1:], 2):
        content = line.strip(" \t\r")
        if in_labels:
            in_labels = content != "."
        elif content:
            quoted = re.match(r"\"(\\.|[^\"\\])*\"|'(\\.|[^'\\])*'", content)
            in_labels = quoted is not None and quoted.end() == len(content)
            yield row, not in_labels


def _lines_of(text: str, path: str) -> Iterator[Said]:
    for row, line in enumerate(split_lines(text), 1):
        place = f"{path}: row {row}"
        match = re.fullmatch(r"(.*)\(([^()\s]+)\)\s*", line)
        if match is None and line.strip():
            raise FormatError(f"{place}: is not words and the name of their recording in brackets")
        if match is not None:
            words = match[1].split()
            yield Said(match[2], words, [place] * len(words), place, row)


class NamedRecordings:
    """Recordings by the names that a table gives them: without suffix, and as much of their folders as a name has.

    Parameters
    ----------
    files : iterable of Path
    root : Path
        The folder of the table, from which patterns are read.
    """

    def __init__(self, files: Iterable[Path], root: Path) -> None:
        self._files = list(files)
        self._root = root.absolute()
        self._by_name: dict[str, list[Path]] = {}
        for file in self._files:
            for name in dict.fromkeys((file.name, file.stem)):
                self._by_name.setdefault(name, []).append(file)

    @classmethod
    def below(cls, root: Path) -> NamedRecordings:
        """Of a folder and those in it."""
        return cls((file for file in sorted(root.rglob("*")) if file.suffix.lower() in AUDIO_SUFFIXES), root)

    def of(self, said: Said) -> list[Path]:
        """All that a row may mean by its name."""
        if said.is_pattern:
            return self._matching(said.name)
        name = Path(said.name).name
        # The whole name first: what looks like a suffix may be a part of it.
        for written in dict.fromkeys((name, _without_suffix(name))):
            if found := [file for file in self._by_name.get(written, ()) if _lies_in(file, _folders(said.name))]:
                return found
        return []

    def of_rows(self, rows: Sequence[Said]) -> list[list[Path]]:
        """The recordings that each row stands for.

        Of the entries of a master label file the first that matches counts, as in HTK; where the same name stands there
        again, both are given.
        """
        found = [self.of(said) for said in rows]
        first: dict[Path, Said] = {}
        for said, files in zip(rows, found, strict=True):
            for file in files:
                first.setdefault(file, said)
        return [
            [file for file in files if not said.in_master or first[file].key == said.key]
            for said, files in zip(rows, found, strict=True)
        ]

    def _matching(self, pattern: str) -> list[Path]:
        """Those whose label files a pattern of HTK matches; its folders are below that of the table, or all of them."""
        pattern = pattern.removeprefix("./")
        # A * also stands for folders: those above the table would match, too, were they part of what is compared.
        below = _matcher(pattern if pattern[:1] in ("*", "/") else _ANYWHERE + pattern)
        whole = _matcher(pattern) if "/" in pattern and pattern[0] not in "*?" else None
        found = []
        for file in self._files:
            full = file.absolute()
            names = [(below, f"./{full.relative_to(self._root) if full.is_relative_to(self._root) else file}")]
            if whole is not None:
                names += [(whole, str(file)), (whole, str(full))]
            suffixes = ("", *_LABEL_SUFFIXES, file.suffix)
            if any(master.search(name.removesuffix(file.suffix) + end) for master, name in names for end in suffixes):
                found.append(file)
        return found


def _matcher(pattern: str) -> MasterLabelFile:
    return MasterLabelFile([(pattern, Transcription([]))])


def recordings_below(table: str) -> list[Recording]:
    """All recordings of a table, which lie below its folder."""
    root = Path(table).parent
    rows = read_said(table)
    recordings = NamedRecordings.below(root)
    found: dict[str, list[Said]] = {}
    faults: dict[str, list[str]] = {}
    for said, files in zip(rows, recordings.of_rows(rows), strict=True):
        if not files and recordings.of(said):
            continue  # an entry above counts
        if files and (said.is_pattern or len(files) == 1):
            for file in files:
                found.setdefault(str(file), []).append(said)
            continue
        fault = f"{said.place}: {said.name!r} is the name of {len(files)} recordings in {root}, not of one"
        found.setdefault(said.name, [])
        faults.setdefault(said.name, []).append(fault)
    return [
        Recording(name, fault="; ".join(faults[name])) if name in faults else _said_once(name, of_name, table)
        for name, of_name in found.items()
    ]


def recordings_among(files: Sequence[str], table: str) -> list[Recording]:
    """The given recordings, with what a table says of each."""
    rows = read_said(table)
    found: dict[Path, list[Said]] = {Path(file): [] for file in files}
    for said, named in zip(rows, NamedRecordings(found, Path(table).parent).of_rows(rows), strict=True):
        for path in named:
            found[path].append(said)
    return [_said_once(file, found[Path(file)], table) for file in files]


def _said_once(name: str, rows: Sequence[Said], table: str) -> Recording:
    if len(rows) == 1:
        return Recording(name, rows[0])
    where = f": {', '.join(f'row {said.row}' for said in rows)}" if rows else ""
    return Recording(name, fault=f"{table}: says {len(rows)} times what was said in {name}, not once{where}")


def _without_suffix(name: str) -> str:
    return Path(name).stem if Path(name).suffix.lower() in _SUFFIXES else name


def _folders(name: str) -> list[str]:
    return [part for part in Path(name).parent.parts if part != "*"]


def _lies_in(file: Path, folders: Sequence[str]) -> bool:
    return not folders or list(file.absolute().parent.parts[-len(folders) :]) == list(folders)
