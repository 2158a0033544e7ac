# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Linear transforms of frames, fitted to which state of which word each frame belongs to: LDA, MLLT and HLDA."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hri.studies.word_features import Frames

Matrix = NDArray[np.float64]

NUM_ITERATIONS = 20
NUM_SWEEPS = 3
"""Updates of every row between two estimates of the variances."""
SMOOTHING = 0.1
"""Of a state's covariance, towards that within all states: some states have few frames."""


@dataclass(frozen=True)
class StateMoments:
    """What transforms are fitted to.

    Attributes
    ----------
    counts : array, shape (num_states,)
        Frames of every state.
    covariances : array, shape (num_states, dim, dim)
        Of every state, smoothed.
    within, total : array, shape (dim, dim)
        Covariance within all states, and of all frames.
    """

    counts: Matrix
    covariances: Matrix
    within: Matrix
    total: Matrix

    @classmethod
    def of(cls, frames: Sequence[Frames], states: Sequence[NDArray[np.int64]]) -> StateMoments:
        """Of the frames of words, `states` the state of every frame."""
        rows = np.concatenate(frames).astype(np.float64)
        _, own = np.unique(np.concatenate(states), return_inverse=True)
        counts = np.bincount(own).astype(np.float64)
        means = np.zeros((len(counts), rows.shape[1]))
        np.add.at(means, own, rows)
        residuals = rows - (means / counts[:, None])[own]
        within = residuals.T @ residuals / len(rows)
        order = np.argsort(own, kind="stable")
        parts = np.split(residuals[order], np.cumsum(counts.astype(np.int64))[:-1])
        covariances = np.stack([part.T @ part / len(part) for part in parts])
        smoothed = (1 - SMOOTHING) * covariances + SMOOTHING * within
        return cls(counts, smoothed, within, np.cov(rows.T, bias=True))


def fit_discriminants(moments: StateMoments) -> Matrix:
    """Linear discriminants by falling ratio of the covariances between and within states, a row each.

    All of them, also those that separate nothing, which `hri.models.LDA` leaves out: the search below starts there.
    """
    whitening = np.linalg.inv(np.linalg.cholesky(moments.within))
    _, vectors = np.linalg.eigh(whitening @ (moments.total - moments.within) @ whitening.T)
    return vectors[:, ::-1].T @ whitening


def fit_heteroscedastic(moments: StateMoments, num_kept: int, start: Matrix) -> Matrix:
    """Heteroscedastic linear discriminants (Kumar and Andreou 1998), all rows; the first `num_kept` matter.

    Maximum likelihood of diagonal Gaussians: every state has variances of its own among the first `num_kept` rows,
    all states share those of the others. With all rows kept that is a maximum likelihood linear transform (MLLT).
    Rows are updated one by one (Gales 1999, eq. 22). `start` is where the search begins.
    """
    basis, weights = start.copy(), moments.counts
    for _ in range(NUM_ITERATIONS):
        kept = np.einsum("ij,sjk,ik->si", basis[:num_kept], moments.covariances, basis[:num_kept])
        shared = np.einsum("ij,jk,ik->i", basis[num_kept:], moments.total, basis[num_kept:])
        for _ in range(NUM_SWEEPS):
            for i in range(len(basis)):
                if i < num_kept:
                    weighted = np.tensordot(weights / kept[:, i], moments.covariances, 1)
                else:
                    weighted = weights.sum() / shared[i - num_kept] * moments.total
                cofactors = np.linalg.inv(basis)[:, i]  # but for a factor
                row = np.linalg.solve(weighted, cofactors)
                basis[i] = row * np.sqrt(weights.sum() / (cofactors @ row))
    return basis


def log_likelihood(basis: Matrix, moments: StateMoments, num_kept: int) -> float:
    """Mean over frames of what `fit_heteroscedastic` maximises, but for a constant."""
    kept = np.einsum("ij,sjk,ik->si", basis[:num_kept], moments.covariances, basis[:num_kept])
    shared = np.einsum("ij,jk,ik->i", basis[num_kept:], moments.total, basis[num_kept:])
    spread = moments.counts @ np.log(kept).sum(axis=1) / moments.counts.sum() + np.log(shared).sum()
    return float(np.linalg.slogdet(basis)[1] - 0.5 * spread)


def apply(basis: Matrix, frames: Sequence[Frames]) -> list[Frames]:
    """The frames of words in the space of the rows of `basis`."""
    return [(own @ basis.T).astype(np.float32) for own in frames]


def with_neighbours(frames: Frames, num_features: int, reach: int) -> Frames:
    """The first `num_features` of every frame and of `reach` frames on either side; the ends are repeated."""
    own = np.pad(frames[:, :num_features], ((reach, reach), (0, 0)), "edge")
    return np.hstack([own[i : i + len(frames)] for i in range(2 * reach + 1)])


def with_third_differences(frames: Frames, num_features: int) -> Frames:
    """Frames and the deltas of their last `num_features`, by regression over two frames on either side."""
    last = np.pad(frames[:, -num_features:], ((2, 2), (0, 0)), "edge")
    count = len(frames)
    near, far = last[3 : 3 + count] - last[1 : 1 + count], last[4:] - last[:count]
    return np.hstack([frames, (near + 2 * far) / 10])
