# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Copies of recordings in noise, to train a recogniser for a place where it is not quiet."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import click
import numpy as np
from numpy.typing import NDArray

from hri.datasets import Dataset
from hri.evaluation import make_noise, mix_noise
from hri.evaluation.noise import SYNTHESISED
from hri.evaluation.training import Progress
from hri.io import write_wav_pcm16
from hri.media import Audio, read_audio

SNRS_DB = (20.0, 15.0, 10.0, 5.0, 0.0)
"""Of copies; those that `hri study fsdd-noise` trains with."""
NUM_DRAWS = 20
"""Pieces of a noise that are tried until one is not digital silence, which some recordings begin or pause with."""


def check_noises(noises: Sequence[str]) -> None:
    """Refuse a noise that is none before all recordings are read.

    Raises
    ------
    click.UsageError
        For a name that is neither of a synthesised noise nor of a file, or a file of digital silence.
    FormatError, IoError
        For a file that is no recording; names it.
    """
    for name in noises:
        if name in SYNTHESISED:
            continue
        if not Path(name).is_file():
            raise click.UsageError(f"--noise {name} is neither {' nor '.join(SYNTHESISED)} nor a file")
        if not read_audio(name).samples.any():
            raise click.UsageError(f"--noise {name} is silent")


def _in_noise(audio: Audio, noises: Sequence[str], rng: np.random.Generator) -> NDArray[np.float32]:
    """A clip in a piece of one of the noises that is no digital silence; as it is where none was found."""
    name, snr_db = str(rng.choice(noises)), float(rng.choice(SNRS_DB))
    for _ in range(NUM_DRAWS):
        noise = make_noise(name, len(audio.samples), audio.sample_rate_hz, rng)
        if noise.any():
            return mix_noise(audio.samples, noise, snr_db, audio.sample_rate_hz)
    return audio.samples


@contextmanager
def with_noisy_copies(dataset: Dataset, noises: Sequence[str], seed: int, progress: Progress) -> Iterator[Dataset]:
    """The recordings, and one copy of each in one of the noises, 0 to 20 dB below the word; for as long as it is open.

    Without noises, the data set itself.
    """
    if not noises:
        yield dataset
        return
    with TemporaryDirectory(prefix="hri-noise-") as folder:
        copies = []
        for number, sample in enumerate(dataset.samples):
            audio = read_audio(sample.path)
            noisy = _in_noise(audio, noises, np.random.default_rng([seed, number]))
            path = Path(folder) / f"{number}_{sample.path.stem}_in_noise.wav"
            # Recognisers do not mind the level, a file of 16 bits does.
            write_wav_pcm16(str(path), noisy / max(1.0, float(np.abs(noisy).max())), audio.sample_rate_hz)
            copies.append(replace(sample, path=path))
            progress("adding noise", number + 1, len(dataset))
        yield replace(dataset, samples=[*dataset.samples, *copies])
