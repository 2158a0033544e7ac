# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What the study of fusion pairs, chooses and judges, on decisions made by hand."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any, ClassVar

import numpy as np
import pytest

from hri.datasets import Sample
from hri.fusion import fuse
from hri.recognition import Decision, NBest
from hri.studies import fusion_conditions as study
from hri.studies.fusion import RULE, meets_target
from hri.studies.fusion_pairs import WORST_EXPOSURE, WORST_SNR_DB, Pair, paired, plan_test, plan_training

LABELS = ("1", "2", "3")


def decided(mode: str, label: str, quality: float, probability: float = 0.8) -> Decision:
    others = [one for one in LABELS if one != label]
    ranked = [(label, probability), *((one, (1 - probability) / 2) for one in others)]
    return Decision(
        mode, label, "recognised", probability, nbest=tuple(NBest(*one, 0.0) for one in ranked), quality=quality
    )


class FakeSpeech:
    """Words that are recognised as they are; quality is the SNR."""

    samples: ClassVar = [Sample(Path(f"{i}.wav"), LABELS[i % 3], f"speaker{i // 3}") for i in range(30)]

    def clean(self, words: Any, number: int) -> Decision:
        return decided("speech", self.samples[number].label, 40.0)

    def noisy(self, words: Any, number: int, seed: int, snr_db: float | None) -> tuple[Decision, float]:
        ratio_db = float(np.random.default_rng([seed, number]).uniform(-5, 25)) if snr_db is None else snr_db
        return decided("speech", self.samples[number].label, ratio_db), ratio_db


class FakeSigns:
    """Signs that are recognised as they are; quality is the exposure."""

    samples: ClassVar = [Sample(Path(f"{i}.jpg"), LABELS[i % 3], f"signer{i // 3}") for i in range(60)]
    exposures = np.random.default_rng(0).uniform(0.06, 0.5, 60).tolist()

    def decided(self, signs: Any, number: int, light: str) -> Decision:
        return decided("gesture", self.samples[number].label, 1.0 if light == "bright" else self.exposures[number])


def test_training_pairs_contradict_only_where_one_mode_is_bad_and_the_other_is_meant() -> None:
    speech, signs, seen = FakeSpeech(), FakeSigns(), range(30)
    plan = plan_training(speech, None, range(15), signs, seen, 0)
    pairs = paired(plan, signs, None)
    assert len(pairs) == 15 * 3 and all(planned.sign in seen for planned in plan)
    contradicting = [p for p in pairs if p.speech.label != p.gesture.label]
    assert 3 <= len(contradicting) <= 25
    for pair in contradicting:
        if pair.truth == pair.gesture.label:
            assert pair.speech.quality < WORST_SNR_DB and pair.gesture.quality == 1.0
        else:
            assert pair.truth == pair.speech.label and pair.gesture.quality < WORST_EXPOSURE
            assert pair.speech.quality == 40.0
    assert all(p.truth == p.speech.label for p in pairs if p not in contradicting)
    again = plan_training(speech, None, range(15), signs, seen, 0)
    assert again == plan and plan_training(speech, None, range(15), signs, seen, 1) != plan


@pytest.mark.parametrize("means", ["both", "speech", "gesture"])
def test_test_pairs_mean_what_the_condition_says(means: str) -> None:
    speech, signs = FakeSpeech(), FakeSigns()
    heard = {i: speech.clean(None, i) for i in range(9)}
    pairs = paired(plan_test(heard, speech, signs, range(60), "bright", means, 0), signs, None)
    assert len(pairs) == 18
    for pair in pairs:
        assert (pair.speech.label == pair.gesture.label) == (means == "both")
        assert pair.truth == (pair.gesture.label if means == "gesture" else pair.speech.label)


def test_the_rule_is_chosen_by_what_inner_folds_hold_out() -> None:
    """Speech is sure and wrong in noise: a rule that knows the quality is right, table 6.9 is not."""
    rng = np.random.default_rng(0)
    parts = []
    for _ in range(2):
        part = []
        for _ in range(60):
            label, noisy = str(rng.choice(LABELS)), rng.random() < 0.5
            said = str(rng.choice(LABELS)) if noisy else label
            speech = decided("speech", said, 2.0 if noisy else 30.0, 0.95)
            part.append(Pair(speech, decided("gesture", label, 0.9, 0.85), label))
        parts.append(part)
    chosen, shares = study._choose(parts)
    assert chosen.startswith("learned") and shares[chosen] > shares["table_6_9"]
    assert set(shares) == {*study.FIXED, *study.LEARNED}
    assert study._recommended([shares, dict.fromkeys(shares, 0.5)]) == chosen


def rows(**changes: float) -> list[dict[str, Any]]:
    """Rows of two conditions where every rule is as good as 0.9 unless changed; the better mode has 0.85."""
    return [
        {"signs learned from": "x", "condition": condition, "decided by": by, "accuracy_mean": value}
        for condition in ("dark", "no sign")
        for by, value in (
            [("speech", 0.85), *([("gesture", 0.6)] if condition == "dark" else [])]
            + [(rule, changes.get(f"{rule}:{condition}", 0.9)) for rule in (*study.FIXED, *study.LEARNED, study.CHOSEN)]
        )
    ]


def test_the_verdict_is_that_of_the_target() -> None:
    found = study._verdict(rows())
    assert all(found[rule]["passed"] for rule in (*study.FIXED, *study.LEARNED, study.CHOSEN))
    assert found["chosen"]["least_gain"] == pytest.approx(0.05)
    found = study._verdict(rows(**{"chosen:dark": 0.87, "product:no sign": 0.86, "table_6_9:no sign": 0.84}))
    assert found["chosen"]["gain_too_small"] == ["x, dark"] and not found["chosen"]["passed"]
    assert found["product"]["passed"]  # a mode alone has nothing to gain from
    assert found["table_6_9"]["below_better_mode"] == ["x, no sign"] and not found["table_6_9"]["passed"]


def test_a_missing_mode_is_not_seen_by_the_rule() -> None:
    pairs = [Pair(decided("speech", "1", 30.0), decided("gesture", "2", 1.0, 0.95), "1")] * 4
    assert study._share("product", pairs) == 0 and study._share("product", pairs, "gesture") == 1
    measured = study._measured(pairs, {"product": "product"}, "product", "no sign")
    assert measured == {"speech": 1.0, "product": 1.0, "chosen": 1.0}
    fold = SimpleNamespace(**study._measured(pairs, {"product": "product"}, "product", "dark"))
    assert (fold.speech, fold.gesture, fold.product) == (1.0, 0.0, 0.0)


def test_digits_that_are_above_the_ceiling_may_lose_little() -> None:
    assert meets_target(0.9, 0.03) and not meets_target(0.9, 0.02)
    assert meets_target(0.99, -0.004) and not meets_target(0.99, -0.006)
    word, sign = decided("speech", "1", 30.0), decided("gesture", "2", 1.0)
    assert fuse(word, sign).rule == fuse(word, sign, rule=RULE).rule
