# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Fusion of whole score vectors: it can be right where both modes alone are wrong."""

from __future__ import annotations

import math

from hri.fusion.options import FusionOptions
from hri.recognition.decision import Decision, NBest

Probabilities = dict[str, float]


def probabilities(decision: Decision, labels: list[str]) -> Probabilities:
    """Calibrated probability of every label; 0 for one the mode does not know."""
    known = {entry.label: entry.probability for entry in decision.nbest}
    return {label: known.get(label, 0.0) for label in labels}


def weighted_sum(speech: Probabilities, gesture: Probabilities, options: FusionOptions) -> Probabilities:
    """w_s P_s(c) + w_g P_g(c), scaled to sum 1."""
    return _scaled({c: options.weight_speech * speech[c] + options.weight_gesture * gesture[c] for c in speech})


def product(speech: Probabilities, gesture: Probabilities, options: FusionOptions) -> Probabilities:
    """P_s(c)^w_s P_g(c)^w_g with floored probabilities, scaled to sum 1 (equal priors)."""
    floor = max(options.probability_floor, 1e-12)
    logs = {
        c: options.weight_speech * math.log(max(speech[c], floor))
        + options.weight_gesture * math.log(max(gesture[c], floor))
        for c in speech
    }
    top = max(logs.values())
    return _scaled({c: math.exp(v - top) for c, v in logs.items()})


def dempster_shafer(speech: Probabilities, gesture: Probabilities, options: FusionOptions) -> Probabilities:
    """Dempster's rule on singletons and ignorance, by pignistic probability.

    A mode of reliability r gives mass r P(c) to each class and 1 - r to "any class". Masses of agreeing classes are
    multiplied, conflict is scaled away, and what is left of ignorance is shared out equally.
    """
    r_s, r_g = options.reliability_speech, options.reliability_gesture
    mass = {
        c: r_s * speech[c] * r_g * gesture[c] + r_s * speech[c] * (1 - r_g) + (1 - r_s) * r_g * gesture[c]
        for c in speech
    }
    ignorance = (1 - r_s) * (1 - r_g)
    share = ignorance / len(mass)
    return _scaled({c: m + share for c, m in mass.items()})


def ranked(fused: Probabilities) -> tuple[NBest, ...]:
    """As an n-best list, best first; equal ones in the order of their labels."""
    order = sorted(fused, key=lambda c: (-fused[c], c))
    return tuple(NBest(c, fused[c], math.log(fused[c]) if fused[c] > 0 else -math.inf) for c in order)


def _scaled(values: Probabilities) -> Probabilities:
    total = sum(values.values())
    if not total > 0:
        return {c: 1 / len(values) for c in values}
    return {c: v / total for c, v in values.items()}
