# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Transcripts as commands write them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import click

from hri.cli.messages import report_fault
from hri.core.errors import Error
from hri.htk import Label, Transcription
from hri.recognition import Transcript

EXIT_BAD_DATA = 3
HTK_UNITS_PER_S = 1e7


def lines_of_words(transcript: Transcript) -> list[str]:
    """A line a word: its beginning and end in seconds, and the word, ``<unk>`` where it is unknown."""
    return [
        f"{word.first_s:.3f}\t{word.last_s:.3f}\t{label}"
        for label, word in zip(transcript.labels, transcript.words, strict=True)
    ]


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
