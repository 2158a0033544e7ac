# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Isolated words of unseen speakers: every clip on its own, and by a recogniser that adapts to the speaker.

By cepstra, by the pretrained speech embedding, and by both together (``front_end``).
"""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Any, Literal

from hri.datasets import Dataset
from hri.evaluation import adapting, evaluate_conditions
from hri.recognition import WordRecognizer
from hri.studies.registry import WORD_SOURCES, Layout, Progress, Study
from hri.studies.sweeps import measured

FrontEndKind = Literal["cepstra", "both", "embedding"]
ALONE = "each clip alone"


def _study(
    name: str,
    folder: str,
    summary: str,
    adapting_target: float,
    front_end: FrontEndKind = "cepstra",
    alone_target: float = 0.0,
) -> Study:
    def run(data_dir: Path, progress: Progress, *, folds: int | None = None) -> dict[str, Any]:
        dataset = Dataset.load(data_dir / folder, "speech")
        make = partial(WordRecognizer, front_end=front_end)
        results = evaluate_conditions(dataset, make, {ALONE: None}, adapt=True, max_folds=folds, progress=progress)
        heard = {"alone": results[ALONE], "adapting": results[adapting(ALONE)]}
        return {
            **heard["adapting"].to_dict(),
            "alone": heard["alone"].to_dict(),
            "rows": [{"listening": how, **measured(result)} for how, result in heard.items()],
            "options": make().options.as_dict(),
            "passed": heard["adapting"].mean >= adapting_target and heard["alone"].mean >= alone_target,
        }

    alone = f" and >= {100 * alone_target:g} % alone" if alone_target else ""
    return Study(
        name,
        summary,
        (folder,),
        f"mean accuracy >= {100 * adapting_target:g} % while adapting to the speaker without supervision: every clip "
        f"is decided before it is learned from{alone}",
        run,
        Layout(),
        sources=WORD_SOURCES,
        folds=True,
    )


_EMBEDDED: dict[FrontEndKind, str] = {
    "both": ", by cepstra and a pretrained speech embedding (extra embedding)",
    "embedding": ", by a pretrained speech embedding alone (extra embedding)",
}
_SETS = (
    ("fsdd", "fsdd/recordings", "English digits, leave one of 4 speakers out", 0.90, 0.985, 0.975),
    ("hindi-digits", "hindi_words/digits", "Hindi digits, leave one of 4 speakers out", 0.97, 0.98, 0.98),
    ("hindi-words", "hindi_words/words", "Hindi words, leave one of 4 speakers out", 0.99, 0.99, 0.99),
)

STUDIES = (
    *(_study(name, folder, what, target) for name, folder, what, target, _, _ in _SETS),
    *(
        _study(f"{name}-{front_end}", folder, what + how, target, front_end, alone)
        for front_end, how in _EMBEDDED.items()
        for name, folder, what, _, target, alone in _SETS
    ),
)
