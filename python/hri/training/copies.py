# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Copies of recordings in noise and across rooms, to train a recogniser for where it is used."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from hri.evaluation.noise import find_noise, mix_noise
from hri.evaluation.room import AcrossRooms
from hri.media import Audio

SNRS_DB = (20.0, 15.0, 10.0, 5.0, 0.0)
"""Of copies; those that `hri study fsdd-noise` trains with."""


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
    noise = find_noise(name, len(audio.samples), audio.sample_rate_hz, rng)
    if noise is None:
        return audio
    mixed = mix_noise(audio.samples, noise, snr_db, audio.sample_rate_hz)
    return replace(audio, samples=mixed, path=_named(audio, "in noise"))


def across_a_room(audio: Audio, rng: np.random.Generator) -> Audio:
    """A clip as a microphone 0.5 to 4 m away hears it in a room that is drawn, see `AcrossRooms`.

    Parameters
    ----------
    audio : Audio
    rng : numpy.random.Generator
    """
    heard = AcrossRooms()(audio.samples, audio.sample_rate_hz, rng)
    return replace(audio, samples=heard, path=_named(audio, "across a room"))


def _named(audio: Audio, how: str) -> Path | None:
    """What messages call the copy: that no speech is found in it does not say so of the recording."""
    return None if audio.path is None else audio.path.with_name(f"{audio.path.name} {how}")
