# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Possibility-theory HMMs from Python: against NumPy, dtypes, shapes, errors, lifetimes, interrupts, threads, files."""

from __future__ import annotations

import gc
import signal
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from conftest import WAIT_S
from hri.core.errors import InvalidArgument
from hri.io import ModelFile
from hri.models import (
    DiscreteHmm,
    FixedPointHmmSet,
    GaussianMixtureHmm,
    GaussianMixtureHmmOptions,
    MarkovChain,
    PossibilisticGaussianHmmSet,
    PossibilisticHmmOptions,
    PossibilisticHmmSet,
    PossibilisticHmmStream,
    PossibilisticRule,
    Topology,
    initial_start,
    initial_transition,
)

NUM_SYMBOLS = 6
DIM = 2
TOPOLOGIES = [
    {"kind": "left_right", "num_states": 4, "max_jump": 1},
    {"kind": "left_right", "num_states": 40, "max_jump": 1},
    {"kind": "left_right", "num_states": 5, "max_jump": 2},
    {"kind": "banded", "num_states": 5, "max_jump": 1},
    {"kind": "ergodic", "num_states": 4},
    {"kind": "rank_one_plus_band", "num_states": 6, "max_jump": 1},
]
RULES = [
    {"conjunction": "product"},
    {"conjunction": "min"},
    {"conjunction": "min", "concentration": 1.0},
    {"conjunction": "min", "concentration": 4.0},
    {"conjunction": "min", "conditioned": False},
]


def random_chain(fields: dict, rng: np.random.Generator) -> MarkovChain:
    topology = Topology(**fields)
    n = topology.num_states
    start = initial_start(topology) * rng.uniform(0.5, 1.0, n)
    band = np.where(initial_transition(topology) > 0, rng.uniform(0.05, 1.0, (n, n)), 0.0)
    band /= band.sum(axis=1, keepdims=True)
    if topology.kind != "rank_one_plus_band":
        return MarkovChain(topology, start / start.sum(), band)
    leave = rng.uniform(0.1, 0.6, n)
    land = rng.dirichlet(np.ones(n))
    return MarkovChain(topology, start / start.sum(), band * (1 - leave[:, None]), leave, land)


def models_of(fields: dict, num_classes: int, seed: int = 1) -> list[DiscreteHmm]:
    rng = np.random.default_rng(seed)
    chains = [random_chain(fields, rng) for _ in range(num_classes)]
    return [DiscreteHmm(c, rng.dirichlet(np.full(NUM_SYMBOLS, 0.3), c.num_states)) for c in chains]


def set_of(num_classes: int = 3, **rule: object) -> PossibilisticHmmSet:
    return PossibilisticHmmSet(models_of(TOPOLOGIES[0], num_classes), PossibilisticRule(**rule))


def symbols_of(length: int, seed: int = 5) -> NDArray[np.int32]:
    return np.random.default_rng(seed).integers(0, NUM_SYMBOLS, length).astype(np.int32)


def log_possibilities(models: list[DiscreteHmm], rule: dict, symbols: NDArray[np.int32]) -> NDArray[np.float64]:
    """The recursion of the header in plain possibilities, from the parameters of the HMMs."""
    largest = np.max([m.emission.max(axis=0) for m in models], axis=0)
    most_start = max(m.chain.start.max() for m in models)
    most_transition = max(m.chain.transition.max() for m in models)
    join: Callable = np.multiply if rule["conjunction"] == "product" else np.minimum
    conditioned = rule["conjunction"] == "min" and rule.get("conditioned", True)
    scores = []
    for model in models:
        chain = model.chain
        s = chain.transition / most_transition
        if len(chain.leave) > 0:  # a jump joins leaving and landing; only product makes that one number
            land = chain.land / chain.land.max()
            leave = chain.leave * chain.land.max() / most_transition
            jump = join(leave[:, None], land[None, :])
            s = np.maximum(np.where(initial_transition(chain.topology) > 0, s, 0.0), jump)
        phi, log_scale = chain.start / most_start, 0.0
        for t, symbol in enumerate(symbols):
            came = phi if t == 0 else join(phi[:, None], s).max(axis=0)
            b = model.emission[:, symbol] / largest[symbol]
            if conditioned:
                log_scale += np.log(b.max())
                b = b / b.max()
                came = np.where(b < 1, came ** rule.get("concentration", 1.5), came)
            phi = join(came, b)
            if conditioned:
                log_scale += np.log(phi.max())
                phi = phi / phi.max()
        scores.append(np.log(phi.max()) + log_scale)
    return np.array(scores)


@pytest.mark.parametrize("fields", TOPOLOGIES)
@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("num_classes", [2, 20])
def test_scores_are_those_of_the_recursion_in_numpy(fields: dict, rule: dict, num_classes: int) -> None:
    models = models_of(fields, num_classes)
    possible = PossibilisticHmmSet(models, PossibilisticRule(**rule))
    for length in (1, 2, 5, 25):
        symbols = symbols_of(length)
        expected = log_possibilities(models, rule, symbols)
        np.testing.assert_allclose(possible.log_possibilities_exact(symbols), expected, rtol=1e-12, atol=1e-12)
        np.testing.assert_allclose(possible.log_possibilities(symbols), expected, rtol=2e-6, atol=1e-5)
        best = [possible.viterbi(c, symbols)[0] for c in range(num_classes)]
        np.testing.assert_allclose(best, expected, rtol=1e-12, atol=1e-12)


def test_jumps_score_as_the_same_numbers_in_an_ergodic_model() -> None:
    jumping = models_of({"kind": "rank_one_plus_band", "num_states": 6, "max_jump": 1}, 5)
    topology = Topology(kind="ergodic", num_states=6)
    chains = [MarkovChain(topology, m.chain.start, m.chain.transition) for m in jumping]
    dense = [DiscreteHmm(c, m.emission) for c, m in zip(chains, jumping, strict=True)]
    for length in (1, 2, 40):
        symbols = symbols_of(length)
        expected = PossibilisticHmmSet(dense).log_possibilities_exact(symbols)
        found = PossibilisticHmmSet(jumping).log_possibilities_exact(symbols)
        np.testing.assert_allclose(found, expected, rtol=1e-12)


def test_results_have_their_dtypes_and_shapes() -> None:
    possible = set_of()
    symbols = symbols_of(9)
    for scores in (possible.log_possibilities(symbols), FixedPointHmmSet(possible).log_possibilities(symbols)):
        assert (scores.dtype, scores.shape) == (np.float32, (3,))
    exact = possible.log_possibilities_exact(symbols)
    assert (exact.dtype, exact.shape) == (np.float64, (3,))
    possibility, necessity = possible.classify(symbols)
    assert (possibility.dtype, possibility.shape) == (necessity.dtype, necessity.shape) == (np.float32, (3,))
    assert possibility.max() == 1.0
    np.testing.assert_allclose(possibility, np.exp(exact - exact.max()), rtol=1e-5)
    best = int(np.argmax(possibility))
    assert necessity[best] == pytest.approx(1 - np.delete(possibility, best).max(), abs=1e-6)
    score, path = possible.viterbi(1, symbols)
    assert (type(score), path.dtype, path.shape) == (float, np.int32, (9,))
    assert possible.start(0).shape == (4,)
    assert possible.transition(0).shape == (4, 4)
    assert possible.emission(0).shape == (4, NUM_SYMBOLS)
    assert (possible.num_classes, possible.num_states, possible.num_symbols) == (3, 4, NUM_SYMBOLS)
    assert possible.topology.kind == "left_right"
    assert [m.num_states for m in possible.models] == [4, 4, 4]


@pytest.mark.parametrize("dtype", ["i1", "u2", "i4", "<i8", ">i8", "u8"])
def test_symbols_are_integers_of_any_kind(dtype: str) -> None:
    possible = set_of()
    symbols = symbols_of(20)
    expected = possible.log_possibilities(symbols)
    np.testing.assert_array_equal(possible.log_possibilities(symbols.astype(dtype)), expected)
    np.testing.assert_array_equal(possible.log_possibilities(np.repeat(symbols, 2).astype(dtype)[::2]), expected)


def test_bad_input_is_refused_by_name() -> None:
    possible = set_of()
    fixed = FixedPointHmmSet(possible)
    sets = (possible.log_possibilities, possible.log_possibilities_exact, possible.classify, fixed.log_possibilities)
    for scores in sets:
        with pytest.raises(InvalidArgument, match="symbol 6 at position 2"):
            scores(np.array([0, 1, 6]))
        with pytest.raises(InvalidArgument, match="symbol -1 at position 0"):
            scores(np.array([-1]))
        with pytest.raises(InvalidArgument, match="integers"):
            scores(np.array([0.0, 1.0]))
        with pytest.raises(InvalidArgument, match="one-dimensional"):
            scores(np.zeros((2, 2), int))
        with pytest.raises(InvalidArgument, match="symbols"):
            scores(np.array([], int))
        with pytest.raises(InvalidArgument, match="out of range"):
            scores(np.array([2**40]))
    one = symbols_of(1)
    for action in (possible.start, possible.transition, possible.emission, lambda c: possible.viterbi(c, one)):
        for class_index in (-1, 3):
            with pytest.raises(InvalidArgument, match="class_index"):
                action(class_index)
    with pytest.raises(InvalidArgument, match="at least one model"):
        PossibilisticHmmSet([])
    with pytest.raises(InvalidArgument, match="same topology"):
        PossibilisticHmmSet(models_of(TOPOLOGIES[0], 1) + models_of(TOPOLOGIES[3], 1))
    with pytest.raises(InvalidArgument, match="same topology"):
        possible.with_class(models_of(TOPOLOGIES[4], 1)[0])
    with pytest.raises(InvalidArgument, match="product"):
        FixedPointHmmSet(set_of(conjunction="min"))
    for beam in (0.0, -1.0, np.nan):
        with pytest.raises(InvalidArgument, match="beam"):
            PossibilisticHmmStream(possible, beam=beam)


def test_rules_refuse_what_they_do_not_know() -> None:
    rule = PossibilisticRule(conjunction="min", concentration=2.0)
    assert (rule.conjunction, rule.conditioned, rule.concentration) == ("min", True, 2.0)
    with pytest.raises((TypeError, ValueError), match="conjuction"):
        PossibilisticRule(conjuction="min")
    with pytest.raises((TypeError, ValueError)):
        PossibilisticRule(conjunction="average")
    for concentration in (0.5, 17.0, np.nan, np.inf):
        with pytest.raises(InvalidArgument, match="concentration"):
            PossibilisticRule(conjunction="min", concentration=concentration)


def discrete_options(**fields: object) -> PossibilisticHmmOptions:
    fields = {"topology": Topology(**TOPOLOGIES[0]), "num_symbols": NUM_SYMBOLS, **fields}
    return PossibilisticHmmOptions(**fields)


@pytest.mark.parametrize("training", ["all_paths", "best_path"])
def test_a_trained_class_more_changes_no_other(training: str) -> None:
    data = [[symbols_of(20, 10 * c + i) % (c + 2) for i in range(4)] for c in range(4)]
    options = discrete_options(training=training)
    whole = PossibilisticHmmSet.train(data, options)
    few = PossibilisticHmmSet.train(data[:3], options)
    symbols = symbols_of(12, 77) % 2
    expected = whole.log_possibilities(symbols)
    np.testing.assert_array_equal(few.with_class(data[3], options).log_possibilities(symbols), expected)
    np.testing.assert_array_equal(few.with_class(whole.models[3]).log_possibilities(symbols), expected)
    assert (few.num_classes, whole.num_classes) == (3, 4)
    with pytest.raises(InvalidArgument, match="sequence"):
        few.with_class([], options)
    with pytest.raises(InvalidArgument, match="symbol 9 at position 1"):
        few.with_class([np.array([0, 9])], options)


def long_training(kind: str) -> None:
    rng = np.random.default_rng(0)
    topology = Topology(kind="ergodic", num_states=30)
    if kind == "gaussian":
        options = GaussianMixtureHmmOptions(topology=topology, max_iterations=100000, tolerance=0.0)
        frames = [rng.normal(size=(200, DIM)).astype("f4") for _ in range(20)]
        PossibilisticGaussianHmmSet.train([frames] * 3, options)
        return
    options = discrete_options(topology=topology, training=kind, max_iterations=100000, tolerance=0.0)
    sequences = [symbols_of(300, i) for i in range(50)]
    if kind == "best_path":  # ends by itself where nothing moves: thousands of classes
        PossibilisticHmmSet.train([sequences] * 5000, options)
    else:
        PossibilisticHmmSet.train([sequences] * 3, options)


@pytest.mark.parametrize("kind", ["all_paths", "best_path", "gaussian"])
def test_an_interrupt_ends_the_training(kind: str) -> None:
    started = time.monotonic()
    timer = threading.Timer(0.5, signal.raise_signal, [signal.SIGINT])
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            long_training(kind)
    finally:
        timer.join()
    assert time.monotonic() - started < WAIT_S


def gaussian_set(num_classes: int = 3, **rule: object) -> PossibilisticGaussianHmmSet:
    rng = np.random.default_rng(3)
    models = []
    for _ in range(num_classes):
        chain = random_chain(TOPOLOGIES[0], rng)
        n = chain.num_states
        means, variances = rng.normal(0, 2, (n, DIM)), rng.uniform(0.5, 2.0, (n, DIM))
        models.append(GaussianMixtureHmm(chain, np.ones((n, 1)), means, variances))
    return PossibilisticGaussianHmmSet(models, PossibilisticRule(**rule))


def test_frames_are_scored_by_densities_over_the_largest() -> None:
    possible = gaussian_set()
    frames = np.random.default_rng(4).normal(0, 2, (15, DIM)).astype("f4")
    log_b = np.stack(
        [
            -0.5 * (((frames[:, None] - m.means) ** 2 / m.variances) + np.log(2 * np.pi * m.variances)).sum(axis=2)
            for m in possible.models
        ]
    )
    log_b -= log_b.max(axis=(0, 2), keepdims=True)
    most = max(m.chain.transition.max() for m in possible.models)
    expected = []
    with np.errstate(divide="ignore"):
        for model, b in zip(possible.models, log_b, strict=True):
            s = np.log(model.chain.transition / most)
            phi = np.log(model.chain.start / max(m.chain.start.max() for m in possible.models)) + b[0]
            for row in b[1:]:
                phi = (phi[:, None] + s).max(axis=0) + row
            expected.append(phi.max())
    scores = possible.log_possibilities(frames)
    assert (scores.dtype, scores.shape) == (np.float32, (3,))
    np.testing.assert_allclose(scores, expected, rtol=1e-5, atol=1e-4)
    possibility, necessity = possible.classify(frames)
    assert possibility.max() == 1.0
    assert necessity.shape == (3,)
    assert (possible.num_classes, possible.dim) == (3, DIM)
    assert possible.with_class(possible.models[0]).num_classes == 4
    with pytest.raises(InvalidArgument, match="row"):
        possible.log_possibilities(frames[:0])
    with pytest.raises(InvalidArgument):
        possible.log_possibilities(frames[:, :1])
    frames[3, 1] = np.nan
    with pytest.raises(InvalidArgument):
        possible.log_possibilities(frames)


def test_a_stream_outlives_its_set_and_gives_its_scores() -> None:
    possible = set_of(20)
    symbols = symbols_of(30)
    expected = [possible.log_possibilities(symbols[: t + 1]) for t in range(len(symbols))]
    stream = PossibilisticHmmStream(possible)
    fixed = FixedPointHmmSet(possible)
    rounded = fixed.log_possibilities(symbols)
    del possible
    gc.collect()
    np.testing.assert_array_equal(fixed.log_possibilities(symbols), rounded)
    np.testing.assert_allclose(rounded, expected[-1], atol=len(symbols) / fixed.units)
    np.testing.assert_array_equal(stream.log_possibilities(), np.zeros(20))
    for t, symbol in enumerate(symbols):
        stream.push(int(symbol))
        scores = stream.log_possibilities()
        assert (scores.dtype, scores.shape) == (np.float32, (20,))
        np.testing.assert_array_equal(scores, expected[t])
    assert stream.nbest(3) == list(np.argsort(-expected[-1], kind="stable")[:3])
    assert (stream.num_frames, stream.num_active, stream.num_classes) == (30, 20, 20)
    with pytest.raises(InvalidArgument, match="symbol 6"):
        stream.push(NUM_SYMBOLS)
    with pytest.raises(InvalidArgument, match="count"):
        stream.nbest(0)
    np.testing.assert_array_equal(stream.log_possibilities(), expected[-1])
    stream.reset()
    assert stream.num_frames == 0


def test_threads_share_the_sets() -> None:
    symbol_sets = [set_of(c, conjunction=r) for c in (2, 20, 70) for r in ("product", "min")]
    sequences = [symbols_of(10 + 40 * i, i) for i in range(8)]
    frames = [np.random.default_rng(i).normal(0, 2, (30 + i, DIM)).astype("f4") for i in range(8)]
    jobs: list[tuple[Callable, NDArray]] = [(s.log_possibilities, x) for s in symbol_sets for x in sequences]
    jobs += [(FixedPointHmmSet(s).log_possibilities, x) for s in symbol_sets[::2] for x in sequences]
    gaussian = gaussian_set(20)
    jobs += [(gaussian.log_possibilities, x) for x in frames]
    expected = [action(x) for action, x in jobs]
    with ThreadPoolExecutor(4) as pool:
        for _ in range(5):
            for found, once in zip(pool.map(lambda job: job[0](job[1]), jobs), expected, strict=True):
                np.testing.assert_array_equal(found, once)


@pytest.mark.parametrize("make", [set_of, gaussian_set])
def test_files_give_back_the_set(make: Callable, tmp_path: Path) -> None:
    possible = make(3, conjunction="min", concentration=2.5)
    file = ModelFile()
    possible.write(file, "p.")
    file.write(str(tmp_path / "set.hri"))
    loaded = type(possible).read(ModelFile.read(str(tmp_path / "set.hri")), "p.")
    assert loaded.rule.as_dict() == possible.rule.as_dict()
    x = symbols_of(20) if make is set_of else np.random.default_rng(4).normal(0, 2, (15, DIM)).astype("f4")
    np.testing.assert_array_equal(loaded.log_possibilities(x), possible.log_possibilities(x))
