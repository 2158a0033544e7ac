# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Forty spoken commands by many people: six groups of speakers left out in turn, in quiet and in noise."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any, Literal

from hri.datasets import Dataset
from hri.evaluation import AddNoise, evaluate_conditions
from hri.evaluation.conditions import Condition
from hri.recognition import WordRecognizer
from hri.recognition.keywords import WordRecognizerKeywords
from hri.studies.noise import noise_paths
from hri.studies.registry import WORD_SOURCES, Layout, Progress, Study, within
from hri.studies.sweeps import SEED, measured
from hri.studies.word_features import first_takes

FOLDER = "commands"
NUM_FOLDS = 6
NOISE_DB = 10.0
QUIET, NOISY = "quiet", "white noise at 10 dB"
FrontEndKind = Literal["cepstra", "both"]
FRONT_ENDS: dict[str, WordRecognizerKeywords] = {"cepstra": {}, "both": {"front_end": "both"}}
WITH_NETWORK: dict[str, WordRecognizerKeywords] = {
    "cepstra-network": {"use_network": True},
    "both-network": {"front_end": "both", "use_network": True},
}
TARGETS = {
    ("cepstra", QUIET): 0.95,
    ("cepstra", NOISY): 0.80,
    ("both", QUIET): 0.985,
    ("both", NOISY): 0.92,
}
"""With a network and without one."""


def conditions(data_dir: Path) -> dict[str, Condition | None]:
    """Quiet, and white noise at 10 dB."""
    return {QUIET: None, NOISY: AddNoise([noise_paths(data_dir)["white"]], [NOISE_DB])}


def _run(
    data_dir: Path,
    progress: Progress,
    *,
    kinds: dict[str, WordRecognizerKeywords] = FRONT_ENDS,
    front_end: Sequence[str] | None = None,
    takes: int | None = None,
    folds: int | None = None,
) -> dict[str, Any]:
    dataset = first_takes(Dataset.load(data_dir / FOLDER, "speech"), takes)
    tests = conditions(data_dir)
    rows = []
    for name in front_end or kinds:
        results = evaluate_conditions(
            dataset,
            partial(WordRecognizer, **kinds[name]),
            tests,
            num_folds=NUM_FOLDS,
            max_folds=folds,
            seed=SEED,
            progress=within(progress, name),
        )
        rows += [{"front_end": name, "test": test, **measured(result)} for test, result in results.items()]
    return {
        "seed": SEED,
        "options": WordRecognizer().options.as_dict(),
        "rows": rows,
        "passed": all(row["accuracy_mean"] >= TARGETS[row["front_end"].split("-")[0], row["test"]] for row in rows),
    }


STUDIES = (
    Study(
        "commands",
        "40 spoken commands, six groups of speakers left out in turn, each clip alone: by cepstra, and by cepstra and "
        "a pretrained speech embedding (extra embedding)",
        (FOLDER, "noise"),
        "mean accuracy in quiet >= 95 % (cepstra) and 98.5 % (both), in white noise at 10 dB >= 80 and 92 %",
        _run,
        Layout(columns="test"),
        axes={"front_end": tuple(FRONT_ENDS)},
        thins=True,
        sources=WORD_SOURCES,
        folds=True,
        quick={"front_end": ("cepstra",)},
    ),
    Study(
        "commands-network",
        "the same with a network trained on the same words: beside cepstra, and beside cepstra and the embedding",
        (FOLDER, "noise"),
        "mean accuracy in quiet >= 95 % (cepstra) and 98.5 % (both), in white noise at 10 dB >= 80 and 92 %",
        partial(_run, kinds=WITH_NETWORK),
        Layout(columns="test"),
        axes={"front_end": tuple(WITH_NETWORK)},
        thins=True,
        sources=WORD_SOURCES,
        folds=True,
    ),
)
