# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Models against hmmlearn."""

from __future__ import annotations

import numpy as np

from hri import _native
from timing import Bench, Timed, medians

NUM_STATES = 8
DIM = 39


def _left_right_pair(seed: int) -> tuple[_native.GaussianMixtureHmm, object]:
    """One left-right model with the same parameters in both libraries."""
    from hmmlearn.hmm import GaussianHMM

    rng = np.random.default_rng(seed)
    topology = _native.Topology(kind="left_right", num_states=NUM_STATES)
    start, transition = _native.initial_start(topology), _native.initial_transition(topology)
    means = rng.normal(size=(NUM_STATES, DIM))
    variances = rng.uniform(0.5, 2.0, (NUM_STATES, DIM))
    chain = _native.MarkovChain(topology, start, transition)
    ours = _native.GaussianMixtureHmm(chain, np.ones((NUM_STATES, 1)), means, variances)
    peer = GaussianHMM(NUM_STATES, covariance_type="diag")
    peer.startprob_, peer.transmat_ = start, transition
    peer.means_, peer.covars_, peer.n_features = means, variances, DIM
    return ours, peer


def _frames(num_frames: int, seed: int) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=(num_frames, DIM)).astype(np.float32)


def hmm_forward() -> Timed:
    """Log-likelihood of 2000 frames, 39 features, 8 left-right states, one Gaussian a state."""
    ours, peer = _left_right_pair(0)
    frames = _frames(2000, 1)
    assert np.isclose(ours.log_likelihood(frames), peer.score(frames), rtol=1e-5)
    return medians(lambda: ours.log_likelihood(frames), lambda: peer.score(frames))


def hmm_viterbi() -> Timed:
    """Best path of the same 2000 frames."""
    ours, peer = _left_right_pair(0)
    frames = _frames(2000, 1)
    assert np.array_equal(ours.viterbi(frames)[1], peer.decode(frames)[1])
    return medians(lambda: ours.viterbi(frames), lambda: peer.decode(frames))


def hmm_baum_welch() -> Timed:
    """Ten Baum-Welch iterations over 20 sequences of 100 frames."""
    from hmmlearn.hmm import GaussianHMM

    first, _ = _left_right_pair(0)
    states = np.repeat(np.arange(NUM_STATES), 13)[:100]
    sequences = [
        (first.means[states] + np.sqrt(first.variances[states]) * _frames(100, seed))
        .astype(np.float32)
        .reshape(100, DIM)
        for seed in range(20)
    ]
    topology = _native.Topology(kind="left_right", num_states=NUM_STATES)
    options = _native.GaussianMixtureHmmOptions(topology=topology, max_iterations=10, tolerance=0.0)
    together, lengths = np.concatenate(sequences), [100] * 20

    def peer() -> GaussianHMM:
        model = GaussianHMM(NUM_STATES, covariance_type="diag", n_iter=10, tol=-np.inf, init_params="")
        model.startprob_, model.transmat_ = first.chain.start, first.chain.transition
        model.means_, model.covars_ = first.means, first.variances
        return model.fit(together, lengths)

    trained = _native.GaussianMixtureHmm.train(sequences, options)
    # Each starts in its own way, so that the models may differ, but not in how well they explain the sequences.
    reached = sum(trained.log_likelihood(sequence) for sequence in sequences)
    assert np.isclose(reached, peer().score(together, lengths), rtol=1e-2)
    return medians(lambda: _native.GaussianMixtureHmm.train(sequences, options), peer, repeats=5)


def hmm_word() -> Timed:
    """One spoken word of 80 frames scored by ten word models."""
    pairs = [_left_right_pair(seed) for seed in range(10)]
    frames = _frames(80, 1)
    assert all(np.isclose(ours.log_likelihood(frames), peer.score(frames), rtol=1e-5) for ours, peer in pairs)
    return medians(
        lambda: [ours.log_likelihood(frames) for ours, _ in pairs],
        lambda: [peer.score(frames) for _, peer in pairs],
        repeats=51,
    )


BENCHES = [
    Bench("hmm_forward", hmm_forward, "hmmlearn"),
    Bench("hmm_viterbi", hmm_viterbi, "hmmlearn"),
    Bench("hmm_baum_welch", hmm_baum_welch, "hmmlearn"),
    Bench("hmm_word", hmm_word, "hmmlearn"),
]
