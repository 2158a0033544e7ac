# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Transcripts as commands write them, and tables of what was said as commands read them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import click

from hri.cli.messages import report_fault
from hri.core.errors import Error, FormatError
from hri.core.files import read_text, split_lines
from hri.htk import Label, MasterLabelFile, Transcription
from hri.media import AUDIO_SUFFIXES
from hri.recognition import Transcript

EXIT_BAD_DATA = 3
HTK_UNITS_PER_S = 1e7
_MASTER = "#!MLF!#"


def lines_of_words(transcript: Transcript) -> list[str]:
    """A line a word: its beginning and end in seconds, and the word."""
    return [f"{word.first_s:.3f}\t{word.last_s:.3f}\t{word.label}" for word in transcript.words]


def labels_of(transcript: Transcript) -> Transcription:
    """The words with their times, as HTK has them."""
    return Transcription(
        [
            Label(label, round(word.first_s * HTK_UNITS_PER_S), round(word.last_s * HTK_UNITS_PER_S), word.log_score)
            for label, word in zip(transcript.labels, transcript.words, strict=True)
        ]
    )


def require_names_apart(paths: Sequence[Path], files: Sequence[str], option: str) -> None:
    """Refuse recordings whose results would stand under one name."""
    first: dict[Path, str] = {}
    for path, file in zip(paths, files, strict=True):
        if path in first:
            raise click.UsageError(f"{option}: the results of {first[path]} and {file} would both be {path}")
        first[path] = file


@contextmanager
def noting_faults(entry: dict[str, Any]) -> Iterator[None]:
    """Say what is wrong with one recording, and keep it with its results, so that the others are not lost."""
    try:
        yield
    except (Error, OSError) as error:
        entry["error"] = str(error)
        report_fault(error)


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
