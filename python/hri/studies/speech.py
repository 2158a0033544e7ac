# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Isolated words of unseen speakers: every clip on its own, and by a recogniser that adapts to the speaker."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from hri.datasets import Dataset
from hri.evaluation import adapting, evaluate_conditions
from hri.recognition import WordRecognizer
from hri.studies.registry import WORD_SOURCES, Layout, Progress, Study
from hri.studies.sweeps import measured

ALONE = "each clip alone"


def _study(name: str, folder: str, summary: str, target: float) -> Study:
    def run(data_dir: Path, progress: Progress, *, folds: int | None = None) -> dict[str, Any]:
        dataset = Dataset.load(data_dir / folder, "speech")
        results = evaluate_conditions(
            dataset, WordRecognizer, {ALONE: None}, adapt=True, max_folds=folds, progress=progress
        )
        heard = {"alone": results[ALONE], "adapting": results[adapting(ALONE)]}
        recognizer = WordRecognizer()
        return {
            **heard["adapting"].to_dict(),
            "alone": heard["alone"].to_dict(),
            "rows": [{"listening": how, **measured(result)} for how, result in heard.items()],
            "options": recognizer.options.as_dict(),
            "passed": heard["adapting"].mean >= target,
        }

    return Study(
        name,
        summary,
        (folder,),
        f"mean accuracy >= {100 * target:.0f} % while adapting to the speaker without supervision: every clip is "
        "decided before it is learned from",
        run,
        Layout(),
        sources=WORD_SOURCES,
        folds=True,
    )


STUDIES = (
    _study(
        "fsdd",
        "fsdd/recordings",
        "English digits, leave one of 4 speakers out",
        0.90,
    ),
    _study(
        "hindi-digits",
        "hindi_words/digits",
        "Hindi digits, leave one of 4 speakers out",
        0.97,
    ),
    _study(
        "hindi-words",
        "hindi_words/words",
        "Hindi words, leave one of 4 speakers out",
        0.99,
    ),
)
