# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Still signs of unseen persons."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from hri.datasets import Dataset
from hri.evaluation import cross_validate
from hri.recognition import GestureRecognizer
from hri.studies.registry import Progress, Study

TARGET = 0.97
NUM_FOLDS = 5


def _run(data_dir: Path, progress: Progress) -> dict[str, Any]:
    dataset = Dataset.load(data_dir / "sign_digits", "gesture")
    result = cross_validate(dataset, GestureRecognizer, num_folds=NUM_FOLDS, progress=progress)
    dark = cross_validate(dataset, GestureRecognizer, num_folds=NUM_FOLDS, exposure=0.5, progress=progress)
    return {
        **result.to_dict(),
        "half_exposure": dark.to_dict(),
        "options": GestureRecognizer().get_params(),
        "passed": result.mean >= TARGET,
    }


STUDIES = (
    Study(
        "sign-digits",
        "hand signs for 0-9, 5 folds by person, as recorded and at half exposure (HOG + RBF SVM: 92.5 %)",
        ("sign_digits",),
        f"mean accuracy >= {100 * TARGET:.0f} %",
        _run,
    ),
)
