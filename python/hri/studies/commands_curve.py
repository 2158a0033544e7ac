# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Spoken commands against the number of people, and of recordings by each, that training has."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from hri.datasets import Dataset, Fold
from hri.evaluation import EvaluationResult
from hri.evaluation.speech import SpeechRunner
from hri.recognition import WordRecognizer
from hri.recognition.keywords import WordRecognizerKeywords
from hri.studies.commands import FOLDER, FRONT_ENDS, NUM_FOLDS, WITH_NETWORK, conditions
from hri.studies.registry import WORD_SOURCES, Layout, Progress, Study, within
from hri.studies.sweeps import SEED, measured
from hri.studies.word_features import first_takes

CHOICES: dict[str, WordRecognizerKeywords] = {**FRONT_ENDS, "both-network": WITH_NETWORK["both-network"]}
TAKES = 3
SIZES = ((5, TAKES), (10, TAKES), (20, TAKES), (20, 1))
"""Speakers, and recordings of a word by each."""


def fewer(fold: Fold, dataset: Dataset, num_speakers: int, takes: int) -> Fold:
    """With a smaller training part. The speakers of a smaller number are among those of a larger one."""
    speakers = sorted({dataset.samples[i].person for i in fold.train})
    kept = set(np.random.default_rng(SEED).permutation(speakers)[:num_speakers])
    early = {sample.path for sample in first_takes(dataset, takes).samples}
    chosen = [i for i in fold.train if dataset.samples[i].person in kept and dataset.samples[i].path in early]
    return replace(fold, train=chosen)


def _run(
    data_dir: Path,
    progress: Progress,
    *,
    front_end: Sequence[str] = tuple(CHOICES),
    folds: int | None = None,
) -> dict[str, Any]:
    dataset = Dataset.load(data_dir / FOLDER, "speech")
    tests = conditions(data_dir)
    held_out = dataset.folds_by_person(NUM_FOLDS, SEED)[:folds]
    rows = []
    for name, (speakers, takes) in product(front_end, SIZES):
        make = partial(WordRecognizer, **CHOICES[name])
        part = within(progress, f"{name}, {speakers} speakers, {takes} takes")
        runner = SpeechRunner(dataset, make, tests, (), SEED, None, part)
        found = [runner.run(fewer(fold, dataset, speakers, takes)) for fold in held_out]
        for test in tests:
            result = EvaluationResult(dataset.labels, [one[test] for one in found], {})
            rows.append({"front_end": name, "takes": takes, "test": test, "speakers": speakers, **measured(result)})
    return {"seed": SEED, "options": WordRecognizer().options.as_dict(), "rows": rows, "passed": None}


STUDIES = (
    Study(
        "commands-curve",
        "40 spoken commands by groups of speakers left out, trained on fewer speakers and on one recording of a word "
        "by each: by cepstra, with a pretrained speech embedding (extra embedding), and with a network too",
        (FOLDER, "noise"),
        "none: a comparison",
        _run,
        Layout(columns="speakers", x="speakers", panel="test"),
        axes={"front_end": tuple(CHOICES)},
        sources=WORD_SOURCES,
        folds=True,
        quick={"front_end": ("cepstra",)},
    ),
)
