# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""`hri.train` without a recogniser: what ``hri train`` makes of the same recordings."""

from __future__ import annotations

import re
import shutil
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import hri
from conftest import QUICK, RATE_HZ, tone_word
from hri.io import write_wav_pcm16
from hri.recognition import ConnectedWordRecognizer, SubwordRecognizer, WordRecognizer
from hri.training import choices, choose_options


@pytest.fixture
def untrained(monkeypatch: pytest.MonkeyPatch) -> None:
    """Training gives the recogniser back as it was."""
    monkeypatch.setattr(hri.WordRecognizer, "fit", lambda self, *_, **__: self)
    monkeypatch.setattr(hri.GestureRecognizer, "features", lambda *_: [])
    monkeypatch.setattr(hri.GestureRecognizer, "fit_features", lambda self, *_, **__: self)


@pytest.mark.usefixtures("untrained")
@pytest.mark.parametrize(("installed", "front_end", "network"), [(True, "both", False), (False, "cepstra", True)])
def test_words_are_of_what_is_installed(
    spoken: Path, monkeypatch: pytest.MonkeyPatch, installed: bool, front_end: str, network: bool
) -> None:
    monkeypatch.setattr(choices, "has_embedding", lambda: installed)
    options = hri.train(spoken).options
    assert (options.front_end, options.use_network) == (front_end, network), "three speakers"
    assert not hri.train(spoken, hri.WordRecognizer(front_end="cepstra")).options.use_network, "is taken as it is"


def test_what_is_given_stands(spoken: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(choices, "has_embedding", lambda: True)
    dataset = hri.Dataset.load(spoken)
    assert choose_options(dataset, {"front_end": "cepstra"}).options == {"use_network": True}
    assert choose_options(dataset, {"front_end": "cepstra"}, num_persons=2).options == {}
    assert choose_options(dataset, {"use_network": False}).options == {"front_end": "both"}
    assert choose_options(dataset, num_persons=10).options == {"front_end": "both", "use_network": True}


def test_a_pattern_that_takes_names_for_labels_replaces_no_model(
    hri: Any, spoken: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    quick = ("--no-fillers", "--front-end", "cepstra", "--no-network", "--option", "num_states=4")
    kept, wrong = tmp_path / "data" / "hri" / "speech.hri", ("--pattern", "{label}.wav")
    train = ("train", "speech", "--data", spoken, *quick)
    first = hri(*train)
    assert first.code == 0 and "replaces" not in first.err and "single recording" not in first.err
    before = kept.read_bytes()
    refused = hri(*train, *wrong)
    assert refused.code == 3 and kept.read_bytes() == before
    assert "each of the 18 labels has a single recording: 1_high_0" in refused.err and "name --out" in refused.err
    monkeypatch.setattr("hri.cli.train_checks.MOST_SINGLE", 18)
    monkeypatch.setattr("hri.cli.train.train_recognizer", lambda *_, **__: 1 / 0)
    warned = hri(*train, *wrong)
    assert "WARNING: each of the 18 labels" in warned.err and "and 13 more" in warned.err
    assert re.search(r"speech.hri: replaces the model of 20\d\d-.*, 2 labels: 1 2\n", warned.err)
    assert "replaces" not in hri(*train).err, "it has the same labels"


@pytest.mark.parametrize("given", [{"front_end": "mfcc"}, {"num_state": 3}])
def test_an_option_that_is_none_is_refused(spoken: Path, given: dict[str, Any]) -> None:
    with pytest.raises((hri.InvalidArgument, TypeError)):
        choose_options(hri.Dataset.load(spoken), given)


@pytest.mark.usefixtures("untrained")
def test_gestures_are_of_the_source_that_is_chosen(signed: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(choices, "choose_source", lambda _: ("silhouettes", "because"))
    trained = hri.train(signed)
    assert isinstance(trained, hri.GestureRecognizer) and trained.options.source == "silhouettes"
    dataset = hri.Dataset.load(signed)
    assert choose_options(dataset).why == "because"
    assert choose_options(dataset, {"source": "landmarks"}) == choices.Choice({})


@pytest.mark.parametrize("label", ["a\tb", "a\nb", " ", "a\u2028b"], ids=repr)
@pytest.mark.parametrize("command", ["train speech", "train-connected", "train-units", "evaluate speech"])
def test_labels_that_break_lines_of_tables_are_refused_with_their_file(
    hri: Any, spoken: Path, tmp_path: Path, command: str, label: str
) -> None:
    for word in ("1", label):
        (tmp_path / "spoken" / word).mkdir(parents=True)
        shutil.copy(spoken / "1_low_0.wav", tmp_path / "spoken" / word / "low_0.wav")
    out = () if command.startswith("evaluate") else ("--out", tmp_path / "m.hri")
    refused = hri(*command.split(), "--data", tmp_path / "spoken", "--pattern", "{label}/{person}_{take}.wav", *out)
    why = "is blank" if not label.strip() else "has characters that break lines and columns"
    assert refused.code == 3 and f"low_0.wav: its label {label!r} {why}" in refused.err, refused.err


def test_labels_that_break_lines_of_tables_are_refused_wherever_they_are_given(
    hri: Any, spoken: Path, tmp_path: Path, word_model: Path
) -> None:
    added = hri("train-connected", "--data", spoken, "--front-end", "cepstra", "--add", "a\tb")
    assert added.code == 2 and "--add: 'a\\tb' has characters that break" in added.err
    named = hri("add-word", "--model", word_model, "--label", " ", "-o", tmp_path / "m.hri", spoken / "1_low_0.wav")
    assert named.code == 2 and "' ' is blank" in named.err


def test_one_label_with_a_single_recording_is_one(
    hri: Any, spoken: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("hri.cli.train.train_recognizer", lambda *_, **__: 1 / 0)
    shutil.copytree(spoken, tmp_path / "spoken")
    shutil.copy(spoken / "1_low_0.wav", tmp_path / "spoken" / "3_low_0.wav")
    warned = hri("train", "speech", *QUICK, "--data", tmp_path / "spoken", "--out", tmp_path / "m.hri")
    assert "WARNING: 1 label has a single recording: 3;" in warned.err


@pytest.mark.parametrize(
    ("command", "fit", "said"),
    [
        (("train", "speech", "--no-fillers", "--network", "--front-end", "cepstra"), "WordRecognizer",
         ("18 recordings, 3 persons, 2 labels: 1 2", "front end: cepstra;", "a network of the same words votes too;")),
        (("train-connected", "--front-end", "cepstra"), "ConnectedWordRecognizer",
         ("18 recordings, 3 persons, 2 labels: 1 2", "front end: cepstra;")),
        (("train-units",), "SubwordRecognizer", ("18 recordings, 3 persons, 2 labels: 1 2",)),
    ],
    ids=lambda value: value[0] if isinstance(value, tuple) else "",
)  # fmt: skip
def test_what_is_trained_is_said_before(
    hri: Any, spoken: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    command: tuple[str, ...], fit: str, said: tuple[str, ...],
) -> None:  # fmt: skip
    """Training may take hours, and shows nothing where there is no terminal."""
    monkeypatch.setattr(f"hri.recognition.{fit}.fit", lambda *_, **__: 1 / 0)
    stopped = hri(*command, "--data", spoken, "--out", tmp_path / "m.hri").err.splitlines()
    assert "ZeroDivisionError" in stopped.pop()
    assert len(stopped) == len(said) and all(map(str.startswith, stopped, said)), stopped


@pytest.mark.parametrize(
    ("command", "trained"),
    [
        (("train", "speech", *QUICK), WordRecognizer),
        (("train-connected", "--front-end", "cepstra"), ConnectedWordRecognizer),
        (("train-units",), SubwordRecognizer),
    ],
    ids=lambda value: value[0] if isinstance(value, tuple) else "",
)
def test_recordings_without_speech_are_named(
    hri: Any, spoken: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command: tuple[str, ...], trained: type
) -> None:
    """Training leaves them out; they are named before it begins."""
    monkeypatch.setattr(trained, "_native_class", SimpleNamespace(train=lambda *_: 1 / 0))
    folder = tmp_path / "spoken"
    shutil.copytree(spoken, folder)
    given = (*command, "--data", folder, "--out", tmp_path / "m.hri")
    assert "no speech" not in hri(*given).err
    silence = 0.0001 * np.random.default_rng(0).normal(size=RATE_HZ).astype(np.float32)
    for number in range(12):
        write_wav_pcm16(str(folder / f"1_low_{10 + number}.wav"), silence, RATE_HZ // (1 + number % 2))
        if number == 0:
            named = f"{folder}/1_low_10.wav\n"
            assert f": no speech is found in 1 recording, which is not learned from: {named}" in hri(*given).err
    warned = next(line for line in hri(*given).err.splitlines() if "no speech" in line)
    assert "in 12 recordings, which are not learned from" in warned and warned.endswith("1_low_19.wav and 2 more")
    cut = hri(*given, "--option", f"{'' if command[0] == 'train' else 'words.'}activity.silence_dbfs=0")
    assert "no speech is found in 30 recordings" in cut.err, "as training finds it"


def test_the_log_names_arrays_without_speech(caplog: pytest.LogCaptureFixture) -> None:
    rng = np.random.default_rng(0)
    words = [tone_word(frequency_hz, 0, seed) for seed in range(3) for frequency_hz in (400, 900)]
    silence = [0.0001 * rng.normal(size=RATE_HZ).astype(np.float32)] * 2
    trained = hri.WordRecognizer(front_end="cepstra")
    trained.fit([*words, *silence], ["low", "high"] * 4, sample_rate_hz=RATE_HZ, fillers=())
    assert trained.predict(words, RATE_HZ).tolist() == ["low", "high"] * 3
    assert [record.getMessage() for record in caplog.records if record.levelname == "WARNING"] == [
        "no speech is found in 2 recordings, which are not learned from: X[6] X[7]"
    ]
