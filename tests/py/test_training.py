# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""From a folder to a recogniser."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import hri
from hri.cli.main import main
from hri.core.errors import InvalidArgument
from hri.recognition import ConfusedPair, HeldOutReport


def test_train_makes_a_recogniser_of_the_kind_of_the_folder(spoken: Path) -> None:
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
    assert main(["train", "speech", "--data", str(spoken), "--out", str(path), "--front-end", "cepstra"]) == 0
    words = hri.WordRecognizer.load(path)
    found = words.held_out
    assert found is not None and found.labels == ("1", "2") and found.confusion.shape == (2, 2)
    assert found.num_samples == 18 and found.accuracy == np.trace(found.confusion) / 18
    said = capsys.readouterr().err
    assert f"of 18 recordings of people held out in training, {100 * found.accuracy:.1f} % are right" in said
    assert main(["info", str(path)]) == 0
    printed = capsys.readouterr().out
    assert f"held_out accuracy\t{100 * found.accuracy:.1f} %\n" in printed and "added since" not in printed
    words.add_word("3", [hri.read_audio(spoken / "1_low_0.wav")])
    assert words.held_out is not None and words.held_out.labels == ("1", "2")
    words.save(path)
    assert main(["info", str(path)]) == 0
    assert "held_out is of training, without what was added since\t3\n" in capsys.readouterr().out


def test_pairs_that_are_confused_are_named() -> None:
    report = HeldOutReport(("go", "no", "up"), np.eye(3, dtype=np.int64), 0.02, 0.1, (ConfusedPair("go", "no", 0.25),))
    rates, pair = report.lines()
    assert "2.0 % of these are rejected as unknown, and 10.0 % of words" in rates
    assert pair.startswith("'go' and 'no' are hard to distinguish (25.0 % taken for one another)")
    assert report.to_dict()["confused_pairs"] == [{"first": "go", "second": "no", "rate": 0.25}]


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
