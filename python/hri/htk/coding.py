# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Recordings to parameters, as HCopy and the tools that read either do it."""

from __future__ import annotations

from os import PathLike, fspath

import numpy as np
from numpy.typing import NDArray

from hri._native import HtkConfiguration, HtkFeatureExtractor, HtkParameterFile
from hri.core.errors import FormatError
from hri.io import read_wav

UNITS_PER_S = 10_000_000
FULL_SCALE = 32768


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
    if configuration.source_format == "WAV":
        wav = read_wav(source)
        return _code_audio(wav.samples, wav.sample_rate_hz, fspath(source), configuration)
    file = HtkParameterFile.read(source)
    kind = configuration.written_kind(file.kind)
    if not file.kind.startswith("WAVEFORM") or kind.startswith("WAVEFORM"):
        return file.convert(kind, configuration.features)
    rate = UNITS_PER_S / file.sample_period
    if rate != round(rate):
        raise FormatError(f"{fspath(source)}: a sample period of {file.sample_period} * 100 ns is no whole rate in Hz")
    return _code_audio(file.values[:, 0] / np.float32(FULL_SCALE), round(rate), fspath(source), configuration)


def load_observations(
    source: str | PathLike[str], kind: str, configuration: HtkConfiguration
) -> tuple[NDArray[np.float32], int]:
    """Frames of a file as models of this kind see them, shape (num_frames, num_columns), and their period in 100 ns.

    Of a recording they are computed; errors as of `code_file`.
    """
    file = code_file(source, configuration)
    return file.observations(file.kind if kind == "ANON" else kind, configuration.features), file.sample_period


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
