# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Words of signed sentences as isolated gestures: `GestureRecognizer` of both hands, and of the right one alone."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from hri.datasets.asl_sentences import SignedSentence, SignedWord, read_asl_sentences
from hri.features import track_rows
from hri.recognition import GestureRecognizer
from hri.studies.registry import Layout, Progress, Study
from hri.studies.sentences import FOLDER, NUM_GROUPS, RECORDINGS, groups_of, scales_of
from hri.studies.tables import Row, statistics

Model = Literal["hmm", "trajectory", "rbf"]
MODELS: tuple[Model, ...] = ("hmm", "trajectory", "rbf")
HANDS = {"both hands": 2, "right hand": 1}

Words = list[tuple[SignedSentence, SignedWord]]


def _words(sentences: Sequence[SignedSentence]) -> Words:
    return [(s, word) for s in sentences for word in s.words]


def _rows(words: Words, scales: dict[str, float], num_hands: int) -> list[NDArray[np.float32]]:
    """Rows of each word: only its own frames."""
    rows = []
    for s, word in words:
        tracks = np.ascontiguousarray(s.positions[word.first : word.last + 1].reshape(-1, 6))
        rows.append(np.asarray(track_rows(tracks, scales.get(s.signer, 0.0), num_hands)))
    return rows


def _run(data_dir: Path, progress: Progress, *, model: Sequence[Model] = MODELS) -> dict[str, Any]:
    sentences = read_asl_sentences(data_dir / FOLDER)
    groups = groups_of(sentences, RECORDINGS)
    errors: dict[tuple[Model, str], dict[str, float]] = {(name, hands): {} for name in model for hands in HANDS}
    for number in range(NUM_GROUPS):
        trained_on = [s for s, group in zip(sentences, groups, strict=True) if group != number]
        train = _words(trained_on)
        test = _words([s for s, group in zip(sentences, groups, strict=True) if group == number])
        truths = np.array([word.label for _, word in test])
        scales = scales_of(trained_on)
        for done, (name, hands) in enumerate(errors):
            recognizer = GestureRecognizer(model=name, num_hands=HANDS[hands])
            recognizer.fit_features(
                _rows(train, scales, HANDS[hands]),
                [word.label for _, word in train],
                groups=[s.video for s, _ in train],
            )
            found = [recognizer.recognise_features(rows).nbest[0].label for rows in _rows(test, scales, HANDS[hands])]
            errors[name, hands][str(number + 1)] = float(np.mean(np.array(found) != truths))
            progress(f"group {number + 1}, {name}, {hands}", done + 1, len(errors))
    rows: list[Row] = [
        {"model": name, "hands": hands, **statistics(of_group, "word_error")}
        for (name, hands), of_group in errors.items()
    ]
    means = {(r["model"], r["hands"]): r["word_error_mean"] for r in rows}
    gains = {name: means[name, "right hand"] - means[name, "both hands"] for name in model}
    return {
        "num_words": len(_words(sentences)),
        "gained_by_both_hands": gains,
        "rows": rows,
        "passed": min(gains.values()) > 0,
    }


STUDIES = (
    Study(
        "asl-gestures",
        "words of 161 signed sentences (RWTH-BOSTON-104, tracks of hands) as isolated gestures, each of 5 groups of "
        "sentences held out: word errors of gesture recognisers of both hands and of the right one",
        (FOLDER,),
        "fewer word errors by both hands than by the right hand alone, with every model",
        _run,
        Layout(columns="hands", measure="word_error"),
        axes={"model": MODELS},
        sources=(
            "cpp/features/hand",
            "cpp/models/...",
            "cpp/recognition",
            "cpp/recognition/gesture",
        ),
    ),
)
