# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Possibility and necessity of every class that a recogniser considered, from their probabilities."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Any

from hri.recognition.decision import NBest


def possibility_and_necessity(probabilities: Sequence[float]) -> list[tuple[float, float]]:
    """How far each class is possible, and how far it is necessary.

    Possibility is the sum of the probabilities that are no larger than that of the class: the transformation of Dubois
    and Prade, which keeps the order and gives the most probable class 1. Necessity is 1 less the largest possibility of
    another class. So necessity <= probability <= possibility holds for each, and the necessity of the best class is its
    lead over the others, whatever they are. Equation 5.14 of the thesis divides likelihoods by the largest in place of
    this; of calibrated probabilities that may give a necessity above the probability.

    Parameters
    ----------
    probabilities : sequence of float
        Each 0 or more, of all classes, in any order; they are divided by their sum.

    Returns
    -------
    list of (float, float)
        Possibility and necessity of each, 0..1. Where all probabilities are 0 everything is possible and nothing
        necessary.
    """
    total = sum(probabilities)
    if total <= 0.0:
        return [(1.0, 0.0)] * len(probabilities)
    below = 0.0
    possible: dict[float, float] = {}
    for value, count in sorted(Counter(probabilities).items()):
        below += value * count
        possible[value] = min(1.0, below / total)
    best = max(possible)
    possible[best] = 1.0
    lead = 1.0 - max((pi for value, pi in possible.items() if value != best), default=0.0)
    alone = Counter(probabilities)[best] == 1
    return [(possible[value], lead if alone and value == best else 0.0) for value in probabilities]


def nbest_fields(nbest: Sequence[NBest]) -> list[dict[str, Any]]:
    """An n-best list for events: "label", "probability", "possibility" and "necessity" of each."""
    degrees = possibility_and_necessity([entry.probability for entry in nbest])
    return [
        {"label": entry.label, "probability": entry.probability, "possibility": pi, "necessity": n}
        for entry, (pi, n) in zip(nbest, degrees, strict=True)
    ]
