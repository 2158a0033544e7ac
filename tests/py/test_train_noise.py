# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri train speech --noise``: for a place where it is not quiet."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import hri
from hri.cli.main import main
from hri.cli.noisy_copies import with_noisy_copies
from hri.evaluation.noise import active_power
from hri.io import write_wav_pcm16
from hri.media import read_audio

RATE_HZ = 16000


def _quiet(*_: object) -> None:
    """Progress that goes nowhere."""


@pytest.fixture
def hum(tmp_path: Path) -> Path:
    """Two seconds of a recorded place."""
    path = tmp_path / "hum.wav"
    samples = 0.1 * np.sin(2 * np.pi * 180 * np.arange(2 * RATE_HZ) / RATE_HZ)
    write_wav_pcm16(str(path), samples.astype(np.float32), RATE_HZ)
    return path


def test_every_recording_gets_a_copy_in_noise_by_the_same_person(spoken: Path, hum: Path) -> None:
    dataset = hri.Dataset.load(spoken, "speech")
    number = len(dataset)
    with with_noisy_copies(dataset, [str(hum)], 3, _quiet) as both:
        assert both.samples[:number] == dataset.samples
        copies = both.samples[number:]
        assert [(c.label, c.person) for c in copies] == [(s.label, s.person) for s in dataset.samples]
        ratios = []
        for sample, copy in zip(dataset.samples, copies, strict=True):
            clean, noisy = read_audio(sample.path), read_audio(copy.path)
            assert noisy.sample_rate_hz == clean.sample_rate_hz and len(noisy.samples) == len(clean.samples)
            scale = (noisy.samples @ clean.samples) / (clean.samples @ clean.samples)
            noise = noisy.samples / scale - clean.samples
            ratios.append(10 * np.log10(active_power(clean.samples, clean.sample_rate_hz) / np.mean(noise**2)))
        assert -3 < min(ratios) < 6 and 14 < max(ratios) < 24  # dB, of 0 to 20
        kept = [copy.path.read_bytes() for copy in copies]
        folder = copies[0].path.parent
    assert not folder.exists()
    with with_noisy_copies(dataset, [str(hum)], 3, _quiet) as again:
        assert [copy.path.read_bytes() for copy in again.samples[number:]] == kept
    with with_noisy_copies(dataset, [], 3, _quiet) as same:
        assert same is dataset


def test_silence_in_a_noise_is_passed_over(spoken: Path, tmp_path: Path) -> None:
    path = tmp_path / "pauses.wav"
    noise = np.zeros(4 * RATE_HZ, np.float32)
    noise[3 * RATE_HZ :] = 0.1 * np.random.default_rng(0).standard_normal(RATE_HZ)
    write_wav_pcm16(str(path), noise, RATE_HZ)
    dataset = hri.Dataset.load(spoken, "speech")
    with with_noisy_copies(dataset, [str(path)], 0, _quiet) as both:
        for sample, copy in zip(dataset.samples, both.samples[len(dataset) :], strict=True):
            assert np.abs(read_audio(copy.path).samples - read_audio(sample.path).samples).max() > 1e-3


def test_train_says_that_it_added_noise(
    spoken: Path, hum: Path, tmp_path: Path, few_fillers: None, capsys: pytest.CaptureFixture[str]
) -> None:
    report, plain, noisy = tmp_path / "report.json", tmp_path / "plain.hri", tmp_path / "noisy.hri"
    usual = ["train", "speech", "--data", str(spoken), "--front-end", "cepstra"]
    assert main([*usual, "--out", str(plain)]) == 0
    capsys.readouterr()
    assert main([*usual, "--noise", str(hum), "--noise", "pink", "--out", str(noisy), "--json", str(report)]) == 0
    said = capsys.readouterr().err
    assert "18 recordings, 3 persons" in said
    assert "a copy of every recording in noise" in said and "of 36 recordings of people held out" in said
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
