# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Signed sentences whose left hand is out of view, read by what was trained on both hands."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from hri.datasets.asl_sentences import SignedSentence, read_asl_sentences
from hri.language import WordErrors
from hri.studies.registry import Layout, Progress, Study, within
from hri.studies.sentences import (
    ALONE,
    BIGRAM,
    FOLDER,
    FOUND,
    KNOWN,
    MODELS,
    NUM_GROUPS,
    RECORDINGS,
    SEED,
    SOURCES,
    groups_of,
    recognise_known,
    recognise_whole,
    scales_of,
    sentence_errors,
    train_signs,
)
from hri.studies.tables import statistics

IN_VIEW, HIDDEN = "both hands", "right hand alone"
MAX_LOSS = 0.15
"""Word errors that the hand out of view may cost: as much as leaving it out of training does, and little more."""


def hide_left(sentence: SignedSentence) -> SignedSentence:
    """The same sentence with the left hand out of view all the time."""
    positions = sentence.positions.copy()
    positions[:, 0] = np.nan
    return replace(sentence, positions=positions)


def _run(data_dir: Path, progress: Progress, *, folds: int | None = None) -> dict[str, Any]:
    """The length of the signer is measured on each sentence itself, as nothing else is known of a stranger."""
    sentences = read_asl_sentences(data_dir / FOLDER)
    groups = groups_of(sentences, RECORDINGS)
    errors: dict[tuple[str, str, str, str], dict[str, float]] = {}
    for number in range(NUM_GROUPS if folds is None else folds):
        train = [s for s, group in zip(sentences, groups, strict=True) if group != number]
        test = [s for s, group in zip(sentences, groups, strict=True) if group == number]
        for model in MODELS:
            signs = train_signs(train, scales_of(train), within(progress, f"{number + 1}, {model}"), model=model)
            ways = {(KNOWN, words): recognise_known(signs, {}, words == BIGRAM) for words in (ALONE, BIGRAM)}
            ways[FOUND, BIGRAM] = recognise_whole(signs, {})
            for view, seen in ((IN_VIEW, test), (HIDDEN, [hide_left(s) for s in test])):
                for (frames, words), recognise in ways.items():
                    counted = sum((sentence_errors(s, recognise(s), frames) for s in seen), start=WordErrors())
                    errors.setdefault((model, frames, words, view), {})[str(number + 1)] = counted.rate
    rows = [
        {"model": model, "frames": frames, "words": words, "view": view, **statistics(rates, "word_error")}
        for (model, frames, words, view), rates in errors.items()
    ]
    means = {(r["model"], r["frames"], r["words"], r["view"]): r["word_error_mean"] for r in rows}
    costs = {
        f"{model}, {frames}, {words}": means[model, frames, words, HIDDEN] - mean
        for (model, frames, words, view), mean in means.items()
        if view == IN_VIEW
    }
    return {"seed": SEED, "rows": rows, "costs": costs, "passed": max(costs.values()) <= MAX_LOSS}


STUDIES = (
    Study(
        "asl-one-hand",
        "161 sentences of American signs (RWTH-BOSTON-104) held out in 5 groups, the left hand out of view all the "
        "time, by recognisers trained on both hands: word errors with known frames and without",
        (FOLDER,),
        f"the hand out of view costs at most {100 * MAX_LOSS:.0f} points of word errors",
        _run,
        Layout(columns="view", measure="word_error"),
        sources=SOURCES,
        folds=True,
    ),
)
