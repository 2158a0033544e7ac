# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Calibration of confidences: by hand, against scikit-learn's calibration curve, and from the command line."""

from __future__ import annotations

import json
from pathlib import Path

import cv2
import numpy as np
import pytest

from hri.core.errors import InvalidArgument
from hri.evaluation import EvaluationResult, FoldResult, reliability
from hri.evaluation.result import EvaluationItem
from hri.recognition import Decision, NBest


def item(truth: str, best: str | None, confidence: float, status: str = "recognised") -> EvaluationItem:
    nbest = () if best is None else (NBest(best, confidence, -1.0),)
    label = best if best is not None and status == "recognised" else status
    return EvaluationItem(0, truth, Decision("speech", label, status, confidence, nbest=nbest))


def test_the_error_is_that_of_a_computation_by_hand() -> None:
    # Five bins. (0.2, 0.4]: 0.3 wrong. (0.4, 0.6]: 0.5 right, 0.6 wrong. (0.8, 1]: 0.9, 0.9, 1.0 right, 0.85 wrong.
    confidence = [0.3, 0.5, 0.6, 0.9, 0.9, 1.0, 0.85]
    right = [False, True, False, True, True, True, False]
    found = reliability(confidence, right, num_bins=5)
    assert [one.num_items for one in found.bins] == [0, 1, 2, 0, 4]
    assert [one.accuracy for one in found.bins] == [None, 0.0, 0.5, None, 0.75]
    assert found.bins[2].confidence == pytest.approx(0.55) and found.bins[4].confidence == pytest.approx(0.9125)
    by_hand = (1 * 0.3 + 2 * 0.05 + 4 * 0.1625) / 7
    assert found.expected_error == pytest.approx(by_hand, rel=1e-12)
    assert found.num_items == 7 and "15.0 %" in repr(found)


def test_a_bin_holds_its_upper_end_and_the_first_one_zero() -> None:
    found = reliability([0.0, 0.25, 0.5, 1.0], [True] * 4, num_bins=4)
    assert [one.num_items for one in found.bins] == [2, 1, 0, 1]
    assert [(one.low, one.high) for one in found.bins] == [(0.0, 0.25), (0.25, 0.5), (0.5, 0.75), (0.75, 1.0)]


def test_the_bins_are_those_of_scikit_learn() -> None:
    sklearn = pytest.importorskip("sklearn.calibration")
    rng = np.random.default_rng(4)
    confidence = rng.beta(4, 1.5, 5000)
    right = rng.uniform(size=5000) < confidence**2  # too sure of itself
    found = reliability(confidence, right)
    share, mean = sklearn.calibration_curve(right, confidence, n_bins=15, strategy="uniform")
    filled = [one for one in found.bins if one.num_items]
    assert [one.accuracy for one in filled] == pytest.approx(share, rel=1e-12)
    assert [one.confidence for one in filled] == pytest.approx(mean, rel=1e-12)
    weights = np.array([one.num_items for one in filled]) / 5000
    assert found.expected_error == pytest.approx(np.sum(weights * np.abs(share - mean)), rel=1e-12)
    # The mean of c - c^2 under that density.
    assert found.expected_error == pytest.approx(np.mean(confidence - confidence**2), abs=0.02)
    honest = reliability(confidence, rng.uniform(size=5000) < confidence)
    assert honest.expected_error < 0.03 < found.expected_error


def test_what_cannot_be_binned_is_refused() -> None:
    for confidence, right in (([], []), ([0.5], [True, False]), ([[0.5]], [[True]])):
        with pytest.raises(InvalidArgument, match="one value for each decision"):
            reliability(confidence, right)
    for wrong in (-0.1, 1.1, float("nan")):
        with pytest.raises(InvalidArgument, match=r"0\.\.1"):
            reliability([0.5, wrong], [True, True])
    for bins in (0, 10**9):
        with pytest.raises(InvalidArgument, match="num_bins"):
            reliability([0.5], [True], bins)
    with pytest.raises(InvalidArgument, match=r"num_bins must be an integer, got 2\.5"):
        reliability([0.5], [True], 2.5)


def test_truth_values_and_numbers_of_tables_are_read() -> None:
    expected = reliability([0.9, 0.6], [True, False])
    objects = np.array([True, False], object), np.array([0.9, 0.6], object)
    for confidence, right in (([0.9, 0.6], [1, 0]), ([0.9, 0.6], np.array([1, 0], "u1")), objects[::-1]):
        assert reliability(confidence, right) == expected


def test_what_is_no_truth_value_or_no_number_is_refused() -> None:
    nan = float("nan")
    for wrong in (["yes", "no"], ["True", "False"], [nan, 1.0], [1.0, 0.0], [None, True], [True, nan], [0, 2], [-1, 1]):
        for given in (wrong, np.array(wrong, object)):
            with pytest.raises(InvalidArgument, match="right must be True or False for each decision"):
                reliability([0.5, 0.6], given)
    for wrong in (["high", "low"], ["0.5", "0.6"], [0.5, "0.6"], [0.5, 0.6j], [0.5, object()]):
        for given in (wrong, np.array(wrong, object)):
            with pytest.raises(InvalidArgument, match="confidence must be numbers"):
                reliability(given, [True, False])
    with pytest.raises(InvalidArgument, match=r"0\.\.1"):
        reliability([0.5, None], [True, False])
    with pytest.raises(InvalidArgument, match="confidence needs one value for each decision"):
        reliability([[0.5], [0.5, 0.6]], [True, False])


def test_the_best_label_counts_rejected_or_not_and_silence_does_not(tmp_path: Path) -> None:
    first = (item("a", "a", 0.9), item("a", "b", 0.7), item("b", None, 0.0, "no_input"))
    second = (item("b", "b", 0.4, "unknown"),)
    result = EvaluationResult(["a", "b"], [FoldResult("x", first), FoldResult("y", second)])
    assert result.reliability().num_items == 3
    assert result.calibration_error == pytest.approx((0.1 + 0.7 + 0.6) / 3)
    assert result.folds[0].calibration_error == pytest.approx(0.4)
    assert result.recognised_right == 0.25 and result.mean == pytest.approx(2 / 3)
    assert [fold.recognised_right for fold in result.folds] == [pytest.approx(1 / 3), 0.0]
    written = json.loads(json.dumps(result.to_dict()))
    assert written["calibration_error"] == result.calibration_error and written["recognised_right"] == 0.25
    axes = result.reliability().plot(tmp_path / "r.png")
    assert axes.get_xlabel() == "confidence" and cv2.imread(str(tmp_path / "r.png")).std() > 5
    silent = EvaluationResult(["a"], [FoldResult("x", (item("a", None, 0.0, "no_input"),))])
    assert silent.calibration_error is None and silent.to_dict()["folds"][0]["calibration_error"] is None
    with pytest.raises(InvalidArgument, match="one value for each decision"):
        silent.reliability()


def test_the_command_line_prints_draws_and_writes_it(hri, signed: Path, tmp_path: Path) -> None:
    picture, report = tmp_path / "new" / "reliability.png", tmp_path / "report.json"
    result = hri(
        *("evaluate", "gesture", "--data", signed, "--folds", "2"), *("--reliability", picture, "--json", report)
    )
    assert result.code == 0, result.err
    written = json.loads(report.read_text())
    rows = [line.split("\t") for line in result.out.splitlines()]
    assert rows[0][4:] == ["recognised and right", "calibration error"]
    assert rows[-1][4] == f"{100 * written['recognised_right']:.1f} %"
    assert rows[-1][5] == f"{100 * written['calibration_error']:.1f} %"
    bins = written["reliability"]["bins"]
    assert len(bins) == 15 and sum(one["num_items"] for one in bins) == written["num_samples"]
    gaps = [one["num_items"] * abs(one["accuracy"] - one["confidence"]) for one in bins if one["num_items"]]
    assert written["calibration_error"] == pytest.approx(sum(gaps) / written["num_samples"])
    assert cv2.imread(str(picture)) is not None
