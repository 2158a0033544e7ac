# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The sentences of tables 4.3 and 5.1 of the thesis, signed by drawn people: synthetic tracks of both hands."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from hri.datasets.asl_sentences import SignedSentence
from hri.language import count_word_errors
from hri.recognition import SentenceRecognizer
from hri.studies.registry import Layout, Progress, Study, within
from hri.studies.sentences import ALONE, BIGRAM, MODELS, SOURCES, labels_of
from hri.studies.tables import Row, further_statistics, statistics
from hri.synthetic.sentences import SENTENCES, draw_sentences

NUM_SIGNERS = 10
"""As many as the thesis has; half of them are trained on, the other half tested, both ways."""
TAKES = 3
SEED = 0


def _train(sentences: Sequence[SignedSentence], model: Any, words: str, progress: Progress) -> SentenceRecognizer:
    recognizer = SentenceRecognizer(model=model, language_order=2 if words == BIGRAM else 1)
    return recognizer.fit(
        [s.positions for s in sentences],
        [[(word.label, word.first, word.last + 1) for word in s.words] for s in sentences],
        groups=[s.signer for s in sentences],
        progress=lambda done, total: progress("training", done, total),
    )


def _run(
    data_dir: Path,
    progress: Progress,
    *,
    table: Sequence[str] = tuple(SENTENCES),
    model: Sequence[str] = MODELS,
    folds: int | None = None,
) -> dict[str, Any]:
    rows: list[Row] = []
    by_sentence: dict[str, dict[str, float]] = {}
    for name in table:
        sentences = draw_sentences(name, NUM_SIGNERS, TAKES, SEED)
        signers = sorted({s.signer for s in sentences})
        halves = (signers[: NUM_SIGNERS // 2], signers[NUM_SIGNERS // 2 :])
        said = {words: text for text, words in SENTENCES[name].items()}
        for kind in model:
            for words in (ALONE, BIGRAM):
                errors: dict[str, float] = {}
                whole: dict[str, float] = {}
                right: dict[str, list[bool]] = {}
                for number, tested in enumerate(halves[:folds], start=1):
                    train = [s for s in sentences if s.signer not in tested]
                    test = [s for s in sentences if s.signer in tested]
                    recognizer = _train(train, kind, words, within(progress, f"{name}, {kind}, {words}, {number}"))
                    truth = [labels_of(s) for s in test]
                    found = [list(recognizer.recognise(s.positions).labels) for s in test]
                    same = [a == b for a, b in zip(truth, found, strict=True)]
                    errors[str(number)] = count_word_errors(truth, found).rate
                    whole[str(number)] = float(np.mean(same))
                    for labels, is_right in zip(truth, same, strict=True):
                        right.setdefault(said[" ".join(labels)], []).append(is_right)
                row = {"table": name, "words": words, "model": kind}
                rows.append({**row, **further_statistics(whole, "accuracy"), **statistics(errors, "word_error")})
                by_sentence[", ".join(row.values())] = {text: float(np.mean(one)) for text, one in right.items()}
    return {
        "synthetic": True,
        "seed": SEED,
        "num_signers": NUM_SIGNERS,
        "takes": TAKES,
        "rows": rows,
        "by_sentence": by_sentence,
        "passed": None,
    }


STUDIES = (
    Study(
        "drawn-sentences",
        "SYNTHETIC: the 10 and the 20 sentences of tables 4.3 and 5.1 of the thesis, signed by ten drawn people, half "
        "of whom are trained on and the others tested: whole sentences right and word errors of HMM and PTBHMM",
        (),
        "none: beside the thesis's means of 91 to 93 % (table 4.3) and its 81 to 94 % (table 5.2) of filmed sentences",
        _run,
        Layout(columns="model"),
        axes={"table": tuple(SENTENCES), "model": MODELS},
        sources=SOURCES,
        folds=True,
    ),
)
