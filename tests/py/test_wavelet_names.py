# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""PyWavelets' arguments: axes, default levels, wavelets as objects, the stationary transform."""

from __future__ import annotations

import numpy as np
import pytest
import pywt

from hri import InvalidArgument
from hri import signal as wavelets

STACK = np.random.default_rng(0).normal(size=(3, 48, 5))


@pytest.mark.parametrize("axis", [0, 1, 2, -1, -2])
@pytest.mark.parametrize("mode", ["symmetric", "periodization"])
def test_lines_along_an_axis_are_those_of_pywavelets(axis: int, mode: str) -> None:
    ours, theirs = wavelets.dwt(STACK, "db2", mode, axis), pywt.dwt(STACK, "db2", mode, axis)
    for band, expected in zip(ours, theirs, strict=True):
        np.testing.assert_allclose(band, expected, rtol=0, atol=1e-10)
    back = pywt.idwt(*theirs, "db2", mode, axis)
    np.testing.assert_allclose(wavelets.idwt(*ours, "db2", mode, axis), back, rtol=0, atol=1e-10)
    bands, expected = wavelets.wavedec(STACK, "haar", mode, 1, axis), pywt.wavedec(STACK, "haar", mode, 1, axis)
    for band, their in zip(bands, expected, strict=True):
        np.testing.assert_allclose(band, their, rtol=0, atol=1e-10)
    back = pywt.waverec(expected, "haar", mode, axis)
    np.testing.assert_allclose(wavelets.waverec(bands, "haar", mode, axis), back, rtol=0, atol=1e-10)


def test_without_a_level_there_are_as_many_as_pywavelets_takes() -> None:
    for count in (1, 5, 16, 100, 4096):
        x = np.random.default_rng(count).normal(size=count)
        for name in ("haar", "db4", "sym8"):
            ours, theirs = wavelets.wavedec(x, name), pywt.wavedec(x, name)
            assert len(ours) == len(theirs)
            np.testing.assert_allclose(np.concatenate(ours), np.concatenate(theirs), rtol=0, atol=1e-10)
            np.testing.assert_allclose(wavelets.waverec(ours, name)[:count], x, rtol=0, atol=1e-10)


def test_none_stands_for_coefficients_of_zero() -> None:
    approximation, detail = wavelets.dwt(STACK[0, :, 0], "db3")
    for pair in ((approximation, None), (None, detail)):
        np.testing.assert_allclose(wavelets.idwt(*pair, "db3"), pywt.idwt(*pair, "db3"), rtol=0, atol=1e-12)


def test_wavelets_have_pywavelets_filters() -> None:
    for name in wavelets.wavelist():
        ours, theirs = wavelets.Wavelet(name), pywt.Wavelet(name)
        np.testing.assert_allclose(ours.filter_bank, theirs.filter_bank, rtol=0, atol=1e-12)
        assert (ours.dec_len, ours.rec_len, str(ours)) == (theirs.dec_len, theirs.rec_len, name)
        assert ours.orthogonal == (theirs.orthogonal or name == "dmey")
    assert wavelets.wavelist("bior") == pywt.wavelist("bior")
    x = STACK[0, :, 0]
    np.testing.assert_array_equal(wavelets.dwt(x, wavelets.Wavelet("db2")), wavelets.dwt(x, "db2"))
    assert wavelets.dwt_max_level(1000, 8) == pywt.dwt_max_level(1000, 8)
    with pytest.raises(InvalidArgument, match="db99"):
        wavelets.Wavelet("db99")
    with pytest.raises(InvalidArgument, match=r"gaus.*haar"):
        wavelets.wavelist("gaus")


@pytest.mark.parametrize("name", ["haar", "db2", "db20", "sym5", "coif2", "bior2.2", "rbio3.1"])
@pytest.mark.parametrize(("dtype", "tolerance"), [("f8", 1e-10), ("f4", 1e-4)])
def test_stationary_transform_is_that_of_pywavelets(name: str, dtype: str, tolerance: float) -> None:
    for count, level in ((8, 3), (16, 1), (96, 5), (1024, 4)):
        x = np.random.default_rng(count).normal(size=count)
        ours = wavelets.swt(x.astype(dtype), name, level)
        theirs = pywt.swt(x, name, level)
        scale = max(1.0, float(np.abs(theirs).max()))
        for (a, d), (expected_a, expected_d) in zip(ours, theirs, strict=True):
            assert a.dtype == d.dtype == np.dtype(dtype)
            np.testing.assert_allclose(a, expected_a, rtol=0, atol=scale * tolerance)
            np.testing.assert_allclose(d, expected_d, rtol=0, atol=scale * tolerance)
        np.testing.assert_allclose(wavelets.iswt(ours, name), x, rtol=0, atol=scale * tolerance)
        trimmed = wavelets.swt(x.astype(dtype), name, level, trim_approx=True)
        np.testing.assert_array_equal(trimmed[1:], [d for _, d in ours])
        np.testing.assert_array_equal(wavelets.iswt(trimmed, name), wavelets.iswt(ours, name))


def test_stationary_transform_of_coefficients_that_no_signal_has() -> None:
    rng = np.random.default_rng(1)
    coefficients = [(rng.normal(size=32), rng.normal(size=32)) for _ in range(3)]
    ours = wavelets.iswt(coefficients, "db3")
    np.testing.assert_allclose(ours, pywt.iswt(coefficients, "db3"), rtol=0, atol=1e-10)


def test_stationary_transform_moves_with_the_signal_and_takes_axes() -> None:
    x = STACK[0, :, 0]
    for (a, d), (moved_a, moved_d) in zip(wavelets.swt(x, "db3"), wavelets.swt(np.roll(x, 5), "db3"), strict=True):
        np.testing.assert_allclose(np.roll(a, 5), moved_a, rtol=0, atol=1e-12)
        np.testing.assert_allclose(np.roll(d, 5), moved_d, rtol=0, atol=1e-12)
    ours, theirs = wavelets.swt(STACK, "db2", 2, axis=1), pywt.swt(STACK, "db2", 2, axis=1)
    np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-10)
    np.testing.assert_allclose(wavelets.iswt(ours, "db2", axis=1), STACK, rtol=0, atol=1e-10)
    assert (
        [wavelets.swt_max_level(n) for n in (0, 1, 7, 96)] == [0, 0, 0, 5] == [0, *map(pywt.swt_max_level, (1, 7, 96))]
    )


def test_stationary_transform_refuses_lengths_that_do_not_fit() -> None:
    for count, level in ((10, 2), (8, 4), (7, 1), (0, 1)):
        with pytest.raises(InvalidArgument, match="level"):
            wavelets.swt(np.zeros(count), "db2", level)
    with pytest.raises(InvalidArgument):
        wavelets.swt(np.zeros(7), "db2")
    with pytest.raises(InvalidArgument):
        wavelets.iswt([(np.zeros(8), np.zeros(8)), (np.zeros(8), np.zeros(4))], "db2")
    with pytest.raises(InvalidArgument, match="no details"):
        wavelets.iswt([np.zeros(8)], "db2")
