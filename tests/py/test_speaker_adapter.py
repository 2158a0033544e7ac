# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Getting used to a speaker: from Python and from the command line."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import hri as package
from conftest import PERSONS, RATE_HZ, tone_word
from hri import _native
from hri.core.errors import InvalidArgument
from hri.datasets import Dataset
from hri.evaluation import adapting, evaluate_conditions
from hri.studies import get_study, run_study

pytestmark = pytest.mark.usefixtures("few_fillers")


@pytest.fixture(scope="module")
def words() -> package.WordRecognizer:
    clips = [
        (tone_word(base_hz, slope, 7 * take + number), label, person)
        for number, (person, base_hz) in enumerate(PERSONS.items())
        for take in range(3)
        for label, slope in (("1", 800.0), ("2", -350.0))
    ]
    x, y, persons = map(list, zip(*clips, strict=True))
    return package.WordRecognizer().fit(x, y, sample_rate_hz=RATE_HZ, groups=persons)


def strange(slope: float, seed: int) -> np.ndarray:
    return tone_word(1100.0, slope, seed)


def test_words_that_were_named_are_learned(words: package.WordRecognizer) -> None:
    adapter = package.SpeakerAdapter(words, words_per_label=0)
    for seed in range(3):
        adapter.learn(strange(800.0, seed), "1", RATE_HZ)
        adapter.learn(strange(-350.0, seed), "2", RATE_HZ)
    assert adapter.update_due and adapter.num_words == 6
    adapter.update()
    assert not adapter.update_due
    for label, slope in enumerate((800.0, -350.0)):
        before = words.scores(strange(slope, 9), RATE_HZ)
        after = adapter.recognizer.scores(strange(slope, 9), RATE_HZ)
        assert after[label] - after[1 - label] > before[label] - before[1 - label]
    adapter.reset()
    clip = strange(800.0, 9)
    np.testing.assert_array_equal(adapter.recognizer.scores(clip, RATE_HZ), words.scores(clip, RATE_HZ))


def test_a_decision_comes_before_what_is_learned_from_it(words: package.WordRecognizer) -> None:
    clip = strange(800.0, 1)
    adapter = package.SpeakerAdapter(words)
    decision, alone = adapter.recognise(clip, RATE_HZ, update=False), words.recognise(clip, RATE_HZ)
    assert decision == alone and decision.quality == alone.quality is not None
    assert adapter.num_words == 1 and adapter.update_due
    assert adapter.recognise(np.zeros(RATE_HZ, np.float32), RATE_HZ).status == "no_input"
    assert adapter.num_words == 1


def test_options_and_words_are_checked(words: package.WordRecognizer) -> None:
    with pytest.raises(InvalidArgument, match="trusted_share"):
        package.SpeakerAdapter(words, trusted_share=2.0)
    with pytest.raises(InvalidArgument, match="no word 'left'"):
        package.SpeakerAdapter(words).learn(strange(800.0, 1), "left", RATE_HZ)
    with pytest.raises(InvalidArgument, match="not trained"):
        package.SpeakerAdapter(package.WordRecognizer())


def test_evaluation_adapts_to_one_person_a_fold(spoken: Path) -> None:
    dataset = Dataset.load(spoken, "speech")
    found = evaluate_conditions(dataset, package.WordRecognizer, {"": None}, adapt=True)
    assert set(found) == {"", adapting("")}
    alone, adapted = found[""], found[adapting("")]
    assert sorted(t.index for t in adapted.items) == sorted(t.index for t in alone.items)
    assert adapted.mean >= alone.mean
    with pytest.raises(InvalidArgument, match="one person"):
        evaluate_conditions(dataset, package.WordRecognizer, {"": None}, adapt=True, num_folds=2)


def test_command_adapts_a_model(hri, words: package.WordRecognizer, tmp_path: Path) -> None:
    words.save(tmp_path / "words.hri")
    for seed in range(3):
        for label, slope in (("1", 800.0), ("2", -350.0)):
            path = tmp_path / f"{label}_{seed}.wav"
            _native.write_wav_pcm16(str(path), tone_word(560.0, slope, 100 + seed), RATE_HZ)
    files = sorted(tmp_path.glob("*.wav"))
    done = hri("adapt", "--model", tmp_path / "words.hri", "-o", tmp_path / "mine.hri", *files)
    assert done.code == 0 and "of 6 recordings" in done.err, done.err
    heard = package.SpeakerAdapter(words)
    assert done.out.splitlines() == [f"{heard.recognise(file).label}\t{file}" for file in files]
    clip = strange(800.0, 9)
    adapted = package.WordRecognizer.load(tmp_path / "mine.hri")
    assert not np.array_equal(adapted.scores(clip, RATE_HZ), words.scores(clip, RATE_HZ))
    named = hri("adapt", "--model", tmp_path / "words.hri", "-o", tmp_path / "mine.hri", "--label", "1", files[0])
    assert named.code == 0, named.err
    wrong = hri("adapt", "--model", tmp_path / "words.hri", "-o", tmp_path / "mine.hri", "--label", "9", files[0])
    assert wrong.code == 3 and "no word '9'" in wrong.err


def test_command_learns_the_words_of_one_person_by_their_names(
    hri, words: package.WordRecognizer, spoken: Path, tmp_path: Path
) -> None:
    words.save(tmp_path / "words.hri")
    place = ("--model", tmp_path / "words.hri", "-o", tmp_path / "mine.hri")
    done = hri("adapt", *place, "--data", spoken, "--person", "low", "--json", "-")
    assert done.code == 0 and "from 6 of 6 recordings" in done.err, done.err
    reported = json.loads(done.out)
    assert sorted(reported["labels"].values()) == ["1", "1", "1", "2", "2", "2"]
    assert all(f"{label}_low_" in file for file, label in reported["labels"].items())
    adapter = package.SpeakerAdapter(words)
    for file, label in reported["labels"].items():
        adapter.learn(file, label)
    adapter.update()
    clip = strange(800.0, 9)
    adapted = package.WordRecognizer.load(tmp_path / "mine.hri")
    np.testing.assert_array_equal(adapted.scores(clip, RATE_HZ), adapter.recognizer.scores(clip, RATE_HZ))

    assert hri("adapt", *place, "--data", spoken, "--person", "absent").code == 3
    for wrong in ((), ("--person", "low", spoken / "1_low_0.wav"), ("--data", spoken, "--label", "1")):
        assert hri("adapt", *place, *wrong).code == 2


def test_the_study_learns_from_few_words_of_a_speaker(tmp_path: Path, few_copies: None) -> None:
    for folder in ("fsdd/recordings", "hindi_words/digits", "hindi_words/words"):
        (tmp_path / folder).mkdir(parents=True)
    for person, base_hz in PERSONS.items():
        for take in range(11):
            for label, slope in (("1", 800.0), ("2", -350.0)):
                path = tmp_path / "fsdd" / "recordings" / f"{label}_{person}_{take}.wav"
                _native.write_wav_pcm16(str(path), tone_word(base_hz, slope, take), RATE_HZ)
    study = get_study("adapt-words")
    only = {"data": ["fsdd"]}
    result = run_study(study, tmp_path, lambda *progress: None, only)
    rows = {(row["learning"], row["words"]): row for row in result["rows"]}
    assert set(rows) == {(how, count) for how in ("supervised", "unsupervised") for count in (0, 5, 10, 20)}
    assert rows["supervised", 0]["per_fold"] == rows["unsupervised", 0]["per_fold"]
    assert min(row["accuracy_mean"] for row in rows.values()) >= 0.9
    assert all(0 < row["right_mean"] <= row["accuracy_mean"] for row in rows.values())
    with pytest.raises(InvalidArgument, match="high has 20 recordings, more than 20 are needed"):
        run_study(study, tmp_path, lambda *progress: None, only, takes=10)
