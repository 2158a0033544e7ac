# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Filler words: words outside the vocabulary, whose models a recogniser compares with before it accepts a word."""

from __future__ import annotations

import io
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

import numpy as np
from numpy.typing import NDArray

from hri.core.display import summary
from hri.core.errors import FormatError

RATE_HZ = 16000
EMBEDDING_RATE_HZ = 8000
"""The pretrained embedding hears nothing above 3.8 kHz."""
_FILE = "filler_words.npz"
_EMBEDDING_FILE = "embedding_filler_words.npz"
_MU = 255.0


@dataclass(frozen=True)
class FillerWord:
    """A recording of a word outside the vocabulary.

    Attributes
    ----------
    samples : float32 array, shape (num_samples,)
        Mono, -1..1.
    sample_rate_hz : int
    label : str
        Which word; recordings of one word share a model.
    """

    samples: NDArray[np.float32]
    sample_rate_hz: int
    label: str

    def __repr__(self) -> str:
        return summary("FillerWord", repr(self.label), f"{len(self.samples)} samples", f"{self.sample_rate_hz} Hz")


def compress(samples: NDArray[np.float32]) -> NDArray[np.uint8]:
    """Eight bits a sample on the mu-law curve (ITU-T G.711's, unquantised): 38 dB for speech at any level."""
    curve = np.sign(samples) * np.log1p(_MU * np.abs(samples)) / np.log1p(_MU)
    return np.round(127.5 * (curve + 1.0)).astype(np.uint8)


def expand(codes: NDArray[np.uint8]) -> NDArray[np.float32]:
    """Invert `compress`, to its precision."""
    curve = codes.astype(np.float64) / 127.5 - 1.0
    return (np.sign(curve) * np.expm1(np.abs(curve) * np.log1p(_MU)) / _MU).astype(np.float32)


@cache
def filler_words() -> tuple[FillerWord, ...]:
    """The filler words that come with the package: synthetic voices, English and Hindi, at 16 kHz.

    Returns
    -------
    tuple of FillerWord

    Raises
    ------
    FormatError
        When the installed file is damaged.

    Examples
    --------
    >>> words = filler_words()
    >>> len({word.label for word in words})
    48
    """
    return _read(_FILE, RATE_HZ)


@cache
def embedding_filler_words() -> tuple[FillerWord, ...]:
    """Further filler words for the pretrained embedding alone: other words, each by one synthetic voice, at 8 kHz.

    Returns
    -------
    tuple of FillerWord

    Raises
    ------
    FormatError
        When the installed file is damaged.
    """
    return _read(_EMBEDDING_FILE, EMBEDDING_RATE_HZ)


def _read(name: str, rate_hz: int) -> tuple[FillerWord, ...]:
    try:
        data = io.BytesIO((files("hri.recognition.word") / name).read_bytes())
        with np.load(data, allow_pickle=False) as stored:
            codes, ends, labels = stored["codes"], stored["ends"], stored["labels"]
    except (OSError, ValueError, KeyError) as error:
        raise FormatError(f"{name}: {error}") from error
    if ends.ndim != 1 or ends.shape != labels.shape or np.any(np.diff(ends, prepend=0) <= 0) or ends[-1] != codes.size:
        raise FormatError(f"{name}: the lengths do not fit the samples")
    pieces = np.split(expand(codes), ends[:-1])
    return tuple(FillerWord(p, rate_hz, str(label)) for p, label in zip(pieces, labels, strict=True))
