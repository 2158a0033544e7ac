# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Wavelets against PyWavelets, resampling against SciPy, end points."""

from __future__ import annotations

import numpy as np
import pytest
import pywt
from scipy.signal import resample_poly

from hri import _native
from hri.errors import InvalidArgument

BORDERS = list(_native.Border.__members__)
WAVELETS = _native.wavelet_names()
LENGTHS = [1, 2, 3, 7, 16, 61, 64]


def signal(count: int, dtype: str = "f8", seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=count).astype(dtype)


@pytest.mark.parametrize("border", BORDERS)
@pytest.mark.parametrize("wavelet", WAVELETS)
def test_dwt_and_its_inverse_equal_pywavelets(wavelet: str, border: str) -> None:
    for count in LENGTHS:
        if border == "reflect" and count == 1:
            continue  # PyWavelets has no mirror without the edge for one sample
        x = signal(count)
        approx, detail = _native.dwt(x, wavelet, _native.Border.__members__[border])
        expected = pywt.dwt(x, wavelet, border)
        np.testing.assert_allclose(approx, expected[0], rtol=0, atol=1e-9)
        np.testing.assert_allclose(detail, expected[1], rtol=0, atol=1e-9)
        back = _native.idwt(approx, detail, wavelet, _native.Border.__members__[border])
        np.testing.assert_allclose(back, pywt.idwt(*expected, wavelet, border), rtol=0, atol=1e-9)


@pytest.mark.parametrize("border", BORDERS)
@pytest.mark.parametrize(("dtype", "tolerance"), [("f8", 1e-10), ("f4", 1e-5)])
def test_several_levels_come_back(border: str, dtype: str, tolerance: float) -> None:
    for wavelet in ("haar", "db4", "sym8", "coif3"):
        for count in (64, 101, 1000):
            x = signal(count, dtype)
            place = _native.Border.__members__[border]
            levels = min(3, pywt.dwt_max_level(count, pywt.Wavelet(wavelet).dec_len)) or 1
            coefficients = _native.wavedec(x, wavelet, place, levels)
            for ours, theirs in zip(coefficients, pywt.wavedec(x, wavelet, border, levels), strict=True):
                assert ours.dtype == x.dtype
                np.testing.assert_allclose(ours, theirs, rtol=0, atol=tolerance)
            back = _native.waverec(coefficients, wavelet, place, count)
            np.testing.assert_allclose(back, x, rtol=0, atol=tolerance)


@pytest.mark.parametrize("border", BORDERS)
@pytest.mark.parametrize("wavelet", WAVELETS)
def test_dwt2_and_its_inverse_equal_pywavelets(wavelet: str, border: str) -> None:
    place = _native.Border.__members__[border]
    for shape in ((2, 3), (8, 8), (33, 17)):
        image = signal(shape[0] * shape[1]).reshape(shape)
        approx, details = _native.dwt2(image, wavelet, place)
        expected_approx, expected = pywt.dwt2(image, wavelet, border)
        np.testing.assert_allclose(approx, expected_approx, rtol=0, atol=1e-9)
        for ours, theirs in zip(details, expected, strict=True):
            np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-9)
        back = _native.idwt2(approx, *details, wavelet, place, shape)
        theirs = pywt.idwt2((expected_approx, expected), wavelet, border)[: shape[0], : shape[1]]
        np.testing.assert_allclose(back, theirs, rtol=0, atol=1e-9)


@pytest.mark.parametrize("wavelet", WAVELETS)
def test_bands_equal_pywavelets(wavelet: str) -> None:
    """Neither our names nor our signs of the bands are our own."""
    edge = np.zeros((32, 32))
    edge[:, 13:] = 1.0
    _, ours = _native.dwt2(edge, wavelet, _native.Border.symmetric)
    _, theirs = pywt.dwt2(edge, wavelet, "symmetric")
    energies = [float((band**2).sum()) for band in ours]
    np.testing.assert_allclose(energies, [(band**2).sum() for band in theirs], atol=1e-9)
    assert np.argmax(energies) == 1  # an upright edge stands in the vertical details


def test_single_precision_stays_single_and_close() -> None:
    for wavelet in ("haar", "db4", "sym20", "dmey"):
        x = signal(101, "f4")
        bands = _native.dwt(x, wavelet, _native.Border.symmetric)
        image = signal(35 * 24, "f4").reshape(35, 24)
        approx, details = _native.dwt2(image, wavelet, _native.Border.symmetric)
        expected_approx, expected = pywt.dwt2(image.astype("f8"), wavelet, "symmetric")
        peers = (*pywt.dwt(x.astype("f8"), wavelet, "symmetric"), expected_approx, *expected)
        for ours, theirs in zip((*bands, approx, *details), peers, strict=True):
            assert ours.dtype == np.float32
            np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-5)


def test_transform_takes_any_layout() -> None:
    zero = _native.Border.zero
    x, image = signal(60), signal(60 * 40).reshape(60, 40)
    for ours, expected in zip(_native.dwt(np.repeat(x, 3)[::3], "db2", zero), pywt.dwt(x, "db2", "zero"), strict=True):
        np.testing.assert_allclose(ours, expected, atol=1e-12)
    for strided in (image.T, image[::2], np.asfortranarray(image), image[:, ::-1]):
        approx, _ = _native.dwt2(strided, "db2", zero)
        np.testing.assert_allclose(approx, pywt.dwt2(strided, "db2", "zero")[0], atol=1e-12)


def test_transform_leaves_its_input_alone() -> None:
    x = signal(32)
    x.flags.writeable = False
    approx, detail = _native.dwt(x, "db2", _native.Border.zero)
    assert approx.flags.owndata or approx.base is not x
    before = approx.copy()
    del x, detail
    np.testing.assert_array_equal(approx, before)


def test_transform_refuses_what_it_cannot_do() -> None:
    zero = _native.Border.zero
    with pytest.raises(InvalidArgument, match="db99"):
        _native.dwt(signal(8), "db99", zero)
    with pytest.raises(InvalidArgument):
        _native.dwt(signal(0), "db2", zero)
    with pytest.raises(InvalidArgument):
        _native.dwt2(np.zeros((0, 5)), "db2", zero)
    with pytest.raises(InvalidArgument, match="1 dimensions, got 2"):
        _native.dwt(signal(8).reshape(2, 4), "db2", zero)
    with pytest.raises(InvalidArgument, match="2 dimensions, got 1"):
        _native.dwt2(signal(8), "db2", zero)
    for wrong in (np.arange(8), signal(8).astype("c16"), signal(8).astype("f2"), np.array(["a"])):
        with pytest.raises(TypeError):
            _native.dwt(wrong, "db2", zero)
    with pytest.raises(TypeError):
        _native.dwt(signal(8), "db2", "zero")


def test_inverse_refuses_coefficients_that_do_not_belong_together() -> None:
    zero = _native.Border.zero
    with pytest.raises(InvalidArgument):
        _native.idwt(signal(4), signal(5), "db2", zero)
    with pytest.raises(InvalidArgument, match="too few"):
        _native.idwt(signal(1), signal(1), "db2", zero)
    with pytest.raises(TypeError):
        _native.idwt(signal(4), signal(4, "f4"), "db2", zero)
    bands = _native.wavedec(signal(64), "db2", zero, 3)
    for wrong in ([], bands[:1], bands[1:], bands[::-1], [*bands, bands[-1]]):
        with pytest.raises(InvalidArgument):
            _native.waverec(wrong, "db2", zero, 64)
    assert len(_native.waverec(bands, "db2", zero, 63)) == 63
    for num_levels in (-1, 0, 100):
        with pytest.raises(InvalidArgument, match="level"):
            _native.wavedec(signal(64), "db2", zero, num_levels)
    approx, details = _native.dwt2(signal(64).reshape(8, 8), "db2", zero)
    for shape in ((9, 8), (8, 9), (6, 8), (-8, 8), (0, 0), (2**40, 2**40)):
        with pytest.raises(InvalidArgument):
            _native.idwt2(approx, *details, "db2", zero, shape)
    with pytest.raises(InvalidArgument):
        _native.idwt2(approx, details[0][:-1], *details[1:], "db2", zero, (8, 8))


@pytest.mark.parametrize(("source", "target"), [(44100, 16000), (8000, 16000), (16000, 8000), (48000, 44100)])
def test_resampling_keeps_tones_and_equals_scipy_inside(source: int, target: int) -> None:
    time_s = np.arange(source) / source
    tone = (0.5 * np.sin(2 * np.pi * 1000 * time_s)).astype("f4")
    ours = _native.resample(tone, source, target)
    assert len(ours) == target
    inner = slice(target // 20, -target // 20)
    exact = 0.5 * np.sin(2 * np.pi * 1000 * np.arange(target) / target)
    np.testing.assert_allclose(ours[inner], exact[inner], atol=2e-3)
    common = np.gcd(source, target)
    peer = resample_poly(tone.astype("f8"), target // common, source // common, window=("kaiser", 8.0))
    np.testing.assert_allclose(ours[inner], peer[inner], atol=5e-3)


def test_resampling_removes_what_the_lower_rate_cannot_hold() -> None:
    tone = np.sin(2 * np.pi * 6000 * np.arange(16000) / 16000).astype("f4")
    assert np.abs(_native.resample(tone, 16000, 8000)[200:-200]).max() < 1e-3


def test_resampling_to_the_same_rate_changes_nothing() -> None:
    x = signal(100, "f4")
    np.testing.assert_array_equal(_native.resample(x, 8000, 8000), x)
    assert len(_native.resample(x[:0], 8000, 16000)) == 0
    with pytest.raises(InvalidArgument, match=r"1000\.\.384000"):
        _native.resample(x, 10, 8000)


def burst(level: float, noise: float) -> np.ndarray:
    """0.3 s of a tone, from 0.5 s on, in 1.3 s of noise at 16 kHz."""
    x = noise * np.random.default_rng(0).normal(size=20800)
    x[8000:12800] += level * np.sin(2 * np.pi * 440 * np.arange(4800) / 16000)
    return x.astype("f4")


@pytest.mark.parametrize("level", [0.5, 0.05, 0.02])
@pytest.mark.parametrize("ratio", [300.0, 10.0, 6.0])
def test_word_is_found_whatever_its_level(level: float, ratio: float) -> None:
    first, last = _native.find_speech(burst(level, level / ratio), 16000)
    assert first == pytest.approx(8000, abs=1200)
    assert last == pytest.approx(12800, abs=1200)


def test_silence_and_steady_noise_hold_no_word() -> None:
    assert _native.find_speech(np.zeros(16000, "f4"), 16000) is None
    assert _native.find_speech(np.full(16000, 0.3, "f4"), 16000) is None
    assert _native.find_speech(signal(16000, "f4") * 0.1, 16000) is None
    with pytest.raises(InvalidArgument, match="sample 7"):
        _native.find_speech(np.where(np.arange(16000) == 7, np.nan, 0).astype("f4"), 16000)
    with pytest.raises(InvalidArgument, match="too short"):
        _native.find_speech(np.zeros(10, "f4"), 16000)
