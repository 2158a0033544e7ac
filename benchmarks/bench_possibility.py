# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Possibility-theory HMMs against classical ones of ours, and 16-bit integers against floats."""

from __future__ import annotations

import numpy as np

from hri.models import DiscreteHmm, FixedPointHmmSet, MarkovChain, PossibilisticHmmSet, Topology
from timing import Bench, Details, Timed, medians

# So few that tables stay in the cache, which is not what the slope is about.
FEW_SYMBOLS = 16
CODEBOOK = 128
SIZES = (4, 8, 16, 32, 64, 128, 256)
NUM_CLASSES = 16


def _models(kind: str, num_states: int, num_classes: int, num_symbols: int) -> list[DiscreteHmm]:
    rng = np.random.default_rng(num_states)
    topology = Topology(kind=kind, num_states=num_states)
    chain = MarkovChain.initial(topology)
    if kind == "ergodic":
        start, transition = rng.dirichlet(np.ones(num_states)), rng.dirichlet(np.ones(num_states), num_states)
        chain = MarkovChain(topology, start, transition)
    emissions = 0.9 * rng.dirichlet(np.ones(num_symbols), (num_classes, num_states)) + 0.1 / num_symbols
    return [DiscreteHmm(chain, emission) for emission in emissions]


def _symbols(count: int, num_symbols: int) -> np.ndarray:
    return np.random.default_rng(5).integers(0, num_symbols, count).astype(np.int32)


def _check(found: PossibilisticHmmSet, symbols: np.ndarray) -> None:
    # The product form is the best path of the models it was made of, but for what all classes share.
    best = np.array([model.viterbi(symbols)[0] for model in found.models])
    scores = found.log_possibilities(symbols)
    assert np.allclose(scores - scores.max(), best - best.max(), atol=1e-3 * abs(best.max()))


def _scaling(num_classes: int, kind: str) -> tuple[float, float, Details]:
    """Seconds a class of both at 64 states, and of all sizes."""
    symbols = _symbols(1000, FEW_SYMBOLS)
    hmm, possibilistic, integers = [], [], []
    for num_states in SIZES:
        dense = _models("ergodic", num_states, 1, FEW_SYMBOLS)[0]
        found = PossibilisticHmmSet(_models(kind, num_states, num_classes, FEW_SYMBOLS))
        fixed = FixedPointHmmSet(found)
        _check(found, symbols)
        integers.append(
            medians(lambda fixed=fixed: fixed.log_possibilities(symbols), lambda: None, 31)[0] / num_classes
        )
        ours, peer = medians(
            lambda found=found: found.log_possibilities(symbols),
            lambda dense=dense: dense.log_likelihood(symbols),
            repeats=31,
        )
        hmm.append(peer)
        possibilistic.append(ours / num_classes)

    def top_slope(seconds: list[float]) -> float:
        return float(np.polyfit(np.log(SIZES[-3:]), np.log(seconds[-3:]), 1)[0])

    at = SIZES.index(64)
    details: Details = {
        "num_states": list(SIZES),
        "hmm_dense_us": [1e6 * s for s in hmm],
        "ptbhmm_us": [1e6 * s for s in possibilistic],
        "ptbhmm_int16_us": [1e6 * s for s in integers],
        "hmm_dense_slope": top_slope(hmm),
        "ptbhmm_slope": top_slope(possibilistic),
        "ptbhmm_int16_slope": top_slope(integers),
    }
    return possibilistic[at], hmm[at], details


def ptbhmm_scaling() -> Timed:
    """A model of 64 left-right states, of 16 scored together: 1000 symbols, beside a dense HMM of as many states."""
    return _scaling(NUM_CLASSES, "left_right")


def ptbhmm_scaling_one() -> Timed:
    """The same with a single model."""
    return _scaling(1, "left_right")


def ptbhmm_scaling_jumps() -> Timed:
    """The same for a band and rank-one jumps, of 16 scored together."""
    return _scaling(NUM_CLASSES, "rank_one_plus_band")


def ptbhmm_set1000() -> Timed:
    """An utterance of 1 s (100 symbols) against 1000 word models of 8 states, beside as many HMMs of that topology."""
    models = _models("left_right", 8, 1000, CODEBOOK)
    found = PossibilisticHmmSet(models)
    symbols = _symbols(100, CODEBOOK)
    _check(found, symbols)
    return medians(
        lambda: found.log_possibilities(symbols),
        lambda: [model.log_likelihood(symbols) for model in models],
        repeats=51,
    )


def _int16(num_states: int, num_classes: int, num_frames: int) -> Timed:
    found = PossibilisticHmmSet(_models("left_right", num_states, num_classes, CODEBOOK))
    fixed = FixedPointHmmSet(found)
    symbols = _symbols(num_frames, CODEBOOK)
    return medians(lambda: fixed.log_possibilities(symbols), lambda: found.log_possibilities(symbols), repeats=201)


def ptbhmm_int16() -> Timed:
    """1000 of 128 symbols against 32 models of 64 left-right states in 16-bit integers, beside float32."""
    shapes = {"32 x 64 states": (64, 32), "1000 x 8 states": (8, 1000), "10 x 8 states": (8, 10)}
    details: Details = {}
    for name, (num_states, num_classes) in shapes.items():
        ours, peer = _int16(num_states, num_classes, 100)
        details[f"1 s, {name}"] = peer / ours
    return *_int16(64, 32, 1000), details


BENCHES = [
    Bench("ptbhmm_scaling", ptbhmm_scaling, "own dense HMM"),
    Bench("ptbhmm_scaling_one", ptbhmm_scaling_one, "own dense HMM"),
    Bench("ptbhmm_scaling_jumps", ptbhmm_scaling_jumps, "own dense HMM"),
    Bench("ptbhmm_set1000", ptbhmm_set1000, "own HMMs, one by one"),
    Bench("ptbhmm_int16", ptbhmm_int16, "own float32"),
]
