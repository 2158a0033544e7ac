# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Still signs of unseen persons."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from hri.datasets import Dataset
from hri.evaluation import cross_validate
from hri.recognition import GestureRecognizer
from hri.studies.registry import GESTURE_SOURCES, Progress, Study
from hri.studies.tables import statistics

TARGET = 0.97
NUM_FOLDS = 5


def _run(data_dir: Path, progress: Progress, *, folds: int | None = None) -> dict[str, Any]:
    dataset = Dataset.load(data_dir / "sign_digits", "gesture")
    common: dict[str, Any] = {"num_folds": NUM_FOLDS, "max_folds": folds, "progress": progress}
    result = cross_validate(dataset, GestureRecognizer, **common)
    dark = cross_validate(dataset, GestureRecognizer, exposure=0.5, **common)
    found = {"as recorded": result, "half exposure": dark}
    return {
        **result.to_dict(),
        "half_exposure": dark.to_dict(),
        "rows": [
            {"light": light, **statistics({fold.name: fold.accuracy for fold in part.folds})}
            for light, part in found.items()
        ],
        "options": GestureRecognizer().options.as_dict(),
        "passed": result.mean >= TARGET,
    }


STUDIES = (
    Study(
        "sign-digits",
        "hand signs for 0-9, 5 folds by person, as recorded and at half exposure",
        ("sign_digits",),
        f"mean accuracy >= {100 * TARGET:.0f} %",
        _run,
        sources=GESTURE_SOURCES,
        folds=True,
    ),
)
