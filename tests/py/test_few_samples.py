# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Words added to a trained recogniser from few recordings: in Python, on the command line, and as a study."""

from __future__ import annotations

import json
from copy import copy
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import hri as hri_package
from conftest import QUICK, RATE_HZ, tone_word
from hri.core.errors import InvalidArgument
from hri.io import write_wav_pcm16
from hri.signal import resample
from hri.studies import get_study, run_study

pytestmark = pytest.mark.usefixtures("few_fillers")


def flat(base_hz: float, seed: int) -> NDArray[np.float32]:
    return tone_word(base_hz, 0.0, 100 + seed)


THREE = [flat(600.0, take) for take in range(3)]


@pytest.fixture(scope="module", params=["hmm", "ptbhmm"])
def words(request: pytest.FixtureRequest, spoken: Path) -> hri_package.WordRecognizer:
    recognizer = hri_package.WordRecognizer(model=request.param)
    return hri_package.train(hri_package.Dataset.load(spoken, "speech"), recognizer)


def test_three_recordings_make_a_word(words: hri_package.WordRecognizer, tmp_path: Path) -> None:
    more = copy(words).add_word("0", THREE, RATE_HZ)
    assert list(more.classes_) == ["0", "1", "2"] and list(words.classes_) == ["1", "2"]
    assert list(more.predict([flat(570.0, 7), flat(640.0, 8)], RATE_HZ)) == ["0", "0"]
    rising, falling = tone_word(550.0, 800.0, 50), tone_word(550.0, -350.0, 51)
    assert list(more.predict([rising, falling], RATE_HZ)) == ["1", "2"]
    before, after = words.scores(rising, RATE_HZ), more.scores(rising, RATE_HZ)
    if words.options.model == "hmm":
        assert (after[1:] == before).all()
    np.testing.assert_allclose(after[1] - after[2], before[0] - before[1], rtol=1e-5)

    more.save(tmp_path / "more.hri")
    again = hri_package.WordRecognizer.load(tmp_path / "more.hri")
    assert (again.scores(rising, RATE_HZ) == after).all()
    assert (again.remove_word("0").scores(rising, RATE_HZ) == before).all()


def test_clips_at_other_rates_are_words_too(words: hri_package.WordRecognizer) -> None:
    slower = resample(THREE[1], RATE_HZ, 22050)
    more = copy(words).add_word("0", [THREE[0], slower], [RATE_HZ, 22050])
    assert list(more.predict([THREE[2]], RATE_HZ)) == ["0"]


def test_what_cannot_be_added_is_named_and_changes_nothing(words: hri_package.WordRecognizer) -> None:
    broken = THREE[0].copy()
    broken[77] = np.nan
    silence = np.zeros(8000, "f4")
    for label, clips, message in (
        ("1", THREE, "'1' is in the vocabulary already"),
        ("unknown", THREE, "'unknown'"),
        ("", THREE, "empty"),
        ("0", [], "at least one recording"),
        ("0", [THREE[0], silence], r"clips\[1\]: audio has no speech"),
        ("0", [THREE[0], broken], r"clips\[1\]: .*index 77"),
        ("0", [THREE[0][:10]], r"clips\[0\]: audio is too short"),
        ("0", [THREE[0].reshape(2, -1)], r"clips\[0\] must be one-dimensional"),
    ):
        with pytest.raises(InvalidArgument, match=message):
            words.add_word(label, clips, RATE_HZ)
    with pytest.raises(InvalidArgument, match="differ in length"):
        words.add_word("0", THREE, [RATE_HZ])
    with pytest.raises(InvalidArgument, match="no word '0'"):
        words.remove_word("0")
    with pytest.raises(InvalidArgument, match="at least 2 words"):
        words.remove_word("1")
    with pytest.raises(InvalidArgument, match="not trained"):
        hri_package.WordRecognizer().add_word("0", THREE, RATE_HZ)
    assert list(words.classes_) == ["1", "2"]


def test_the_command_line_adds_and_removes_words(hri, spoken: Path, tmp_path: Path) -> None:
    model, more = tmp_path / "two.hri", tmp_path / "new" / "three.hri"
    assert hri("train", "speech", "--data", spoken, "--out", model, *QUICK).code == 0
    files = [tmp_path / f"flat{take}.wav" for take in range(3)]
    for path, clip in zip(files, THREE, strict=True):
        write_wav_pcm16(str(path), clip, RATE_HZ)
    added = hri("add-word", "--model", model, "--label", "0", *files, "-o", more, "--json", "-")
    assert added.code == 0 and "3 labels: 0 1 2" in added.err
    assert json.loads(added.out) == {"model": str(more), "labels": ["0", "1", "2"]}
    heard = hri("recognise", "--speech", files[1], "--speech-model", more, "--json", "-")
    assert json.loads(heard.out)["speech"]["nbest"][0]["label"] == "0"

    again = hri("add-word", "--model", more, "--label", "0", *files)
    assert again.code == 3 and "in the vocabulary already" in again.err
    removed = hri("remove-word", "--model", more, "--label", "0")  # in place
    assert (removed.code, removed.out) == (0, f"{more}\n")
    assert more.read_bytes() == model.read_bytes()
    assert hri("remove-word", "--label", "0").code == 3  # no model is kept
    assert hri("add-word", "--model", model, "--label", "0").code == 2


def test_the_study_compares_with_training(tmp_path: Path, few_fillers: None, few_copies: None) -> None:
    folder = tmp_path / "fsdd" / "recordings"
    folder.mkdir(parents=True)
    (tmp_path / "hindi_words" / "words").mkdir(parents=True)
    for person, base_hz in (("a", 500.0), ("b", 550.0), ("c", 600.0)):
        for label, slope in (("0", 0.0), ("1", 800.0), ("2", -350.0)):
            for take in range(4):
                clip = tone_word(base_hz, slope, 10 * take + int(label))
                write_wav_pcm16(str(folder / f"{label}_{person}_{take}.wav"), clip, RATE_HZ)
    only = {"data": ["fsdd"], "model": ["hmm"]}
    rows = run_study(get_study("few-samples"), tmp_path, lambda *progress: None, only)["rows"]
    places = [(row["source"], row["samples"]) for row in rows]
    assert places == [
        *(("not added", 0), ("user", 1), ("user", 2)),
        *(("others", count) for count in (1, 2, 3, 5)),
        ("training", 8),
    ]
    assert "added_mean" not in rows[0] and set(rows[1]["per_fold"]) == {"a", "b", "c"}
    assert rows[0]["others_mean"] == rows[-1]["others_mean"] == rows[-1]["added_mean"] == 1.0
    for row in rows[1:]:
        assert row["added_right_mean"] <= min(row["added_mean"], 1 - row["rejected_mean"])
        assert row["others_right_mean"] <= row["others_mean"]
    assert rows[2]["added_mean"] >= 0.8 and rows[-2]["added_mean"] >= 0.8  # two of his own, five of others
