# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Recordings that tools read: their names in scripts, and what their headers agree on before anything is done."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import click
import numpy as np
from numpy.typing import NDArray

from hri.cli.htk.options import all_arguments
from hri.core.errors import FormatError, InvalidArgument
from hri.htk import DISCRETE, Configuration, ModelSet, ParameterFile, load_observations, observed, read_header

UNITS_PER_MS = 10_000
_EXTENDED = re.compile(r"(?:(?P<name>[^=]+)=)?(?P<path>[^=\[\]]+)(?:\[(?P<first>\d{1,12}),(?P<last>\d{1,12})\])?")


@dataclass(frozen=True)
class DataFile:
    """A recording, or a part of it.

    Attributes
    ----------
    name : str
        By which its labels are found, and under which its results go.
    path : str
    first, last : int or None
        Frames of the part, both included; None: all.
    """

    name: str
    path: str
    first: int | None = None
    last: int | None = None


def data_files(given: Sequence[str], scripts: Iterable[str], what: str) -> list[DataFile]:
    """The recordings of the command line and of scripts: `path`, `name=path`, each perhaps with `[first,last]`.

    Raises
    ------
    click.UsageError
        Where there is none: `what` is then the message.
    FormatError
        For parts that end before they begin.
    """
    files = []
    for argument in all_arguments(given, scripts):
        files.append(_data_file(argument))
        argument.require_file(files[-1].path)
    if not files:
        raise click.UsageError(what)
    return files


def _data_file(text: str) -> DataFile:
    match = _EXTENDED.fullmatch(text)
    if Path(text).is_file() or match is None:
        return DataFile(text, text)
    path, name = match["path"], match["name"] or match["path"]
    if match["first"] is None:
        return DataFile(name, path)
    first, last = int(match["first"]), int(match["last"])
    if last < first:
        raise FormatError(f"{text}: the part ends before it begins")
    return DataFile(name, path, first, last)


def check_headers(files: Sequence[DataFile], models: ModelSet, configuration: Configuration) -> int:
    """The sample period of all files, in 100 ns, once every one can become what the models take.

    Raises
    ------
    IoError, FormatError
        For a file that cannot be read, and one of another kind, size or sample period; names it.
    """
    period, before = 0, ""
    checked: set[str] = set()
    for file in files:
        if file.path in checked:
            continue
        checked.add(file.path)
        of_file = _check_header(file.path, models, configuration)
        if period and of_file != period:
            raise FormatError(
                f"{file.path}: a frame each {of_file} * 100 ns, where {before} has one each {period} * 100 ns"
            )
        if not period:
            period, before = of_file, file.path
    return period


def _check_header(path: str, models: ModelSet, configuration: Configuration) -> int:
    target = round(configuration.features.frame_shift_ms * UNITS_PER_MS)
    kind = configuration.target if configuration.source_format == "WAV" else read_header(path).kind
    if kind.startswith("WAVEFORM") or configuration.source_format == "WAV":
        if not Path(path).is_file():
            raise FormatError(f"{path}: there is no such file")
        check_kind(path, configuration.target, None, models, configuration)
        if not configuration.has_target_rate:
            raise FormatError(f"{path}: TARGETRATE is not set in any configuration file")
        return target
    header = read_header(path)
    check_kind(path, header.kind, header.num_columns, models, configuration)
    if configuration.has_target_rate and header.sample_period != target:
        raise FormatError(
            f"{path}: a frame each {header.sample_period} * 100 ns, where TARGETRATE says {target} * 100 ns"
        )
    return header.sample_period


def check_kind(path: str, kind: str, columns: int | None, models: ModelSet, configuration: Configuration) -> None:
    """Raises FormatError unless frames of this kind can become what models take.

    Parameters
    ----------
    path : str
        Of the file, or what else messages begin with.
    kind : str
    columns : int or None
        None: not known.
    models : ModelSet
    configuration : Configuration
    """
    wanted = models.kind
    if columns is None:
        is_quantised = configuration.has_codewords and wanted == DISCRETE
        if wanted != "ANON" and not is_quantised and kind.split("_")[0] != wanted.split("_")[0]:
            raise FormatError(f"{path}: becomes {kind} by the configuration, and the models take {wanted}")
        return
    try:
        # One frame of zeros goes the way that all will go.
        frame = ParameterFile(np.zeros((1, columns), np.float32), kind, UNITS_PER_MS)
        seen = observed(frame, wanted, configuration, path)
    except InvalidArgument as error:
        raise FormatError(f"{path}: its frames are {kind}, and the models take {wanted}: {error}") from error
    if models.vector_size and seen.shape[1] != models.vector_size:
        raise FormatError(
            f"{path}: {seen.shape[1]} columns as {wanted}, and the models take vectors of {models.vector_size}"
        )


def load_frames(file: DataFile, models: ModelSet, configuration: Configuration) -> NDArray[np.float32]:
    """Frames as models see them; of a part these alone. Errors as of `load_observations`, with the file.

    Raises
    ------
    FormatError
        Also for a codeword that discrete models have not: names file and frame.
    """
    try:
        frames, _ = load_observations(file.path, models.kind, configuration, file.first or 0, file.last)
    except InvalidArgument as error:
        raise FormatError(f"{file.path}: {error}") from error
    require_codewords(frames, models, file.path, file.first or 0)
    return frames


def require_codewords(frames: NDArray[np.float32], models: ModelSet, path: str, first: int = 0) -> None:
    """Raises FormatError for a codeword that discrete models have not: names file and frame, counted from `first`."""
    if not models.num_codewords:
        return
    outside = np.flatnonzero((frames[:, 0] < 1) | (frames[:, 0] > models.num_codewords))
    if outside.size:
        raise FormatError(
            f"{path}: frame {first + outside[0]} has the codeword {frames[outside[0], 0]:g}, and the models have 1 to "
            f"{models.num_codewords}"
        )
