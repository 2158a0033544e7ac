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
from hri.media import read_audio
from hri.recognition import ConnectedWordRecognizer
from hri.signal import find_speech

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


def test_a_confusion_network_is_printed(hri, model: Path, number: Path, tmp_path: Path) -> None:
    recognizer = ConnectedWordRecognizer.load(model)
    _, first_s, frame_s = recognizer.lattice(number)
    slots = recognizer.confusion_network(number)
    done = hri("transcribe", number, "--model", model, "--confusions", "--json", tmp_path / "j")
    assert done.code == 0
    report = json.loads((tmp_path / "j").read_text())[str(number)]
    assert report["text"] == "1 2 2 1" and len(report["confusions"]) == len(slots)
    for place, slot, line in zip(report["confusions"], slots, done.out.splitlines(), strict=True):
        assert place["first_s"] == pytest.approx(max(0.0, first_s + slot.first_frame * frame_s))
        assert place["last_s"] == pytest.approx(max(0.0, first_s + slot.last_frame * frame_s))
        words = [(word["label"], word["probability"]) for word in place["words"]]
        assert words == [(None if index < 0 else str(recognizer.classes_[index]), p) for index, p in slot.entries]
        fields = [f"{place['first_s']:.3f}", f"{place['last_s']:.3f}"]
        assert line.split("\t") == fields + [f"{label or '-'} {p:.3f}" for label, p in words if p >= 0.0005]
    best = [field.split()[0] for field in column(done.out, 2)]
    assert [label for label in best if label != "-"] == WORDS and any(len(slot.entries) > 2 for slot in slots)
    # Around a word at the very beginning frames begin before the recording.
    audio = read_audio(number)
    first, last = find_speech(audio.samples, RATE_HZ) or (0, 0)
    write_wav_pcm16(str(tmp_path / "cut.wav"), audio.samples[first:last], RATE_HZ)
    assert recognizer.lattice(tmp_path / "cut.wav")[1] < 0
    cut = hri("transcribe", tmp_path / "cut.wav", "--model", model, "--confusions")
    assert min(map(float, column(cut.out, 0))) == 0.0
    three = hri("transcribe", number, "--model", model, "--confusions", "--words", 3)
    assert len([field for field in column(three.out, 2) if field[0] != "-"]) == 3
    for other in (("--times",), ("--alternatives", 2), ("--stream",)):
        refused = hri("transcribe", number, "--model", model, "--confusions", *other)
        assert refused.code == 2 and "--confusions" in refused.err
