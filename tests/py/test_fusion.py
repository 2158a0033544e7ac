# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Table 6.9 case by case, the rules on whole score vectors, and STOP."""

from __future__ import annotations

import json
import math
from dataclasses import replace

import pytest

from hri.core.errors import InvalidArgument
from hri.fusion import ASK, RULES, FusionOptions, fuse
from hri.recognition import Decision, NBest

MODES = ("speech", "gesture")
NAN = math.nan


def decided(mode: str, status: str = "recognised", **probabilities: float) -> Decision:
    """A decision with these probabilities (labels as keywords), the best first."""
    ranked = sorted(probabilities.items(), key=lambda item: -item[1])
    nbest = tuple(NBest(label, p, math.log(p) if p > 0 else -math.inf) for label, p in ranked)
    label = nbest[0].label if status == "recognised" else status
    return Decision(mode, label, status, nbest[0].probability if nbest else 0.0, nbest=nbest)


def heard(status: str = "recognised", **probabilities: float) -> Decision:
    return decided("speech", status, **probabilities)


def seen(status: str = "recognised", **probabilities: float) -> Decision:
    return decided("gesture", status, **probabilities)


@pytest.mark.parametrize(
    ("speech", "gesture", "label", "rule"),
    [
        (heard(a=0.95, b=0.05), seen(b=0.9, a=0.1), "a", "both above, speech surer"),
        (heard(a=0.9, b=0.1), seen(b=0.95, a=0.05), "b", "both above, gesture at least as sure"),
        (heard(a=0.9, b=0.1), seen(b=0.9, a=0.1), "b", "both above, gesture at least as sure"),
        (heard(a=0.86, b=0.14), seen(b=0.79, a=0.21), "a", "only speech above"),
        (heard(a=0.85, b=0.15), seen(b=0.79, a=0.21), "a", "only speech above"),
        (heard(a=0.84, b=0.16), seen(b=0.8, a=0.2), "b", "only gesture above"),
        (heard(a=0.6, b=0.4), seen(b=0.7, a=0.3), "b", "both below, weighted gesture"),
        (heard(a=0.75, b=0.25), seen(b=0.7, a=0.3), "a", "both below, weighted speech"),
        (heard(a=0.7, b=0.3), seen(b=0.7, a=0.3), "b", "both below, weighted gesture"),
        # A mode that rejected its input does not win over one that recognised, however sure its best class was.
        (heard("unknown", a=0.84, b=0.16), seen(b=0.79, a=0.21), "b", "both below, only gesture recognised"),
        (heard(a=0.5, b=0.5), seen("unknown", b=0.79, a=0.21), "a", "both below, only speech recognised"),
        # A mode that rejected its input is below its threshold, however sure its best class was.
        (heard("unknown", a=0.99, b=0.01), seen(b=0.85, a=0.15), "b", "only gesture above"),
    ],
)
def test_table_6_9(speech: Decision, gesture: Decision, label: str, rule: str) -> None:
    fused = fuse(speech, gesture)
    assert (fused.label, fused.status) == (label, "recognised")
    assert fused.rule.startswith(f"table 6.9: {rule}")
    winner = speech if fused.rule.split(": ")[1].count("speech") else gesture
    assert fused.nbest == winner.nbest and fused.confidence == winner.nbest[0].probability
    assert (fused.speech, fused.gesture) == (speech, gesture)


def test_weights_decide_where_both_are_below() -> None:
    speech, gesture = heard(a=0.6, b=0.4), seen(b=0.7, a=0.3)
    assert fuse(speech, gesture, options=FusionOptions(weight_speech=2.0)).label == "a"
    assert fuse(speech, gesture, options=FusionOptions(weight_gesture=2.0)).label == "b"


@pytest.mark.parametrize("rule", RULES)
def test_stop_wins_from_either_mode(rule: str) -> None:
    stop, go = {"stop": 0.4, "a": 0.3, "b": 0.3}, {"a": 0.999, "b": 0.001}
    for speech, gesture in ((heard(**stop), seen(**go)), (heard(**go), seen(**stop)), (heard(**stop), None)):
        fused = fuse(speech, gesture, rule=rule)
        assert (fused.label, fused.status) == ("stop", "recognised")
        assert fused.rule.startswith("stop: recognised in ")
    halt = FusionOptions(stop_labels=("halt",))
    assert fuse(heard(**stop), seen(**go), rule=rule, options=halt).rule.startswith("stop") is False
    rejected = fuse(heard("unknown", **stop), seen(**go), rule=rule)
    assert not rejected.rule.startswith("stop")


def unsure_stop(mode: str, threshold: float = 0.5) -> Decision:
    """STOP at 43 %, below what training asks of it."""
    return replace(decided(mode, stop=0.43, a=0.3, b=0.27), class_threshold=threshold)


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("mode", MODES)
def test_an_unsure_stop_beside_a_sure_other_class_asks(rule: str, mode: str) -> None:
    other = decided({"speech": "gesture", "gesture": "speech"}[mode], **{"7": 0.97, "a": 0.03})
    stop = unsure_stop(mode)
    fused = fuse(rule=rule, **{stop.mode: stop, other.mode: other})
    assert (fused.label, fused.status, fused.confidence) == (ASK, ASK, 0.0)
    assert fused.rule == f"ask: stop unsure in {mode}, {other.mode} sure of another class"
    assert [entry.label for entry in fused.nbest] == ["stop", "7"]
    at_threshold = replace(stop, class_threshold=stop.confidence)
    assert fuse(rule=rule, **{stop.mode: at_threshold, other.mode: other}).label == "stop"
    lenient = FusionOptions(stop_threshold=0.4)
    assert fuse(rule=rule, options=lenient, **{stop.mode: stop, other.mode: other}).label == "stop"


@pytest.mark.parametrize("mode", MODES)
def test_an_unsure_stop_wins_over_what_is_not_sure(mode: str) -> None:
    name = {"speech": "gesture", "gesture": "speech"}[mode]
    stop = unsure_stop(mode)
    for other in (
        None,
        decided(name, a=0.7, b=0.3),  # below its threshold
        decided(name, "unknown", a=0.99, b=0.01),  # rejected
        Decision(name, "no_input", "no_input", 0.0),
        unsure_stop(name),
    ):
        fused = fuse(**{mode: stop, name: other})
        assert (fused.label, fused.status) == ("stop", "recognised") and fused.rule.startswith("stop: unsure in")


def test_a_sure_stop_wins_over_an_unsure_one_and_over_everything() -> None:
    sure = replace(seen(stop=0.9, a=0.1), class_threshold=0.8)
    assert fuse(unsure_stop("speech"), sure).rule == "stop: recognised in gesture"
    assert fuse(heard(a=1.0), sure).label == "stop"


def test_swapped_modes_are_refused() -> None:
    with pytest.raises(InvalidArgument, match=r"^speech is a decision of mode 'gesture': .*WordRecognizer"):
        fuse(GESTURE, SPEECH)
    with pytest.raises(InvalidArgument, match=r"^gesture is a decision of mode 'speech': .*GestureRecognizer"):
        fuse(None, SPEECH)


@pytest.mark.parametrize("wrong", ["seven", 0.9, ("7", 0.9)])
def test_what_is_no_decision_is_refused_by_name(wrong: object) -> None:
    with pytest.raises(TypeError, match=rf"^speech must be a Decision or None.* got {type(wrong).__name__}$"):
        fuse(wrong, GESTURE)
    with pytest.raises(TypeError, match=r"^gesture must be a Decision or None"):
        fuse(SPEECH, wrong)
    with pytest.raises(TypeError, match=r"^options must be a FusionOptions"):
        fuse(SPEECH, GESTURE, options=wrong)


@pytest.mark.parametrize("rule", RULES)
def test_one_mode_alone_decides_and_none_is_no_input(rule: str) -> None:
    speech, nothing = heard(a=0.5, b=0.3, c=0.2), Decision("gesture", "no_input", "no_input", 0.0)
    for gesture in (None, nothing):
        fused = fuse(speech, gesture, rule=rule)
        assert (fused.label, fused.confidence) == ("a", 0.5) and fused.rule.startswith("speech alone")
    alone = fuse(None, seen("unknown", a=0.5, b=0.5), rule=rule)
    assert (alone.label, alone.status) == ("unknown", "unknown")
    for pair in ((None, None), (None, nothing), (Decision("speech", "no_input", "no_input", 0.0), nothing)):
        fused = fuse(*pair, rule=rule)
        assert (fused.label, fused.status, fused.confidence) == ("no_input", "no_input", 0.0)


@pytest.mark.parametrize("rule", RULES)
def test_two_rejections_are_unknown(rule: str) -> None:
    fused = fuse(heard("unknown", a=0.9, b=0.1), seen("unknown", a=0.9, b=0.1), rule=rule)
    assert (fused.label, fused.status) == ("unknown", "unknown")


SPEECH, GESTURE = heard(a=0.5, b=0.4, c=0.1), seen(c=0.5, b=0.4, a=0.1)
"""Both put b second: alone each is wrong where b is right."""


@pytest.mark.parametrize("rule", ["weighted_sum", "product", "dempster_shafer"])
def test_vectors_can_be_right_where_both_modes_are_wrong(rule: str) -> None:
    fused = fuse(SPEECH, GESTURE, rule=rule)
    assert fused.label == "b" and fuse(SPEECH, GESTURE).label in "ac"
    assert sum(entry.probability for entry in fused.nbest) == pytest.approx(1)
    assert [e.probability for e in fused.nbest] == sorted((e.probability for e in fused.nbest), reverse=True)
    assert fused.confidence == fused.nbest[0].probability


def test_sums_and_products_by_hand() -> None:
    by_sum = {e.label: e.probability for e in fuse(SPEECH, GESTURE, rule="weighted_sum").nbest}
    assert by_sum == pytest.approx({"a": 0.3, "b": 0.4, "c": 0.3})
    by_product = {e.label: e.probability for e in fuse(SPEECH, GESTURE, rule="product").nbest}
    assert by_product == pytest.approx({"a": 0.05 / 0.26, "b": 0.16 / 0.26, "c": 0.05 / 0.26})


def test_dempster_shafer_by_hand() -> None:
    options = FusionOptions(reliability_speech=0.8, reliability_gesture=0.6)
    fused = {e.label: e.probability for e in fuse(SPEECH, GESTURE, rule="dempster_shafer", options=options).nbest}
    mass = {
        label: 0.8 * s * 0.6 * g + 0.8 * s * 0.4 + 0.2 * 0.6 * g + 0.2 * 0.4 / 3
        for label, s, g in (("a", 0.5, 0.1), ("b", 0.4, 0.4), ("c", 0.1, 0.5))
    }
    assert fused == pytest.approx({label: m / sum(mass.values()) for label, m in mass.items()})


def test_unreliable_mode_says_nothing() -> None:
    options = FusionOptions(reliability_speech=0.0)
    fused = fuse(heard(a=0.99, b=0.01), seen(b=0.6, a=0.4), rule="dempster_shafer", options=options)
    assert fused.label == "b"


@pytest.mark.parametrize("rule", ["product", "dempster_shafer"])
def test_agreement_makes_surer(rule: str) -> None:
    assert fuse(heard(a=0.7, b=0.3), seen(a=0.7, b=0.3), rule=rule).confidence > 0.7


def test_label_that_one_mode_does_not_know_is_not_vetoed() -> None:
    fused = fuse(heard(a=0.9, b=0.1), seen(c=0.6, b=0.4), rule="product")
    assert {e.label for e in fused.nbest} == {"a", "b", "c"}
    assert all(e.probability > 0 for e in fused.nbest)


@pytest.mark.parametrize("rule", ["weighted_sum", "product", "dempster_shafer"])
def test_vector_rules_do_not_mind_which_mode_said_what(rule: str) -> None:
    """Probabilities, weights and reliabilities exchanged between the modes give the same answer."""
    a, b = {"a": 0.6, "b": 0.3, "c": 0.1}, {"a": 0.2, "b": 0.5, "c": 0.3}
    one = FusionOptions(weight_speech=2.0, weight_gesture=0.5, reliability_speech=0.7, reliability_gesture=0.9)
    other = FusionOptions(weight_speech=0.5, weight_gesture=2.0, reliability_speech=0.9, reliability_gesture=0.7)
    fused = {e.label: e.probability for e in fuse(heard(**a), seen(**b), rule=rule, options=one).nbest}
    exchanged = {e.label: e.probability for e in fuse(heard(**b), seen(**a), rule=rule, options=other).nbest}
    assert fused == pytest.approx(exchanged) and sum(fused.values()) == pytest.approx(1)


@pytest.mark.parametrize("rule", ["weighted_sum", "product", "dempster_shafer"])
def test_equal_classes_come_in_the_order_of_their_labels(rule: str) -> None:
    fused = fuse(heard(b=0.5, a=0.5), seen(b=0.5, a=0.5), rule=rule)
    assert [e.label for e in fused.nbest] == ["a", "b"] and fused.confidence == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("field", "value"),
    [
        *((f"{name}_{mode}", v) for name in ("threshold", "reliability") for mode in MODES for v in (-0.1, 1.1, NAN)),
        *((f"weight_{mode}", v) for mode in MODES for v in (0.0, -1.0, NAN, math.inf)),
        *(("probability_floor", v) for v in (-0.1, 0.5, NAN)),
        *(("stop_threshold", v) for v in (-0.1, 1.1, NAN)),
        ("stop_labels", "stop"),  # every letter of it would be a label
    ],
)
def test_impossible_options_are_named(field: str, value: object) -> None:
    with pytest.raises(InvalidArgument, match=rf"FusionOptions\.{field} must .* got"):
        FusionOptions(**{field: value})


def test_unknown_rule_lists_those_there_are() -> None:
    with pytest.raises(InvalidArgument, match=", ".join(RULES)):
        fuse(SPEECH, GESTURE, rule="majority")


def test_result_can_be_written_as_json() -> None:
    reported = json.loads(json.dumps(fuse(SPEECH, GESTURE, rule="product").to_dict()))
    assert reported["label"] == "b" and reported["speech"]["nbest"][0]["label"] == "a"


@pytest.mark.parametrize("rule", RULES)
def test_json_holds_numbers_that_every_reader_knows(rule: str) -> None:
    """The logarithm of 0 is no JSON."""
    fused = fuse(heard(a=1.0, b=0.0), seen(a=1.0, b=0.0), rule=rule)
    reported = json.loads(json.dumps(fused.to_dict(), allow_nan=False))
    assert reported["speech"]["nbest"][1] == {"label": "b", "probability": 0.0, "log_score": None}
    assert json.dumps(heard(a=1.0, b=0.0).to_dict(), allow_nan=False)
