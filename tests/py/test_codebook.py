# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Codebooks from Python: shapes, dtypes, reports, interrupts, threads, files."""

from __future__ import annotations

import signal
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

from conftest import WAIT_S
from hri import _native
from hri.core.errors import FormatError, InvalidArgument

WIDTHS = [13, 13, 13]


def noise(num_rows: int, dim: int, seed: int) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=(num_rows, dim)).astype(np.float32)


def nearest(frames: np.ndarray, centroids: np.ndarray) -> np.ndarray:
    differences = frames[:, None].astype(np.float64) - centroids[None].astype(np.float64)
    return (differences**2).sum(axis=2).argmin(axis=1)


@pytest.fixture(scope="module")
def streams() -> _native.MultiStreamCodebook:
    return _native.MultiStreamCodebook.train_lbg(noise(500, 39, 1), WIDTHS, _native.CodebookOptions(num_codewords=16))


@pytest.mark.parametrize("num_rows", [0, 1, 15, 16, 50, 1000])
def test_symbols_are_the_nearest_codewords(num_rows: int) -> None:
    centroids, frames = noise(64, 13, 2), noise(num_rows, 13, 3)
    symbols = _native.Codebook(centroids).quantise(frames)
    assert symbols.dtype == np.int32 and symbols.shape == (num_rows,)
    np.testing.assert_array_equal(symbols, nearest(frames, centroids))


def test_any_layout_and_number_type_gives_the_same_symbols() -> None:
    frames = noise(60, 26, 4)
    book = _native.Codebook(noise(20, 13, 5))
    expected = book.quantise(np.ascontiguousarray(frames[:, 13:]))
    for same in (frames[:, 13:], np.asfortranarray(frames[:, 13:]), frames[:, 13:].astype(np.float64)):
        np.testing.assert_array_equal(book.quantise(same), expected)


def test_report_holds_a_distortion_that_never_rises_within_one_size() -> None:
    rows, report = noise(2000, 13, 6), _native.CodebookReport()
    _native.Codebook.train_lbg(rows, _native.CodebookOptions(num_codewords=32), report)
    sizes, distortions = np.array(report.sizes), np.array(report.distortions)
    assert sorted(set(report.sizes)) == [2, 4, 8, 16, 32] and report.converged
    within = np.diff(sizes) == 0
    assert within.any() and (np.diff(distortions)[within] <= 1e-6 * distortions[1:][within]).all()
    book = _native.Codebook.train_kmeans(rows, rows[:8], _native.CodebookOptions(max_iterations=2), report)
    assert report.sizes == [8, 8] and not report.converged
    assert report.distortions[0] == pytest.approx(_native.Codebook(rows[:8]).distortion(rows))
    assert book.distortion(rows) < report.distortions[1]


def test_streams_are_coded_apart(streams: _native.MultiStreamCodebook) -> None:
    frames = noise(70, 39, 7)
    symbols = streams.quantise(frames)
    assert symbols.dtype == np.int32 and symbols.shape == (70, 3)
    assert len(streams) == streams.num_streams == 3 and streams.dim == 39
    distortion = 0.0
    for s, book in enumerate(streams.streams):
        part = frames[:, 13 * s : 13 * (s + 1)]
        np.testing.assert_array_equal(symbols[:, s], book.quantise(part))
        distortion += book.distortion(part)
    assert streams.distortion(frames) == distortion
    assert streams.quantise(frames[:0]).shape == (0, 3)


def test_one_stream_is_a_codebook() -> None:
    rows, options = noise(300, 13, 8), _native.CodebookOptions(num_codewords=16)
    one = _native.MultiStreamCodebook.train_lbg(rows, [13], options)
    alone = _native.Codebook.train_lbg(rows, options)
    np.testing.assert_array_equal(one.streams[0].centroids, alone.centroids)
    np.testing.assert_array_equal(one.quantise(rows)[:, 0], alone.quantise(rows))
    assert one.distortion(rows) == alone.distortion(rows)


def test_streams_come_back_to_the_bit(streams: _native.MultiStreamCodebook, tmp_path: Path) -> None:
    file = _native.ModelFile()
    streams.write(file, "vq.")
    file.write(str(tmp_path / "vq.hri"))
    loaded = _native.MultiStreamCodebook.read(_native.ModelFile.read(str(tmp_path / "vq.hri")), "vq.")
    for ours, theirs in zip(streams.streams, loaded.streams, strict=True):
        np.testing.assert_array_equal(ours.centroids, theirs.centroids)
    frames = noise(40, 39, 9)
    np.testing.assert_array_equal(loaded.quantise(frames), streams.quantise(frames))
    with pytest.raises(FormatError, match=r"other\.num_streams"):
        _native.MultiStreamCodebook.read(file, "other.")


def test_bad_input_is_refused_by_name(streams: _native.MultiStreamCodebook) -> None:
    rows = noise(50, 39, 10)
    train = _native.MultiStreamCodebook.train_lbg
    with pytest.raises(InvalidArgument, match="widths add up to 26, the rows have 39 columns"):
        train(rows, [13, 13])
    with pytest.raises(InvalidArgument, match=r"widths\[1\] = 0"):
        train(rows, [39, 0])
    with pytest.raises(InvalidArgument, match="streams"):
        _native.MultiStreamCodebook([])
    with pytest.raises(InvalidArgument, match="columns"):
        streams.quantise(rows[:, :38])
    rows[4, 20] = np.nan
    for action in (streams.quantise, streams.distortion, lambda bad: train(bad, WIDTHS)):
        with pytest.raises(InvalidArgument, match="row 4, column 20"):
            action(rows)


@pytest.mark.parametrize("method", ["lbg", "kmeans", "streams"])
def test_an_interrupt_ends_the_training(method: str) -> None:
    rows = noise(100000, 26, 11)
    options = _native.CodebookOptions(num_codewords=512, max_iterations=100000, tolerance=0.0)
    train = {
        "lbg": lambda: _native.Codebook.train_lbg(rows, options),
        "kmeans": lambda: _native.Codebook.train_kmeans(rows, rows[:512], options),
        "streams": lambda: _native.MultiStreamCodebook.train_lbg(rows, [13, 13], options),
    }[method]
    start = time.monotonic()
    timer = threading.Timer(0.3, signal.raise_signal, [signal.SIGINT])
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            train()
    finally:
        timer.join()
    assert time.monotonic() - start < WAIT_S


def test_threads_share_a_codebook() -> None:
    book = _native.Codebook(noise(64, 13, 12))
    batches = [noise(200 if seed % 2 else 5000, 13, seed) for seed in range(8)]  # the lock is let go for the long ones
    expected = [book.quantise(batch) for batch in batches]
    with ThreadPoolExecutor(4) as pool:
        for symbols, once in zip(pool.map(book.quantise, batches * 5), expected * 5, strict=True):
            np.testing.assert_array_equal(symbols, once)
