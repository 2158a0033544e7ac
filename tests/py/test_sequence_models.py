# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Sequence models against hmmlearn, and the Python side of them: dtypes, errors, options, threads."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from hri.core.errors import FormatError, InvalidArgument
from hri.io import ModelFile
from hri.models import (
    DiscreteHmm,
    DiscreteHmmOptions,
    GaussianMixtureHmm,
    GaussianMixtureHmmOptions,
    MarkovChain,
    PossibilisticHmmOptions,
    PossibilisticHmmSet,
    Topology,
    TrainingReport,
    initial_start,
)

hmmlearn = pytest.importorskip("hmmlearn.hmm")

TOPOLOGIES = [
    {"kind": "left_right", "num_states": 5, "max_jump": 1},
    {"kind": "left_right", "num_states": 5, "max_jump": 2},
    {"kind": "banded", "num_states": 4, "max_jump": 1},
    {"kind": "ergodic", "num_states": 4},
    {"kind": "ergodic", "num_states": 1},
]


def random_transition(topology: Topology, rng: np.random.Generator) -> np.ndarray:
    """A row-stochastic matrix with the zeros of the topology."""
    n = topology.num_states
    allowed = np.array([[topology.allows(i, j) for j in range(n)] for i in range(n)])
    weights = np.where(allowed, rng.uniform(0.1, 1.0, (n, n)), 0.0)
    return weights / weights.sum(axis=1, keepdims=True)


def gaussian_pair(topology: Topology, num_mixtures: int, dim: int, seed: int) -> tuple[GaussianMixtureHmm, object]:
    """The same parameters as our model and as hmmlearn's."""
    rng = np.random.default_rng(seed)
    n = topology.num_states
    start = initial_start(topology)
    transition = random_transition(topology, rng)
    weights = rng.dirichlet(np.ones(num_mixtures), n)
    means = rng.normal(0, 2, (n, num_mixtures, dim))
    variances = rng.uniform(0.5, 2.0, (n, num_mixtures, dim))
    chain = MarkovChain(topology, start, transition)
    ours = GaussianMixtureHmm(chain, weights, means.reshape(-1, dim), variances.reshape(-1, dim))
    if num_mixtures == 1:
        peer = hmmlearn.GaussianHMM(n, covariance_type="diag")
        peer.means_, peer.covars_ = means[:, 0], variances[:, 0]
    else:
        peer = hmmlearn.GMMHMM(n, num_mixtures, covariance_type="diag")
        peer.means_, peer.covars_, peer.weights_ = means, variances, weights
    peer.startprob_, peer.transmat_ = start, transition
    peer.n_features = dim
    return ours, peer


@pytest.mark.parametrize("fields", TOPOLOGIES)
@pytest.mark.parametrize("num_mixtures", [1, 3])
@pytest.mark.filterwarnings("ignore:divide by zero")
def test_gaussian_forward_and_viterbi_match_hmmlearn(fields: dict, num_mixtures: int) -> None:
    topology = Topology(**fields)
    for seed, num_frames in enumerate([1, 2, 17, 300]):
        ours, peer = gaussian_pair(topology, num_mixtures, 13, seed)
        frames = np.random.default_rng(seed + 100).normal(0, 2, (num_frames, 13)).astype("f4")
        assert ours.log_likelihood_exact(frames) == pytest.approx(peer.score(frames), rel=1e-9)
        assert ours.log_likelihood(frames) == pytest.approx(peer.score(frames), rel=1e-5)
        score, path = ours.viterbi(frames)
        peer_score, peer_path = peer.decode(frames)
        assert score == pytest.approx(peer_score, rel=1e-9)
        np.testing.assert_array_equal(path, peer_path)


@pytest.mark.parametrize("fields", TOPOLOGIES)
@pytest.mark.filterwarnings("ignore:divide by zero")
def test_discrete_forward_and_viterbi_match_hmmlearn(fields: dict) -> None:
    topology = Topology(**fields)
    rng = np.random.default_rng(1)
    n = topology.num_states
    emission = rng.dirichlet(np.ones(7), n)
    transition = random_transition(topology, rng)
    start = initial_start(topology)
    ours = DiscreteHmm(MarkovChain(topology, start, transition), emission)
    peer = hmmlearn.CategoricalHMM(n)
    peer.startprob_, peer.transmat_, peer.emissionprob_ = start, transition, emission
    peer.n_features = 7
    for num_frames in [1, 2, 17, 300]:
        symbols = rng.integers(0, 7, num_frames)
        assert ours.log_likelihood(symbols) == pytest.approx(peer.score(symbols[:, None]), rel=1e-9)
        score, path = ours.viterbi(symbols)
        peer_score, _ = peer.decode(symbols[:, None])
        assert score == pytest.approx(peer_score, rel=1e-9)
        # Symbols repeat, so several paths can be equally good: ours has to be worth its score.
        along_path = np.log(start[path[0]]) + np.log(transition[path[:-1], path[1:]]).sum()
        assert along_path + np.log(emission[path, symbols]).sum() == pytest.approx(score, rel=1e-9)


@pytest.mark.filterwarnings("ignore:divide by zero")
def test_one_baum_welch_step_matches_hmmlearn() -> None:
    topology = Topology(kind="ergodic", num_states=3)
    rng = np.random.default_rng(2)
    sequences = [rng.integers(0, 5, n).astype("i4") for n in (30, 45, 60)]
    options = DiscreteHmmOptions(
        topology=topology, num_symbols=5, emission_floor=0.0, seed=3, max_iterations=1, tolerance=0
    )
    first = DiscreteHmm.train(sequences, options)
    peer = hmmlearn.CategoricalHMM(3, n_iter=1, init_params="", tol=0)
    peer.startprob_, peer.transmat_ = first.chain.start, first.chain.transition
    peer.emissionprob_ = first.emission
    peer.fit(np.concatenate(sequences)[:, None], [len(s) for s in sequences])
    options.max_iterations = 2
    second = DiscreteHmm.train(sequences, options)
    np.testing.assert_allclose(second.chain.start, peer.startprob_, rtol=1e-9)
    np.testing.assert_allclose(second.chain.transition, peer.transmat_, rtol=1e-9)
    np.testing.assert_allclose(second.emission, peer.emissionprob_, rtol=1e-9)


def test_one_gaussian_baum_welch_step_matches_hmmlearn() -> None:
    rng = np.random.default_rng(4)
    sequences = [rng.normal(0, 1, (n, 3)).astype("f4") for n in (40, 50)]
    options = GaussianMixtureHmmOptions(
        topology={"kind": "ergodic", "num_states": 3}, variance_floor=1e-9, tolerance=0, seed=1
    )
    options.max_iterations = 4
    before = GaussianMixtureHmm.train(sequences, options)
    options.max_iterations = 5
    after = GaussianMixtureHmm.train(sequences, options)
    # hmmlearn's priors on means and covariances are switched off, so that both maximise likelihood.
    peer = hmmlearn.GaussianHMM(
        3, n_iter=1, init_params="", tol=0, min_covar=0, covars_prior=0, covars_weight=1, means_weight=0
    )
    peer.startprob_, peer.transmat_ = before.chain.start, before.chain.transition
    peer.means_, peer.covars_ = before.means, before.variances
    peer.fit(np.concatenate(sequences), [len(s) for s in sequences])
    np.testing.assert_allclose(after.chain.start, peer.startprob_, rtol=1e-7, atol=1e-12)
    np.testing.assert_allclose(after.chain.transition, peer.transmat_, rtol=1e-7)
    np.testing.assert_allclose(after.means, peer.means_, rtol=1e-7)
    variances = np.array([np.diag(c) for c in peer.covars_])
    np.testing.assert_allclose(after.variances, variances, rtol=1e-6)


def test_training_reports_rising_likelihoods() -> None:
    rng = np.random.default_rng(5)
    report = TrainingReport()
    GaussianMixtureHmm.train([rng.normal(size=(50, 4))], report=report)
    assert len(report.log_likelihoods) >= 2
    assert np.all(np.diff(report.log_likelihoods) > -1e-6)


def test_possibilities_match_a_plain_recursion() -> None:
    rng = np.random.default_rng(6)
    per_class = [[rng.integers(0, 4, 20) + 2 * c for _ in range(4)] for c in range(3)]
    options = PossibilisticHmmOptions(topology={"num_states": 4}, num_symbols=8)
    model = PossibilisticHmmSet.train(per_class, options)
    symbols = rng.integers(0, 8, 15)
    scores = model.log_possibilities(symbols)
    assert scores.dtype == np.float32 and scores.shape == (3,)
    for c in range(3):
        phi = np.array([1.0, 0, 0, 0]) * model.emission(c)[:, symbols[0]]
        for o in symbols[1:]:
            phi = model.emission(c)[:, o] * (phi[:, None] * model.transition(c)).max(axis=0)
        assert scores[c] == pytest.approx(np.log(phi.max()), rel=1e-5)


def test_literal_maximum_scores_all_classes_alike() -> None:
    rng = np.random.default_rng(7)
    per_class = [[rng.integers(0, 4, 20) + 2 * c for _ in range(4)] for c in range(3)]
    options = PossibilisticHmmOptions(num_symbols=8, rule={"conjunction": "max"})
    model = PossibilisticHmmSet.train(per_class, options)
    for sequences in per_class:
        for symbols in sequences:
            np.testing.assert_array_equal(model.log_possibilities(symbols), np.zeros(3, "f4"))


def test_float32_frames_are_not_copied_and_other_types_are_converted() -> None:
    ours, _ = gaussian_pair(Topology(num_states=3), 1, 4, 1)
    frames = np.random.default_rng(8).normal(size=(20, 4)).astype("f4")
    expected = ours.log_likelihood(frames)
    assert ours.log_likelihood(frames.astype("f8")) == expected
    assert ours.log_likelihood(np.asfortranarray(frames)) == expected
    wide = np.zeros((20, 8), "f4")
    wide[:, ::2] = frames
    assert ours.log_likelihood(wide[:, ::2]) == expected


def test_bad_input_raises_errors_that_name_it() -> None:
    ours, _ = gaussian_pair(Topology(num_states=3), 1, 4, 1)
    frames = np.zeros((5, 4), "f4")
    frames[3, 2] = np.nan
    with pytest.raises(InvalidArgument, match="row 3, column 2"):
        ours.log_likelihood(frames)
    with pytest.raises(ValueError, match="dimensions"):
        ours.log_likelihood(frames[0])
    with pytest.raises(InvalidArgument, match="sequence 1 is not finite"):
        GaussianMixtureHmm.train([frames[:3], frames])
    options = DiscreteHmmOptions(num_symbols=3)
    with pytest.raises(InvalidArgument, match="symbol 5 at position 1"):
        DiscreteHmm.train([np.array([0, 5])], options)
    with pytest.raises(InvalidArgument, match="integers"):
        DiscreteHmm.train([np.array([0.0, 1.0])], options)
    with pytest.raises(InvalidArgument, match="out of range"):
        DiscreteHmm.train([np.array([0, 2**40])], options)


def test_options_keep_their_defaults_and_refuse_unknown_names() -> None:
    options = GaussianMixtureHmmOptions(num_mixtures=3, topology={"num_states": 9})
    assert options.num_mixtures == 3 and options.topology.num_states == 9
    assert options.max_iterations == GaussianMixtureHmmOptions().max_iterations
    assert GaussianMixtureHmmOptions(**options.as_dict()) == options
    with pytest.raises(TypeError, match="num_mixture'"):
        GaussianMixtureHmmOptions(num_mixture=3)


def test_models_score_the_same_after_a_model_file() -> None:
    ours, _ = gaussian_pair(Topology(num_states=3), 2, 4, 1)
    frames = np.random.default_rng(9).normal(size=(20, 4)).astype("f4")
    file = ModelFile()
    ours.write(file, "word.")
    loaded = GaussianMixtureHmm.read(file, "word.")
    assert loaded.log_likelihood(frames) == ours.log_likelihood(frames)
    with pytest.raises(FormatError):
        GaussianMixtureHmm.read(file, "other.")


def test_threads_score_alike() -> None:
    ours, _ = gaussian_pair(Topology(num_states=5), 3, 13, 1)
    frames = np.random.default_rng(10).normal(size=(400, 13)).astype("f4")
    expected = ours.log_likelihood(frames)
    with ThreadPoolExecutor(4) as pool:
        assert set(pool.map(ours.log_likelihood, [frames] * 40)) == {expected}
