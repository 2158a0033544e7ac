# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Noise reduction against its formulae written in numpy, with PyWavelets' transform and thresholds."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import pywt

from hri import denoise
from hri.cli.main import main
from hri.core.errors import InvalidArgument
from hri.io import write_wav_pcm16
from hri.media import read_audio
from hri.signal import noise_reduction as reduction

RULES, SHAPES, NOISES = list(reduction.RULES), list(reduction.SHAPES), list(reduction.NOISES)


def bumps(count: int = 4096, seed: int = 0, noise: float = 0.3) -> tuple[np.ndarray, np.ndarray]:
    """Two tones that come and go; clean, and with white noise."""
    t = np.arange(count) / count
    clean = np.sin(2 * np.pi * 9 * t) * (t > 0.3) + 0.7 * np.sin(2 * np.pi * 31 * t) * (t < 0.6)
    return clean, clean + noise * np.random.default_rng(seed).standard_normal(count)


def sure_threshold(details: np.ndarray, sigma: float) -> float:
    y = details / sigma
    n = len(y)
    if (y**2).mean() - 1 <= np.log2(n) ** 1.5 / np.sqrt(n):
        return sigma * np.sqrt(2 * np.log(n))
    candidates = [0.0, *(t for t in np.abs(y) if t <= np.sqrt(2 * np.log(n)))]
    risks = [n - 2 * (np.abs(y) <= t).sum() + (np.minimum(np.abs(y), t) ** 2).sum() for t in candidates]
    # At 0 nothing is below, but for details of 0.
    risks[0] = n
    return sigma * candidates[int(np.argmin(risks))]


def threshold_by_formula(details: np.ndarray, sigma: float, count: int, rule: str) -> float:
    if rule == "universal":
        return sigma * np.sqrt(2 * np.log(count))
    if rule == "sure":
        return sure_threshold(details, sigma)
    clean = (details**2).mean() - sigma**2
    return sigma**2 / np.sqrt(clean) if clean > 0 else np.inf


def quiet_levels(bands: list[np.ndarray]) -> list[float]:
    """Of the details, in the quietest two of twenty parts of all bands."""
    parts = [[band[len(band) * s // 20 : len(band) * (s + 1) // 20] for s in range(20)] for band in bands]
    energies = [sum(float((part[s] ** 2).sum()) for part in parts) for s in range(20)]
    first, second = sorted(range(20), key=energies.__getitem__)[:2]
    quiet = [np.concatenate([part[first], part[second]]) for part in parts[1:]]
    return [
        float(np.sqrt((values**2).mean())) if len(values) else float(np.median(np.abs(band)) / 0.6745)
        for values, band in zip(quiet, bands[1:], strict=True)
    ]


def by_formula(x: np.ndarray, wavelet: str, levels: int, rule: str, shape: str, noise: str) -> np.ndarray:
    bands = pywt.wavedec(x, wavelet, "symmetric", levels)
    sigmas = [np.median(np.abs(d)) / 0.6745 for d in bands[1:]]
    if noise == "finest":
        sigmas = [sigmas[-1]] * levels
    elif noise == "quietest":
        sigmas = quiet_levels(bands)
    kept = [bands[0]]
    for details, sigma in zip(bands[1:], sigmas, strict=True):
        t = threshold_by_formula(details, sigma, len(x), rule)
        kept.append(pywt.threshold(details, t, shape) if np.isfinite(t) else np.zeros_like(details))
    return pywt.waverec(kept, wavelet, "symmetric")[: len(x)]


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("noise", NOISES)
def test_denoising_is_its_formula(rule: str, shape: str, noise: str) -> None:
    for count, wavelet, levels in ((4096, "sym8", 5), (1001, "db4", 3), (37, "haar", 2), (300, "bior4.4", 4)):
        _, x = bumps(count, seed=count)
        expected = by_formula(x, wavelet, levels, rule, shape, noise)
        ours = denoise(x, wavelet, level=levels, threshold=rule, shape=shape, noise=noise)
        np.testing.assert_allclose(ours, expected, rtol=0, atol=1e-9)
        single = denoise(x.astype("f4"), wavelet, level=levels, threshold=rule, shape="soft", noise=noise)
        assert single.dtype == np.float32 and single.shape == x.shape
        np.testing.assert_allclose(single, by_formula(x, wavelet, levels, rule, "soft", noise), rtol=0, atol=1e-4)


@pytest.mark.parametrize("rule", RULES)
def test_thresholds_are_their_formulae(rule: str) -> None:
    rng = np.random.default_rng(1)
    noise = rng.standard_normal(500)
    for details in (noise, noise + 5 * (rng.random(500) < 0.3), 3 * rng.standard_normal(64), rng.standard_normal(1)):
        for sigma in (0.5, 1.0, 2.0):
            expected = threshold_by_formula(details, sigma, 900, rule)
            assert reduction.shrinkage_threshold(details, sigma, 900, rule) == pytest.approx(expected, rel=1e-12)


def test_shapes_are_those_of_pywavelets() -> None:
    x = np.concatenate([np.random.default_rng(2).standard_normal(200), [0.0, 1.0, -1.0, 0.5, -0.5]])
    for shape in SHAPES:
        for t in (0.0, 0.5, 1.0, 10.0):
            values = x if t else x[x != 0.0]  # where PyWavelets would divide 0 by 0
            np.testing.assert_allclose(reduction.shrink(values, t, shape), pywt.threshold(values, t, shape), atol=1e-15)
    assert reduction.shrink(x, np.inf, "soft").tolist() == [0.0] * len(x)
    assert reduction.noise_level([3.0, -1.0, 2.0]) == pytest.approx(2.0 / 0.6745)
    assert reduction.noise_level([3.0, -1.0, 2.0, -4.0]) == pytest.approx(2.5 / 0.6745)


@pytest.mark.parametrize("rule", RULES)
def test_white_noise_goes_and_the_signal_stays(rule: str) -> None:
    clean, noisy = bumps()
    left = denoise(noisy, threshold=rule) - clean
    before = noisy - clean
    gain = 10 * np.log10((before**2).sum() / (left**2).sum())
    assert gain > 8.0
    untouched = denoise(noisy, threshold=rule, strength=0.0)
    np.testing.assert_allclose(untouched, noisy, atol=1e-9)


def test_coloured_noise_goes_where_the_signal_pauses() -> None:
    """Noise that is loudest in the coarse levels: the finest level's says nothing of it."""
    rng = np.random.default_rng(3)
    t = np.arange(8192) / 8192
    clean = 3 * np.sin(2 * np.pi * 700 * t) * (np.abs(t - 0.5) < 0.2)
    noise = np.convolve(rng.standard_normal(8192), np.ones(6) / 6, "same")
    gains = {}
    for estimate in NOISES:
        left = denoise(clean + noise, noise=estimate) - clean
        gains[estimate] = 10 * np.log10((noise**2).sum() / (left**2).sum())
    assert gains["quietest"] > 2.0
    assert gains["quietest"] > gains["finest"] + 1.0


def test_silence_and_short_signals_stay() -> None:
    for rule in RULES:
        assert denoise(np.zeros(100), threshold=rule).tolist() == [0.0] * 100
        for count in (1, 2, 5):
            assert denoise(np.ones(count), "haar", threshold=rule).tolist() == pytest.approx([1.0] * count)


def test_approximation_is_the_low_half_as_loud() -> None:
    tone = np.sin(2 * np.pi * 100 * np.arange(8000) / 16000)
    for level in (1, 2, 3):
        found = reduction.approximation(tone, "sym8", "periodization", level)
        assert len(found) == 8000 // 2**level
        assert np.sqrt((found[50:-50] ** 2).mean()) == pytest.approx(np.sqrt(0.5), rel=0.01)
        expected = pywt.wavedec(tone, "sym8", "periodization", level)[0] / 2 ** (level / 2)
        np.testing.assert_allclose(found, expected, atol=1e-10)


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        ({"wavelet": "db99"}, "db99"),
        ({"mode": "mirror"}, "mode"),
        ({"threshold": "best"}, "threshold"),
        ({"shape": "firm"}, "shape"),
        ({"noise": "pink"}, "noise"),
        ({"level": -1}, "num_levels"),
        ({"level": 63}, "num_levels"),
        ({"strength": -1.0}, "strength"),
        ({"strength": np.nan}, "strength"),
    ],
)
def test_arguments_out_of_range_are_named(arguments: dict[str, object], named: str) -> None:
    with pytest.raises(InvalidArgument, match=named):
        denoise(np.ones(64), **arguments)  # type: ignore[arg-type]


def test_signals_that_are_none_are_refused() -> None:
    for wrong in (np.ones(0), np.array([1.0, np.nan]), np.array([1.0, np.inf])):
        with pytest.raises(InvalidArgument, match="signal"):
            denoise(wrong)
    with pytest.raises(InvalidArgument, match="threshold"):
        reduction.shrink(np.ones(3), -1.0)
    with pytest.raises(InvalidArgument, match="details"):
        reduction.noise_level(np.ones(0))


def test_command_cleans_a_recording(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    clean, noisy = bumps(noise=0.2)
    source, target = tmp_path / "noisy.wav", tmp_path / "clean.wav"
    write_wav_pcm16(str(source), (noisy / 4).astype("f4"), 16000)
    assert main(["denoise", str(source), str(target), "--wavelet", "db6", "--threshold", "sure", "--levels", "6"]) == 0
    assert str(target) in capsys.readouterr().out
    heard, found = read_audio(source).samples, read_audio(target)
    expected = denoise(heard, "db6", level=6, threshold="sure")
    assert found.sample_rate_hz == 16000
    np.testing.assert_allclose(found.samples, expected, atol=2**-15)
    assert ((4 * found.samples - clean) ** 2).sum() < 0.3 * ((noisy - clean) ** 2).sum()
    assert main(["denoise", str(source), str(target), "--approximation", "2"]) == 0
    lower = read_audio(target)
    assert lower.sample_rate_hz == 4000 and len(lower.samples) == len(noisy) // 4


def test_command_refuses_what_it_cannot_do(tmp_path: Path) -> None:
    source = tmp_path / "x.wav"
    write_wav_pcm16(str(source), np.ones(1000, "f4") / 2, 11025)
    assert main(["denoise", str(source), str(tmp_path / "y.mp3")]) == 2
    assert main(["denoise", str(source), str(tmp_path / "y.wav"), "--threshold", "best"]) == 2
    assert main(["denoise", str(source), str(tmp_path / "y.wav"), "--wavelet", "db99"]) == 3
    assert main(["denoise", str(source), str(tmp_path / "y.wav"), "--approximation", "1"]) == 3  # 5512.5 Hz
    assert not (tmp_path / "y.wav").exists()
