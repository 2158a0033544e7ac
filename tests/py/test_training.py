# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""From a folder to a recogniser."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import hri
from hri import _native
from hri.datasets.synthetic_signer import make_gesture_corpus
from hri.errors import InvalidArgument

RATE_HZ = 16000


@pytest.fixture(scope="module")
def spoken(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Rising and falling tones as words, by two "persons" of different pitch."""
    folder = tmp_path_factory.mktemp("spoken")
    rng = np.random.default_rng(0)
    time_s = np.arange(RATE_HZ // 2) / RATE_HZ
    for person, base_hz in (("low", 500), ("high", 600)):
        for take in range(4):
            for label, slope in (("rise", 800), ("fall", -350)):
                phase = 2 * np.pi * (base_hz * time_s + 0.5 * slope * time_s**2)
                tone = 0.3 * np.sin(phase) + 0.001 * rng.standard_normal(len(time_s))
                clip = np.concatenate([0.001 * rng.standard_normal(RATE_HZ // 4), tone, np.zeros(RATE_HZ // 4)])
                _native.write_wav_pcm16(str(folder / f"{label}_{person}_{take}.wav"), clip.astype(np.float32), RATE_HZ)
    return folder


def test_train_makes_a_recogniser_of_the_kind_of_the_folder(spoken: Path) -> None:
    seen: list[tuple[str, int, int]] = []
    recognizer = hri.train(hri.Dataset.load(spoken, "speech"), progress=lambda *step: seen.append(step))
    assert isinstance(recognizer, hri.WordRecognizer)
    assert list(recognizer.classes_) == ["fall", "rise"]
    audio = hri.read_audio(spoken / "rise_high_0.wav")
    assert recognizer.recognise(audio.samples, audio.sample_rate_hz).nbest[0].label == "rise"
    assert ("reading", 16, 16) in seen and seen[-1][0] == "training" and seen[-1][1] == seen[-1][2]


def test_train_keeps_the_options_it_is_given(tmp_path: Path) -> None:
    make_gesture_corpus(tmp_path, labels=("1", "5"), num_persons=3, seed=1)
    recognizer = hri.train(hri.Dataset.load(tmp_path), hri.GestureRecognizer(model="knn"))
    assert isinstance(recognizer, hri.GestureRecognizer)
    assert str(recognizer.get_params()["model"]).endswith("knn")
    assert list(recognizer.classes_) == ["1", "5"]


def test_train_refuses_a_recogniser_of_the_other_mode(spoken: Path) -> None:
    with pytest.raises(InvalidArgument, match=r"is for speech, the recogniser is for gesture"):
        hri.train(hri.Dataset.load(spoken, "speech"), hri.GestureRecognizer())
