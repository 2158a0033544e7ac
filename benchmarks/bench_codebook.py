# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Codebooks against faiss, scikit-learn and NumPy."""

from __future__ import annotations

from types import ModuleType

import numpy as np

from hri.models import Codebook
from timing import Bench, Timed, medians

DIM = 13
SIZE = 64
NUM_ITERATIONS = 20


def _frames(num_frames: int, seed: int) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=(num_frames, DIM)).astype(np.float32)


def _faiss() -> ModuleType:
    """The module, held to one thread."""
    import faiss

    faiss.omp_set_num_threads(1)
    return faiss


def _kmeans(frames: np.ndarray) -> Codebook:
    """Ours, from the first rows."""
    book = Codebook(max_iterations=NUM_ITERATIONS, tolerance=0.0).fit(frames, init=frames[:SIZE])
    assert len(book.report_.sizes) == NUM_ITERATIONS and len(book) == SIZE
    return book


def _same_distortion(frames: np.ndarray, theirs: np.ndarray) -> None:
    ours = _kmeans(frames).distortion(frames)
    assert np.isclose(ours, Codebook.from_centers(theirs).distortion(frames), rtol=0.01)


def _per_iteration(seconds: Timed) -> Timed:
    return seconds[0] / NUM_ITERATIONS, seconds[1] / NUM_ITERATIONS


def lbg() -> Timed:
    """An iteration of k-means: 64 codewords, 20000 frames of 13 features, 20 iterations from the same start."""
    faiss, frames = _faiss(), _frames(20000, 2)

    def peer() -> object:
        # Without the limit faiss would train on a part of the frames.
        kmeans = faiss.Kmeans(DIM, SIZE, niter=NUM_ITERATIONS, max_points_per_centroid=len(frames))
        kmeans.train(frames, init_centroids=frames[:SIZE])
        assert len(kmeans.obj) == NUM_ITERATIONS
        return kmeans

    _same_distortion(frames, peer().centroids)
    return _per_iteration(medians(lambda: _kmeans(frames), peer, repeats=9))


def lbg_sklearn() -> Timed:
    """The same iteration of k-means; of scikit-learn's two algorithms the one that is faster here."""
    from sklearn.cluster import KMeans

    frames = _frames(20000, 2)

    def peer(algorithm: str) -> KMeans:
        options = {"n_init": 1, "max_iter": NUM_ITERATIONS, "tol": 0.0, "algorithm": algorithm}
        kmeans = KMeans(SIZE, init=frames[:SIZE], **options).fit(frames)
        assert kmeans.n_iter_ == NUM_ITERATIONS
        return kmeans

    timed = []
    for algorithm in ("lloyd", "elkan"):
        _same_distortion(frames, peer(algorithm).cluster_centers_)
        timed.append(medians(lambda: _kmeans(frames), lambda algorithm=algorithm: peer(algorithm), repeats=5))
    return _per_iteration(min(timed, key=lambda seconds: seconds[1]))


def quantise() -> Timed:
    """The nearest of 64 codewords for the 50 frames of one word, 13 features; the peer is one matrix product."""
    frames, centroids = _frames(50, 3), _frames(SIZE, 4)
    ours = Codebook.from_centers(centroids).model_
    squares, doubled = (centroids * centroids).sum(axis=1), np.ascontiguousarray(2 * centroids.T)

    def peer() -> np.ndarray:
        return (squares - frames @ doubled).argmin(axis=1)

    np.testing.assert_array_equal(ours.quantise(frames), peer())
    return medians(lambda: ours.quantise(frames), peer, repeats=2001)


def quantise_many() -> Timed:
    """The nearest of the same 64 codewords for 10000 frames."""
    faiss, frames, centroids = _faiss(), _frames(10000, 5), _frames(SIZE, 4)
    ours = Codebook.from_centers(centroids).model_
    peer = faiss.IndexFlatL2(DIM)
    peer.add(centroids)
    assert np.mean(ours.quantise(frames) == peer.search(frames, 1)[1][:, 0]) > 0.999  # rounding may break ties
    return medians(lambda: ours.quantise(frames), lambda: peer.search(frames, 1), repeats=51)


BENCHES = [
    Bench("lbg", lbg, "faiss"),
    Bench("lbg_sklearn", lbg_sklearn, "scikit-learn"),
    Bench("quantise", quantise, "NumPy"),
    Bench("quantise_many", quantise_many, "faiss"),
]
