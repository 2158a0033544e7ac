# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""STOP before any rule: a sure one always wins, an unsure one beside a sure other class asks."""

from __future__ import annotations

from hri.core.phrases import phrase
from hri.fusion.options import ASK, FusedDecision, FusionOptions
from hri.recognition.decision import RECOGNISED, Decision


def decide_stop(speech: Decision | None, gesture: Decision | None, options: FusionOptions) -> FusedDecision | None:
    """The decision where a stop label was recognised in either mode; None where it was in neither.

    A wrong STOP only makes the robot wait, a missed one may hurt: so an unsure STOP wins too, unless the other mode is
    sure of something else. Then the robot rests all the same, and asks.
    """
    stops = [d for d in (speech, gesture) if d is not None and _is_stop(d, options)]
    for decision in stops:
        if decision.confidence >= _threshold(decision, options):
            return _stopped(decision, phrase("rule_stop", mode=phrase(decision.mode)), speech, gesture)
    if not stops:
        return None
    unsure = max(stops, key=lambda decision: decision.confidence)
    other = gesture if unsure is speech else speech
    if other is not None and len(stops) == 1 and _is_sure_of_another(other, options):
        rule = phrase("rule_ask", mode=phrase(unsure.mode), other=phrase(other.mode))
        return FusedDecision(ASK, ASK, 0.0, rule, (unsure.nbest[0], other.nbest[0]), speech, gesture)
    return _stopped(unsure, phrase("rule_stop_unsure", mode=phrase(unsure.mode)), speech, gesture)


def _is_stop(decision: Decision, options: FusionOptions) -> bool:
    return decision.status == RECOGNISED and decision.label in options.stop_labels


def _threshold(decision: Decision, options: FusionOptions) -> float:
    return decision.class_threshold if options.stop_threshold is None else options.stop_threshold


def _is_sure_of_another(decision: Decision, options: FusionOptions) -> bool:
    threshold = options.threshold_speech if decision.mode == "speech" else options.threshold_gesture
    return decision.status == RECOGNISED and decision.confidence >= threshold


def _stopped(decision: Decision, rule: str, speech: Decision | None, gesture: Decision | None) -> FusedDecision:
    return FusedDecision(decision.label, RECOGNISED, decision.confidence, rule, decision.nbest, speech, gesture)
