# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Minimum classification error training (Juang and Katagiri 1992) of the means of Gaussian-mixture HMMs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from hri.models import GaussianMixtureHmm
from hri.studies.word_features import Frames

NUM_PASSES = 12
NUM_RIVALS = 4
STEEPNESS = 4.0
"""Of the error function, per unit of log-likelihood a frame."""
FOCUS = 5.0
"""How much the best rival weighs beside the others, per unit of log-likelihood a frame."""
RATE = 0.4
PRIOR = 2.0
"""Frames that a mean weighs by itself, of which few see it in a pass."""
LEAST_WEIGHT = 1e-3
"""Words that are this sure, or this lost, move nothing."""


def _nearest_gaussians(model: GaussianMixtureHmm, means: NDArray[np.float64], frames: Frames) -> NDArray[np.int64]:
    """Of every frame the Gaussian that fits best in the state of the best path."""
    per_state = model.weights.shape[1]
    path = np.asarray(model.viterbi(frames)[1], np.int64)
    choices = path[:, None] * per_state + np.arange(per_state)
    variances = model.variances[choices]
    squares = (frames[:, None, :] - means[choices]) ** 2 / variances
    fit = np.log(model.weights).ravel()[choices] - 0.5 * (squares + np.log(variances)).sum(axis=2)
    return np.asarray(choices[np.arange(len(frames)), fit.argmax(axis=1)])


def _scores(models: Sequence[GaussianMixtureHmm], frames: Frames) -> NDArray[np.float64]:
    """Log-likelihoods a frame."""
    return np.array([model.log_likelihood(frames) for model in models]) / len(frames)


def mean_loss(models: Sequence[GaussianMixtureHmm], frames: Sequence[Frames], classes: Sequence[int]) -> float:
    """The smoothed share of errors that training lowers."""
    losses = []
    for own, label in zip(frames, classes, strict=True):
        scores = _scores(models, own)
        losses.append(1 / (1 + np.exp(STEEPNESS * (scores[label] - np.delete(scores, label).max()))))
    return float(np.mean(losses))


def train_minimum_error(
    models: Sequence[GaussianMixtureHmm], frames: Sequence[Frames], classes: Sequence[int]
) -> list[GaussianMixtureHmm]:
    """Models whose means moved so that fewer of these words are confused with others; all else stays.

    Means of the right word move towards its frames, those of its best rivals away, each in units of its own variance,
    weighted by the slope of the error function.
    """
    current = list(models)
    means = [np.array(model.means) for model in models]
    for _ in range(NUM_PASSES):
        moves = [np.zeros_like(own) for own in means]
        seen = [np.zeros(len(own)) for own in means]
        for own, label in zip(frames, classes, strict=True):
            scores = _scores(current, own)
            rivals = [c for c in np.argsort(-scores) if c != label][:NUM_RIVALS]
            loss = 1 / (1 + np.exp(STEEPNESS * (scores[label] - scores[rivals[0]])))
            slope = STEEPNESS * loss * (1 - loss)
            if slope < LEAST_WEIGHT:
                continue
            shares = np.exp(FOCUS * (scores[rivals] - scores[rivals[0]]))
            for c, sign in [(label, 1.0), *zip(rivals, -shares / shares.sum(), strict=True)]:
                at = _nearest_gaussians(current[c], means[c], own)
                np.add.at(moves[c], at, sign * slope * (own - means[c][at]))
                np.add.at(seen[c], at, abs(sign) * slope)
        means = [
            own + RATE * move / (count[:, None] + PRIOR) for own, move, count in zip(means, moves, seen, strict=True)
        ]
        current = [
            GaussianMixtureHmm(model.chain, model.weights, own, model.variances)
            for model, own in zip(models, means, strict=True)
        ]
    return current
