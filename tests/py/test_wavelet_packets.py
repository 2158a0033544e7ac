# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Wavelet packets and streams against PyWavelets."""

from __future__ import annotations

import numpy as np
import pytest
import pywt

from hri import InvalidArgument
from hri import signal as wavelets


def signal(count: int, dtype: str = "f8") -> np.ndarray:
    return np.random.default_rng(count).normal(size=count).astype(dtype)


@pytest.mark.parametrize("border", ["symmetric", "zero", "periodization", "smooth", "antireflect"])
@pytest.mark.parametrize("wavelet", ["haar", "db4", "bior2.2", "coif3"])
def test_nodes_are_those_of_pywavelets(wavelet: str, border: str) -> None:
    for count in (64, 101):
        for dtype, tolerance in (("f8", 1e-10), ("f4", 1e-4)):
            x = signal(count, dtype)
            packets = wavelets.wavelet_packets(x, wavelet, border, 3)
            tree = pywt.WaveletPacket(x.astype("f8"), wavelet, border, maxlevel=3)
            assert packets[0].tolist() == [x.tolist()]
            for level in (1, 2, 3):
                assert packets[level].dtype == x.dtype
                natural = [node.data for node in tree.get_level(level, "natural")]
                np.testing.assert_allclose(packets[level], natural, rtol=0, atol=tolerance * np.abs(natural).max())
                rising = [node.data for node in tree.get_level(level, "freq")]
                ours = packets[level][wavelets.frequency_order(level)]
                np.testing.assert_allclose(ours, rising, rtol=0, atol=tolerance * np.abs(rising).max())


def test_the_tree_has_pywavelets_paths() -> None:
    x = signal(101)
    ours, theirs = wavelets.WaveletPacket(x, "db3"), pywt.WaveletPacket(x, "db3")
    assert ours.maxlevel == theirs.maxlevel
    for order in ("natural", "freq"):
        paths = [node.path for node in theirs.get_level(3, order)]
        assert [node.path for node in ours.get_level(3, order)] == paths
        for path in paths:
            np.testing.assert_allclose(ours[path].data, theirs[path].data, rtol=0, atol=1e-10)
    np.testing.assert_array_equal(ours[""].data, x)
    np.testing.assert_allclose(ours.reconstruct()[:101], x, rtol=0, atol=1e-10)
    basis = ours.best_basis()
    assert sum(2.0**-node.level for node in basis) == 1
    for wrong in ("ax", "a" * 9):
        with pytest.raises(InvalidArgument, match="no node"):
            ours[wrong]
    with pytest.raises(InvalidArgument, match="order"):
        ours.get_level(1, "rising")  # type: ignore[arg-type]
    one = wavelets.WaveletPacket([1.0], "db3")
    assert one.maxlevel == 0 and one.reconstruct().tolist() == [1.0]


def test_best_basis_gives_the_signal_back_and_needs_fewer_numbers() -> None:
    x = np.sin(2 * np.pi * 0.17 * np.arange(512)) + 0.01 * signal(512)
    packets = wavelets.wavelet_packets(x, "sym8", "periodization", 5)
    basis = wavelets.best_basis(packets)
    np.testing.assert_allclose(wavelets.waverec_packets(packets, basis, "sym8", "periodization"), x, atol=1e-9)
    kept = np.sort(np.concatenate([packets[level][index] for level, index in basis]) ** 2)[::-1]
    assert len(kept) == 512
    assert kept[:32].sum() > 2 * np.sort(x**2)[::-1][:32].sum()
    with pytest.raises(InvalidArgument, match="exactly once"):
        wavelets.waverec_packets(packets, [*basis, (5, 0)], "sym8", "periodization")


@pytest.mark.parametrize("dtype", ["f4", "f8"])
def test_stream_gives_the_transform_with_zeros_around(dtype: str) -> None:
    x = signal(3000, dtype)
    stream = wavelets.WaveletStream("db4", 3, dtype)
    for piece in (1, 160, 5000):
        found = [stream.push(x[i : i + piece]) for i in range(0, len(x), piece)]
        assert len(found[0]) == 4
        found.append(stream.finish())
        bands = [np.concatenate(parts) for parts in zip(*found, strict=True)]
        for ours, whole in zip(bands, wavelets.wavedec(x, "db4", "zero", 3), strict=True):
            assert ours.dtype == x.dtype
            np.testing.assert_array_equal(ours, whole)
    stream.push(x)
    stream.reset()
    assert [len(band) for band in stream.finish()] == [0, 0, 0, 0]


def test_streams_and_packets_refuse_what_they_cannot_do() -> None:
    with pytest.raises(InvalidArgument, match="float16"):
        wavelets.WaveletStream("db4", 3, "f2")
    with pytest.raises(InvalidArgument, match="num_levels"):
        wavelets.WaveletStream("db4", 0)
    with pytest.raises(InvalidArgument, match="db99"):
        wavelets.WaveletStream("db99", 1)
    with pytest.raises(InvalidArgument, match="num_levels"):
        wavelets.wavelet_packets(signal(8), "db4", level=21)
    with pytest.raises(InvalidArgument, match="level"):
        wavelets.frequency_order(-1)
