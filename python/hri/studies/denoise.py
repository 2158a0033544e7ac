# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""How much noise do wavelets take out of speech? The gain in signal-to-noise ratio, by way of doing it and noise."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.datasets import Dataset
from hri.evaluation import AddNoise
from hri.media import read_audio
from hri.signal import wavedec, waverec
from hri.signal.noise_reduction import NOISES, RULES, denoise
from hri.studies.noise import NOISES as FILES
from hri.studies.noise import noise_paths
from hri.studies.registry import Layout, Progress, Study
from hri.studies.tables import statistics

Samples = NDArray[np.float32]

WAVELET = "sym8"
SNR_DB = 10.0
SEED = 0
SHAPES = ("soft", "hard", "garrote")
APPROXIMATIONS = (1, 2, 3)


def _approximation(samples: Samples, level: int) -> Samples:
    """Without the details of the finest levels, at the rate it had."""
    bands = wavedec(samples, WAVELET, "symmetric", level)
    return waverec([bands[0], *map(np.zeros_like, bands[1:])], WAVELET, num_samples=len(samples))


def _methods(threshold: Sequence[str]) -> Iterator[tuple[dict[str, str], Callable[[Samples], Samples]]]:
    for rule in threshold:
        for shape in SHAPES:
            for noise in NOISES:
                named = {"threshold": rule, "shape": shape, "estimate": noise}
                yield named, partial(denoise, wavelet=WAVELET, threshold=rule, shape=shape, noise=noise)
    for level in APPROXIMATIONS:
        named = {"threshold": f"approximation {level}", "shape": "", "estimate": ""}
        yield named, partial(_approximation, level=level)


def _run(
    data_dir: Path,
    progress: Progress,
    *,
    threshold: Sequence[str] = tuple(RULES),
    noise: Sequence[str] = tuple(FILES),
) -> dict[str, Any]:
    clips = Dataset.load(data_dir / "fsdd" / "recordings", "speech").samples
    paths = noise_paths(data_dir)
    methods = list(_methods(threshold))
    rows = []
    for name in noise:
        add = AddNoise([paths[name]], [SNR_DB])
        rng = np.random.default_rng(SEED)
        gains: list[defaultdict[str, list[float]]] = [defaultdict(list) for _ in methods]
        for done, clip in enumerate(clips):
            audio = read_audio(clip.path)
            noisy = add(audio.samples, audio.sample_rate_hz, rng)
            before = _energy(noisy - audio.samples)
            for (_, method), by_person in zip(methods, gains, strict=True):
                left = _energy(method(noisy) - audio.samples)
                by_person[clip.person].append(10.0 * np.log10(before / left))
            progress(name, done + 1, len(clips))
        for (named, _), by_person in zip(methods, gains, strict=True):
            means = {person: float(np.mean(found)) for person, found in by_person.items()}
            rows.append({**named, "noise": name, **statistics(means, "gain_db")})
    return {"seed": SEED, "snr_db": SNR_DB, "wavelet": WAVELET, "rows": rows, "passed": None}


def _energy(samples: Samples) -> float:
    return max(float(np.square(samples, dtype=np.float64).sum()), 1e-12)


STUDIES = (
    Study(
        "denoise",
        "gain in signal-to-noise ratio (dB) of spoken digits in noise at 10 dB, by threshold, shape and "
        "estimate of the noise, and by the approximation of levels 1 to 3",
        ("fsdd/recordings", "noise"),
        "none: a comparison",
        _run,
        Layout(columns="noise", panel="noise", measure="gain_db", percent=False),
        {"threshold": tuple(RULES), "noise": tuple(FILES)},
        sources=("cpp/signal",),
        quick={"noise": ("white",), "threshold": ("bayes",)},
    ),
)
