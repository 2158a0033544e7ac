# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Tables of what was said in recordings."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from hri.core.errors import FormatError
from hri.core.files import read_text, split_lines
from hri.htk import MasterLabelFile
from hri.media import AUDIO_SUFFIXES

_MASTER = "#!MLF!#"


@dataclass(frozen=True)
class Said:
    """What was said in one recording.

    Attributes
    ----------
    name : str
        Of the recording, as a table has it.
    words : list of str
    places : list of str
        Where each of the words stands, for messages.
    place : str
        Where the recording stands.
    """

    name: str
    words: list[str]
    places: list[str]
    place: str


def read_said(path: str) -> list[Said]:
    """What a table says of each of its recordings.

    Parameters
    ----------
    path : str
        A master label file of HTK, or lines of words with the name of their recording behind them in brackets (trn).

    Raises
    ------
    FormatError
        For a line of another form.
    """
    text = read_text(path)
    if not text.startswith(_MASTER):
        return _lines_of(text, path)
    said = []
    for name, transcription in MasterLabelFile.parse(text, path).entries:
        labels = transcription.labels
        places = [f"{path}: row {label.line}" for label in labels]
        said.append(Said(name, [label.name for label in labels], places, path))
    return said


def _lines_of(text: str, path: str) -> list[Said]:
    said = []
    for row, line in enumerate(split_lines(text), 1):
        place = f"{path}: row {row}"
        match = re.fullmatch(r"(.*)\(([^()\s]+)\)\s*", line)
        if match is None and line.strip():
            raise FormatError(f"{place}: is not words and the name of their recording in brackets")
        if match is not None:
            words = match[1].split()
            said.append(Said(match[2], words, [place] * len(words), place))
    return said


class NamedRecordings:
    """Recordings by the names that tables give them: without suffix, and as much of their folders as a name has."""

    def __init__(self, files: Iterable[Path]) -> None:
        self._by_stem: dict[str, list[Path]] = {}
        for file in files:
            self._by_stem.setdefault(file.stem, []).append(file)

    @classmethod
    def below(cls, root: Path) -> NamedRecordings:
        """Of a folder and those in it."""
        return cls(file for file in sorted(root.rglob("*")) if file.suffix.lower() in AUDIO_SUFFIXES)

    def of(self, name: str) -> list[Path]:
        """All that a name may mean."""
        folder = [part for part in Path(name).parent.parts if part != "*"]
        return [
            file
            for file in self._by_stem.get(Path(name).stem, self._by_stem.get(Path(name).name, []))
            if not folder or list(file.absolute().parent.parts[-len(folder) :]) == folder
        ]

    def one_of(self, said: Said, root: Path) -> Path:
        """The one that is meant. Raises FormatError where there is none, or several."""
        found = self.of(said.name)
        if len(found) != 1:
            raise FormatError(
                f"{said.place}: {said.name!r} is the name of {len(found)} recordings in {root}, not of one"
            )
        return found[0]
