# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Spoken words and the features that studies compare on them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri import signal
from hri.datasets import Dataset
from hri.evaluation.conditions import Condition
from hri.features import CepstraComputer, CepstraOptions
from hri.media import read_audio
from hri.signal import find_speech, resample
from hri.studies.registry import Progress

Samples = NDArray[np.float32]
Frames = NDArray[np.float32]

RATE_HZ = 16000
"""That of the thesis's recordings, so that a wavelet's level means the same band."""
NUM_FILTERS = 29
"""Of the thesis, section 6.2.6."""
NUM_CEPSTRA = 12
WAVELET = "db6"
LEVEL = 3
WORD_FOLDERS = {
    "fsdd": "fsdd/recordings",
    "hindi-digits": "hindi_words/digits",
    "hindi-words": "hindi_words/words",
}


@dataclass(frozen=True)
class SpokenWord:
    """One recording at 16 kHz without the pauses round the word; what lies above `band_hz` was never recorded."""

    label: str
    person: str
    samples: Samples
    band_hz: float


def load_words(data_dir: Path, name: str, takes: int | None = None) -> Dataset:
    """A data set of `WORD_FOLDERS`, with the first `takes` recordings of every word by every person."""
    return first_takes(Dataset.load(data_dir / WORD_FOLDERS[name], "speech"), takes)


def first_takes(dataset: Dataset, takes: int | None) -> Dataset:
    """The first `takes` recordings of every word by every person; None: all."""
    if takes is None:
        return dataset
    met: Counter[tuple[str, str]] = Counter()
    kept = []
    for sample in dataset.samples:
        met[sample.person, sample.label] += 1
        if met[sample.person, sample.label] <= takes:
            kept.append(sample)
    return replace(dataset, samples=kept)


def read_words(
    data_dir: Path,
    name: str,
    progress: Progress,
    takes: int | None = None,
    condition: Condition | None = None,
    seed: int = 0,
) -> list[SpokenWord]:
    """Every recording of `load_words`; what a condition adds moves no end point."""
    dataset = load_words(data_dir, name, takes)
    words = []
    for done, sample in enumerate(dataset.samples):
        audio = read_audio(sample.path)
        bounds = find_speech(audio.samples, audio.sample_rate_hz)
        heard = audio.samples
        if condition is not None:
            heard = condition(heard, audio.sample_rate_hz, np.random.default_rng([seed, done]))
        clip = heard if bounds is None else heard[bounds[0] : bounds[1]]
        clip = np.asarray(resample(clip, audio.sample_rate_hz, RATE_HZ))
        words.append(SpokenWord(sample.label, sample.person, clip, min(RATE_HZ, audio.sample_rate_hz) / 2))
        progress(f"{name}: reading", done + 1, len(dataset))
    return words


@dataclass(frozen=True)
class FeatureKind:
    """How frames come from the sound of a word.

    Attributes
    ----------
    options : dict
        Of `CepstraOptions`, where they differ from 29 mel filters and 12 cepstra.
    prepare : callable, optional
        What is done to the samples before; what it gives is at `rate_divisor` times less than 16 kHz.
    rate_divisor : int
    at_band : bool
        Whether to work at twice the band that was recorded, where linear prediction must not model emptiness.
    """

    options: dict[str, Any] = field(default_factory=dict)
    prepare: Callable[[Samples], Samples] | None = None
    rate_divisor: int = 1
    at_band: bool = False

    def frames(self, samples: Samples, band_hz: float) -> Frames:
        """Cepstra 0-12, deltas and accelerations, mean normalised, shape (num_frames, num_features)."""
        prepared = samples if self.prepare is None else self.prepare(samples)
        rate_hz = RATE_HZ // self.rate_divisor
        if self.at_band and 2 * band_hz < rate_hz:
            prepared = np.asarray(resample(prepared, rate_hz, round(2 * band_hz)))
            rate_hz = round(2 * band_hz)
        computer = _computer(rate_hz, band_hz, self.options)
        least = int(np.ceil(rate_hz * computer.options.frame_length_ms / 1000))
        if len(prepared) < least:
            prepared = np.pad(prepared, (0, least - len(prepared)))
        return computer.compute(prepared)


def _computer(rate_hz: int, band_hz: float, options: dict[str, Any]) -> Any:
    """Fewer filters where there is less to hear: as many for an octave as over the full band."""
    band = min(band_hz, rate_hz / 2)
    filters = round(NUM_FILTERS * _mel(band) / _mel(RATE_HZ / 2)) if band < RATE_HZ / 4 else NUM_FILTERS
    named = {"num_filters": filters, "num_cepstra": min(NUM_CEPSTRA, filters - 1), **options}
    return CepstraComputer(CepstraOptions(sample_rate_hz=rate_hz, high_hz=band, **named))


def _mel(hz: float) -> float:
    return float(np.log1p(hz / 700.0))


def approximation(samples: Samples, wavelet: str = WAVELET, level: int = LEVEL) -> Samples:
    """The level's approximation: the sound below 8 kHz / 2^level, at 16 kHz / 2^level."""
    return signal.approximation(samples, wavelet, "periodization", level)


def denoised(samples: Samples, wavelet: str = WAVELET, level: int = 0) -> Samples:
    """Shrinkage of the details of `level` levels with the library's other defaults; 0 takes its levels too."""
    return signal.denoise(samples, wavelet, level=level or None)


def approximation_kind(wavelet: str, level: int, options: dict[str, Any]) -> FeatureKind:
    """Cepstra of the approximation (thesis section 6.2.2, as it reads)."""
    return FeatureKind(options, partial(approximation, wavelet=wavelet, level=level), 2**level)


def shrinkage_kind(wavelet: str, level: int, options: dict[str, Any]) -> FeatureKind:
    """Cepstra of the sound without its noise (the other reading)."""
    return FeatureKind(options, partial(denoised, wavelet=wavelet, level=level))


HFCC = {"filter_bank": "hfcc"}

FEATURES: dict[str, FeatureKind] = {
    "mfcc": FeatureKind(),
    "hfcc": FeatureKind(HFCC),
    "lpcc": FeatureKind({"kind": "linear_prediction"}, at_band=True),
    f"dwt{LEVEL}+hfcc": approximation_kind(WAVELET, LEVEL, HFCC),
    "shrinkage+hfcc": shrinkage_kind(WAVELET, 0, HFCC),
}
"""By name, as the thesis compares them; "dwt3" are features of the third level's approximation."""


def all_frames(words: Sequence[SpokenWord], kind: FeatureKind, name: str, progress: Progress) -> list[Frames]:
    """The frames of every word."""
    found = []
    for done, word in enumerate(words):
        found.append(kind.frames(word.samples, word.band_hz))
        progress(f"{name}: features", done + 1, len(words))
    return found
