# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri train speech --noise`` and `hri.train`: for a place where it is not quiet."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hri
from hri.cli.main import main
from hri.evaluation.noise import active_power
from hri.io import write_wav_pcm16
from hri.media import Audio, read_audio

RATE_HZ = 16000


@pytest.fixture
def hum(tmp_path: Path) -> Path:
    """Two seconds of a recorded place."""
    path = tmp_path / "hum.wav"
    samples = 0.1 * np.sin(2 * np.pi * 180 * np.arange(2 * RATE_HZ) / RATE_HZ)
    write_wav_pcm16(str(path), samples.astype(np.float32), RATE_HZ)
    return path


@pytest.fixture
def trained_on(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """The clips, labels, persons and recordings of the last training, which does not take place."""
    given: list[Any] = []

    def fit(self: hri.WordRecognizer, clips: list[Audio], labels: list[str], **more: Any) -> hri.WordRecognizer:
        given[:] = [clips, labels, more["groups"], more["recordings"]]
        return self

    monkeypatch.setattr(hri.WordRecognizer, "fit", fit)
    return given


def test_every_recording_gets_a_copy_in_noise_by_the_same_person(
    spoken: Path, hum: Path, trained_on: list[Any]
) -> None:
    dataset = hri.Dataset.load(spoken, "speech")
    number = len(dataset)
    hri.train(dataset, hri.WordRecognizer(seed=3), noises=[str(hum)])
    clips, labels, persons, recordings = (list(part) for part in trained_on)
    assert recordings[:number] == recordings[number:] and len(set(recordings)) == number, "held out together"
    assert labels == 2 * [s.label for s in dataset.samples] and persons == 2 * [s.person for s in dataset.samples]
    ratios = []
    for sample, clean, noisy in zip(dataset.samples, clips[:number], clips[number:], strict=True):
        assert np.array_equal(clean.samples, read_audio(sample.path).samples)
        assert noisy.sample_rate_hz == clean.sample_rate_hz and len(noisy.samples) == len(clean.samples)
        noise = noisy.samples - clean.samples
        ratios.append(10 * np.log10(active_power(clean.samples, clean.sample_rate_hz) / np.mean(noise**2)))
    assert -3 < min(ratios) < 6 and 14 < max(ratios) < 24  # dB, of 0 to 20
    hri.train(dataset, hri.WordRecognizer(seed=3), noises=[str(hum)])
    assert all(np.array_equal(a.samples, b.samples) for a, b in zip(clips, trained_on[0], strict=True))
    hri.train(dataset, hri.WordRecognizer(seed=4), noises=[str(hum)])
    assert not np.array_equal(clips[number].samples, trained_on[0][number].samples)
    hri.train(dataset, hri.WordRecognizer(seed=3))
    assert len(trained_on[0]) == number


def test_silence_in_a_noise_is_passed_over(spoken: Path, tmp_path: Path, trained_on: list[Any]) -> None:
    path = tmp_path / "pauses.wav"
    noise = np.zeros(4 * RATE_HZ, np.float32)
    noise[3 * RATE_HZ :] = 0.1 * np.random.default_rng(0).standard_normal(RATE_HZ)
    write_wav_pcm16(str(path), noise, RATE_HZ)
    hri.train(spoken, hri.WordRecognizer(), noises=[str(path)])
    clips = trained_on[0]
    for clean, noisy in zip(clips[: len(clips) // 2], clips[len(clips) // 2 :], strict=True):
        assert np.abs(noisy.samples - clean.samples).max() > 1e-3


def test_train_says_that_it_added_noise(
    spoken: Path, hum: Path, tmp_path: Path, few_fillers: None, capsys: pytest.CaptureFixture[str]
) -> None:
    report, plain, noisy = tmp_path / "report.json", tmp_path / "plain.hri", tmp_path / "noisy.hri"
    usual = ["train", "speech", "--data", str(spoken), "--front-end", "cepstra", "--no-network"]
    assert main([*usual, "--out", str(plain)]) == 0
    capsys.readouterr()
    assert main([*usual, "--noise", str(hum), "--noise", "pink", "--out", str(noisy), "--json", str(report)]) == 0
    said = capsys.readouterr().err
    assert "18 recordings, 3 persons" in said
    assert "a copy of every recording in noise" in said and "of 36 recordings held out" in said
    found = json.loads(report.read_text())
    assert found["noises"] == [str(hum), "pink"] and found["num_recordings"] == 18
    assert plain.read_bytes() != noisy.read_bytes()


@pytest.mark.parametrize(
    ("noise", "complaint"),
    [
        ("street.wav", "--noise street.wav is neither white nor pink nor a file"),
        ("silence.wav", "--noise silence.wav is silent"),
        ("text.wav", "text.wav: not a WAV file"),
    ],
)
def test_what_is_no_noise_is_refused_before_training(
    spoken: Path,
    tmp_path: Path,
    noise: str,
    complaint: str,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    write_wav_pcm16(str(tmp_path / "silence.wav"), np.zeros(RATE_HZ, np.float32), RATE_HZ)
    (tmp_path / "text.wav").write_text("noise")
    monkeypatch.chdir(tmp_path)
    assert main(["train", "speech", "--data", str(spoken), "--noise", noise, "--out", "model.hri"]) != 0
    assert complaint in capsys.readouterr().err
    assert not Path("model.hri").exists()


def test_noise_is_for_speech(signed: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["train", "gesture", "--data", str(signed), "--noise", "white"]) != 0
    assert "--noise is for speech" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("noises", "complaint"),
    [(["street.wav"], "noise street.wav is neither white nor pink nor a file"), ("white", "must be a sequence")],
)
def test_python_refuses_what_is_no_noise(spoken: Path, noises: Any, complaint: str, trained_on: list[Any]) -> None:
    with pytest.raises(hri.InvalidArgument, match=complaint):
        hri.train(spoken, hri.WordRecognizer(), noises=noises)
    assert not trained_on


def test_copies_across_rooms_are_of_their_recordings(spoken: Path, trained_on: list[Any]) -> None:
    dataset = hri.Dataset.load(spoken, "speech")
    hri.train(dataset, hri.WordRecognizer(seed=3), rooms=True)
    clips, number = trained_on[0], len(dataset)
    assert len(clips) == 2 * number
    for clean, far in zip(clips[:number], clips[number:], strict=True):
        assert str(far.path) == f"{clean.path} across a room" and len(far.samples) >= len(clean.samples) + 0.2 * RATE_HZ
    hri.train(dataset, hri.WordRecognizer(seed=3), noises=["pink"], rooms=True)
    assert len(trained_on[0]) == 3 * number
    again = trained_on[0][2 * number :]
    assert all(np.array_equal(a.samples, b.samples) for a, b in zip(clips[number:], again, strict=True))


def test_train_says_that_it_added_rooms(
    spoken: Path, few_fillers: None, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    report = tmp_path / "report.json"
    usual = ["train", "speech", "--data", str(spoken), "--front-end", "cepstra", "--no-network"]
    assert main([*usual, "--rooms", "--out", str(tmp_path / "m.hri"), "--json", str(report)]) == 0
    said = capsys.readouterr().err
    assert "a copy of every recording across a room, too" in said and "of 36 recordings held out" in said
    assert json.loads(report.read_text())["rooms"] is True
    assert main(["train", "gesture", "--data", str(spoken), "--rooms"]) != 0
    assert "--rooms is for speech" in capsys.readouterr().err


@pytest.mark.parametrize("given", [{"noises": ["white"]}, {"fillers": []}, {"rooms": True}])
def test_what_is_for_words_is_refused_for_gestures(signed: Path, given: dict[str, Any]) -> None:
    with pytest.raises(hri.InvalidArgument, match="for speech, the data set is gesture"):
        hri.train(signed, **given)


def test_clips_of_a_recording_are_held_out_together(spoken: Path, few_fillers: None, tmp_path: Path) -> None:
    dataset = hri.Dataset.load(spoken, "speech")
    twice = [read_audio(sample.path) for sample in dataset.samples] * 2
    labels = [sample.label for sample in dataset.samples] * 2
    names = [sample.path.name for sample in dataset.samples] * 2

    def model(**given: Any) -> bytes:
        words = hri.WordRecognizer(num_states=3, num_vtlp_factors=1, num_noisy_copies=0, max_iterations=2)
        words.fit(twice, labels, fillers=[], **given).save(tmp_path / "words.hri")
        return (tmp_path / "words.hri").read_bytes()

    assert model() != model(recordings=names), "nine recordings of a word: a copy falls in the next of four folds"
    persons = [sample.person for sample in dataset.samples] * 2
    assert model(groups=persons) == model(groups=persons, recordings=names)
    with pytest.raises(hri.InvalidArgument, match="X and recordings differ in length: 36, 2"):
        model(recordings=["a", "b"])
