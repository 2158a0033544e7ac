# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Copies of recordings in noise, to train a recogniser for a place where it is not quiet."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from hri.core.errors import InvalidArgument
from hri.evaluation.noise import SYNTHESISED, make_noise, mix_noise
from hri.media import Audio, read_audio

SNRS_DB = (20.0, 15.0, 10.0, 5.0, 0.0)
"""Of copies; those that `hri study fsdd-noise` trains with."""
NUM_DRAWS = 20
"""Pieces of a noise that are tried until one is not digital silence, which some recordings begin or pause with."""


def check_noises(noises: Sequence[str]) -> None:
    """Refuse a noise that is none, before all recordings are read.

    Raises
    ------
    InvalidArgument
        For a name that is neither of a synthesised noise nor of a file, or a file of digital silence.
    FormatError, IoError
        For a file that is no recording; names it.
    """
    if isinstance(noises, str):
        raise InvalidArgument(f"noises must be a sequence of names, got {noises!r}")
    for name in noises:
        if name in SYNTHESISED:
            continue
        if not Path(name).is_file():
            raise InvalidArgument(f"noise {name} is neither {' nor '.join(SYNTHESISED)} nor a file")
        if not read_audio(name).samples.any():
            raise InvalidArgument(f"noise {name} is silent")


def in_noise(audio: Audio, noises: Sequence[str], rng: np.random.Generator) -> Audio:
    """A clip in a piece of one of the noises, 0 to 20 dB below the word; as it is where all pieces are silent.

    Parameters
    ----------
    audio : Audio
    noises : sequence of str
        As `make_noise` takes them; one is drawn, and one of `SNRS_DB`.
    rng : numpy.random.Generator
    """
    name, snr_db = str(rng.choice(noises)), float(rng.choice(SNRS_DB))
    for _ in range(NUM_DRAWS):
        noise = make_noise(name, len(audio.samples), audio.sample_rate_hz, rng)
        if noise.any():
            return replace(audio, samples=mix_noise(audio.samples, noise, snr_db, audio.sample_rate_hz))
    return audio
