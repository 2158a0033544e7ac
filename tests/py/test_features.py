# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Filter banks and cepstra against librosa and against the formulae written out in NumPy."""

from __future__ import annotations

import librosa
import numpy as np
import pytest
from scipy.fft import dct

from hri.core.errors import InvalidArgument
from hri.features import CepstraComputer, CepstraOptions, FilterBankOptions, filter_bank, filter_edges, normalise_time

RATE_HZ = 16000


def audio(seconds: float = 0.5, seed: int = 0) -> np.ndarray:
    rng = np.random.default_rng(seed)
    count = int(seconds * RATE_HZ)
    return (0.1 * rng.normal(size=count) * np.linspace(0.2, 1, count)).astype("f4")


def reference(x: np.ndarray, bank: np.ndarray, options: CepstraOptions) -> np.ndarray:
    """Static cepstra in double, one line a step."""
    x = x.astype("f8")
    emphasised = x - options.pre_emphasis * np.concatenate([x[:1], x[:-1]])
    starts = np.arange(0, len(x) - 400 + 1, 160)
    frames = emphasised[starts[:, None] + np.arange(400)] * np.hamming(400)
    power = np.abs(np.fft.rfft(frames, 512)) ** 2
    cepstra = dct(np.log(np.maximum(power @ bank.T, 1e-10)), norm="ortho")[:, : options.num_cepstra + 1]
    if options.lifter:
        cepstra *= 1 + options.lifter / 2 * np.sin(np.pi * np.arange(cepstra.shape[1]) / options.lifter)
    return cepstra


def test_mel_bank_equals_librosas() -> None:
    options = FilterBankOptions(num_filters=40, low_hz=20.0, high_hz=7600.0)
    ours = filter_bank(options, RATE_HZ, 512)
    theirs = librosa.filters.mel(sr=RATE_HZ, n_fft=512, n_mels=40, fmin=20, fmax=7600, htk=True, norm=None)
    assert ours.shape == (40, 257) and ours.dtype == np.float32
    np.testing.assert_allclose(ours, theirs, atol=2e-6)


def test_hfcc_filters_are_as_wide_as_the_ear_asks() -> None:
    factor = 1.3
    options = FilterBankOptions(kind="hfcc", num_filters=29, low_hz=100.0, high_hz=8000.0, erb_factor=factor)
    low, centre, high = filter_edges(options, RATE_HZ).T
    mel = 2595 * np.log10(1 + centre / 700)
    np.testing.assert_allclose(np.diff(mel), np.diff(mel)[0], rtol=1e-9)  # centres are even in mel
    erb = factor * (6.23e-6 * centre**2 + 93.39e-3 * centre + 28.52)
    np.testing.assert_allclose(high - low, 2 * erb, rtol=1e-9)  # width follows the ERB, not the spacing
    np.testing.assert_allclose((700 + centre) ** 2, (700 + low) * (700 + high), rtol=1e-9)  # symmetric in mel
    assert low[0] == pytest.approx(100, rel=1e-9) and high[-1] == pytest.approx(8000, rel=1e-9)


@pytest.mark.parametrize("kind", ["mel", "hfcc"])
@pytest.mark.parametrize("lifter", [0.0, 22.0])
def test_cepstra_equal_the_formulae(kind: str, lifter: float) -> None:
    options = CepstraOptions(filter_bank=kind, normalisation="none", delta_orders=0, lifter=lifter)
    ours = CepstraComputer(options).compute(audio())
    bank = filter_bank(FilterBankOptions(kind=kind), RATE_HZ, 512)
    theirs = reference(audio(), bank, options)
    assert ours.shape == theirs.shape == (48, 13) and ours.dtype == np.float32
    # Single precision all the way, then a logarithm: 1e-3 absolute on values of up to 60.
    np.testing.assert_allclose(ours, theirs, atol=1e-3)


def test_deltas_are_regressions_over_five_frames() -> None:
    plain = CepstraComputer(CepstraOptions(delta_orders=0)).compute(audio())
    ours = CepstraComputer(CepstraOptions(delta_orders=2)).compute(audio())
    assert ours.shape == (48, 39)
    np.testing.assert_array_equal(ours[:, :13], plain)
    for column in (0, 13):
        padded = np.pad(ours[:, column : column + 13].astype("f8"), ((2, 2), (0, 0)), mode="edge")
        slope = (2 * (padded[4:] - padded[:-4]) + padded[3:-1] - padded[1:-3]) / 10
        np.testing.assert_allclose(ours[:, column + 13 : column + 26], slope, atol=1e-4)


def test_normalisation_does_what_it_says() -> None:
    def static(kind: str, gain: float = 1.0) -> np.ndarray:
        options = CepstraOptions(normalisation=kind, delta_orders=0)
        return CepstraComputer(options).compute(gain * audio())

    np.testing.assert_allclose(static("mean").mean(axis=0), 0, atol=1e-4)
    np.testing.assert_allclose(static("mean_variance").std(axis=0), 1, atol=1e-3)
    np.testing.assert_allclose(static("level").mean(axis=0)[0], 0, atol=1e-4)
    np.testing.assert_array_equal(static("level")[:, 1:], static("none")[:, 1:])
    for kind in ("level", "mean", "mean_variance"):  # loudness does not matter
        np.testing.assert_allclose(static(kind, 0.1), static(kind), atol=2e-3)


@pytest.mark.parametrize("x", [np.zeros(4000), np.full(4000, 0.5), np.eye(1, 4000, 2000)[0], np.full(4000, 1e18)])
def test_strange_audio_gives_finite_features(x: np.ndarray) -> None:
    for kind in ("none", "mean", "mean_variance"):
        features = CepstraComputer(CepstraOptions(normalisation=kind)).compute(x.astype("f4"))
        assert np.isfinite(features).all()


def test_input_is_taken_in_any_layout_and_refused_with_its_place() -> None:
    computer = CepstraComputer()
    x = audio()
    expected = computer.compute(x)
    np.testing.assert_array_equal(computer.compute(np.repeat(x, 2)[::2]), expected)
    np.testing.assert_array_equal(computer.compute(x.astype("f8")), expected)
    broken = x.copy()
    broken[123] = np.inf
    with pytest.raises(InvalidArgument, match="sample 123"):
        computer.compute(broken)
    with pytest.raises(InvalidArgument, match="too short"):
        computer.compute(x[:399])
    with pytest.raises(InvalidArgument):
        computer.compute(x.reshape(2, -1))
    assert computer.num_frames(400) == 1 and computer.num_frames(399) == 0


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ({"num_cepstra": 26}, "num_cepstra"),
        ({"frame_length_ms": 0}, "frame_length_ms"),
        ({"low_hz": 9000.0}, "low_hz"),
        ({"pre_emphasis": 2.0}, "pre_emphasis"),
        ({"sample_rate_hz": 1}, "sample_rate_hz"),
        ({"delta_orders": 3}, "delta_orders"),
    ],
)
def test_impossible_options_are_named(fields: dict, message: str) -> None:
    with pytest.raises(InvalidArgument, match=message):
        CepstraComputer(CepstraOptions(**fields))
    with pytest.raises(TypeError, match="no_such_field"):
        CepstraOptions(no_such_field=1)


@pytest.mark.parametrize("num_rows", [1, 2, 7, 40])
def test_time_normalisation_is_linear_interpolation(num_rows: int) -> None:
    from scipy.interpolate import interp1d

    frames = np.random.default_rng(3).normal(size=(11, 3)).astype("f4")
    places = np.array([5.0]) if num_rows == 1 else np.linspace(0, 10, num_rows)
    expected = interp1d(np.arange(11), frames.astype("f8"), axis=0)(places)
    np.testing.assert_allclose(normalise_time(frames, num_rows), expected, atol=1e-6)
    with pytest.raises(InvalidArgument, match="num_rows must be at least 1"):
        normalise_time(frames, 0)
