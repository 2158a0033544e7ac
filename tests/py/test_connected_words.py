# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Connected words from Python and from the command line."""

from __future__ import annotations

import copy
import json
import pickle
from pathlib import Path

import numpy as np
import pytest

import hri as package
from conftest import RATE_HZ, tone_word
from hri.core.errors import FormatError, InvalidArgument, NotFittedError
from hri.datasets import Dataset
from hri.io import write_wav_pcm16
from hri.language import NGramModel
from hri.recognition import ConnectedWordRecognizer

WORDS = ["1", "2", "2", "1"]
OPTIONS = {
    "words": {"num_states": 5, "num_vtlp_factors": 1, "num_noisy_copies": 1, "min_snr_db": 10.0},
    "max_words": 4,
}


@pytest.fixture(scope="module")
def words(spoken: Path) -> ConnectedWordRecognizer:
    samples = Dataset.load(spoken).samples
    return ConnectedWordRecognizer(**OPTIONS).fit(
        [s.path for s in samples], [s.label for s in samples], groups=[s.person for s in samples]
    )


@pytest.fixture(scope="module")
def sentence() -> np.ndarray:
    """The words by a speaker who was not trained on, each in the second half second of 0.7 s."""
    clips = [tone_word(575, 800 if word == "1" else -350, 50 + i) for i, word in enumerate(WORDS)]
    middle = [clip[RATE_HZ // 10 : 4 * RATE_HZ // 5] for clip in clips]
    return np.concatenate([clips[0][: RATE_HZ // 5], *middle, clips[0][: RATE_HZ // 5]])


def test_words_and_their_times_are_found(words: ConnectedWordRecognizer, sentence: np.ndarray) -> None:
    found = words.recognise(sentence, RATE_HZ)
    assert list(found.labels) == WORDS and found.text == "1 2 2 1" and found.complete
    for number, word in enumerate(found.words):
        assert word.first_s == pytest.approx(0.2 + 0.7 * number + 0.15, abs=0.05)
        assert word.last_s == pytest.approx(0.2 + 0.7 * number + 0.65, abs=0.05)
    assert words.recognise(sentence, RATE_HZ, num_words=4).labels == found.labels
    assert len(words.recognise(sentence, RATE_HZ, num_words=2).words) == 2
    assert words.count_errors([sentence], [["1", "2", "1", "1"]], RATE_HZ).substitutions == 1
    assert json.loads(json.dumps(found.to_dict()))["words"][0]["label"] == "1"
    assert words.recognise(np.zeros(RATE_HZ, np.float32), RATE_HZ).words == ()


def test_a_model_goes_through_a_file_a_copy_and_a_pickle(
    words: ConnectedWordRecognizer, sentence: np.ndarray, tmp_path: Path
) -> None:
    found = words.recognise(sentence, RATE_HZ)
    words.save(tmp_path / "words.hri")
    loaded = ConnectedWordRecognizer.load(tmp_path / "words.hri")
    for same in (loaded, copy.deepcopy(words), pickle.loads(pickle.dumps(words))):
        assert same.recognise(sentence, RATE_HZ) == found
        assert list(same.classes_) == ["1", "2"]
    with pytest.raises(FormatError, match=r"is a recogniser of connected words, and a word recogniser is needed here"):
        package.WordRecognizer.load(tmp_path / "words.hri")


def test_language_and_decoder_change_after_training(words: ConnectedWordRecognizer, sentence: np.ndarray) -> None:
    changed = copy.deepcopy(words)
    changed.set_language(NGramModel.train([["2"]] * 1000, vocabulary=["1"]))
    assert changed.recognise(sentence, RATE_HZ).text == "1 2 2 1"
    changed.set_decoder(language_scale=1e5)
    assert changed.recognise(sentence, RATE_HZ).text == "2"
    assert changed.recognise(sentence, RATE_HZ, num_words=4).text == "1 2 2 1"
    with pytest.raises(InvalidArgument, match="does not know '1'"):
        changed.set_language(NGramModel.train([["2"]]))
    with pytest.raises(InvalidArgument, match="beam"):
        changed.set_decoder(beam=-1)


def test_what_cannot_be_done_is_refused(words: ConnectedWordRecognizer, sentence: np.ndarray) -> None:
    with pytest.raises(NotFittedError):
        ConnectedWordRecognizer().recognise(sentence, RATE_HZ)
    with pytest.raises(InvalidArgument, match=r"num_words is 0, must lie in 1..1000"):
        words.recognise(sentence, RATE_HZ, num_words=0)
    with pytest.raises(InvalidArgument, match="differ in length"):
        ConnectedWordRecognizer().fit([sentence], ["1", "2"], sample_rate_hz=RATE_HZ)
    with pytest.raises(InvalidArgument, match=r"words\.model must be hmm"):
        ConnectedWordRecognizer(words={"model": "ptbhmm"})


def test_command_line_trains_and_transcribes(hri, spoken: Path, sentence: np.ndarray, tmp_path: Path) -> None:
    NGramModel.train([["1", "2", "2", "1"]]).save(tmp_path / "digits.arpa")
    options = [f"words.{name}={value}" for name, value in OPTIONS["words"].items()]
    arguments = [word for option in options for word in ("--option", option)]
    trained = hri("train-connected", "--data", spoken, "--language", tmp_path / "digits.arpa", *arguments)
    assert (trained.code, trained.out) == (0, f"{tmp_path / 'data' / 'hri' / 'connected.hri'}\n")
    assert "insertion penalty: " in trained.err
    file = tmp_path / "number.wav"
    write_wav_pcm16(str(file), sentence, RATE_HZ)
    assert hri("transcribe", file).out == "1 2 2 1\n"
    assert hri("transcribe", file, "--words", 3).out.split()[0] in ("1", "2")
    lines = hri("transcribe", file, "--times").out.splitlines()
    assert [line.split("\t")[2] for line in lines] == WORDS
    found = json.loads(hri("transcribe", file, "--json", "-").out)
    assert found[str(file)]["text"] == "1 2 2 1"
    assert hri("transcribe", file, "--words", 1000).err.count("too short for 1000 words") == 1


def test_command_line_says_what_is_missing(hri, spoken: Path, tmp_path: Path) -> None:
    file = next(spoken.glob("*.wav"))
    refused = hri("transcribe", file)
    assert refused.code == 3 and "run 'hri train-connected --data DIR'" in refused.err
    wrong = hri("train-connected", "--data", spoken, "--option", "word=1")
    assert wrong.code == 3 and "ConnectedWordRecognizerOptions has no field 'word'" in wrong.err
    (tmp_path / "bad.arpa").write_text("\\data\\\n")
    damaged = hri("train-connected", "--data", spoken, "--language", tmp_path / "bad.arpa")
    assert damaged.code == 3 and "bad.arpa: line 1: has no counts of n-grams" in damaged.err
