# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Models of isolated units, as HInit and HRest train them; by Baum-Welch of `hri.models`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri._native import GaussianMixtureHmm, GaussianMixtureHmmOptions, HtkModelSet, Topology
from hri.core.errors import InvalidArgument


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


def retrain_model(
    models: HtkModelSet, source: HtkModelSet, name: str, sequences: Sequence[NDArray[np.float32]], **options: Any
) -> GaussianMixtureHmm:
    """Train the model `name` of `source` further, and add it to `models`; as `train_model` else."""
    if not len(sequences):
        raise InvalidArgument(f"there is no recording to train {name!r} on")
    model = source.hmm(name).retrain(list(sequences), GaussianMixtureHmmOptions(**options))
    models.add(name, model, _final_stay(model, sequences))
    return model


def _final_stay(model: GaussianMixtureHmm, sequences: Sequence[NDArray[np.float32]]) -> float:
    """The probability to stay in the last state that its length on the best paths makes most likely."""
    last = model.num_states - 1
    lengths = [np.count_nonzero(np.asarray(model.viterbi(frames)[1]) == last) for frames in sequences]
    mean = max(1.0, float(np.mean(lengths)))
    return 1 - 1 / mean
