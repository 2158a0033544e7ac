# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""From a folder to a recogniser."""

from __future__ import annotations

from pathlib import Path

import pytest

import hri
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


def test_train_refuses_a_recogniser_of_the_other_mode(spoken: Path) -> None:
    with pytest.raises(InvalidArgument, match=r"is for speech, the recogniser is for gesture"):
        hri.train(hri.Dataset.load(spoken, "speech"), hri.GestureRecognizer())
