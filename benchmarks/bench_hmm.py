# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Hidden Markov models against hmmlearn, whose faster implementation (scaling or log) counts."""

from __future__ import annotations

import logging
from collections.abc import Callable

import numpy as np

from hri.models import (
    DiscreteHmm,
    DiscreteHmmOptions,
    GaussianMixtureHmm,
    GaussianMixtureHmmOptions,
    MarkovChain,
    Topology,
    initial_start,
    initial_transition,
)
from timing import Bench, Timed, medians

NUM_STATES = 8
DIM = 39
IMPLEMENTATIONS = ("scaling", "log")


def _faster(ours: Callable[[], object], peers: list[Callable[[], object]], repeats: int = 15) -> Timed:
    """Medians of ours and of the faster peer."""
    return min((medians(ours, peer, repeats) for peer in peers), key=lambda timed: timed[1])


def _discrete(kind: str, num_states: int, num_symbols: int, seed: int) -> tuple[DiscreteHmm, list]:
    """One model over symbols with the same parameters in both libraries, hmmlearn's in both implementations."""
    from hmmlearn.hmm import CategoricalHMM

    rng = np.random.default_rng(seed)
    topology = Topology(kind=kind, num_states=num_states)
    start, transition = initial_start(topology), initial_transition(topology)
    if kind == "ergodic":
        start, transition = rng.dirichlet(np.ones(num_states)), rng.dirichlet(np.ones(num_states), num_states)
    emission = rng.dirichlet(np.ones(num_symbols), num_states)
    ours = DiscreteHmm(MarkovChain(topology, start, transition), emission)
    peers = []
    for implementation in IMPLEMENTATIONS:
        peer = CategoricalHMM(num_states, implementation=implementation, n_iter=1, tol=0, init_params="")
        peer.startprob_, peer.transmat_, peer.emissionprob_ = start, transition, emission
        peer.n_features = num_symbols
        peers.append(peer)
    return ours, peers


def _symbols(num_symbols: int, count: int) -> np.ndarray:
    return np.random.default_rng(5).integers(0, num_symbols, count).astype(np.int32)


def hmm_forward() -> Timed:
    """Log-likelihood of 1000 of 64 symbols, 64 ergodic states."""
    ours, peers = _discrete("ergodic", 64, 64, 0)
    symbols = _symbols(64, 1000)
    column = symbols[:, None]
    assert all(np.isclose(ours.log_likelihood(symbols), peer.score(column), rtol=1e-9) for peer in peers)
    return _faster(lambda: ours.log_likelihood(symbols), [lambda p=peer: p.score(column) for peer in peers])


def hmm_forward_limit() -> Timed:
    """The same log-likelihood, beside a matrix product of as many multiply-adds: the limit of the machine."""
    ours, _ = _discrete("ergodic", 64, 64, 0)
    symbols = _symbols(64, 1000)
    left = np.random.default_rng(6).random((1000, 64))
    right = np.ascontiguousarray(ours.chain.transition)
    return medians(lambda: ours.log_likelihood(symbols), lambda: left @ right, repeats=51)


def hmm_viterbi() -> Timed:
    """Best path of the same 1000 symbols."""
    ours, peers = _discrete("ergodic", 64, 64, 0)
    symbols = _symbols(64, 1000)
    column = symbols[:, None]
    score, path = ours.viterbi(symbols)
    for peer in peers:
        peer_score, peer_path = peer.decode(column)
        assert np.isclose(score, peer_score, rtol=1e-9) and np.array_equal(path, peer_path)
    return _faster(lambda: ours.viterbi(symbols), [lambda p=peer: p.decode(column) for peer in peers])


def hmm_baum_welch() -> Timed:
    """One Baum-Welch iteration over the same 1000 symbols."""
    logging.getLogger("hmmlearn").setLevel(logging.ERROR)  # it warns of too little data
    ours, peers = _discrete("ergodic", 64, 64, 0)
    symbols = _symbols(64, 1000)
    column = symbols[:, None]
    options = DiscreteHmmOptions(max_iterations=1, emission_floor=0.0)

    def step(peer: object) -> object:
        peer.startprob_, peer.transmat_ = ours.chain.start, ours.chain.transition
        peer.emissionprob_ = ours.emission
        return peer.fit(column)

    trained = ours.retrain([symbols], options)
    for peer in map(step, peers):
        assert np.allclose(trained.chain.start, peer.startprob_, rtol=1e-9, atol=1e-12)
        assert np.allclose(trained.chain.transition, peer.transmat_, rtol=1e-9, atol=1e-12)
        assert np.allclose(trained.emission, peer.emissionprob_, rtol=1e-9, atol=1e-12)
    return _faster(lambda: ours.retrain([symbols], options), [lambda p=peer: step(p) for peer in peers])


def hmm_word() -> Timed:
    """A word of 50 symbols scored by one model of 5 left-right states."""
    ours, peers = _discrete("left_right", 5, 64, 0)
    symbols = _symbols(64, 50)
    column = symbols[:, None]
    assert all(np.isclose(ours.log_likelihood(symbols), peer.score(column), rtol=1e-9) for peer in peers)
    return _faster(lambda: ours.log_likelihood(symbols), [lambda p=peer: p.score(column) for peer in peers], 301)


def _left_right_pair(seed: int) -> tuple[GaussianMixtureHmm, list]:
    """One left-right model with the same parameters in both libraries, hmmlearn's in both implementations."""
    from hmmlearn.hmm import GaussianHMM

    rng = np.random.default_rng(seed)
    topology = Topology(kind="left_right", num_states=NUM_STATES)
    start, transition = initial_start(topology), initial_transition(topology)
    means = rng.normal(size=(NUM_STATES, DIM))
    variances = rng.uniform(0.5, 2.0, (NUM_STATES, DIM))
    chain = MarkovChain(topology, start, transition)
    ours = GaussianMixtureHmm(chain, np.ones((NUM_STATES, 1)), means, variances)
    peers = []
    for implementation in IMPLEMENTATIONS:
        peer = GaussianHMM(NUM_STATES, covariance_type="diag", implementation=implementation)
        peer.startprob_, peer.transmat_ = start, transition
        peer.means_, peer.covars_, peer.n_features = means, variances, DIM
        peers.append(peer)
    return ours, peers


def _frames(num_frames: int, seed: int) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=(num_frames, DIM)).astype(np.float32)


def gmm_hmm_forward() -> Timed:
    """Log-likelihood of 2000 frames, 39 features, 8 left-right states, one Gaussian a state; ours in float32,
    hmmlearn in float64, which it has alone."""
    ours, peers = _left_right_pair(0)
    frames = _frames(2000, 1)
    assert all(np.isclose(ours.log_likelihood(frames), peer.score(frames), rtol=1e-5) for peer in peers)
    return _faster(lambda: ours.log_likelihood(frames), [lambda p=peer: p.score(frames) for peer in peers])


def gmm_hmm_viterbi() -> Timed:
    """Best path of the same 2000 frames; ours in float32, hmmlearn in float64."""
    ours, peers = _left_right_pair(0)
    frames = _frames(2000, 1)
    assert all(np.array_equal(ours.viterbi(frames)[1], peer.decode(frames)[1]) for peer in peers)
    return _faster(lambda: ours.viterbi(frames), [lambda p=peer: p.decode(frames) for peer in peers])


def gmm_hmm_baum_welch() -> Timed:
    """Ten Baum-Welch iterations over 20 sequences of 100 frames; ours score in float32, hmmlearn in float64."""
    from hmmlearn.hmm import GaussianHMM

    first, _ = _left_right_pair(0)
    states = np.repeat(np.arange(NUM_STATES), 13)[:100]
    sequences = [
        (first.means[states] + np.sqrt(first.variances[states]) * _frames(100, seed))
        .astype(np.float32)
        .reshape(100, DIM)
        for seed in range(20)
    ]
    options = GaussianMixtureHmmOptions(max_iterations=10, tolerance=0.0, variance_floor=1e-9)
    together, lengths = np.concatenate(sequences), [100] * 20

    def peer(implementation: str) -> GaussianHMM:
        model = GaussianHMM(
            NUM_STATES, n_iter=10, tol=-np.inf, init_params="", implementation=implementation,
            min_covar=0, covars_prior=0, covars_weight=1, means_weight=0,
        )  # fmt: skip
        model.startprob_, model.transmat_ = first.chain.start, first.chain.transition
        model.means_, model.covars_ = first.means, first.variances
        return model.fit(together, lengths)

    trained = first.retrain(sequences, options)
    assert all(np.allclose(trained.means, peer(name).means_, rtol=1e-6, atol=1e-6) for name in IMPLEMENTATIONS)
    return _faster(
        lambda: first.retrain(sequences, options), [lambda n=name: peer(n) for name in IMPLEMENTATIONS], repeats=5
    )


def gmm_hmm_word() -> Timed:
    """One spoken word of 80 frames scored by ten word models; ours in float32, hmmlearn in float64."""
    pairs = [_left_right_pair(seed) for seed in range(10)]
    frames = _frames(80, 1)
    assert all(
        np.isclose(ours.log_likelihood(frames), p.score(frames), rtol=1e-5) for ours, peers in pairs for p in peers
    )
    return _faster(
        lambda: [ours.log_likelihood(frames) for ours, _ in pairs],
        [lambda i=i: [peers[i].score(frames) for _, peers in pairs] for i in range(len(IMPLEMENTATIONS))],
        repeats=51,
    )


BENCHES = [
    Bench("hmm_forward", hmm_forward, "hmmlearn"),
    Bench("hmm_forward_limit", hmm_forward_limit, "numpy dgemm"),
    Bench("hmm_viterbi", hmm_viterbi, "hmmlearn"),
    Bench("hmm_baum_welch", hmm_baum_welch, "hmmlearn"),
    Bench("hmm_word", hmm_word, "hmmlearn"),
    Bench("gmm_hmm_forward", gmm_hmm_forward, "hmmlearn"),
    Bench("gmm_hmm_viterbi", gmm_hmm_viterbi, "hmmlearn"),
    Bench("gmm_hmm_baum_welch", gmm_hmm_baum_welch, "hmmlearn"),
    Bench("gmm_hmm_word", gmm_hmm_word, "hmmlearn"),
]
