# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Hand and nose positions of signed sentences (RWTH-BOSTON-104): three CSV files in one folder."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hri.core.display import short_repr
from hri.core.errors import FormatError
from hri.core.files import parse_seen, read_csv

HANDS_COLUMNS = ("video", "frame", "left-x", "left-y", "right-x", "right-y", "nose-x", "nose-y")
WORDS_COLUMNS = ("video", "speaker", "word", "startframe", "endframe")
SIGNERS_COLUMNS = ("video", "speaker")
MAX_PIXELS = 65535
"""Positions lie within this of the picture's corner."""
_NAME = re.compile(r"[^\x00-\x1f\x7f]+")
_NUMBER = re.compile(r"-?[0-9]{1,9}")
_MAX_FRAME = 10**9 - 1


@dataclass(frozen=True)
class SignedWord:
    """One word of a sentence: frames `first` up to and with `last`."""

    label: str
    first: int
    last: int


@dataclass(frozen=True)
@short_repr
class SignedSentence:
    """One video.

    Attributes
    ----------
    video, signer : str
    positions : ndarray of float32, shape (num_frames, 3, 2)
        Pixels from the upper left corner: left hand, right hand, nose; x, y. NaN where not seen.
    words : tuple of SignedWord
        In the order of the file; all within the frames.
    """

    video: str
    signer: str
    positions: NDArray[np.float32]
    words: tuple[SignedWord, ...]


def read_asl_sentences(directory: Path) -> list[SignedSentence]:
    """Read ``hands.csv``, ``words.csv`` and ``signers.csv``; videos come in the order of ``signers.csv``.

    An empty cell or ``nan`` among the positions is one that was not seen.

    Parameters
    ----------
    directory : Path

    Raises
    ------
    FormatError
        Names the file, the row and the field: a missing column, a number that is none, frames that
        do not count up from 0, a word beyond the frames, files that contradict each other.
    IoError
        When a file cannot be read.
    """
    signers = _read_signers(directory / "signers.csv")
    positions = _read_positions(directory / "hands.csv", signers)
    for video in signers:
        if video not in positions:
            raise FormatError(f"{directory / 'hands.csv'}: no row of video {video!r}, which signers.csv lists")
    words = _read_words(directory / "words.csv", signers, positions)
    return [SignedSentence(video, signers[video], positions[video], tuple(words[video])) for video in signers]


def _read_signers(path: Path) -> dict[str, str]:
    signers: dict[str, str] = {}
    for where, row in _rows(path, SIGNERS_COLUMNS):
        video, signer = _name(where, row, "video"), _name(where, row, "speaker")
        if video in signers:
            raise FormatError(f"{where}, field video: {video!r} stands in an earlier row too")
        signers[video] = signer
    return signers


def _read_positions(path: Path, signers: dict[str, str]) -> dict[str, NDArray[np.float32]]:
    points: dict[str, list[list[float]]] = {}
    for where, row in _rows(path, HANDS_COLUMNS):
        video = _known_video(where, row, signers)
        frames = points.setdefault(video, [])
        frame = _number(where, row, "frame", 0, _MAX_FRAME)
        if frame != len(frames):
            raise FormatError(f"{where}, field frame: {frame}, but the next frame of video {video!r} is {len(frames)}")
        frames.append([_position(where, row, name) for name in HANDS_COLUMNS[2:]])
    return {video: np.array(rows, np.float32).reshape(-1, 3, 2) for video, rows in points.items()}


def _read_words(
    path: Path, signers: dict[str, str], positions: dict[str, NDArray[np.float32]]
) -> dict[str, list[SignedWord]]:
    words: dict[str, list[SignedWord]] = {video: [] for video in signers}
    for where, row in _rows(path, WORDS_COLUMNS):
        video = _known_video(where, row, signers)
        if row["speaker"] != signers[video]:
            known = f"signers.csv says {signers[video]!r} for video {video!r}"
            raise FormatError(f"{where}, field speaker: {row['speaker']!r}, but {known}")
        num_frames = len(positions[video])
        first = _number(where, row, "startframe", 0, num_frames - 1)
        last = _number(where, row, "endframe", first, num_frames - 1)
        words[video].append(SignedWord(_name(where, row, "word"), first, last))
    return words


def _rows(path: Path, columns: tuple[str, ...]) -> Iterator[tuple[str, dict[str, str]]]:
    """Every row with its place, such as "hands.csv: row 7" (rows count from 1, the header is row 1)."""
    rows = read_csv(path)
    if len(rows) < 2:
        raise FormatError(f"{path}: no rows")
    if tuple(rows[0]) != columns:
        raise FormatError(f"{path}: row 1: the columns are {','.join(rows[0])!r}, must be {','.join(columns)!r}")
    for number, fields in enumerate(rows[1:], start=2):
        where = f"{path}: row {number}"
        if len(fields) != len(columns):
            raise FormatError(f"{where}: {len(fields)} fields, must be {len(columns)}")
        yield where, dict(zip(columns, fields, strict=True))


def _name(where: str, row: dict[str, str], field: str) -> str:
    value = row[field]
    if not value.strip() or not _NAME.fullmatch(value):
        raise FormatError(f"{where}, field {field}: {value!r} is no name")
    return value


def _known_video(where: str, row: dict[str, str], signers: dict[str, str]) -> str:
    video = row["video"]
    if video not in signers:
        raise FormatError(f"{where}, field video: {video!r} is not in signers.csv")
    return video


def _position(where: str, row: dict[str, str], field: str) -> float:
    value = parse_seen(row[field])
    if value is None or abs(value) > MAX_PIXELS:
        raise FormatError(f"{where}, field {field}: {row[field]!r} is no number within {MAX_PIXELS}")
    return value


def _number(where: str, row: dict[str, str], field: str, least: int, most: int) -> int:
    value = row[field]
    if not _NUMBER.fullmatch(value):
        raise FormatError(f"{where}, field {field}: {value!r} is no whole number")
    number = int(value)
    if not least <= number <= most:
        raise FormatError(f"{where}, field {field}: {number}, must be {least}..{most}")
    return number
