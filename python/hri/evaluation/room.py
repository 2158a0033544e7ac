# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Speech from across a room: impulse responses simulated or recorded, and the noise of the room."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from hri.core.display import short_repr
from hri.core.errors import InvalidArgument
from hri.core.optional import import_optional
from hri.evaluation.conditions import Samples
from hri.evaluation.noise import active_power, draw_noise, noise_at
from hri.media import read_audio
from hri.signal import resample

REFERENCE_M = 0.5
"""Simulated responses have a direct sound of gain 1 at this distance."""
VOLUMES_M3 = (40.0, 250.0)
REVERBERATIONS_S = (0.2, 2.0)
DISTANCES_M = (0.5, 4.0)
"""Of `AcrossRooms`, each drawn evenly in its logarithm."""
_FIRST_ECHO_S = 0.002
_WALL_M = 0.4
"""Speaker and microphone stand no nearer to a wall."""
_TRIES = 1000


@dataclass(frozen=True)
class Room:
    """A box-shaped room.

    Attributes
    ----------
    size_m : tuple of float
        Length, width, height.
    reverberation_s : float
        Time in which sound falls by 60 dB (RT60).
    """

    size_m: tuple[float, float, float] = (7.0, 5.0, 2.8)
    reverberation_s: float = 0.4


@dataclass(frozen=True)
@short_repr
class Response:
    """What a microphone hears of a click: `samples` at `sample_rate_hz`."""

    samples: NDArray[np.float32]
    sample_rate_hz: int

    @classmethod
    def read(cls, path: str) -> Response:
        """A recorded response; its strongest sample gets gain 1."""
        audio = read_audio(path)
        return cls(audio.samples / np.abs(audio.samples).max(), audio.sample_rate_hz)

    def at(self, sample_rate_hz: int) -> NDArray[np.float32]:
        """Resampled, as loud as it was."""
        if sample_rate_hz == self.sample_rate_hz:
            return self.samples
        resampled = np.asarray(resample(self.samples, self.sample_rate_hz, sample_rate_hz))
        return resampled * np.float32(self.sample_rate_hz / sample_rate_hz)


def simulate_response(room: Room, distance_m: float, sample_rate_hz: int, rng: np.random.Generator) -> Response:
    """By the image-source method, a speaker and a microphone `distance_m` apart at a place drawn at random.

    Both are 1.2 to 1.7 m above the floor. The direct sound has gain 0.5 m / `distance_m`.

    Raises
    ------
    InvalidArgument
        For a distance for which the room has no place.
    ImportError
        Without pyroomacoustics; says how to install it.
    """
    acoustics = import_optional("pyroomacoustics", "studies", "to simulate rooms")
    low = np.array([_WALL_M, _WALL_M, 1.2])
    high = np.array([room.size_m[0] - _WALL_M, room.size_m[1] - _WALL_M, 1.7])
    for _ in range(_TRIES):
        microphone, angle = rng.uniform(low, high), rng.uniform(0, 2 * np.pi)
        rise = rng.uniform(1.2, 1.7) - microphone[2]
        flat = np.sqrt(max(distance_m**2 - rise**2, 0.0))
        speaker = microphone + np.array([flat * np.cos(angle), flat * np.sin(angle), rise])
        if np.all(speaker >= low - 1e-9) and np.all(speaker <= high + 1e-9) and flat > 0:
            break
    else:
        raise InvalidArgument(f"a room of {room.size_m} m has no place for {distance_m} m")
    absorption, order = acoustics.inverse_sabine(room.reverberation_s, room.size_m)
    box = acoustics.ShoeBox(room.size_m, fs=sample_rate_hz, materials=acoustics.Material(absorption), max_order=order)
    box.add_source(speaker)
    box.add_microphone(microphone)
    box.compute_rir()
    samples = REFERENCE_M * np.asarray(box.rir[0][0])  # which has gain 1 at 1 m
    return Response(samples.astype(np.float32), sample_rate_hz)


@dataclass(frozen=True, eq=False)
class InRoom:
    """A condition: the clip as heard through a response, with the room's own noise.

    Attributes
    ----------
    responses : sequence of Response
        One is drawn for each clip.
    noises : sequence of str
        As `make_noise` takes them, one is drawn for each clip; none for a silent room.
    snr_db : float
        Level of the dry clip over the noise: what is heard at a gain of 1.
    part : str
        Which part of recorded noises.
    """

    responses: Sequence[Response]
    noises: Sequence[str] = ()
    snr_db: float = 30.0
    part: str = "all"

    def __call__(self, samples: Samples, sample_rate_hz: int, rng: np.random.Generator) -> Samples:
        """The clip in the room, longer by the room's reverberation."""
        response = self.responses[int(rng.integers(len(self.responses)))]
        heard = convolve(samples, response.at(sample_rate_hz))
        if not self.noises:
            return heard
        name = self.noises[int(rng.integers(len(self.noises)))]
        noise = draw_noise(name, len(heard), sample_rate_hz, rng, self.part)
        return heard + noise_at(noise, active_power(samples, sample_rate_hz), self.snr_db)


def diffuse_response(
    volume_m3: float, reverberation_s: float, distance_m: float, sample_rate_hz: int, rng: np.random.Generator
) -> Response:
    """By statistics alone: the direct sound, and noise that decays as the reverberation does. No library is needed.

    The reverberation is as strong as the direct sound at the critical distance, 0.057 sqrt(V / T) metres, and equally
    strong everywhere (after J.-D. Polack, "La transmission de l'énergie sonore dans les salles", 1988).

    Parameters
    ----------
    volume_m3 : float
        V.
    reverberation_s : float
        T, in which sound falls by 60 dB.
    distance_m : float
        From speaker to microphone. The direct sound has gain 0.5 m / `distance_m`, as of `simulate_response`.
    sample_rate_hz : int
    rng : numpy.random.Generator
        Of the reverberation.

    Raises
    ------
    InvalidArgument
        For what is not above 0.
    """
    if min(volume_m3, reverberation_s, distance_m, sample_rate_hz) <= 0:
        raise InvalidArgument("volume_m3, reverberation_s, distance_m and sample_rate_hz must be above 0")
    first = 1 + int(_FIRST_ECHO_S * sample_rate_hz)
    num_samples = first + int(reverberation_s * sample_rate_hz)
    times_s = np.arange(num_samples) / sample_rate_hz
    samples = rng.standard_normal(num_samples) * 10 ** (-3 * times_s / reverberation_s)
    samples[:first] = 0
    critical_m = 0.057 * np.sqrt(volume_m3 / reverberation_s)
    samples *= distance_m / critical_m / np.sqrt(np.sum(samples**2))
    samples[0] = 1
    return Response((REFERENCE_M / distance_m * samples).astype(np.float32), sample_rate_hz)


@dataclass(frozen=True, eq=False)
class AcrossRooms:
    """A condition: every clip in a room of its own, drawn from small to large and from furnished to bare.

    Attributes
    ----------
    noises, snr_db, part
        As of `InRoom`.
    """

    noises: Sequence[str] = ("pink",)
    snr_db: float = 30.0
    part: str = "all"

    def __call__(self, samples: Samples, sample_rate_hz: int, rng: np.random.Generator) -> Samples:
        """The clip in such a room, longer by its reverberation."""
        limits = np.log([VOLUMES_M3, REVERBERATIONS_S, DISTANCES_M])
        volume, reverberation, distance = (float(drawn) for drawn in np.exp(rng.uniform(limits[:, 0], limits[:, 1])))
        response = diffuse_response(volume, reverberation, distance, sample_rate_hz, rng)
        return InRoom([response], self.noises, self.snr_db, self.part)(samples, sample_rate_hz, rng)


def convolve(samples: Samples, response: NDArray[np.float32]) -> Samples:
    """Linear convolution, len(samples) + len(response) - 1 samples."""
    length = len(samples) + len(response) - 1
    size = 1 << (length - 1).bit_length()
    spectrum = np.fft.rfft(samples, size) * np.fft.rfft(response, size)
    return np.fft.irfft(spectrum, size)[:length].astype(np.float32)


@lru_cache(maxsize=64)
def responses_at(room: Room, distance_m: float, sample_rate_hz: int, count: int, seed: int) -> tuple[Response, ...]:
    """`count` simulated responses at one distance, at places drawn with `seed`."""
    rng = np.random.default_rng([seed, round(1000 * distance_m)])
    return tuple(simulate_response(room, distance_m, sample_rate_hz, rng) for _ in range(count))
