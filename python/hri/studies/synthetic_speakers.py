# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Do synthetic voices, added to the people trained on, help people who were not?"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from hri.datasets import Dataset, Fold
from hri.evaluation import EvaluationResult
from hri.evaluation.speech import SpeechRunner
from hri.recognition import WordRecognizer
from hri.studies.registry import WORD_SOURCES, Layout, Progress, Study, within
from hri.studies.sweeps import SEED, measured, result_of
from hri.studies.word_features import WORD_FOLDERS, load_words
from hri.synthetic.speech import DIGIT_WORDS, make_speech_corpus

WORDS: dict[str, dict[str, dict[str, str]]] = {
    "fsdd": {"en": DIGIT_WORDS["en"]},
    "hindi-digits": {"hi": {label: text for label, text in DIGIT_WORDS["hi"].items() if label != "0"} | {"10": "दस"}},
    "hindi-words": {
        "hi": {
            "aadmi": "आदमी",
            "bharat": "भारत",
            "gareeb": "गरीब",
            "ghar": "घर",
            "hindi": "हिंदी",
            "jeet": "जीत",
            "kahani": "कहानी",
            "khel": "खेल",
            "kitaab": "किताब",
            "ladka": "लड़का",
        }
    },
}
"""What is said, by data set, language and label."""
REAL = (0, 1, 2, 3)
"""People trained on; 0 is synthetic voices alone."""
SYNTHETIC = (0, 8, 24, 48)
TAKES = 2


def _fold(real: Dataset, added: Dataset, person: str, num_real: int, num_synthetic: int) -> Fold:
    """Indices into the samples of `real`, then `added`. Of the others the first `num_real` after the held-out one."""
    start = real.persons.index(person) + 1
    trained = (real.persons[start:] + real.persons[: start - 1])[:num_real] + added.persons[:num_synthetic]
    train = [i for i, sample in enumerate([*real.samples, *added.samples]) if sample.person in trained]
    return Fold(person, train, [i for i, sample in enumerate(real.samples) if sample.person == person])


def _run(
    data_dir: Path,
    progress: Progress,
    *,
    data: Sequence[str] = tuple(WORDS),
    real: Sequence[str] = tuple(map(str, REAL)),
    synthetic: Sequence[str] = tuple(map(str, SYNTHETIC)),
    takes: int | None = None,
) -> dict[str, Any]:
    rows = []
    most = max(map(int, synthetic))
    for name in data:
        recorded = load_words(data_dir, name, takes)
        words = {
            language: {label: text for label, text in table.items() if label in recorded.labels}
            for language, table in WORDS[name].items()
        }
        with TemporaryDirectory() as folder:
            say = within(progress, name)
            made = make_speech_corpus(folder, words, max(1, most), TAKES, SEED, partial(say, "speaking"))
            both = Dataset(recorded.root, "speech", [*recorded.samples, *made.samples])
            runner = SpeechRunner(both, WordRecognizer, {"": None}, [], SEED, None, say)
        for num_real in map(int, real):
            for num_synthetic in map(int, synthetic):
                if num_real + num_synthetic == 0:
                    continue
                folds = [_fold(recorded, made, person, num_real, num_synthetic) for person in recorded.persons]
                result = EvaluationResult(recorded.labels, [runner.run(fold)[""] for fold in folds])
                place = {"data": name, "real": num_real, "synthetic": num_synthetic}
                rows.append({**place, **measured(result)})
    return result_of(rows, synthetic_takes=TAKES)


STUDIES = (
    Study(
        "synthetic-speakers",
        "synthetic voices beside 0 to 3 real speakers in training, tested on a real speaker held out: English digits, "
        "Hindi digits, Hindi words",
        tuple(WORD_FOLDERS[name] for name in WORDS),
        "none: a comparison",
        _run,
        layout=Layout(columns="synthetic", x="synthetic", panel="data"),
        axes={"data": tuple(WORDS), "real": tuple(map(str, REAL)), "synthetic": tuple(map(str, SYNTHETIC))},
        thins=True,
        sources=WORD_SOURCES,
        quick={"data": ("hindi-digits",), "real": ("0",)},
    ),
)
