# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""States given all frames: posteriors of HMMs against hmmlearn, possibilities of PTBHMMs against NumPy."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument
from hri.models import (
    GMMHMM,
    PTBHMM,
    CategoricalHMM,
    DiscreteHmm,
    ForwardBackward,
    GaussianHMM,
    GaussianMixtureHmm,
    MarkovChain,
    PossibilisticGaussianHmmSet,
    PossibilisticHmmSet,
    PossibilisticRule,
    StatePossibilities,
    Topology,
    initial_start,
    initial_transition,
)

hmmlearn = pytest.importorskip("hmmlearn.hmm")
_hmmc = pytest.importorskip("hmmlearn._hmmc")
pytestmark = pytest.mark.filterwarnings("ignore:divide by zero")

NUM_SYMBOLS = 5
DIM = 3
LENGTHS = [1, 2, 60, 137]
TOPOLOGIES = [
    {"kind": "left_right", "num_states": 4, "max_jump": 1},
    {"kind": "left_right", "num_states": 9, "max_jump": 2},
    {"kind": "banded", "num_states": 6, "max_jump": 1},
    {"kind": "ergodic", "num_states": 5},
    {"kind": "rank_one_plus_band", "num_states": 6, "max_jump": 1},
]


def random_chain(fields: dict[str, Any], rng: np.random.Generator) -> MarkovChain:
    topology = Topology(**fields)
    n = topology.num_states
    start = initial_start(topology) * rng.uniform(0.5, 1.0, n)
    band = np.where(initial_transition(topology) > 0, rng.uniform(0.1, 1.0, (n, n)), 0.0)
    band /= band.sum(axis=1, keepdims=True)
    if topology.kind != "rank_one_plus_band":
        return MarkovChain(topology, start / start.sum(), band)
    leave = rng.uniform(0.1, 0.6, n)
    return MarkovChain(topology, start / start.sum(), band * (1 - leave[:, None]), leave, rng.dirichlet(np.ones(n)))


def symbols_and(fields: dict[str, Any]) -> tuple[CategoricalHMM, Any, NDArray[Any]]:
    rng = np.random.default_rng(1)
    chain = random_chain(fields, rng)
    emission = rng.dirichlet(np.ones(NUM_SYMBOLS), chain.num_states)
    peer = hmmlearn.CategoricalHMM(chain.num_states)
    peer.emissionprob_, peer.n_features = emission, NUM_SYMBOLS
    X = rng.integers(0, NUM_SYMBOLS, sum(LENGTHS)).astype(np.int32)
    return CategoricalHMM.from_model(DiscreteHmm(chain, emission)), peer, X


def frames_and(fields: dict[str, Any], num_mixtures: int) -> tuple[GMMHMM, Any, NDArray[Any]]:
    rng = np.random.default_rng(2)
    chain = random_chain(fields, rng)
    n = chain.num_states
    weights = rng.dirichlet(np.full(num_mixtures, 3.0), n)
    means = rng.normal(0, 2, (n, num_mixtures, DIM))
    variances = rng.uniform(0.5, 2.0, (n, num_mixtures, DIM))
    model = GaussianMixtureHmm(chain, weights, means.reshape(-1, DIM), variances.reshape(-1, DIM))
    X = rng.normal(0, 2, (sum(LENGTHS), DIM)).astype(np.float32)
    if num_mixtures == 1:
        peer = hmmlearn.GaussianHMM(n, "diag")
        peer.n_features, peer.means_, peer.covars_ = DIM, means[:, 0], variances[:, 0]
        return GaussianHMM.from_model(model), peer, X
    peer = hmmlearn.GMMHMM(n, num_mixtures, covariance_type="diag")
    peer.n_features, peer.weights_, peer.means_, peer.covars_ = DIM, weights, means, variances
    return GMMHMM.from_model(model), peer, X


@pytest.mark.parametrize("fields", TOPOLOGIES)
@pytest.mark.parametrize("kind", ["symbols", "gaussian", "mixture"])
def test_states_are_hmmlearns(fields: dict[str, Any], kind: str) -> None:
    ours, peer, X = symbols_and(fields) if kind == "symbols" else frames_and(fields, 1 if kind == "gaussian" else 3)
    peer.startprob_, peer.transmat_ = ours.startprob_, ours.transmat_
    # In double, as hmmlearn takes frames in the precision they have.
    column = X[:, None] if kind == "symbols" else X.astype(np.float64)
    log_prob, posteriors = ours.score_samples(X, LENGTHS)
    expected, rows = peer.score_samples(column, LENGTHS)
    assert log_prob == pytest.approx(expected, rel=1e-9)
    assert (posteriors.dtype, posteriors.shape) == (np.float64, rows.shape)
    np.testing.assert_allclose(posteriors, rows, rtol=1e-7, atol=1e-10)
    np.testing.assert_array_equal(ours.predict_proba(X, LENGTHS), posteriors)

    for end, length in zip(np.cumsum(LENGTHS), LENGTHS, strict=True):
        part = slice(end - length, end)
        both = ours.model_.forward_backward(X[part])
        assert isinstance(both, ForwardBackward)
        log_b = peer._compute_log_likelihood(column[part])
        total, forward = _hmmc.forward_log(peer.startprob_, peer.transmat_, log_b)
        assert both.log_likelihood == pytest.approx(total, rel=1e-9)
        np.testing.assert_allclose(both.log_forward, forward, rtol=1e-9)
        backward = _hmmc.backward_log(peer.startprob_, peer.transmat_, log_b)
        np.testing.assert_allclose(both.log_backward, backward, rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(
            np.exp(both.log_forward + both.log_backward - both.log_likelihood), posteriors[part], atol=1e-9
        )


def test_impossible_sequences_have_no_posteriors() -> None:
    chain = MarkovChain(Topology(num_states=2), [1.0, 0.0], [[0.5, 0.5], [0.0, 1.0]])
    model = CategoricalHMM.from_model(DiscreteHmm(chain, [[1.0, 0.0], [0.0, 1.0]]))
    with pytest.raises(InvalidArgument, match="sequence 1 is impossible"):
        model.score_samples([0, 1, 1, 0], [2, 2])
    with pytest.raises(InvalidArgument, match="impossible"):
        model.predict_proba([1, 0])
    both = model.model_.forward_backward(np.array([1, 0]))
    assert both.log_likelihood == -np.inf and not np.isnan(both.log_backward).any()
    log_likelihood, posteriors = model.model_.state_posteriors(np.array([1, 0]))
    assert log_likelihood == -np.inf and not posteriors.any()


def test_wrong_sequences_are_named() -> None:
    ours, _, X = symbols_and(TOPOLOGIES[0])
    for method in (ours.model_.forward_backward, ours.model_.state_posteriors):
        with pytest.raises(InvalidArgument, match="position 1"):
            method(np.array([0, NUM_SYMBOLS]))
        with pytest.raises(InvalidArgument, match="empty"):
            method(X[:0])
    frames, _, rows = frames_and(TOPOLOGIES[0], 2)
    bad = rows.copy()
    bad[3, 1] = np.nan
    with pytest.raises(InvalidArgument, match=r"\[3, 1\]"):
        frames.score_samples(bad)
    for wrong in (bad, rows[:, :2], rows[:0]):
        with pytest.raises(InvalidArgument):
            frames.model_.forward_backward(wrong)


def possibilities_in_numpy(
    start: NDArray[Any], transition: NDArray[Any], b: NDArray[Any], join: Any
) -> tuple[NDArray[Any], NDArray[Any]]:
    """phi and gamma (eq. 4.10-4.11, 4.15-4.16) in plain possibilities."""
    phi, gamma = np.ones_like(b), np.ones_like(b)
    phi[0] = join(start, b[0])
    for t in range(1, len(b)):
        phi[t] = join(join(phi[t - 1][:, None], transition).max(axis=0), b[t])
    for t in range(len(b) - 1, 0, -1):
        gamma[t - 1] = join(transition, join(b[t], gamma[t])[None, :]).max(axis=1)
    return phi, gamma


@pytest.mark.parametrize("fields", TOPOLOGIES)
@pytest.mark.parametrize("conjunction", ["product", "min"])
def test_possibilities_of_states_are_those_of_the_recursions_in_numpy(fields: dict[str, Any], conjunction: str) -> None:
    rng = np.random.default_rng(3)
    chains = [random_chain(fields, rng) for _ in range(3)]
    models = [DiscreteHmm(c, rng.dirichlet(np.full(NUM_SYMBOLS, 0.5), c.num_states)) for c in chains]
    found = PossibilisticHmmSet(models, PossibilisticRule(conjunction=conjunction, conditioned=False))
    join = np.multiply if conjunction == "product" else np.minimum
    symbols = rng.integers(0, NUM_SYMBOLS, 40).astype(np.int32)
    for c in range(3):
        states = found.state_possibilities(c, symbols)
        phi, gamma = possibilities_in_numpy(found.start(c), found.transition(c), found.emission(c)[:, symbols].T, join)
        both = join(phi, gamma)
        whole = found.viterbi(c, symbols)[0]
        assert states.log_possibility == pytest.approx(whole, rel=1e-12)
        np.testing.assert_allclose(both.max(axis=1), np.exp(whole), rtol=1e-11)
        np.testing.assert_allclose(np.exp(states.log_forward), phi, rtol=1e-11)
        np.testing.assert_allclose(np.exp(states.log_backward), gamma, rtol=1e-11)
        assert (states.possibility.dtype, states.possibility.shape) == (np.float64, (40, fields["num_states"]))
        np.testing.assert_allclose(states.possibility, both / both.max(axis=1, keepdims=True), rtol=1e-10, atol=1e-300)
        assert (states.possibility.max(axis=1) == 1).all()
        others = np.sort(states.possibility, axis=1)[:, -2]
        np.testing.assert_allclose(states.necessity.max(axis=1), 1 - others)
        assert ((states.necessity > 0).sum(axis=1) <= 1).all()


def test_possibilities_of_states_by_label() -> None:
    rng = np.random.default_rng(4)
    words = [np.repeat(order, rng.integers(3, 9, 3)) for order in ((0, 1, 2), (2, 1, 0)) for _ in range(10)]
    labels = ["abc"] * 10 + ["cba"] * 10
    model = PTBHMM(topology={"num_states": 3}, emission_floor=0.01).fit(words, labels)
    states = model.state_possibilities(words[0], "abc")
    assert isinstance(states, StatePossibilities)
    score, path = model.decode(words[0], "abc")
    assert states.log_possibility == pytest.approx(score, rel=1e-12)
    np.testing.assert_array_equal(states.possibility.argmax(axis=1), path)
    # Every symbol belongs to one state.
    assert states.necessity.max(axis=1).min() > 0.9
    with pytest.raises(InvalidArgument, match="no class"):
        model.state_possibilities(words[0], "xyz")
    for wrong in ([], [0.5], [[0, 1]]):
        with pytest.raises(InvalidArgument, match="symbols"):
            model.state_possibilities(wrong, "abc")
    with pytest.raises(InvalidArgument, match="position 1"):
        model.state_possibilities([0, 3], "abc")
    minimum = PTBHMM(topology={"num_states": 3}, rule={"conjunction": "min"}).fit(words, labels)
    with pytest.raises(InvalidArgument, match="concentration"):
        minimum.state_possibilities(words[0], "abc")


def test_possibilities_of_states_of_frames() -> None:
    frames, _, rows = frames_and(TOPOLOGIES[0], 2)
    found = PossibilisticGaussianHmmSet([frames.model_, frames.model_])
    states = found.state_possibilities(1, rows)
    assert states.log_possibility == pytest.approx(found.viterbi(1, rows)[0], rel=1e-12)
    assert (states.possibility.max(axis=1) == 1).all()
    bad = rows.copy()
    bad[5, 0] = np.inf
    for wrong in (bad, rows[:, :2], rows[:0]):
        with pytest.raises(InvalidArgument):
            found.state_possibilities(0, wrong)
        with pytest.raises(InvalidArgument):
            found.viterbi(0, wrong)
