# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Recordings to parameters, as HCopy and the tools that read either do it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike, fspath

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hri._native import HtkConfiguration, HtkFeatureExtractor, HtkParameterFile, HtkVqTable
from hri.core.errors import FormatError, InvalidArgument
from hri.core.files import regular_file
from hri.io import read_wav

UNITS_PER_S = 10_000_000
FULL_SCALE = 32768
DISCRETE = "DISCRETE"
"""The kind of codewords."""


@dataclass(frozen=True)
class Source:
    """A recording, or a part of it.

    Attributes
    ----------
    path : path
        A WAV file where SOURCEFORMAT says so; else a parameter file, which may be a waveform.
    start : float
        Where the part begins, in 100 ns.
    end : float
        Where it ends, at the latest with the recording; 0 or below: so far before its end.
    """

    path: str | PathLike[str]
    start: float = 0.0
    end: float = 0.0

    def duration(self, configuration: HtkConfiguration) -> int:
        """Of the part, in 100 ns. Raises as `code_file` does."""
        if configuration.source_format == "WAV":
            samples, rate_hz = _part_of_wav(self)
            return round(len(samples) * UNITS_PER_S / rate_hz)
        header = read_header(self.path)
        first, last = self.span(header.num_frames, UNITS_PER_S / header.sample_period)
        return (last - first) * header.sample_period

    def span(self, length: int, rate_hz: float) -> tuple[int, int]:
        """The first of the samples or frames of the part, of so many, and the one behind its last.

        Raises FormatError where it is empty.
        """
        first = round(self.start * rate_hz / UNITS_PER_S)
        last = round(self.end * rate_hz / UNITS_PER_S)
        last = min(last, length) if self.end > 0 else length + last
        if first >= last:
            end = f"{self.end} * 100 ns" if self.end > 0 else f"{-self.end} * 100 ns before its end"
            raise FormatError(f"{fspath(self.path)}: nothing is left between {self.start} * 100 ns and {end}")
        return first, last


def code_file(source: str | PathLike[str], configuration: HtkConfiguration) -> HtkParameterFile:
    """What HCopy makes of a recording, or of a parameter file.

    Parameters
    ----------
    source : path
        A WAV file where SOURCEFORMAT says so; else a parameter file, which may be a waveform.
    configuration : Configuration

    Raises
    ------
    IoError, FormatError
        For files that cannot be read, and where TARGETRATE is not set for a recording.
    InvalidArgument
        For recordings shorter than a frame, and kinds that the source cannot become.
    """
    return code_sources([Source(source)], configuration)


def code_sources(sources: Sequence[Source], configuration: HtkConfiguration) -> HtkParameterFile:
    """What HCopy makes of recordings, or parts of them, one behind the other; errors as of `code_file`.

    Where TARGETKIND has _V these are codewords of VQTABLE, kind DISCRETE; parameters that are codewords stay so.

    Raises
    ------
    FormatError
        Also for recordings of several rates, or parameters of several kinds or periods; for _V without SAVEASVQ, which
        would put codewords beside frames, and SAVEASVQ without _V.
    """
    if configuration.has_codewords != configuration.save_codewords:
        raise FormatError(
            "files of codewords take both _V in TARGETKIND and SAVEASVQ = T; there are none beside frames"
        )
    file = _code(sources, configuration)
    if not configuration.has_codewords or _is_discrete(file):
        return file
    name = fspath(sources[0].path)
    codewords = _quantised(file, configuration, name)
    kind = f"{DISCRETE}_K" if "_K" in file.kind else DISCRETE
    return HtkParameterFile(codewords, kind, file.sample_period)


def _code(sources: Sequence[Source], configuration: HtkConfiguration) -> HtkParameterFile:
    """Parameters of sources one behind the other."""
    clips: list[tuple[NDArray[np.float32], int]] = []
    files: list[HtkParameterFile] = []
    for source in sources:
        name = fspath(source.path)
        if _is_recording(source.path, configuration):
            clips.append(_audio(source, configuration))
        else:
            whole = source.start == 0 and source.end == 0
            part = HtkParameterFile.read(source.path) if whole else _part_of(source)
            files.append(part)
            if (part.kind, part.sample_period) != (files[0].kind, files[0].sample_period):
                raise FormatError(
                    f"{name}: {part.kind}, {part.sample_period} * 100 ns: of another kind than those before"
                )
        if (clips and files) or (clips and clips[-1][1] != clips[0][1]):
            raise FormatError(f"{name}: of another kind or rate than the files before it")
    name = fspath(sources[0].path)
    if clips:
        return _code_audio(np.concatenate([samples for samples, _ in clips]), clips[0][1], name, configuration)
    if len(files) > 1:
        together = np.concatenate([file.values for file in files])
        files = [HtkParameterFile(together, _uncompressed(files[0].kind), files[0].sample_period)]
    return _converted(files[0], configuration)


def _converted(file: HtkParameterFile, configuration: HtkConfiguration) -> HtkParameterFile:
    """A file as the configuration wants it; codewords for which it wants codewords stay as they are."""
    if configuration.has_codewords and _is_discrete(file):
        return file
    return file.convert(configuration.written_kind(file.kind), configuration.features)


def _is_discrete(file: HtkParameterFile) -> bool:
    return _uncompressed(file.kind) == DISCRETE


def _quantised(file: HtkParameterFile, configuration: HtkConfiguration, name: str) -> NDArray[np.float32]:
    """Codewords of frames, shape (num_frames, 1)."""
    if not configuration.vq_table:
        raise FormatError(
            f"{name}: VQTABLE is not set in any configuration file, by which {file.kind} becomes codewords"
        )
    table = HtkVqTable.read(configuration.vq_table)
    kind = _uncompressed(file.kind)
    if table.kind not in ("ANON", kind):
        raise FormatError(f"{name}: its frames are {kind}, and the table {configuration.vq_table} is of {table.kind}")
    frames = file.observations(kind, configuration.features)
    if frames.shape[1] != table.dim:
        raise FormatError(
            f"{name}: frames of {frames.shape[1]} columns, and the table {configuration.vq_table} is of {table.dim}"
        )
    return table.quantise(frames)[:, np.newaxis].astype(np.float32)


def observed(file: HtkParameterFile, kind: str, configuration: HtkConfiguration, name: str) -> NDArray[np.float32]:
    """Frames of a file as models of this kind see them, shape (num_frames, num_columns).

    Discrete models see codewords: those of the file, or of its frames where TARGETKIND has _V.

    Raises
    ------
    FormatError
        Where frames have to become codewords and no table, or one of other frames, is named; `name` is in its message.
    InvalidArgument
        For a kind that the frames cannot become.
    """
    file = _converted(file, configuration)
    if kind == DISCRETE and configuration.has_codewords and not _is_discrete(file):
        return _quantised(file, configuration, name)
    return file.observations(file.kind if kind == "ANON" else kind, configuration.features)


def _part_of(source: Source) -> HtkParameterFile:
    header = read_header(source.path)
    first, last = source.span(header.num_frames, UNITS_PER_S / header.sample_period)
    file = HtkParameterFile.read_frames(source.path, first, last)
    return HtkParameterFile(file.values, _uncompressed(file.kind), file.sample_period)


def _uncompressed(kind: str) -> str:
    """The kind without _C, whose scales are of the whole file, and _K."""
    base, *letters = kind.split("_")
    return "_".join([base, *(letter for letter in letters if letter not in "CK")])


def _is_recording(path: str | PathLike[str], configuration: HtkConfiguration) -> bool:
    """Whether the file is coded; parameters, and waveforms that stay so, are not."""
    if configuration.source_format == "WAV":
        return True
    kind = read_header(path).kind
    return kind.startswith("WAVEFORM") and not configuration.written_kind(kind).startswith("WAVEFORM")


def _audio(source: Source, configuration: HtkConfiguration) -> tuple[NDArray[np.float32], int]:
    """Samples of a part of a recording, and their rate in Hz."""
    if configuration.source_format == "WAV":
        return _part_of_wav(source)
    header = read_header(source.path)
    rate_hz = UNITS_PER_S / header.sample_period
    if rate_hz != round(rate_hz):
        raise FormatError(
            f"{fspath(source.path)}: a sample period of {header.sample_period} * 100 ns is no whole rate in Hz"
        )
    file = HtkParameterFile.read_frames(source.path, *source.span(header.num_frames, rate_hz))
    return file.values[:, 0] / np.float32(FULL_SCALE), round(rate_hz)


def _part_of_wav(source: Source) -> tuple[NDArray[np.float32], int]:
    wav = read_wav(source.path)
    first, last = source.span(len(wav.samples), wav.sample_rate_hz)
    return wav.samples[first:last], wav.sample_rate_hz


@dataclass(frozen=True)
class ParameterHeader:
    """What a parameter file says of itself.

    Attributes
    ----------
    kind : str
    sample_period : int
        From frame to frame, in 100 ns.
    num_frames, num_columns : int
    """

    kind: str
    sample_period: int
    num_frames: int
    num_columns: int


def read_header(path: str | PathLike[str]) -> ParameterHeader:
    """The header of a parameter file, of which no more is read.

    Raises
    ------
    IoError
        For a file that cannot be read.
    FormatError
        For a header that is none, and a file of another size than it says; names file and byte.
    """
    with regular_file(path) as file:
        if file.read(4) == b"RIFF":
            raise FormatError(f"{fspath(path)}: is a WAV file, which SOURCEFORMAT = WAV, or -F WAV, reads")
    return ParameterHeader(*HtkParameterFile.read_header(path))


def load_observations(
    source: str | PathLike[str], kind: str, configuration: HtkConfiguration, first: int = 0, last: int | None = None
) -> tuple[NDArray[np.float32], int]:
    """Frames of a file as models of this kind see them, shape (num_frames, num_columns), and their period in 100 ns.

    Of a recording they are computed. Of a parameter file no more is read than the frames asked for and those beside
    them that differences take, unless `_Z`, or another base, takes all.

    Parameters
    ----------
    source : path
    kind : str
    configuration : Configuration
    first, last : int
        Of a part, both included; None: to the end.

    Raises
    ------
    IoError, FormatError, InvalidArgument
        As `code_file` does; FormatError also where there are fewer frames.
    """
    name = fspath(source)
    is_part = first > 0 or last is not None
    beside = None
    if is_part and not _is_recording(source, configuration):
        header = read_header(source)
        beside = _frames_beside(header.kind, kind, configuration)
    if beside is None:
        file = _code([Source(source)], configuration)
        frames = observed(file, kind, configuration, name)
        if not is_part:
            return frames, file.sample_period
        begin, end = 0, _end_of_part(first, last, len(frames), name)
    else:
        end = _end_of_part(first, last, header.num_frames, name)
        begin = max(first - beside, 0)
        file = HtkParameterFile.read_frames(source, begin, min(end + beside, header.num_frames))
        frames = observed(file, kind, configuration, name)
    # A copy: the frames around the part are not kept with it.
    return frames[first - begin : end - begin].copy(), file.sample_period


def observe_samples(
    samples: ArrayLike, sample_rate_hz: int, kind: str, configuration: HtkConfiguration, name: str = "samples"
) -> tuple[NDArray[np.float32], int]:
    """Frames of sound as models of this kind see them, as of a file with these samples, and their period in 100 ns.

    Energy is normalised, and `_Z` takes the mean, over all these samples.

    Parameters
    ----------
    samples : array_like, shape (num_samples,)
        Mono, -1 to 1.
    sample_rate_hz : int
        Of the samples; they are not resampled.
    kind : str
        Of the models.
    configuration : Configuration
    name : str
        What errors call the samples.

    Raises
    ------
    FormatError
        Where TARGETRATE is not set, and where frames have to become codewords and no table, or one of other frames, is
        named.
    InvalidArgument
        For samples shorter than a frame, a TARGETKIND that sound cannot become, and a kind that the frames cannot
        become.
    """
    file = _code_audio(np.asarray(samples, np.float32), sample_rate_hz, name, configuration)
    return observed(file, kind, configuration, name), file.sample_period


def _end_of_part(first: int, last: int | None, num_frames: int, name: str) -> int:
    """The frame behind the last of a part."""
    end = num_frames if last is None else last + 1
    if first < 0 or first >= end:
        raise InvalidArgument(f"{name}: there is no frame from {first} to {end - 1}")
    if end > num_frames:
        raise FormatError(f"{name}: has {num_frames} frames, none with number {end - 1}")
    return end


def _frames_beside(kind: str, wanted: str, configuration: HtkConfiguration) -> int | None:
    """How many frames on each side `observed` takes to make one of a file of this kind; None: all."""
    is_discrete = _uncompressed(kind) == DISCRETE
    written = kind if configuration.has_codewords and is_discrete else configuration.written_kind(kind)
    seen = _uncompressed(written) if wanted in ("ANON", DISCRETE) else wanted
    steps = [
        HtkParameterFile.frames_beside(*kinds, configuration.features) for kinds in ((kind, written), (written, seen))
    ]
    return None if None in steps else sum(step for step in steps if step is not None)


def _code_audio(
    samples: NDArray[np.float32], rate_hz: int, name: str, configuration: HtkConfiguration
) -> HtkParameterFile:
    kind = configuration.written_kind("WAVEFORM")
    if kind.startswith("WAVEFORM"):
        if UNITS_PER_S % rate_hz:
            raise FormatError(f"{name}: the period of {rate_hz} Hz is no whole number of 100 ns")
        values = np.clip(np.round(samples[:, np.newaxis] * FULL_SCALE), -FULL_SCALE, FULL_SCALE - 1)
        return HtkParameterFile(values, kind, UNITS_PER_S // rate_hz)
    if not configuration.has_target_rate:
        raise FormatError(f"{name}: TARGETRATE is not set in any configuration file")
    extractor = HtkFeatureExtractor(kind, rate_hz, configuration.features)
    return HtkParameterFile(extractor.compute(samples), kind, extractor.sample_period)
