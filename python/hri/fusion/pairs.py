# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Pairs of decisions on what different people said and showed, for fusion to learn from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hri.core.errors import InvalidArgument
from hri.recognition.decision import Decision

Labelled = Sequence[tuple[str, Decision]]
"""Right labels, and what was decided."""


@dataclass(frozen=True)
class DecisionPairs:
    """What was decided on what was said and on what was shown at once, and the right label of each pair; as
    `LearnedFusion.fit_decisions` takes them."""

    speech: list[Decision]
    gesture: list[Decision]
    labels: list[str]


def pair_decisions(speech: Labelled, gesture: Labelled, signs_per_word: int = 2, seed: int = 0) -> DecisionPairs:
    """Every decision on a word beside decisions on signs of the same label, drawn at random.

    Parameters
    ----------
    speech, gesture : sequence of (label, Decision)
        The right label, and what was decided. Labels that one of them has not are left out.
    signs_per_word : int
        At least 1.
    seed : int

    Raises
    ------
    InvalidArgument
        For another number, and where both have fewer than two labels in common.
    """
    if signs_per_word < 1:
        raise InvalidArgument(f"signs_per_word must be at least 1, got {signs_per_word}")
    shown: dict[str, list[Decision]] = {}
    for label, decision in gesture:
        shown.setdefault(label, []).append(decision)
    common = sorted({label for label, _ in speech}.intersection(shown))
    if len(common) < 2:
        said = ", ".join(sorted({label for label, _ in speech})) or "none"
        signed = ", ".join(sorted(shown)) or "none"
        raise InvalidArgument(f"words and signs need two labels in common; there are {said}, and {signed}")
    rng = np.random.default_rng(seed)
    pairs = DecisionPairs([], [], [])
    for label, decision in speech:
        signs = shown.get(label, [])
        for number in rng.integers(len(signs), size=signs_per_word if signs else 0):
            pairs.speech.append(decision)
            pairs.gesture.append(signs[int(number)])
            pairs.labels.append(label)
    return pairs
