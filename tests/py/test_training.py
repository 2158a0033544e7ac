# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""From a folder to a recogniser."""

from __future__ import annotations

from pathlib import Path

import pytest

import hri
from hri.cli.main import main
from hri.core.errors import InvalidArgument


def test_train_makes_a_recogniser_of_the_kind_of_the_folder(spoken: Path) -> None:
    seen: list[tuple[str, int, int]] = []
    recognizer = hri.train(hri.Dataset.load(spoken, "speech"), progress=lambda *step: seen.append(step))
    assert isinstance(recognizer, hri.WordRecognizer)
    assert list(recognizer.classes_) == ["1", "2"]
    audio = hri.read_audio(spoken / "1_low_0.wav")
    assert recognizer.recognise(audio.samples, audio.sample_rate_hz).nbest[0].label == "1"
    assert ("reading", 18, 18) in seen and seen[-1][0] == "training" and seen[-1][1] == seen[-1][2]


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
