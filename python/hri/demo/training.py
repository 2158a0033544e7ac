# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Training on all but a few made-up people, and how well those few are recognised."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace

from hri.datasets import Dataset
from hri.demo.corpus import Corpus, Progress
from hri.evaluation import EvaluationItem, EvaluationResult, FoldResult
from hri.recognition import GestureRecognizer, WordRecognizer
from hri.training import train


@dataclass(frozen=True)
class Trained:
    """Both recognisers, and their accuracy on the people held out."""

    words: WordRecognizer
    signs: GestureRecognizer
    words_result: EvaluationResult
    signs_result: EvaluationResult


def train_both(corpus: Corpus, progress: Progress) -> Trained:
    """Hold out the last voice and the last two signers (one if there are fewer than six), train on the others."""
    voices, signers = corpus.spoken.persons, corpus.signed.persons
    out_words = {voices[-1]}
    out_signs = set(signers[-2:] if len(signers) >= 6 else signers[-1:])

    def named(mode: str) -> Progress:
        return lambda what, done, total: progress(f"{mode}: {what}", done, total)

    words = train(_only(corpus.spoken, set(voices) - out_words), WordRecognizer(), progress=named("words"))
    signs = train(_only(corpus.signed, set(signers) - out_signs), GestureRecognizer(), progress=named("signs"))
    return Trained(
        words, signs, _test(_only(corpus.spoken, out_words), words), _test(_only(corpus.signed, out_signs), signs)
    )


def _only(dataset: Dataset, persons: Collection[str]) -> Dataset:
    return replace(dataset, samples=[s for s in dataset.samples if s.person in persons])


def _test(dataset: Dataset, recognizer: WordRecognizer | GestureRecognizer) -> EvaluationResult:
    items = tuple(EvaluationItem(i, s.label, recognizer.recognise(s.path)) for i, s in enumerate(dataset.samples))
    fold = FoldResult(", ".join(dataset.persons), items)
    return EvaluationResult(dataset.labels, [fold], {"synthetic": True})
