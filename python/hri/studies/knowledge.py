# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A knowledge base behind the recogniser of signed sentences: what it gains, and what it forces wrongly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from hri.datasets.asl_sentences import SignedSentence, read_asl_sentences
from hri.language import KnowledgeBase, StoredMatch, StoredSentence, choose_max_distance
from hri.recognition import SentenceRecognizer
from hri.studies.registry import Layout, Progress, Study, within
from hri.studies.sentences import FOLDER, NUM_GROUPS, RECORDINGS, SOURCES, groups_of, labels_of, scales_of, train_signs
from hri.studies.tables import Row, statistics

NUM_INNER = 4
"""Groups of the sentences trained on, of which each is held out once to choose the largest distance."""
STORED, NOT_STORED = "stored", "not stored"
"""Whether the sentence signed is in the knowledge base; every sentence is tried both ways."""
BEFORE, NEAREST, WITHIN = "words as recognised", "nearest", "nearest within the distance"
OF_BEST, OF_BEST_WITHIN = "nearest to the ten best", "nearest to the ten best within the distance"
NUM_BEST = 10
"""Sentences recognised, the best and its alternatives, that stored ones are compared with."""

Words = tuple[str, ...]


@dataclass(frozen=True)
class _Tried:
    """A sentence that was signed, the words that were recognised, and what else they may have been."""

    signed: Words
    found: Words
    alternatives: tuple[Words, ...]


def _recognised(
    signs: SentenceRecognizer, scales: dict[str, float], sentences: Sequence[SignedSentence]
) -> list[_Tried]:
    tried = []
    for s in sentences:
        scale = scales.get(s.signer, 0.0)
        best = signs.recognise_n_best(s.positions, NUM_BEST, scale_px=scale)
        found = signs.recognise(s.positions, scale_px=scale).labels
        tried.append(_Tried(tuple(labels_of(s)), found, tuple(one.labels for one in best)))
    return tried


def _bases(texts: Sequence[Words], tried: _Tried, max_distance: float = 1.0) -> dict[str, KnowledgeBase]:
    """With the sentence that was signed, and without it."""
    others = [StoredSentence(words) for words in texts if words != tried.signed]
    return {
        STORED: KnowledgeBase([StoredSentence(tried.signed), *others], max_distance),
        NOT_STORED: KnowledgeBase(others, max_distance),
    }


def _choose(tried: Sequence[_Tried], use_alternatives: bool) -> float:
    texts = sorted({one.signed for one in tried})
    distances: dict[bool, list[float]] = {True: [], False: []}
    for one in tried:
        for base in _bases(texts, one).values():
            nearest = base.nearest(one.found, one.alternatives if use_alternatives else ())
            distances[nearest.sentence.words == one.signed].append(nearest.distance)
    return choose_max_distance(distances[True], distances[False])


def _inner(train: Sequence[SignedSentence], weights: Any, progress: Progress) -> list[_Tried]:
    """Every sentence trained on, recognised by a model of the others, with the weights that all of them chose."""
    inner = [group % NUM_INNER for group in np.random.default_rng(0).permutation(len(train))]
    tried = []
    for number in range(NUM_INNER):
        own = [s for s, group in zip(train, inner, strict=True) if group != number]
        rest = [s for s, group in zip(train, inner, strict=True) if group == number]
        scales = scales_of(own)
        signs = train_signs(own, scales, progress, choose_weights=False, decoder=weights)
        tried += _recognised(signs, scales, rest)
    return tried


def _meant(one: _Tried, base: KnowledgeBase, by_best: KnowledgeBase) -> dict[str, Words | None]:
    """What the words mean, each way; None: no stored sentence."""

    def words(match: StoredMatch | None) -> Words | None:
        return None if match is None else match.sentence.words

    return {
        BEFORE: one.found,
        NEAREST: words(base.nearest(one.found)),
        WITHIN: words(base.match(one.found)),
        OF_BEST: words(by_best.nearest(one.found, one.alternatives)),
        OF_BEST_WITHIN: words(by_best.match(one.found, one.alternatives)),
    }


def _shares(
    tried: Sequence[_Tried], texts: Sequence[Words], max_distance: float, max_distance_of_best: float
) -> dict[tuple[str, str, str], float]:
    """Of every (signed sentence is, meaning of the words, outcome): its share."""
    outcomes: dict[tuple[str, str, str], list[bool]] = {}
    for one in tried:
        by_best = _bases(texts, one, max_distance_of_best)
        for stored, base in _bases(texts, one, max_distance).items():
            for way, words in _meant(one, base, by_best[stored]).items():
                right = words == one.signed if stored == STORED or way == BEFORE else words is None
                outcomes.setdefault((stored, way, "right"), []).append(right)
                outcomes.setdefault((stored, way, "wrong"), []).append(words is not None and not right)
                outcomes.setdefault((stored, way, "none"), []).append(words is None)
    return {key: float(np.mean(values)) for key, values in outcomes.items()}


def _run(data_dir: Path, progress: Progress, *, folds: int | None = None) -> dict[str, Any]:
    sentences = read_asl_sentences(data_dir / FOLDER)
    texts = sorted({tuple(labels_of(s)) for s in sentences})
    groups = groups_of(sentences, RECORDINGS)
    chosen: dict[str, tuple[float, float]] = {}
    shares: dict[tuple[str, str, str], dict[str, float]] = {}
    for number in range(NUM_GROUPS if folds is None else folds):
        train = [s for s, group in zip(sentences, groups, strict=True) if group != number]
        test = [s for s, group in zip(sentences, groups, strict=True) if group == number]
        part = within(progress, str(number + 1))
        name = str(number + 1)
        scales = scales_of(train)
        signs = train_signs(train, scales, part)
        inner = _inner(train, signs.trained_options.decoder, part)
        chosen[name] = _choose(inner, False), _choose(inner, True)
        for key, share in _shares(_recognised(signs, scales, test), texts, *chosen[name]).items():
            shares.setdefault(key, {})[name] = share
    rows: list[Row] = [
        {"signed": stored, "meaning": way, "outcome": outcome, **statistics(values, "share")}
        for (stored, way, outcome), values in shares.items()
    ]
    return {"num_texts": len(texts), "max_distance": chosen, "rows": rows, "passed": None}


STUDIES = (
    Study(
        "asl-knowledge",
        "the stored sentence that is nearest to the words recognised, on the same sentences, with and without the "
        "signed one among those stored, and that nearest to any of the ten best; the largest distance is chosen on "
        "sentences trained on",
        (FOLDER,),
        "none: sentences right before and after, and those that are forced on another one wrongly",
        _run,
        Layout(columns="outcome", measure="share"),
        sources=SOURCES,
        folds=True,
    ),
)
