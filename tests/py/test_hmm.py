# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""HMMs of all four topologies against hmmlearn; streams and the choice of the number of states from Python."""

from __future__ import annotations

import logging

import numpy as np
import pytest

from hri.core.errors import InvalidArgument
from hri.models import (
    DiscreteHmm,
    DiscreteHmmOptions,
    DiscreteHmmStream,
    GaussianMixtureHmm,
    GaussianMixtureHmmOptions,
    GaussianMixtureHmmStream,
    MarkovChain,
    StateChoiceOptions,
    Topology,
    choose_num_states,
    initial_start,
    initial_transition,
)

hmmlearn = pytest.importorskip("hmmlearn.hmm")
logging.getLogger("hmmlearn").setLevel(logging.ERROR)  # it warns of too little data
pytestmark = pytest.mark.filterwarnings("ignore:divide by zero")

NUM_SYMBOLS = 7
DIM = 3
TOPOLOGIES = [
    {"kind": "left_right", "num_states": 5, "max_jump": 1},
    {"kind": "left_right", "num_states": 9, "max_jump": 2},
    {"kind": "banded", "num_states": 6, "max_jump": 1},
    {"kind": "ergodic", "num_states": 5},
    {"kind": "ergodic", "num_states": 17},
    {"kind": "rank_one_plus_band", "num_states": 6, "max_jump": 1},
]


def random_chain(topology: Topology, rng: np.random.Generator) -> MarkovChain:
    """Random values with the zeros and the jumps of the topology."""
    n = topology.num_states
    start = initial_start(topology) * rng.uniform(0.5, 1.0, n)
    start /= start.sum()
    in_band = initial_transition(topology) > 0
    band = np.where(in_band, rng.uniform(0.1, 1.0, (n, n)), 0.0)
    band /= band.sum(axis=1, keepdims=True)
    if topology.kind != "rank_one_plus_band":
        return MarkovChain(topology, start, band)
    leave = rng.uniform(0.1, 0.6, n)
    return MarkovChain(topology, start, band * (1 - leave[:, None]), leave, rng.dirichlet(np.ones(n)))


def discrete_pair(fields: dict, seed: int, implementation: str = "log") -> tuple[DiscreteHmm, object]:
    """The same model here and in hmmlearn, which only has whole matrices."""
    rng = np.random.default_rng(seed)
    chain = random_chain(Topology(**fields), rng)
    emission = rng.dirichlet(np.ones(NUM_SYMBOLS), chain.num_states)
    peer = hmmlearn.CategoricalHMM(chain.num_states, n_iter=1, tol=0, init_params="", implementation=implementation)
    peer.startprob_, peer.transmat_, peer.emissionprob_ = chain.start, chain.transition, emission
    peer.n_features = NUM_SYMBOLS
    return DiscreteHmm(chain, emission), peer


def gaussian_pair(fields: dict, seed: int) -> tuple[GaussianMixtureHmm, object]:
    rng = np.random.default_rng(seed)
    chain = random_chain(Topology(**fields), rng)
    n = chain.num_states
    means, variances = rng.normal(0, 2, (n, DIM)), rng.uniform(0.5, 2.0, (n, DIM))
    # hmmlearn's priors on means and covariances are switched off, so that both maximise likelihood.
    peer = hmmlearn.GaussianHMM(
        n, n_iter=1, tol=0, init_params="", min_covar=0, covars_prior=0, covars_weight=1, means_weight=0
    )
    peer.startprob_, peer.transmat_, peer.n_features = chain.start, chain.transition, DIM
    peer.means_, peer.covars_ = means, variances
    return GaussianMixtureHmm(chain, np.ones((n, 1)), means, variances), peer


def symbols_of(seed: int, *lengths: int) -> list[np.ndarray]:
    rng = np.random.default_rng(seed)
    return [rng.integers(0, NUM_SYMBOLS, length).astype("i4") for length in lengths]


@pytest.mark.parametrize("fields", TOPOLOGIES)
@pytest.mark.parametrize("implementation", ["log", "scaling"])
def test_symbols_score_as_in_hmmlearn(fields: dict, implementation: str) -> None:
    ours, peer = discrete_pair(fields, 1, implementation)
    for symbols in symbols_of(2, 1, 2, 17, 200):
        column = symbols[:, None]
        assert ours.log_likelihood(symbols) == pytest.approx(peer.score(column), rel=1e-9)
        assert ours.log_likelihood_exact(symbols) == pytest.approx(ours.log_likelihood(symbols), rel=1e-12)
        score, path = ours.viterbi(symbols)
        peer_score, peer_path = peer.decode(column)
        assert score == pytest.approx(peer_score, rel=1e-9)
        np.testing.assert_array_equal(path, peer_path)
        np.testing.assert_allclose(ours.posterior(symbols), peer.predict_proba(column), rtol=1e-7, atol=1e-10)


@pytest.mark.parametrize("fields", TOPOLOGIES)
def test_frames_score_as_in_hmmlearn(fields: dict) -> None:
    ours, peer = gaussian_pair(fields, 3)
    for num_frames in (1, 2, 17, 300):
        frames = np.random.default_rng(num_frames).normal(0, 2, (num_frames, DIM)).astype("f4")
        assert ours.log_likelihood_exact(frames) == pytest.approx(peer.score(frames), rel=1e-9)
        assert ours.log_likelihood(frames) == pytest.approx(peer.score(frames), rel=1e-5)
        score, path = ours.viterbi(frames)
        peer_score, peer_path = peer.decode(frames)
        assert score == pytest.approx(peer_score, rel=1e-9)
        np.testing.assert_array_equal(path, peer_path)
        np.testing.assert_allclose(ours.posterior(frames), peer.predict_proba(frames), rtol=1e-7, atol=1e-10)


def assert_chains_agree(ours: MarkovChain, before: MarkovChain, peer: object, moved: np.ndarray) -> None:
    """Ours after a step against hmmlearn's, whose jumps and steps of the band are split by their shares before.

    moved : expected visits of every state but in the last frame of a sequence.
    """
    np.testing.assert_allclose(ours.start, peer.startprob_, rtol=1e-7, atol=1e-12)
    share = np.divide(before.band, before.transition, out=np.zeros_like(before.band), where=before.transition > 0)
    np.testing.assert_allclose(ours.band, peer.transmat_ * share, rtol=1e-7, atol=1e-10)
    if len(ours.leave) == 0:
        return
    jumped = peer.transmat_ * (1 - share)
    np.testing.assert_allclose(ours.leave, jumped.sum(axis=1), rtol=1e-7)
    landed = moved @ jumped
    np.testing.assert_allclose(ours.land, landed / landed.sum(), rtol=1e-7)


@pytest.mark.parametrize("fields", TOPOLOGIES)
def test_a_baum_welch_step_over_symbols_is_hmmlearns(fields: dict) -> None:
    ours, peer = discrete_pair(fields, 4)
    sequences = symbols_of(5, 30, 45, 60)
    moved = sum(ours.posterior(s)[:-1].sum(axis=0) for s in sequences)
    after = ours.retrain(sequences, DiscreteHmmOptions(max_iterations=1, emission_floor=0.0))
    peer.fit(np.concatenate(sequences)[:, None], [len(s) for s in sequences])
    assert_chains_agree(after.chain, ours.chain, peer, moved)
    np.testing.assert_allclose(after.emission, peer.emissionprob_, rtol=1e-7, atol=1e-12)


@pytest.mark.parametrize("fields", TOPOLOGIES)
def test_a_baum_welch_step_over_frames_is_hmmlearns(fields: dict) -> None:
    ours, peer = gaussian_pair(fields, 6)
    # Drawn from the model, as states that are never visited keep what they were here.
    sequences = [peer.sample(length, random_state=length)[0].astype("f4") for length in (40, 50, 60)]
    moved = sum(ours.posterior(s)[:-1].sum(axis=0) for s in sequences)
    options = GaussianMixtureHmmOptions(max_iterations=1, variance_floor=1e-12)
    after = ours.retrain(sequences, options)
    # In double, as hmmlearn squares frames in the precision they have.
    peer.fit(np.concatenate(sequences).astype("f8"), [len(s) for s in sequences])
    assert_chains_agree(after.chain, ours.chain, peer, moved)
    np.testing.assert_allclose(after.means, peer.means_, rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(after.variances, [np.diag(c) for c in peer.covars_], rtol=1e-5, atol=1e-9)


@pytest.mark.parametrize("dtype", ["i1", "u2", "i4", "u4", "i8", ">i4", ">i8"])
def test_symbols_of_any_integer_type_score_alike(dtype: str) -> None:
    ours, _ = discrete_pair(TOPOLOGIES[0], 8)
    (symbols,) = symbols_of(9, 600)
    expected = ours.log_likelihood(symbols)
    assert ours.log_likelihood(symbols.astype(dtype)) == expected
    wide = np.zeros(1200, dtype)
    wide[::2] = symbols
    assert ours.log_likelihood(wide[::2]) == expected
    assert ours.log_likelihood(symbols.astype(dtype)[::-1]) == ours.log_likelihood(symbols[::-1].copy())
    with pytest.raises(InvalidArgument, match="one-dimensional integers"):
        ours.log_likelihood(symbols.astype("f4"))
    with pytest.raises(InvalidArgument, match="one-dimensional integers"):
        ours.log_likelihood(symbols[:, None])


def test_a_symbol_beyond_32_bits_is_out_of_range() -> None:
    ours, _ = discrete_pair(TOPOLOGIES[0], 8)
    with pytest.raises(InvalidArgument, match=r"symbols\[1\] = 4294967296 is out of range"):
        ours.log_likelihood(np.array([0, 2**32]))


def test_streams_are_where_whole_scores_are() -> None:
    models = [discrete_pair(fields, seed)[0] for seed, fields in enumerate(TOPOLOGIES)]
    stream = DiscreteHmmStream(models)
    (symbols,) = symbols_of(10, 50)
    for count, symbol in enumerate(symbols, start=1):
        stream.push(symbol)
        expected = [model.log_likelihood(symbols[:count]) for model in models]
        np.testing.assert_allclose(stream.log_likelihoods(), expected, rtol=1e-12)
    assert stream.num_frames == 50 and stream.num_models == stream.num_active == len(models)
    assert stream.nbest(2) == list(np.argsort(expected)[::-1][:2])
    stream.reset()
    stream.push_all(symbols)
    np.testing.assert_allclose(stream.log_likelihoods(), expected, rtol=1e-12)
    with pytest.raises(InvalidArgument, match="symbol 7 at position 50"):
        stream.push(7)


def test_streams_of_frames_drop_what_falls_below_the_beam() -> None:
    models = [gaussian_pair(fields, seed)[0] for seed, fields in enumerate(TOPOLOGIES)]
    frames = np.random.default_rng(11).normal(0, 2, (80, DIM)).astype("f4")
    whole, pruned = GaussianMixtureHmmStream(models), GaussianMixtureHmmStream(models, beam=20.0)
    for frame in frames:
        whole.push(frame)
    pruned.push_all(frames)
    expected = np.array([model.log_likelihood(frames) for model in models])
    np.testing.assert_allclose(whole.log_likelihoods(), expected, rtol=1e-12)
    kept = pruned.log_likelihoods()
    assert 1 <= pruned.num_active == np.isfinite(kept).sum() < len(models)
    np.testing.assert_array_equal(kept[np.isfinite(kept)], whole.log_likelihoods()[np.isfinite(kept)])
    assert pruned.nbest(1) == whole.nbest(1)
    with pytest.raises(InvalidArgument, match="beam"):
        GaussianMixtureHmmStream(models, beam=-1.0)


@pytest.mark.parametrize("criterion", ["bic", "held_out"])
def test_the_number_of_states_is_found(criterion: str) -> None:
    rng = np.random.default_rng(12)
    lengths = rng.integers(4, 12, (20, 3))
    words = [np.repeat([0, 1, 2], length) for length in lengths]
    curves = [(4.0 * word[:, None] + rng.normal(size=(len(word), 2))).astype("f4") for word in words]
    choice = StateChoiceOptions(criterion=criterion)
    found = choose_num_states(curves, GaussianMixtureHmmOptions(), [1, 2, 3], choice)
    assert found.num_states == 3 and [c.num_states for c in found.candidates] == [1, 2, 3]
    options = DiscreteHmmOptions(num_symbols=3)
    found = choose_num_states(words, options, [1, 2, 3], choice)
    assert found.num_states == 3
    assert max(c.score for c in found.candidates) == found.candidates[2].score
