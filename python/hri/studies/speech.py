# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Isolated words of unseen speakers."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from hri.datasets import Dataset
from hri.evaluation import cross_validate
from hri.recognition import WordRecognizer
from hri.studies.registry import Progress, Study


def _study(name: str, folder: str, summary: str, target: float) -> Study:
    def run(data_dir: Path, progress: Progress) -> dict[str, Any]:
        dataset = Dataset.load(data_dir / folder, "speech")
        result = cross_validate(dataset, WordRecognizer, progress=progress)
        return {
            **result.to_dict(),
            "options": WordRecognizer().get_params(),
            "passed": result.mean >= target,
        }

    return Study(name, summary, (folder,), f"mean accuracy >= {100 * target:.0f} %", run)


STUDIES = (
    _study(
        "fsdd",
        "fsdd/recordings",
        "English digits, leave one of 4 speakers out (GMM-HMM of hmmlearn: 84 % trained on 5 speakers)",
        0.90,
    ),
    _study(
        "hindi-digits",
        "hindi_words/digits",
        "Hindi digits, leave one of 4 speakers out (hmmlearn: 89.5 %)",
        0.97,
    ),
    _study(
        "hindi-words",
        "hindi_words/words",
        "Hindi words, leave one of 4 speakers out (hmmlearn: 95.5 %)",
        0.99,
    ),
)
