# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Rejection of out-of-vocabulary words and noise: half the words of a data set are never trained."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument
from hri.datasets import Dataset, Fold
from hri.evaluation import make_noise
from hri.evaluation.rejection import equal_error_rate, false_rejects_at
from hri.media import read_audio
from hri.recognition import Decision, WordRecognizer
from hri.recognition.decision import NO_INPUT, RECOGNISED
from hri.studies.noise import noise_paths
from hri.studies.registry import WORD_SOURCES, Layout, Progress, Study, within
from hri.studies.speech import FrontEndKind
from hri.studies.tables import Row, further_statistics, statistics
from hri.studies.word_features import WORD_FOLDERS, load_words

SEED = 0
NUM_HALVES = 3
FALSE_ACCEPTS = (0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5)
"""Of the curve."""
NUM_NOISES = 10
"""Of each kind and recording."""
NOISE_RATE_HZ = 16000
TARGETS = {"fsdd": 0.12, "hindi-digits": 0.08, "hindi-words": 0.08}
TARGETS_EMBEDDED = {"fsdd": 0.06, "hindi-digits": 0.05, "hindi-words": 0.05}
"""Equal error rates."""
MAX_FALSE_ACCEPTS = 0.15
MAX_FALSE_REJECTS = 0.05
"""At the model's own threshold."""

Clip = tuple[NDArray[np.float32], int]


@dataclass(frozen=True)
class Turn:
    """What was decided of one speaker's words: score, or -inf without speech; and whether accepted."""

    known: NDArray[np.float64]
    unknown: NDArray[np.float64]
    known_accepted: NDArray[np.bool_]
    unknown_accepted: NDArray[np.bool_]


def halves(labels: Sequence[str], number: int = NUM_HALVES, seed: int = SEED) -> list[tuple[str, ...]]:
    """Random halves of a vocabulary.

    Raises
    ------
    InvalidArgument
        For fewer than 4 labels: a recogniser needs two.
    """
    if len(labels) < 4:
        raise InvalidArgument(f"half of {len(labels)} words is too few: a recogniser needs two")
    rng = np.random.default_rng(seed)
    return [tuple(sorted(rng.permutation(np.array(labels))[: len(labels) // 2].tolist())) for _ in range(number)]


def noises(paths: dict[str, str], seed: int = SEED) -> dict[str, list[Clip]]:
    """Pieces of a file of noise: a second as it is, and bursts of 0.2 to 0.8 s in silence."""
    rng = np.random.default_rng(seed)
    stationary, bursts = [], []
    for path in paths.values():
        for _ in range(NUM_NOISES):
            stationary.append((make_noise(path, NOISE_RATE_HZ, NOISE_RATE_HZ, rng), NOISE_RATE_HZ))
            clip = 1e-4 * rng.standard_normal(3 * NOISE_RATE_HZ // 2).astype(np.float32)
            length = int(rng.uniform(0.2, 0.8) * NOISE_RATE_HZ)
            clip[4000 : 4000 + length] += make_noise(path, length, NOISE_RATE_HZ, rng)
            bursts.append((clip, NOISE_RATE_HZ))
    return {"noise": stationary, "burst": bursts}


def _score(decision: Decision) -> float:
    return decision.score if decision.nbest else -np.inf


def _test(words: WordRecognizer, dataset: Dataset, clips: Sequence[Clip], fold: Fold, half: Sequence[str]) -> Turn:
    decisions = [words.recognise(*clips[i]) for i in fold.test]
    is_known = np.array([dataset.samples[i].label in half for i in fold.test])
    score = np.array([_score(d) for d in decisions])
    accepted = np.array([d.status == RECOGNISED for d in decisions])
    return Turn(score[is_known], score[~is_known], accepted[is_known], accepted[~is_known])


def _shares(words: WordRecognizer, clips: Sequence[Clip]) -> dict[str, float]:
    status = [words.recognise(*clip).status for clip in clips]
    return {name: status.count(name) / len(status) for name in (NO_INPUT, RECOGNISED)}


def _train(
    dataset: Dataset,
    clips: Sequence[Clip],
    fold: Fold,
    half: Sequence[str],
    front_end: FrontEndKind,
    progress: Progress,
) -> WordRecognizer:
    train = [i for i in fold.train if dataset.samples[i].label in half]
    return WordRecognizer(front_end=front_end).fit(
        [clips[i][0] for i in train],
        [dataset.samples[i].label for i in train],
        sample_rate_hz=[clips[i][1] for i in train],
        groups=[dataset.samples[i].person for i in train],
        progress=lambda done, total: progress(f"training without {fold.name}", done, total),
    )


def _measure(
    dataset: Dataset, noise: dict[str, list[Clip]], folds: int | None, front_end: FrontEndKind, progress: Progress
) -> tuple[Row, dict[str, Any]]:
    clips = []
    for sample in dataset.samples:
        audio = read_audio(sample.path)
        clips.append((audio.samples, audio.sample_rate_hz))
    measured: dict[str, dict[str, float]] = {}
    curve: dict[str, list[float]] = {}
    chosen = halves(dataset.labels)
    for number, half in enumerate(chosen[:folds]):
        for fold in dataset.folds_by_person(None, SEED)[:folds]:
            name = f"half {number + 1}, {fold.name}"
            words = _train(dataset, clips, fold, half, front_end, within(progress, f"half {number + 1}"))
            turn = _test(words, dataset, clips, fold, half)
            found = {
                "eer": equal_error_rate(turn.known, turn.unknown),
                "false_rejects": float(1 - turn.known_accepted.mean()),
                "false_accepts": float(turn.unknown_accepted.mean()),
            }
            for kind, sounds in noise.items():
                shares = _shares(words, sounds)
                found |= {f"{kind}_no_input": shares[NO_INPUT], f"{kind}_as_word": shares[RECOGNISED]}
            for measure, value in found.items():
                measured.setdefault(measure, {})[name] = value
            curve[name] = false_rejects_at(turn.known, turn.unknown, FALSE_ACCEPTS)
    row: Row = {}
    for measure, values in measured.items():
        row |= statistics(values, measure) if measure == "eer" else further_statistics(values, measure)
    mean = np.mean(list(curve.values()), axis=0)
    more = {"halves": chosen, "by_fold": measured, "curve_by_fold": curve, "curve": [float(x) for x in mean]}
    return row, more


def _run(
    data_dir: Path,
    progress: Progress,
    *,
    data: Sequence[str] = tuple(WORD_FOLDERS),
    takes: int | None = None,
    folds: int | None = None,
    front_end: FrontEndKind = "cepstra",
    targets: Mapping[str, float] = TARGETS,
) -> dict[str, Any]:
    noise = noises(noise_paths(data_dir))
    rows, details = [], {}
    for name in data:
        row, details[name] = _measure(
            load_words(data_dir, name, takes), noise, folds, front_end, within(progress, name)
        )
        rows.append({"data": name, **row})
    lines = {name: {"x": list(FALSE_ACCEPTS), "y": found.pop("curve")} for name, found in details.items()}
    return {
        "seed": SEED,
        "options": WordRecognizer(front_end=front_end).options.as_dict(),
        "rows": rows,
        "details": details,
        "curves": {"x": "false accepts", "y": "false rejects", "lines": lines},
        **_verdict(rows, targets),
    }


def _verdict(rows: Sequence[Row], targets: Mapping[str, float]) -> dict[str, Any]:
    """Which targets are met, by data set, and whether all are."""
    met = {
        "eer": {row["data"]: row["eer_mean"] <= targets[row["data"]] for row in rows},
        "threshold": {
            row["data"]: row["false_accepts_mean"] <= MAX_FALSE_ACCEPTS
            and row["false_rejects_mean"] <= MAX_FALSE_REJECTS
            for row in rows
        },
        "noise": {row["data"]: row["noise_no_input_mean"] == 1 for row in rows},
    }
    return {
        **{f"passed_by_{name}": by_data for name, by_data in met.items()},
        "passed": all(one for by_data in met.values() for one in by_data.values()),
    }


def _study(name: str, how: str, run: Callable[..., dict[str, Any]], targets: Mapping[str, float]) -> Study:
    wanted = ", ".join(f"{100 * value:.0f} % {data}" for data, value in targets.items())
    return Study(
        name,
        f"words of unseen speakers{how} with half the vocabulary never trained: equal error rate of rejection, shares "
        "at the default threshold, and what becomes of noise; three random halves, one speaker held out",
        ("fsdd/recordings", "hindi_words/digits", "hindi_words/words", "noise"),
        f"equal error rate <= {wanted}; at the model's own threshold <= {100 * MAX_FALSE_ACCEPTS:.0f} % of other words "
        f"accepted and <= {100 * MAX_FALSE_REJECTS:.0f} % of known ones rejected; no_input on all stationary noise",
        run,
        Layout(measure="eer"),
        {"data": tuple(WORD_FOLDERS)},
        thins=True,
        sources=WORD_SOURCES,
        folds=True,
        quick={"data": ("hindi-words",)},
    )


_EMBEDDED: dict[FrontEndKind, str] = {
    "both": "cepstra and a pretrained speech embedding",
    "embedding": "a pretrained speech embedding alone",
}

STUDIES = (
    _study("unknown-words", "", _run, TARGETS),
    *(
        _study(
            f"unknown-words-{front_end}",
            f", by {how} (extra embedding),",
            partial(_run, front_end=front_end, targets=TARGETS_EMBEDDED),
            TARGETS_EMBEDDED,
        )
        for front_end, how in _EMBEDDED.items()
    ),
)
