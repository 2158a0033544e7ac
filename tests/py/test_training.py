# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""From a folder to a recogniser."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import hri
from conftest import RATE_HZ, tone_word
from hri.cli.main import main
from hri.core.errors import InvalidArgument
from hri.io import write_wav_pcm16
from hri.recognition import ConfusedPair, HeldOutReport


def test_train_makes_a_recogniser_of_the_kind_of_the_folder(spoken: Path, few_fillers: None) -> None:
    seen: list[tuple[str, int, int]] = []
    recognizer = hri.train(hri.Dataset.load(spoken, "speech"), progress=lambda *step: seen.append(step))
    assert isinstance(recognizer, hri.WordRecognizer)
    assert list(recognizer.classes_) == ["1", "2"]
    audio = hri.read_audio(spoken / "1_low_0.wav")
    assert recognizer.recognise(audio.samples, audio.sample_rate_hz).nbest[0].label == "1"
    assert ("reading", 18, 18) in seen and seen[-1][0] == "training" and seen[-1][1] == seen[-1][2]


def test_train_says_what_it_measured_on_people_held_out(
    spoken: Path, tmp_path: Path, few_fillers: None, capsys
) -> None:
    path = tmp_path / "words.hri"
    quick = ["--front-end", "cepstra", "--no-network"]
    assert main(["train", "speech", "--data", str(spoken), "--out", str(path), *quick]) == 0
    words = hri.WordRecognizer.load(path)
    found = words.held_out
    assert found is not None and found.labels == ("1", "2") and found.confusion.shape == (2, 2)
    assert found.num_samples == 18 and found.accuracy == np.trace(found.confusion) / 18
    said = capsys.readouterr().err
    held_out = "of 18 recordings held out in training, by person where that was possible"
    assert f"{held_out}, {100 * found.accuracy:.1f} % are right" in said
    assert "how many words that are not in the vocabulary are accepted was not measured" in said
    assert found.num_others == 0 and found.false_accept_rate is None  # of two words neither can be left out
    assert main(["info", str(path)]) == 0
    printed = capsys.readouterr().out
    assert f"held_out accuracy\t{100 * found.accuracy:.1f} %\n" in printed and "added since" not in printed
    assert "held_out false_accept_rate\tnot measured\n" in printed
    words.add_word("3", [hri.read_audio(spoken / "1_low_0.wav")])
    assert words.held_out is not None and words.held_out.labels == ("1", "2")
    words.save(path)
    assert main(["info", str(path)]) == 0
    assert "held_out is of training, without what was added since\t3\n" in capsys.readouterr().out


def _say(folder: Path, label: str, person: str, slope: float, base_hz: float, takes: int) -> None:
    for take in range(takes):
        audio = tone_word(base_hz, slope, takes * len(person + label) + take)
        write_wav_pcm16(str(folder / f"{label}_{person}_{take}.wav"), audio, RATE_HZ)


def test_words_are_rejected_where_each_person_alone_recorded_some(tmp_path: Path, few_fillers: None, capsys) -> None:
    spoken, path = tmp_path / "spoken", tmp_path / "words.hri"
    spoken.mkdir()
    for person, base_hz in (("asha", 500.0), ("ravi", 550.0)):
        _say(spoken, "up", person, 800.0, base_hz, 3)
        _say(spoken, "down", person, -350.0, base_hz, 3)
    _say(spoken, "flat", "asha", 0.0, 900.0, 3)
    _say(spoken, "high", "ravi", 0.0, 1500.0, 3)
    assert main(["train", "speech", "--data", str(spoken), "--out", str(path), "--front-end", "cepstra"]) == 0
    said = capsys.readouterr().err
    assert "every person alone recorded some label" in said and "no rejection" not in said
    words = hri.WordRecognizer.load(path)
    assert words.is_calibrated and words.held_out is not None and words.held_out.num_samples == 18
    assert words.threshold > -1e6


def test_one_recording_of_a_word_is_said_to_be_no_rejection(tmp_path: Path, few_fillers: None, capsys) -> None:
    spoken, path = tmp_path / "spoken", tmp_path / "words.hri"
    spoken.mkdir()
    _say(spoken, "up", "asha", 800.0, 500.0, 1)
    _say(spoken, "down", "ravi", -350.0, 550.0, 1)
    out = str(tmp_path / "train.json")
    command = ["train", "speech", "--data", str(spoken), "--out", str(path), "--front-end", "cepstra", "--json", out]
    assert main(command) == 0
    assert "no rejection: nothing could be held out" in capsys.readouterr().err
    assert json.loads(Path(out).read_text())["is_calibrated"] is False
    words = hri.WordRecognizer.load(path)
    assert not words.is_calibrated and words.held_out is None
    assert main(["info", str(path)]) == 0
    shown = capsys.readouterr()
    assert "is_calibrated\tfalse" in shown.out and "no rejection" in shown.err


def test_pairs_that_are_confused_are_named() -> None:
    pairs = (ConfusedPair("go", "no", 0.25),)
    report = HeldOutReport(("go", "no", "up"), np.eye(3, dtype=np.int64), 0.02, 3, 0.1, pairs)
    rates, pair = report.lines("word")
    assert "2.0 % of these are rejected as unknown, and 10.0 % of words" in rates
    assert pair.startswith("'go' and 'no' are hard to distinguish (25.0 % taken for one another)")
    assert "choose another word for one of them" in pair and "choose another gesture" in report.lines("gesture")[1]
    assert report.to_dict()["confused_pairs"] == [{"first": "go", "second": "no", "rate": 0.25}]


def test_no_rate_is_given_of_what_was_not_measured() -> None:
    never_right = HeldOutReport(("go", "no"), np.array([[0, 1], [1, 0]]), 0.0, 0, None, ())
    assert never_right.lines("gesture") == [
        "of 2 recordings held out in training, by person where that was possible, 0.0 % are right; "
        "how many gestures that are not in the vocabulary are accepted was not measured"
    ]
    assert never_right.to_dict()["false_accept_rate"] is None and never_right.to_dict()["num_others"] == 0


def test_train_keeps_the_options_it_is_given(signed: Path) -> None:
    recognizer = hri.train(hri.Dataset.load(signed), hri.GestureRecognizer(model="knn"))
    assert isinstance(recognizer, hri.GestureRecognizer)
    assert str(recognizer.get_params()["model"]).endswith("knn")
    assert list(recognizer.classes_) == ["1", "2"]


def test_threads_do_not_change_what_is_trained(spoken: Path, tmp_path: Path, few_fillers: None) -> None:
    models = []
    try:
        for count in (1, 3):
            command = [
                "--threads",
                str(count),
                "train",
                "speech",
                "--data",
                str(spoken),
                "--out",
                str(tmp_path / "words.hri"),
                "--option",
                "num_embedding_copies=1",
                "--option",
                "num_noisy_copies=1",
            ]
            assert main(command) == 0 and hri.num_threads() == count
            models.append((tmp_path / "words.hri").read_bytes())
    finally:
        hri.set_num_threads(0)
    assert models[0] == models[1] and hri.num_threads() >= 1
    with pytest.raises(InvalidArgument, match="num_threads"):
        hri.set_num_threads(-1)


def test_train_refuses_a_recogniser_of_the_other_mode(spoken: Path) -> None:
    with pytest.raises(InvalidArgument, match=r"is for speech, the recogniser is for gesture"):
        hri.train(hri.Dataset.load(spoken, "speech"), hri.GestureRecognizer())
