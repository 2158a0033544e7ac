# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Digits said and signed at once by unseen people, under conditions good and bad, fused by fixed and learned rules.

All is nested: learned rules see decisions that inner folds of the training persons held out, by recognisers that did
not meet them; which rule is "chosen" follows from other inner folds of the same pairs.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from hri.datasets.folds import split_by_person
from hri.fusion import KINDS, CombiningRule, LearnedFusion, fuse
from hri.recognition import Decision
from hri.studies.fusion_pairs import (
    TEST_EXPOSURE,
    TRAIN_EXPOSURES,
    TRAIN_SNRS_DB,
    Pair,
    Signs,
    Speech,
    paired,
    plan_test,
    plan_training,
)
from hri.studies.registry import GESTURE_SOURCES, WORD_SOURCES, Layout, Progress, Study
from hri.studies.tables import Row, statistics

NUM_FOLDS = 3
NUM_INNER = 2
SEED = 0
FEW_PERSONS = 5
SIGNERS: dict[str, int | None] = {f"{FEW_PERSONS} signers": FEW_PERSONS, "all signers": None}
"""How many persons signs are learned from: a laboratory has a handful."""
FIXED = ("table_6_9", "product", "dempster_shafer")
LEARNED = tuple(f"learned {kind.replace('_', ' ')}" for kind in KINDS)
CHOSEN = "chosen"
SINGLE = ("speech", "gesture")
CONDITIONS: dict[str, tuple[float | None, str, str]] = {
    "clean": (None, "bright", "both"),
    "speech at 20 dB": (20.0, "bright", "both"),
    "speech at 10 dB": (10.0, "bright", "both"),
    "speech at 0 dB": (0.0, "bright", "both"),
    "dark": (None, "test", "both"),
    "speech at 10 dB, dark": (10.0, "test", "both"),
    "no sign": (None, "", "both"),
    "no word": (None, "bright", "gesture alone"),
    "contradicting, speech at 0 dB is wrong": (0.0, "bright", "gesture"),
    "contradicting, dark sign is wrong": (None, "test", "speech"),
}
"""SNR of the speech (None: as recorded), light of the sign ("": none), and which mode means the digit."""
LOSS, GAIN, CEILING = 0.005, 0.03, 0.95

Rule = str | CombiningRule


def _best(decision: Any) -> str:
    """The best label, whether or not it was rejected."""
    return str(decision.nbest[0].label) if decision.nbest else ""


def _share(rule: Rule, pairs: Sequence[Pair], without: str = "") -> float:
    """How many pairs the rule is right about; `without` a mode, the other is alone."""
    given = [
        (None if without == "speech" else p.speech, None if without == "gesture" else p.gesture, p.truth) for p in pairs
    ]
    return float(np.mean([_best(fuse(speech, gesture, rule=rule)) == truth for speech, gesture, truth in given]))


def _rules(pairs: Sequence[Pair]) -> dict[str, Rule]:
    """The fixed rules, and those learned from these pairs."""
    speech, gesture, truth = ([getattr(p, name) for p in pairs] for name in ("speech", "gesture", "truth"))
    learned = {
        name: LearnedFusion(kind, SEED).fit_decisions(speech, gesture, truth)
        for name, kind in zip(LEARNED, KINDS, strict=True)
    }
    return {**{rule: rule for rule in FIXED}, **learned}


def _choose(parts: Sequence[Sequence[Pair]]) -> tuple[str, dict[str, float]]:
    """The rule that is right most often about each part, learned from the others; how often each is."""
    shares: dict[str, list[float]] = {}
    for number, held_out in enumerate(parts):
        others = [pair for i, part in enumerate(parts) if i != number for pair in part]
        for name, rule in _rules(others).items():
            shares.setdefault(name, []).append(_share(rule, held_out))
    means = {name: float(np.mean(values)) for name, values in shares.items()}
    return max(means, key=lambda name: means[name]), means


def _measured(pairs: Sequence[Pair], rules: dict[str, Rule], chosen: str, condition: str) -> dict[str, float]:
    _, light, means = CONDITIONS[condition]
    without = "gesture" if not light else "speech" if means == "gesture alone" else ""
    single = {
        mode: float(np.mean([_best(getattr(p, mode)) == p.truth for p in pairs])) for mode in SINGLE if mode != without
    }
    fused = {name: _share(rule, pairs, without) for name, rule in rules.items()}
    return {**single, **fused, CHOSEN: fused[chosen]}


def _fold(speech: Speech, signs: Signs, said: Any, seen: Any, seed: int, progress: Progress) -> dict[str, Any]:
    """What one fold finds: for every number of signers its accuracies by condition and rule, and the choice."""
    inner_said = split_by_person([speech.samples[i].person for i in said.train], NUM_INNER, seed)
    inner_seen = split_by_person([signs.samples[i].person for i in seen.train], NUM_INNER, seed)
    parts = []
    for number, (word_part, sign_part) in enumerate(zip(inner_said, inner_seen, strict=True)):
        words = speech.trained([said.train[i] for i in word_part.train])
        shown = [seen.train[i] for i in sign_part.test]
        held_out = [said.train[i] for i in word_part.test]
        plan = plan_training(speech, words, held_out, signs, shown, seed * NUM_INNER + number)
        parts.append((plan, [seen.train[i] for i in sign_part.train]))
        progress(f"fold {seed + 1}: held out within training", number + 1, NUM_INNER + 1)
    words = speech.trained(said.train)
    progress(f"fold {seed + 1}: trained", NUM_INNER + 1, NUM_INNER + 1)
    heard: dict[float | None, dict[int, Decision]] = {None: {i: speech.clean(words, i) for i in said.test}}
    for ratio_db in sorted({snr for snr, _, _ in CONDITIONS.values() if snr is not None}):
        heard[ratio_db] = {i: speech.noisy(words, i, seed, ratio_db)[0] for i in said.test}
    found: dict[str, Any] = {}
    for name, num_persons in SIGNERS.items():
        inner = [paired(plan, signs, signs.trained(train, num_persons, seed)) for plan, train in parts]
        chosen, shares = _choose(inner)
        rules = _rules([pair for part in inner for pair in part])
        recognizer = signs.trained(seen.train, num_persons, seed)
        accuracy = {}
        for condition, (snr_db, light, means) in CONDITIONS.items():
            kind = means if means in SINGLE else "both"
            plan = plan_test(heard[snr_db], speech, signs, seen.test, light or "bright", kind, seed)
            accuracy[condition] = _measured(paired(plan, signs, recognizer), rules, chosen, condition)
        found[name] = {"accuracy": accuracy, "chosen": chosen, "inner": shares}
        progress(f"fold {seed + 1}: fused, {name}", len(found), len(SIGNERS))
    return found


def _verdict(rows: Sequence[Row]) -> dict[str, Any]:
    """For every rule the least gain over the better single mode, and where it misses which part of the target."""
    result: dict[str, Any] = {}
    mean = {(r["signs learned from"], r["condition"], r["decided by"]): r["accuracy_mean"] for r in rows}
    places = list(dict.fromkeys(key[:2] for key in mean))
    for rule in (*FIXED, *LEARNED, CHOSEN):
        gains, lost, short = {}, [], []
        for place in places:
            better = max(mean.get((*place, mode), 0.0) for mode in SINGLE)
            gains[place] = mean[*place, rule] - better
            if gains[place] < -LOSS - 1e-9:
                lost.append(", ".join(place))
            if CONDITIONS[place[1]][2] == "both" and CONDITIONS[place[1]][1] and better < CEILING:
                short += [", ".join(place)] if gains[place] < GAIN - 1e-9 else []
        result[rule] = {
            "least_gain": min(gains.values()),
            "mean_gain": float(np.mean(list(gains.values()))),
            "below_better_mode": lost,
            "gain_too_small": short,
            "passed": not lost and not short,
        }
    return result


def _recommended(inner: Sequence[dict[str, float]]) -> str:
    """The rule that is right most often in the inner folds of all folds and numbers of signers."""
    return max(inner[0], key=lambda name: sum(shares[name] for shares in inner))


def _run(data_dir: Path, progress: Progress, *, folds: int | None = None) -> dict[str, Any]:
    speech, signs = Speech(data_dir, progress), Signs(data_dir, SEED, progress)
    said = split_by_person([s.person for s in speech.samples], NUM_FOLDS, SEED)
    seen = split_by_person([s.person for s in signs.samples], NUM_FOLDS, SEED)
    found = [
        _fold(speech, signs, word_fold, sign_fold, number, progress)
        for number, (word_fold, sign_fold) in enumerate(zip(said, seen, strict=True))
        if folds is None or number < folds
    ]
    rows: list[Row] = []
    for signers in SIGNERS:
        for condition in CONDITIONS:
            by_fold = [fold[signers]["accuracy"][condition] for fold in found]
            rows += [
                {
                    "signs learned from": signers,
                    "condition": condition,
                    "decided by": by,
                    **statistics({f"fold {i + 1}": values[by] for i, values in enumerate(by_fold)}),
                }
                for by in by_fold[0]
            ]
    verdict = _verdict(rows)
    return {
        "seed": SEED,
        "train_snrs_db": TRAIN_SNRS_DB,
        "train_exposures": TRAIN_EXPOSURES,
        "test_exposure": TEST_EXPOSURE,
        "rows": rows,
        "rules": verdict,
        "recommended": _recommended([fold[s]["inner"] for fold in found for s in SIGNERS]),
        "chosen": {s: [fold[s]["chosen"] for fold in found] for s in SIGNERS},
        "inner": {s: [fold[s]["inner"] for fold in found] for s in SIGNERS},
        "passed": verdict[CHOSEN]["passed"],
    }


STUDIES = (
    Study(
        "fusion-conditions",
        "spoken digits of unseen speakers with signed digits of unseen persons: clean, in noise, in the dark, with one "
        "mode missing, and contradicting each other; table 6.9, fixed and learned rules",
        ("commands", "sign_digits", "noise"),
        f"the rule chosen within training is never more than {100 * LOSS:g} points below the better mode, and "
        f"{100 * GAIN:g} points above it where both modes mean the same and it is below {100 * CEILING:g} %",
        _run,
        layout=Layout(columns="decided by"),
        sources=tuple(
            dict.fromkeys(
                (
                    *WORD_SOURCES,
                    *GESTURE_SOURCES,
                )
            )
        ),
        folds=True,
    ),
)
