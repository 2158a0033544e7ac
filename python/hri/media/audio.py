# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Sound files: WAV by libhri's own strict reader, other formats by the soundfile library."""

from __future__ import annotations

import io
import logging
import os
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.display import summary
from hri.core.errors import FormatError, InvalidArgument
from hri.core.files import read_bytes
from hri.core.optional import import_optional
from hri.io import read_wav
from hri.media.suffixes import kind_of_file

_log = logging.getLogger(__name__)

_MAX_BYTES = 1 << 31
_MAX_SAMPLES = 1 << 29  # of all channels: a small file of silence may claim any length
_UNKNOWN_FRAMES = (1 << 63) - 1  # of FLAC that was written as a stream
_BLOCK_SAMPLES = 1 << 20
_DAMAGE = re.compile(r"should be|not equal|end-of-stream|file length", re.IGNORECASE)
"""What libsndfile says of files that were cut, or whose parts do not fit together."""


@dataclass(frozen=True)
class Audio:
    """One recording.

    Attributes
    ----------
    samples : ndarray of float32, shape (num_samples,)
        Mono, full scale is 1; finite and not empty.
    sample_rate_hz : int
    notes : list of str
        What was done to the file on the way: channels averaged, a header that promised more, ...
    path : Path, optional
        Of the file.
    """

    samples: NDArray[np.float32]
    sample_rate_hz: int
    notes: list[str] = field(default_factory=list)
    path: Path | None = None

    def __repr__(self) -> str:
        return summary("Audio", f"{self.duration_s:.3f} s", f"{self.sample_rate_hz} Hz", *self.notes)

    @property
    def duration_s(self) -> float:
        """Length in seconds."""
        return len(self.samples) / self.sample_rate_hz


def read_audio(path: str | PathLike[str]) -> Audio:
    """Read a recording as mono float samples.

    Parameters
    ----------
    path : path-like
        A ``.wav`` file, or anything else that soundfile can read.

    Returns
    -------
    Audio
        Several channels are averaged; a shortened file gives what it holds. Both are said in
        ``notes``.

    Raises
    ------
    FormatError
        For a file that is no recording, holds no sample, or holds a NaN or an infinity (the message
        gives its index).
    IoError
        For a file that cannot be opened.
    ImportError
        For a file other than WAV when soundfile is not installed.
    """
    path = Path(path)
    kind = kind_of_file(path)
    if kind not in ("", "a sound file") and os.path.exists(path):  # noqa: PTH110 - never raises
        raise FormatError(f"{path} is {kind}, and a sound file is needed here")
    if path.suffix.lower() == ".wav":
        wav = read_wav(path)
        samples = np.asarray(wav.samples, dtype=np.float32)
        audio = Audio(samples, int(wav.sample_rate_hz), list(wav.notes), path)
    else:
        audio = _read_with_soundfile(path)
    _require_usable(audio.samples, path)
    for note in audio.notes:
        _log.info("%s: %s", path, note)
    return audio


def _read_with_soundfile(path: Path) -> Audio:
    soundfile = import_optional("soundfile", "audio", f"to read {path.suffix or path.name} audio")
    data = read_bytes(path, _MAX_BYTES)
    try:
        with soundfile.SoundFile(io.BytesIO(data)) as sound:
            declared, rate = sound.frames, sound.samplerate
            if declared != _UNKNOWN_FRAMES and declared * sound.channels > _MAX_SAMPLES:
                raise FormatError(f"{path}: {declared} samples of {sound.channels} channels are too many")
            is_streamed = declared == _UNKNOWN_FRAMES
            samples = _read_stream(sound, path) if is_streamed else sound.read(dtype="float32", always_2d=True)
            is_short = len(samples) < declared and not is_streamed
            damage = [line for line in sound.extra_info.splitlines() if _DAMAGE.search(line)]
    except (soundfile.SoundFileError, RuntimeError, TypeError) as error:
        raise FormatError(
            f"{path}: not a sound file that soundfile reads: {getattr(error, 'error_string', error)}"
        ) from error
    num_channels = samples.shape[1]
    notes = [f"averaged {num_channels} channels to mono"] if num_channels > 1 else []
    if is_short or damage:
        why = "; ".join(line.strip(" *") for line in damage)
        notes.append(f"file ends early or is damaged: {len(samples)} samples are there" + (f" ({why})" if why else ""))
    mono = np.ascontiguousarray(samples.mean(axis=1, dtype=np.float32))
    return Audio(mono, int(rate), notes, path)


def _read_stream(sound: Any, path: Path) -> NDArray[np.float32]:
    """All samples of a file whose header does not say how many there are, as encoders write to a pipe."""
    sound.seekable = lambda: False  # soundfile would look for its place after each block, which such a file refuses
    blocks: list[NDArray[np.float32]] = []
    count = 0
    while len(block := sound.read(_BLOCK_SAMPLES // sound.channels, dtype="float32", always_2d=True)):
        blocks.append(block)
        count += block.size
        if count > _MAX_SAMPLES:
            raise FormatError(f"{path}: more than {_MAX_SAMPLES} samples are too many")
    return np.concatenate(blocks) if blocks else np.zeros((0, sound.channels), np.float32)


def _require_usable(samples: NDArray[np.float32], path: Path) -> None:
    if samples.size == 0:
        raise FormatError(f"{path}: too short: no samples")
    finite = np.isfinite(samples)
    if not finite.all():
        index = int(np.flatnonzero(~finite)[0])
        raise FormatError(f"{path}: sample {index} is {samples[index]}")


@contextmanager
def naming_file(path: Path | None) -> Iterator[None]:
    """Within the block, what is wrong with samples is wrong with their file, and the message names it.

    Raises
    ------
    FormatError
        In place of an InvalidArgument, where the samples were read from a file.
    """
    try:
        yield
    except InvalidArgument as error:
        if path is None:
            raise
        raise FormatError(f"{path}: {error}") from None


@contextmanager
def naming_files(paths: Sequence[Path | None], name: str) -> Iterator[None]:
    """As `naming_file`, for an error about one item of several, such as ``X[3]``."""
    try:
        yield
    except InvalidArgument as error:
        found = re.match(rf"{name}\[([0-9]+)\]:? ?", str(error))
        path = paths[int(found[1])] if found and int(found[1]) < len(paths) else None
        if found is None or path is None:
            raise
        raise FormatError(f"{path}: {str(error)[found.end() :]}") from None
