# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Slow, medium and fast speech (thesis table 6.6): recordings of unseen speakers at other tempos."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from hri.evaluation.conditions import Condition
from hri.evaluation.tempo import ChangeTempo
from hri.studies.registry import WORD_SOURCES, Layout, Progress, Study
from hri.studies.sweeps import result_of, sweep

FACTORS = (0.5, 0.7, 1.0, 1.4, 2.0)
"""How much faster than recorded: slow, medium at 1, fast."""
TRAINING = ("natural", "with other tempos")
DATA = ("fsdd", "hindi-digits", "hindi-words")


def _run(
    data_dir: Path,
    progress: Progress,
    *,
    data: Sequence[str] = DATA,
    training: Sequence[str] = TRAINING,
    takes: int | None = None,
    folds: int | None = None,
) -> dict[str, Any]:
    tests: dict[str, Condition | None] = {str(f): None if f == 1.0 else ChangeTempo(f) for f in FACTORS}
    added = {"natural": [], "with other tempos": [ChangeTempo(0.7), ChangeTempo(1.4)]}
    rows = []
    for name in data:
        chosen = {choice: added[choice] for choice in training}
        found = sweep(data_dir, name, tests, chosen, progress, takes=takes, folds=folds)
        for (_, trained), measured in found.items():
            rows += [{"data": name, "training": trained, "tempo": f, **measured[str(f)]} for f in FACTORS]
    return result_of(rows)


STUDIES = (
    Study(
        "speech-tempo",
        "slow, medium and fast words (thesis table 6.6): recordings stretched and squeezed in time, leave one of 4 "
        "speakers out",
        ("fsdd/recordings", "hindi_words/digits", "hindi_words/words"),
        "none: a comparison",
        _run,
        layout=Layout(columns="tempo", x="tempo", panel="data"),
        axes={"data": DATA, "training": TRAINING},
        thins=True,
        sources=WORD_SOURCES,
        folds=True,
        quick={"data": ("hindi-words",), "training": ("natural",)},
    ),
)
