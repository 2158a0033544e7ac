# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Words outside the vocabulary: error rates of rejection, and the study that measures them."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest

from conftest import PERSONS, RATE_HZ, tone_word
from hri import _native, studies
from hri.core.errors import InvalidArgument
from hri.evaluation.rejection import equal_error_rate, error_rates, false_rejects_at
from hri.studies import noise, unknown_words

pytestmark = pytest.mark.usefixtures("few_fillers")


def test_error_rates_are_those_of_counting() -> None:
    rng = np.random.default_rng(3)
    known, unknown = rng.normal(1.5, 1, 200), rng.normal(0, 1, 300)
    accepted, rejected = error_rates(known, unknown)
    thresholds = [*np.unique(np.concatenate([known, unknown])), np.inf]
    assert accepted == pytest.approx([np.mean(unknown >= t) for t in thresholds])
    assert rejected == pytest.approx([np.mean(known < t) for t in thresholds])
    # Two normals 1.5 deviations apart cross at 0.75 deviations.
    assert equal_error_rate(known, unknown) == pytest.approx(0.227, abs=0.04)
    shares = false_rejects_at(known, unknown, (0.0, 0.1, 1.0))
    assert shares == sorted(shares, reverse=True) and shares[-1] == 0.0
    assert shares[0] == np.mean(known <= unknown.max())


def test_what_nobody_heard_is_never_accepted() -> None:
    assert equal_error_rate([1.0, 2.0], [-np.inf, -np.inf]) == 0.0
    accepted, rejected = error_rates([1.0, -np.inf], [0.0])
    assert rejected.min() == 0.5 and accepted.max() == 1.0
    for known, unknown in (([], [1.0]), ([1.0], []), ([np.nan], [1.0])):
        with pytest.raises(InvalidArgument, match="score"):
            equal_error_rate(known, unknown)


@pytest.fixture(scope="module")
def data_dir(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Four words of gliding tones by three persons, and noises."""
    folder = tmp_path_factory.mktemp("data")
    (folder / "fsdd" / "recordings").mkdir(parents=True)
    for number, (person, base_hz) in enumerate(PERSONS.items()):
        for label, slope in (("0", 2000.0), ("1", 800.0), ("2", -350.0), ("3", 100.0)):
            for take in range(4):
                path = folder / "fsdd" / "recordings" / f"{label}_{person}_{take}.wav"
                _native.write_wav_pcm16(str(path), tone_word(base_hz, slope, 10 * number + take), RATE_HZ)
    for name in ("hindi_words/digits", "hindi_words/words", "noise"):
        (folder / name).mkdir(parents=True)
    rng = np.random.default_rng(0)
    for file in noise.NOISES.values():
        hiss = (0.1 * rng.standard_normal(3 * RATE_HZ)).astype("f4")
        _native.write_wav_pcm16(str(folder / "noise" / file), hiss, RATE_HZ)
    return folder


def test_half_a_vocabulary_is_turned_down(data_dir: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(unknown_words, "NUM_NOISES", 2)
    study = studies.get_study("unknown-words")
    result = studies.run_study(study, data_dir, lambda *progress: None, {"data": ["fsdd"]})
    (row,) = result["rows"]
    assert len(row["per_fold"]) == unknown_words.NUM_HALVES * len(PERSONS)
    assert row["eer_mean"] < 0.3, "chance is 0.5"
    assert row["noise_as_word_mean"] == 0 and row["burst_as_word_mean"] <= 0.25
    for half in result["details"]["fsdd"]["halves"]:
        assert len(set(half)) == 2 and set(half) < set("0123")
    assert result["passed_by_eer"].keys() == result["passed_by_threshold"].keys() == {"fsdd"}
    rejects = result["curves"]["lines"]["fsdd"]["y"]
    assert rejects == sorted(rejects, reverse=True)
    studies.draw(result, study.layout, tmp_path / "roc.png")
    assert cv2.imread(str(tmp_path / "roc.png")).std() > 5


def test_the_own_threshold_is_judged_too() -> None:
    met = {
        "data": "fsdd",
        "eer_mean": 0.12,
        "false_accepts_mean": 0.15,
        "false_rejects_mean": 0.05,
        "noise_no_input_mean": 1,
    }
    found = unknown_words._verdict([met], unknown_words.TARGETS)
    assert found["passed"] and found["passed_by_threshold"] == {"fsdd": True}
    for measure, value in (("false_accepts_mean", 0.16), ("false_rejects_mean", 0.06)):
        found = unknown_words._verdict([{**met, measure: value}], unknown_words.TARGETS)
        assert found["passed_by_eer"]["fsdd"] and not found["passed_by_threshold"]["fsdd"] and not found["passed"]
    assert not unknown_words._verdict([{**met, "eer_mean": 0.13}], unknown_words.TARGETS)["passed"]
    assert not unknown_words._verdict([{**met, "noise_no_input_mean": 0.9}], unknown_words.TARGETS)["passed"]


def test_a_vocabulary_too_small_to_halve_is_refused() -> None:
    with pytest.raises(InvalidArgument, match="half of 3 words"):
        unknown_words.halves(["a", "b", "c"])
    assert unknown_words.halves(list("abcdef"), 2, seed=1) == unknown_words.halves(list("abcdef"), 2, seed=1)
