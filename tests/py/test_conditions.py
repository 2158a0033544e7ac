# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Rooms and tempos: what they do to sound whose answer is known."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from hri.core.errors import InvalidArgument
from hri.evaluation.noise import active_power
from hri.evaluation.room import (
    AcrossRooms,
    InRoom,
    Response,
    Room,
    convolve,
    diffuse_response,
    responses_at,
    simulate_response,
)
from hri.evaluation.tempo import ChangeTempo
from hri.io import write_wav_pcm16

RATE_HZ = 16000
SPEED_OF_SOUND = 343.0


def rng(seed: int = 0) -> np.random.Generator:
    return np.random.default_rng(seed)


def pitch_hz(samples: np.ndarray) -> float:
    spectrum = np.abs(np.fft.rfft(samples * np.hanning(len(samples)), 1 << 16))
    return float(spectrum.argmax() * RATE_HZ / (1 << 16))


@pytest.mark.parametrize("factor", [0.5, 0.7, 1.4, 2.0])
def test_tempo_changes_the_length_and_not_the_pitch(factor: float) -> None:
    pytest.importorskip("audiotsm")
    time_s = np.arange(RATE_HZ // 2) / RATE_HZ
    tone = (0.5 * np.sin(2 * np.pi * 440 * time_s)).astype("f4")
    changed = ChangeTempo(factor)(tone, RATE_HZ, rng())
    assert changed.dtype == np.float32 and len(changed) == round(len(tone) / factor)
    assert pitch_hz(changed) == pytest.approx(440, rel=0.02)
    last = changed[-len(changed) // 10 :]
    assert last.std() > 0.2, "the end of the word is not lost"


def test_tempo_out_of_range_is_refused() -> None:
    for factor in (0.0, 5.0, float("nan")):
        with pytest.raises(InvalidArgument, match="factor of tempo"):
            ChangeTempo(factor)


@pytest.mark.parametrize("distance_m", [0.5, 1.0, 4.0])
def test_direct_sound_falls_with_distance(distance_m: float) -> None:
    pytest.importorskip("pyroomacoustics")
    dry = simulate_response(Room(reverberation_s=0.15), distance_m, RATE_HZ, rng(1))
    delay = round(distance_m / SPEED_OF_SOUND * RATE_HZ)
    # The simulator delays everything by half of its fractional-delay filter of 81 taps. The first reflection is later.
    direct = np.abs(np.fft.rfft(dry.samples[delay : delay + 81].astype("f8"), 1024))
    assert direct[40:400].mean() == pytest.approx(0.5 / distance_m, rel=0.1)
    assert np.abs(dry.samples[: max(0, delay - 5)]).max(initial=0.0) < 0.02 / distance_m


def test_a_room_repeats_with_its_seed_and_has_its_reverberation() -> None:
    acoustics = pytest.importorskip("pyroomacoustics")
    room = Room((6.0, 5.0, 3.0), 0.5)
    first, second = (simulate_response(room, 2.0, RATE_HZ, rng(7)) for _ in range(2))
    np.testing.assert_array_equal(first.samples, second.samples)
    assert acoustics.experimental.measure_rt60(first.samples, fs=RATE_HZ, decay_db=30) == pytest.approx(0.5, rel=0.3)
    places = responses_at(room, 2.0, RATE_HZ, 3, 0)
    assert len(places) == 3 and not np.array_equal(places[0].samples[:500], places[1].samples[:500])
    with pytest.raises(InvalidArgument, match="no place for 9"):
        simulate_response(room, 9.0, RATE_HZ, rng())


def test_convolution_is_linear_and_complete() -> None:
    x, h = rng().normal(size=300).astype("f4"), rng(1).normal(size=77).astype("f4")
    np.testing.assert_allclose(convolve(x, h), np.convolve(x.astype("f8"), h), atol=1e-4)


def test_the_noise_of_a_room_does_not_fall_with_distance() -> None:
    word = np.sin(np.arange(RATE_HZ) * 0.2).astype("f4")
    for gain in (1.0, 0.1):
        click = Response(np.array([gain], "f4"), RATE_HZ)
        silent = InRoom([click])(word, RATE_HZ, rng())
        np.testing.assert_allclose(silent, gain * word, atol=1e-6)
        noise = InRoom([click], ["white"], 20.0)(word, RATE_HZ, rng()) - silent
        assert 10 * np.log10(active_power(word, RATE_HZ) / np.mean(noise**2)) == pytest.approx(20, abs=0.01)


def test_a_recorded_response_is_read_and_resampled(tmp_path: Path) -> None:
    echo = np.zeros(4000, "f4")
    echo[[200, 2200]] = 0.4, 0.1
    write_wav_pcm16(str(tmp_path / "r.wav"), echo, 2 * RATE_HZ)
    response = Response.read(str(tmp_path / "r.wav"))
    assert response.samples[200] == 1.0 and response.samples[2200] == pytest.approx(0.25, abs=1e-3)
    time_s = np.arange(RATE_HZ) / RATE_HZ
    tone = np.sin(2 * np.pi * 500 * time_s).astype("f4")
    heard = convolve(tone, response.at(RATE_HZ))[:RATE_HZ]
    # The echo comes 1000 samples later, a whole number of periods but for a quarter: 500 Hz has 32 samples a period.
    expected = np.abs(1 + 0.25 * np.exp(-2j * np.pi * 500 * 1000 / RATE_HZ))
    assert heard[4000:8000].std() / tone.std() == pytest.approx(expected, rel=0.02)


@pytest.mark.parametrize(("volume_m3", "reverberation_s", "distance_m"), [(60.0, 0.3, 1.0), (200.0, 0.9, 4.0)])
def test_a_diffuse_echo_decays_and_is_as_strong_as_the_critical_distance_says(
    volume_m3: float, reverberation_s: float, distance_m: float
) -> None:
    samples = diffuse_response(volume_m3, reverberation_s, distance_m, RATE_HZ, rng(3)).samples.astype(np.float64)
    assert samples[0] == pytest.approx(0.5 / distance_m) and not samples[1 : int(0.002 * RATE_HZ)].any()
    echo = float(np.sum(samples[1:] ** 2)) / samples[0] ** 2
    assert echo == pytest.approx(distance_m**2 / (0.057**2 * volume_m3 / reverberation_s), rel=1e-4)
    left_db = 10 * np.log10(np.cumsum(samples[:0:-1] ** 2)[::-1])  # Schroeder's integral
    fall = np.polyfit(
        np.arange(int(0.5 * reverberation_s * RATE_HZ)), left_db[: int(0.5 * reverberation_s * RATE_HZ)], 1
    )
    assert -60 / fall[0] / RATE_HZ == pytest.approx(reverberation_s, rel=0.1)
    with pytest.raises(InvalidArgument, match="must be above 0"):
        diffuse_response(volume_m3, 0.0, distance_m, RATE_HZ, rng())


def test_every_clip_stands_in_a_room_of_its_own() -> None:
    clip = np.zeros(RATE_HZ // 2, np.float32)
    clip[100:4000] = np.sin(np.arange(3900) / 3)
    first, second = (AcrossRooms()(clip, RATE_HZ, rng(seed)) for seed in (1, 2))
    assert len(first) != len(second) and min(len(first), len(second)) >= len(clip) + 0.2 * RATE_HZ
    np.testing.assert_array_equal(first, AcrossRooms()(clip, RATE_HZ, rng(1)))
