# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Noise added to clean speech at a stated ratio to the level of the speech itself."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hri.core.checks import check_number
from hri.core.errors import InvalidArgument
from hri.media import read_audio
from hri.signal import resample

Samples = NDArray[np.float32]
SYNTHESISED = ("white", "pink")
PARTS = {"all": (0.0, 1.0), "first": (0.0, 0.5), "second": (0.5, 1.0)}
"""Of a recorded noise, as shares of its length: training takes the first half and tests the second."""
_FRAME_S = 0.02
_MARGIN_DB = 15.9
"""ITU-T P.56, method B: what lies further below the active level is a pause."""
_MIN_SNR_DB, _MAX_SNR_DB = -30, 60
_NUM_DRAWS = 20
"""Pieces of a noise that are tried until one is not digital silence, which some recordings begin or pause with."""


def check_noises(noises: Sequence[str], parts: Sequence[str] = ("all",)) -> None:
    """Refuse a noise that is none, before all recordings are read.

    Parameters
    ----------
    noises : sequence of str
        As `make_noise` takes them.
    parts : sequence of str
        Of recorded noises, those that are going to be used.

    Raises
    ------
    InvalidArgument
        For a name that is neither of a synthesised noise nor of a file, or a file with digital silence alone in one of
        the parts.
    FormatError, IoError
        For a file that is no recording; names it.
    """
    if isinstance(noises, str):
        raise InvalidArgument(f"noises must be a sequence of names, got {noises!r}")
    for name in noises:
        if name in SYNTHESISED:
            continue
        if not isinstance(name, str | PathLike):
            raise InvalidArgument(f"noise must be a name or a file, got {name!r}")
        if not Path(name).is_file():
            raise InvalidArgument(f"noise {name} is neither {' nor '.join(SYNTHESISED)} nor a file")
        samples = read_audio(name).samples
        for part in parts:
            first, last = _span(len(samples), part)
            if not samples[first:last].any():
                raise InvalidArgument(f"noise {name} is silent" + ("" if part == "all" else f" in its {part} half"))


def check_snr_db(snr_db: float) -> None:
    """Refuse a ratio of speech to noise that is no number of -30..60 dB. Raises InvalidArgument."""
    check_number(snr_db, "snr_db", _MIN_SNR_DB, _MAX_SNR_DB)


def make_noise(
    name: str, num_samples: int, sample_rate_hz: int, rng: np.random.Generator, part: str = "all"
) -> Samples:
    """Noise of any level, as long as asked for.

    Parameters
    ----------
    name : str
        "white" or "pink" (synthesised), or the path of a recording, of which a piece is taken at random.
    num_samples, sample_rate_hz : int
    rng : numpy.random.Generator
    part : str
        Where in a recording the piece may lie: "all", "first" or "second" half.

    Raises
    ------
    InvalidArgument
        For a name that is neither, another part, or a recording without samples.
    """
    if part not in PARTS:
        raise InvalidArgument(f"part {part!r} of a noise is none of {', '.join(PARTS)}")
    if name == "white":
        return rng.standard_normal(num_samples).astype(np.float32)
    if name == "pink":
        spectrum = np.fft.rfft(rng.standard_normal(num_samples))
        spectrum /= np.sqrt(np.maximum(np.arange(len(spectrum)), 1.0))
        return np.fft.irfft(spectrum, num_samples).astype(np.float32)
    if not Path(name).is_file():
        raise InvalidArgument(f"noise {name!r} is neither {' nor '.join(SYNTHESISED)} nor a file")
    recording = _recording(name, sample_rate_hz)
    first, last = _span(len(recording), part)
    if last == first:
        raise InvalidArgument(f"noise {name!r} is too short")
    if last - first <= num_samples:  # too short for a piece of its own: go round
        return np.resize(np.roll(recording[first:last], -int(rng.integers(last - first))), num_samples)
    start = first + int(rng.integers(last - first - num_samples))
    return recording[start : start + num_samples].copy()


def find_noise(
    name: str, num_samples: int, sample_rate_hz: int, rng: np.random.Generator, part: str = "all"
) -> Samples | None:
    """Noise as of `make_noise`, drawn anew while it is digital silence; None where that is all that is found."""
    for _ in range(_NUM_DRAWS):
        noise = make_noise(name, num_samples, sample_rate_hz, rng, part)
        if noise.any():
            return noise
    return None


def draw_noise(
    name: str, num_samples: int, sample_rate_hz: int, rng: np.random.Generator, part: str = "all"
) -> Samples:
    """As `find_noise`. Raises InvalidArgument, which names the noise, where nothing but silence is found."""
    noise = find_noise(name, num_samples, sample_rate_hz, rng, part)
    if noise is None:
        raise InvalidArgument(f"noise {name} is silent in {_NUM_DRAWS} pieces of {num_samples / sample_rate_hz:.2f} s")
    return noise


def _span(length: int, part: str) -> tuple[int, int]:
    """Where a part of a recording begins and ends."""
    first, last = PARTS[part]
    return round(first * length), round(last * length)


@lru_cache(maxsize=16)
def _recording(path: str, sample_rate_hz: int) -> Samples:
    audio = read_audio(path)
    if audio.sample_rate_hz == sample_rate_hz:
        return audio.samples
    return np.asarray(resample(audio.samples, audio.sample_rate_hz, sample_rate_hz))


def active_power(samples: Samples, sample_rate_hz: int) -> float:
    """Mean power of the frames with speech, so that pauses around a word do not count.

    After ITU-T P.56: frames (20 ms) more than 15.9 dB below the active level are pauses; the level follows from the
    others, until both agree.
    """
    length = max(1, round(_FRAME_S * sample_rate_hz))
    squares = np.square(samples, dtype=np.float64)
    whole = squares[: len(squares) // length * length]
    frames = whole.reshape(-1, length).mean(axis=1) if len(whole) else squares
    level = float(frames.mean())
    for _ in range(len(frames)):
        active = frames[frames >= level * 10 ** (-_MARGIN_DB / 10)]
        if not len(active) or float(active.mean()) == level:
            break
        level = float(active.mean())
    return level


def mix_noise(samples: Samples, noise: Samples, snr_db: float, sample_rate_hz: int) -> Samples:
    """`samples` plus `noise`, scaled so that the active level of the speech is `snr_db` above that of the noise.

    Parameters
    ----------
    samples, noise : float32 arrays, shape (num_samples,)
    snr_db : float
        -30..60.
    sample_rate_hz : int

    Raises
    ------
    InvalidArgument
        For lengths that differ, an SNR out of range, or noise without power.
    """
    if samples.shape != noise.shape:
        raise InvalidArgument(f"samples and noise differ in shape: {samples.shape}, {noise.shape}")
    check_snr_db(snr_db)
    return (samples + noise_at(noise, active_power(samples, sample_rate_hz), snr_db)).astype(np.float32)


def noise_at(noise: Samples, speech_power: float, snr_db: float) -> Samples:
    """`noise` scaled to lie `snr_db` below speech of a mean power. Raises InvalidArgument for noise without power."""
    power = float(np.mean(np.square(noise, dtype=np.float64)))
    if not power > 0:
        raise InvalidArgument("noise has no power")
    return (noise * np.sqrt(speech_power / 10 ** (snr_db / 10) / power)).astype(np.float32)


@dataclass(frozen=True)
class AddNoise:
    """A condition: noise drawn anew for every clip, from where a recorded noise is not digital silence.

    Attributes
    ----------
    noises : sequence of str
        As `make_noise` takes them; one is drawn for each clip.
    snrs_db : sequence of float
        One is drawn for each clip.
    part : str
        Which part of recorded noises, see `make_noise`.
    """

    noises: Sequence[str]
    snrs_db: Sequence[float]
    part: str = "all"

    def __call__(self, samples: Samples, sample_rate_hz: int, rng: np.random.Generator) -> Samples:
        """The clip with noise."""
        if not len(samples):
            return samples
        name = self.noises[int(rng.integers(len(self.noises)))]
        snr_db = self.snrs_db[int(rng.integers(len(self.snrs_db)))]
        noise = draw_noise(name, len(samples), sample_rate_hz, rng, self.part)
        return mix_noise(samples, noise, snr_db, sample_rate_hz)
