# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Wavelet transforms against PyWavelets."""

from __future__ import annotations

import numpy as np
import pytest
import pywt

from hri import InvalidArgument
from hri import signal as wavelets

BORDERS = list(wavelets.MODES)
WAVELETS = wavelets.wavelist()
LENGTHS = [1, 2, 3, 7, 16, 61, 64]
TOLERANCES = [("f8", 1e-10), ("f4", 1e-5)]


def signal(count: int, dtype: str = "f8", seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=count).astype(dtype)


def refused_by_pywavelets(border: str, *lengths: int) -> bool:
    """It has no mirror without the edge for one sample."""
    return border in ("reflect", "antireflect") and 1 in lengths


def test_names_are_those_of_pywavelets() -> None:
    assert sorted(WAVELETS) == sorted(pywt.wavelist(kind="discrete"))
    assert sorted(BORDERS) == sorted(pywt.Modes.modes)


@pytest.mark.parametrize("wavelet", WAVELETS)
def test_filters_are_those_of_pywavelets(wavelet: str) -> None:
    """Seen as responses: one sample in much silence, one coefficient among zeros."""
    theirs = pywt.Wavelet(wavelet)
    impulse = np.zeros(256)
    impulse[128] = 1.0
    for ours, expected in zip(wavelets.dwt(impulse, wavelet, "zero"), pywt.dwt(impulse, wavelet, "zero"), strict=True):
        np.testing.assert_array_equal(ours, expected)
    zeros, one = np.zeros(theirs.dec_len), np.zeros(theirs.dec_len)
    one[theirs.dec_len // 2 - 1] = 1.0
    for pair in ((one, zeros), (zeros, one)):
        np.testing.assert_array_equal(wavelets.idwt(*pair, wavelet), pywt.idwt(*pair, wavelet, "symmetric"))


@pytest.mark.parametrize("border", BORDERS)
@pytest.mark.parametrize(("dtype", "tolerance"), TOLERANCES)
def test_dwt_and_its_inverse_equal_pywavelets(border: str, dtype: str, tolerance: float) -> None:
    for wavelet in WAVELETS:
        for count in LENGTHS:
            if refused_by_pywavelets(border, count):
                continue
            x = signal(count, dtype)
            ours = wavelets.dwt(x, wavelet, border)
            expected = pywt.dwt(x.astype("f8"), wavelet, border)
            # Filters as long as this, over borders that climb, bring forth large numbers.
            scale = max(1.0, *(float(np.abs(band).max()) for band in expected))
            for band, theirs in zip(ours, expected, strict=True):
                assert band.dtype == x.dtype
                np.testing.assert_allclose(band, theirs, rtol=0, atol=scale * tolerance, err_msg=f"{wavelet} {count}")
            back = wavelets.idwt(*ours, wavelet, border)
            theirs = pywt.idwt(*(band.astype("f8") for band in ours), wavelet, border)
            np.testing.assert_allclose(back, theirs, rtol=0, atol=scale * tolerance, err_msg=f"{wavelet} {count}")


@pytest.mark.parametrize("border", BORDERS)
@pytest.mark.parametrize(("dtype", "tolerance"), TOLERANCES)
def test_several_levels_come_back(border: str, dtype: str, tolerance: float) -> None:
    for wavelet in ("haar", "db4", "sym8", "coif3", "bior4.4", "rbio2.2"):
        for count in (64, 101, 1000, 2203):
            x = signal(count, dtype)
            levels = min(3, pywt.dwt_max_level(count, pywt.Wavelet(wavelet).dec_len)) or 1
            coefficients = wavelets.wavedec(x, wavelet, border, levels)
            expected = pywt.wavedec(x, wavelet, border, levels)
            scale = max(1.0, *(float(np.abs(band).max()) / 4 for band in expected))
            for ours, theirs in zip(coefficients, expected, strict=True):
                assert ours.dtype == x.dtype
                np.testing.assert_allclose(ours, theirs, rtol=0, atol=scale * tolerance)
            np.testing.assert_allclose(
                wavelets.waverec(coefficients, wavelet, border, num_samples=count), x, rtol=0, atol=tolerance
            )
            assert len(wavelets.waverec(coefficients, wavelet, border)) in (count, count + 1)


@pytest.mark.parametrize("border", BORDERS)
@pytest.mark.parametrize(("dtype", "tolerance"), TOLERANCES)
def test_dwt2_and_its_inverse_equal_pywavelets(border: str, dtype: str, tolerance: float) -> None:
    for wavelet in WAVELETS:
        for shape in ((2, 3), (1, 9), (8, 8), (33, 17)):
            if refused_by_pywavelets(border, *shape):
                continue
            image = signal(shape[0] * shape[1], dtype).reshape(shape)
            approx, details = wavelets.dwt2(image, wavelet, border)
            expected_approx, expected = pywt.dwt2(image.astype("f8"), wavelet, border)
            scale = max(1.0, *(float(np.abs(band).max()) for band in (expected_approx, *expected)))
            for ours, theirs in zip((approx, *details), (expected_approx, *expected), strict=True):
                assert ours.dtype == image.dtype
                np.testing.assert_allclose(ours, theirs, rtol=0, atol=scale * tolerance, err_msg=f"{wavelet} {shape}")
            back = wavelets.idwt2((approx, details), wavelet, border, shape=shape)
            bands = approx.astype("f8"), tuple(band.astype("f8") for band in details)
            theirs = pywt.idwt2(bands, wavelet, border)[: shape[0], : shape[1]]
            np.testing.assert_allclose(back, theirs, rtol=0, atol=2 * scale * tolerance, err_msg=f"{wavelet} {shape}")


@pytest.mark.parametrize("border", BORDERS)
def test_several_levels_of_a_picture_equal_pywavelets(border: str) -> None:
    for wavelet, shape in (("db2", (61, 50)), ("bior2.2", (64, 33)), ("sym5", (40, 40))):
        image = signal(shape[0] * shape[1]).reshape(shape)
        coefficients = wavelets.wavedec2(image, wavelet, border, 3)
        expected = pywt.wavedec2(image, wavelet, border, 3)
        np.testing.assert_allclose(coefficients[0], expected[0], rtol=0, atol=1e-10)
        for level, theirs in zip(coefficients[1:], expected[1:], strict=True):
            for band, their in zip(level, theirs, strict=True):
                np.testing.assert_allclose(band, their, rtol=0, atol=1e-10)
        back = wavelets.waverec2(coefficients, wavelet, border, shape=shape)
        np.testing.assert_allclose(back, image, rtol=0, atol=1e-10)
        theirs = pywt.waverec2(expected, wavelet, border)
        np.testing.assert_allclose(wavelets.waverec2(coefficients, wavelet, border), theirs, rtol=0, atol=1e-10)
        ours = wavelets.wavedec2(image, wavelet, border)
        assert len(ours) == len(pywt.wavedec2(image, wavelet, border))
    with pytest.raises(InvalidArgument):
        wavelets.waverec2([coefficients[0], *coefficients[:0:-1]], "sym5", border, shape=(40, 40))
    with pytest.raises(InvalidArgument, match="no coefficients"):
        wavelets.waverec2([], "sym5", border)
    np.testing.assert_array_equal(wavelets.waverec2(wavelets.wavedec2(image, "sym5", level=0), "sym5"), image)
    with pytest.raises(InvalidArgument, match="level"):
        wavelets.wavedec2(image, "sym5", border, -1)


def test_levels_end_where_pywavelets_ends_them() -> None:
    for wavelet in WAVELETS:
        for count in (0, 1, 2, 3, 13, 14, 15, 16, 16000):
            expected = pywt.dwt_max_level(count, pywt.Wavelet(wavelet).dec_len) if count else 0
            assert wavelets.dwt_max_level(count, wavelet) == expected


def test_vertical_edges_stand_in_the_vertical_details() -> None:
    edge = np.zeros((32, 32))
    edge[:, 13:] = 1.0
    _, details = wavelets.dwt2(edge, "db3")
    assert np.argmax([float((band**2).sum()) for band in details]) == 1


def test_transform_takes_any_layout_and_real_type() -> None:
    x, image = signal(60), signal(60 * 40).reshape(60, 40)
    expected = pywt.dwt(x, "db2", "zero")
    for ours, theirs in zip(wavelets.dwt(np.repeat(x, 3)[::3], "db2", "zero"), expected, strict=True):
        np.testing.assert_allclose(ours, theirs, atol=1e-12)
    for strided in (image.T, image[::2], np.asfortranarray(image), image[:, ::-1]):
        approx, _ = wavelets.dwt2(strided, "db2", "zero")
        np.testing.assert_allclose(approx, pywt.dwt2(strided, "db2", "zero")[0], atol=1e-12)
    for same in (list(range(9)), np.arange(9), np.arange(9, dtype="u1"), np.arange(9, dtype="f2")):
        approx, _ = wavelets.dwt(same, "db2")
        assert approx.dtype == np.float64
        np.testing.assert_allclose(approx, pywt.dwt(np.arange(9.0), "db2")[0], atol=1e-12)


def test_transform_leaves_its_input_alone() -> None:
    x = signal(32)
    x.flags.writeable = False
    approx, detail = wavelets.dwt(x, "db2", "zero")
    assert approx.flags.owndata or approx.base is not x
    before = approx.copy()
    del x, detail
    np.testing.assert_array_equal(approx, before)


def test_transform_refuses_what_it_cannot_do() -> None:
    with pytest.raises(InvalidArgument, match="db99"):
        wavelets.dwt(signal(8), "db99")
    with pytest.raises(InvalidArgument, match=r"mirror.*symmetric"):
        wavelets.dwt(signal(8), "db2", "mirror")
    with pytest.raises(InvalidArgument):
        wavelets.dwt(signal(0), "db2")
    with pytest.raises(InvalidArgument):
        wavelets.dwt2(np.zeros((0, 5)), "db2")
    with pytest.raises(InvalidArgument, match="axis 2"):
        wavelets.dwt(signal(8).reshape(2, 4), "db2", axis=2)
    with pytest.raises(InvalidArgument, match="2 dimensions, got 1"):
        wavelets.dwt2(signal(8), "db2")
    for wrong in (signal(8).astype("c16"), np.array(["a"])):
        with pytest.raises(TypeError):
            wavelets.dwt(wrong, "db2")


def test_inverse_refuses_coefficients_that_do_not_belong_together() -> None:
    with pytest.raises(InvalidArgument):
        wavelets.idwt(signal(4), signal(5), "db2")
    with pytest.raises(InvalidArgument, match="too few"):
        wavelets.idwt(signal(1), signal(1), "db2")
    with pytest.raises(InvalidArgument, match="None"):
        wavelets.idwt(None, None, "db2")
    bands = wavelets.wavedec(signal(64), "db2", "zero", 3)
    for wrong in ([], bands[1:], bands[::-1], [*bands, bands[-1]]):
        with pytest.raises(InvalidArgument):
            wavelets.waverec(wrong, "db2", "zero", num_samples=64)
    assert len(wavelets.waverec(bands, "db2", "zero", num_samples=63)) == 63
    for level in (-1, 100):
        with pytest.raises(InvalidArgument, match="level"):
            wavelets.wavedec(signal(64), "db2", "zero", level)
    approx, details = wavelets.dwt2(signal(64).reshape(8, 8), "db2", "zero")
    for shape in ((9, 8), (8, 9), (6, 8), (-8, 8), (0, 0), (2**40, 2**40)):
        with pytest.raises(InvalidArgument):
            wavelets.idwt2((approx, details), "db2", "zero", shape=shape)
    with pytest.raises(InvalidArgument):
        wavelets.idwt2((approx, (details[0][:-1], *details[1:])), "db2", "zero", shape=(8, 8))
