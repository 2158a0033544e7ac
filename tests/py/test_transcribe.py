# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What ``hri transcribe`` prints of a recording and of a stream."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from conftest import RATE_HZ, tone_word
from hri.datasets import Dataset
from hri.htk import MasterLabelFile
from hri.io import write_wav_pcm16
from hri.recognition import ConnectedWordRecognizer

WORDS = ["1", "2", "2", "1"]


def model_of(spoken: Path, path: Path, **options: float) -> Path:
    """A model that doubts: by the scale that training chooses, of so clear words every confidence would be 1."""
    quick = {"num_states": 5, "num_vtlp_factors": 1, "num_noisy_copies": 0}
    doubting = {"choose_penalty": False, "confidence_scale": 0.001, "lattice": {"beam": 3000.0}}
    samples = Dataset.load(spoken).samples
    recognizer = ConnectedWordRecognizer(words=quick, max_words=4, **doubting, **options)
    recognizer.fit([s.path for s in samples], [s.label for s in samples]).save(path)
    return path


@pytest.fixture(scope="module")
def model(spoken: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return model_of(spoken, tmp_path_factory.mktemp("model") / "words.hri")


@pytest.fixture
def number(tmp_path: Path) -> Path:
    """The words by a speaker who was not trained on, between a second of quiet and another."""
    clips = [tone_word(575, 800 if word == "1" else -350, 50 + i) for i, word in enumerate(WORDS)]
    quiet = np.resize(clips[0][: RATE_HZ // 5], RATE_HZ)
    middle = [clip[RATE_HZ // 10 : 4 * RATE_HZ // 5] for clip in clips]
    write_wav_pcm16(str(tmp_path / "number.wav"), np.concatenate([quiet, *middle, quiet]), RATE_HZ)
    return tmp_path / "number.wav"


def column(text: str, number: int) -> list[str]:
    return [line.split("\t")[number] for line in text.splitlines()]


def test_unknown_words_are_so_however_they_are_printed(hri, spoken: Path, number: Path, tmp_path: Path) -> None:
    strict = model_of(spoken, tmp_path / "strict.hri", min_confidence=0.95)
    read = ("transcribe", number, "--model", strict)
    report = json.loads(hri(*read, "--json", "-").out)[str(number)]
    labels = report["text"].split()
    assert labels == ["1", "<unk>", "<unk>", "1"] and [word["label"] for word in report["words"]] == WORDS
    assert hri(*read).out.split() == labels
    assert column(hri(*read, "--times", "--mlf", tmp_path / "found.mlf").out, 2) == labels
    ((_, written),) = MasterLabelFile.read(tmp_path / "found.mlf").entries
    assert [label.name for label in written.labels] == labels
    *_, last = map(json.loads, hri(*read, "--stream").out.splitlines())
    assert last["event"] == "final" and "<unk>" in last["text"]
    assert column(hri(*read, "--stream", "--times").out, 2) == last["text"].split()


def test_a_stream_takes_what_is_said_behind_the_wake_word(hri, model: Path, number: Path) -> None:
    read = ("transcribe", number, "--model", model, "--stream")
    every = [json.loads(line) for line in hri(*read).out.splitlines()]
    woken = [json.loads(line) for line in hri(*read, "--wake", "2").out.splitlines()]
    assert every[-1]["event"] == woken[-1]["event"] == "final"
    assert (every[-1]["text"], woken[-1]["text"]) == ("1 2 2 1", "2 1")
    assert woken[-1]["words"] == every[-1]["words"][2:]
    assert all(line["text"] in ("", "2", "2 1") for line in woken)
    assert column(hri(*read, "--wake", "2", "--times").out, 2) == ["2", "1"]
    refused = hri(*read, "--wake", "robot")
    assert refused.code == 3 and "wake_word is 'robot', which is no label" in refused.err
