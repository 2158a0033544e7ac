# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Speech and gesture to one command: table 6.9 of the thesis, and rules on whole score vectors."""

from __future__ import annotations

from typing import Protocol

from hri.core.errors import InvalidArgument
from hri.core.phrases import phrase
from hri.core.suggest import did_you_mean
from hri.fusion import vectors
from hri.fusion.options import RULES, FusedDecision, FusionOptions
from hri.fusion.stop import decide_stop
from hri.recognition.decision import NO_INPUT, RECOGNISED, UNKNOWN, Decision

_VECTOR_RULES = {
    "weighted_sum": vectors.weighted_sum,
    "product": vectors.product,
    "dempster_shafer": vectors.dempster_shafer,
}


class CombiningRule(Protocol):
    """A rule on whole score vectors: `hri.fusion.LearnedFusion`."""

    @property
    def rule(self) -> str:
        """Its name in `FusedDecision.rule`."""
        ...

    def combine(self, speech: Decision, gesture: Decision, options: FusionOptions) -> vectors.Probabilities:
        """Fused probability of every label that either mode knows; both have input."""
        ...


def fuse(
    speech: Decision | None,
    gesture: Decision | None,
    *,
    rule: str | CombiningRule = "table_6_9",
    options: FusionOptions | None = None,
) -> FusedDecision:
    """Fuse the decisions of both modes.

    Parameters
    ----------
    speech, gesture : Decision or None
        What a `WordRecognizer` and what a `GestureRecognizer` decided. None, or a decision without input, leaves the
        other mode alone.
    rule : {"table_6_9", "weighted_sum", "product", "dempster_shafer"} or LearnedFusion
        Table 6.9 takes the class of the surer mode; the others combine the whole score vectors.
    options : FusionOptions, optional

    Returns
    -------
    FusedDecision
        ``rule`` says which case fired. Its status is "ask" where a stop label is unsure and the other mode is sure of
        another class: the robot should rest, and ask.

    Raises
    ------
    InvalidArgument
        For an unknown rule, or a decision of the other mode, as when `speech` and `gesture` are swapped.
    TypeError
        For an argument that is no decision; names it, and says what would work.
    """
    if isinstance(rule, str) and rule not in RULES:
        raise InvalidArgument(f"no rule {rule!r}; {did_you_mean(rule, RULES)}")
    if not isinstance(rule, str) and not hasattr(rule, "combine"):
        raise TypeError(f"rule must be a name or a LearnedFusion, got {type(rule).__name__}")
    _require_mode(speech, "speech")
    _require_mode(gesture, "gesture")
    if options is not None and not isinstance(options, FusionOptions):
        raise TypeError(f"options must be a FusionOptions or None, got {type(options).__name__}")
    options = options or FusionOptions()
    stopped = decide_stop(speech, gesture, options)
    if stopped is not None:
        return stopped
    heard = speech if _has_input(speech) else None
    seen = gesture if _has_input(gesture) else None
    if heard is None and seen is None:
        return FusedDecision(NO_INPUT, NO_INPUT, 0.0, phrase("rule_no_input"), (), speech, gesture)
    if heard is None or seen is None:
        only = heard or seen
        assert only is not None
        return _as_decided(only, phrase("rule_alone", mode=phrase(only.mode)), speech, gesture)
    if heard.status == UNKNOWN and seen.status == UNKNOWN:
        return FusedDecision(UNKNOWN, UNKNOWN, 0.0, phrase("rule_both_rejected"), (), speech, gesture)
    if rule == "table_6_9":
        return _table_6_9(heard, seen, options)
    return _by_vectors(heard, seen, rule, options)


def _require_mode(decision: Decision | None, argument: str) -> None:
    value: object = decision  # what the caller gave, whatever the annotation says
    if value is None:
        return
    recognizer = {"speech": "WordRecognizer", "gesture": "GestureRecognizer"}[argument]
    if not isinstance(value, Decision):
        raise TypeError(
            f"{argument} must be a Decision or None, as {recognizer}.recognise gives it, got {type(value).__name__}"
        )
    if value.mode != argument:
        raise InvalidArgument(
            f"{argument} is a decision of mode {value.mode!r}: give what {recognizer}.recognise decided; "
            "the call is fuse(speech, gesture)"
        )


def _has_input(decision: Decision | None) -> bool:
    return decision is not None and decision.status != NO_INPUT and len(decision.nbest) > 0


def _as_decided(decision: Decision, rule: str, speech: Decision | None, gesture: Decision | None) -> FusedDecision:
    return FusedDecision(decision.label, decision.status, decision.confidence, rule, decision.nbest, speech, gesture)


def _winner(decision: Decision, rule: str, speech: Decision, gesture: Decision) -> FusedDecision:
    """The class that `decision` puts first wins."""
    best = decision.nbest[0]
    return FusedDecision(
        best.label, RECOGNISED, best.probability, phrase("rule_table", case=rule), decision.nbest, speech, gesture
    )


def _table_6_9(speech: Decision, gesture: Decision, options: FusionOptions) -> FusedDecision:
    """The four cases of table 6.9; gesture is source 1, and it wins ties."""
    alpha_1, alpha_2 = gesture.confidence, speech.confidence
    # A mode that rejected its input cannot be above its threshold.
    above_1 = alpha_1 >= options.threshold_gesture and gesture.status == RECOGNISED
    above_2 = alpha_2 >= options.threshold_speech and speech.status == RECOGNISED
    if above_1 and above_2:
        if alpha_2 <= alpha_1:
            return _winner(gesture, phrase("case_both_gesture"), speech, gesture)
        return _winner(speech, phrase("case_both_speech"), speech, gesture)
    if above_1:
        return _winner(gesture, phrase("case_one_above", mode=phrase("gesture")), speech, gesture)
    if above_2:
        return _winner(speech, phrase("case_one_above", mode=phrase("speech")), speech, gesture)
    # Nor does it win over one that recognised: the robot must not act on what was rejected.
    if gesture.status != speech.status:
        recognised = gesture if gesture.status == RECOGNISED else speech
        return _winner(recognised, phrase("case_one_recognised", mode=phrase(recognised.mode)), speech, gesture)
    if options.weight_speech * alpha_2 <= options.weight_gesture * alpha_1:
        return _winner(gesture, phrase("case_weighted_gesture"), speech, gesture)
    return _winner(speech, phrase("case_weighted_speech"), speech, gesture)


def _by_vectors(
    speech: Decision, gesture: Decision, rule: str | CombiningRule, options: FusionOptions
) -> FusedDecision:
    if isinstance(rule, str):
        labels = sorted({n.label for n in speech.nbest} | {n.label for n in gesture.nbest})
        both = vectors.probabilities(speech, labels), vectors.probabilities(gesture, labels)
        fused, name = _VECTOR_RULES[rule](*both, options), rule.replace("_", " ")
    else:
        fused, name = rule.combine(speech, gesture, options), rule.rule
    nbest = vectors.ranked(fused)
    why = phrase("rule_vectors", rule=name)
    return FusedDecision(nbest[0].label, RECOGNISED, nbest[0].probability, why, nbest, speech, gesture)
