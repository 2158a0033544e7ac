# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Models of isolated units."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri._native import (
    EmbeddedTrainerOptions,
    GaussianMixtureHmm,
    GaussianMixtureHmmOptions,
    HtkEmbeddedTrainer,
    HtkModelSet,
    Topology,
)
from hri._native import min_frames_of_htk_model as min_frames_of
from hri._native import train_htk_model_by_viterbi as train_by_viterbi
from hri.core.errors import InvalidArgument

__all__ = ["min_frames_of", "retrain_by_baum_welch", "train_by_viterbi", "train_model"]


def train_model(
    models: HtkModelSet,
    name: str,
    sequences: Sequence[NDArray[np.float32]],
    num_states: int,
    num_mixtures: int = 1,
    **options: Any,
) -> GaussianMixtureHmm:
    """Train a left-right HMM from uniform segmentation, and add it to `models`.

    Parameters
    ----------
    models : ModelSet
    name : str
    sequences : list of ndarray of float32, shape (num_frames, num_columns)
        Recordings of the unit.
    num_states : int
        Those that emit.
    num_mixtures : int
        Gaussians a state.
    **options
        Further fields of `GaussianMixtureHmmOptions`.

    Raises
    ------
    InvalidArgument
        For no recordings, and values that the options or the model cannot have.
    """
    topology = Topology(kind="left_right", num_states=num_states, max_jump=1)
    made = GaussianMixtureHmmOptions(topology=topology, num_mixtures=num_mixtures, **options)
    model = GaussianMixtureHmm.train(list(sequences), made)
    models.add(name, model, _final_stay(model, sequences))
    return model


def retrain_by_baum_welch(
    models: HtkModelSet,
    name: str,
    sequences: Sequence[NDArray[np.float32]],
    options: EmbeddedTrainerOptions,
    max_iterations: int = 20,
    tolerance: float = 1e-4,
) -> tuple[HtkModelSet, list[float]]:
    """Train one model of a set further by Baum-Welch, as HRest: its topology and macros stay.

    Parameters
    ----------
    models : ModelSet
    name : str
    sequences : list of ndarray of float32, shape (num_frames, num_columns)
        Recordings of the unit; those that no path of the model fits are not counted.
    options : EmbeddedTrainerOptions
    max_iterations : int
    tolerance : float
        Training ends when the log likelihood grows by a smaller share.

    Returns
    -------
    ModelSet
    list of float
        The log likelihood before each pass.

    Raises
    ------
    InvalidArgument
        For a model that there is not, options out of range, and where no recording fits.
    """
    likelihoods: list[float] = []
    for _ in range(max_iterations):
        trainer = HtkEmbeddedTrainer(models, options)
        for frames in sequences:
            trainer.add(frames, [name])
        if not trainer.num_frames:
            raise InvalidArgument(f"there is no recording that fits {name!r}")
        models = trainer.estimate()
        likelihoods.append(trainer.log_likelihood)
        if len(likelihoods) > 1 and likelihoods[-1] - likelihoods[-2] < tolerance * abs(likelihoods[-2]):
            break
    return models, likelihoods


def _final_stay(model: GaussianMixtureHmm, sequences: Sequence[NDArray[np.float32]]) -> float:
    """The probability to stay in the last state that its length on the best paths makes most likely."""
    last = model.num_states - 1
    lengths = [np.count_nonzero(np.asarray(model.viterbi(frames)[1]) == last) for frames in sequences]
    mean = max(1.0, float(np.mean(lengths)))
    return 1 - 1 / mean
