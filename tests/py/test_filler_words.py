# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Filler words, as they come with the package and as users bring their own."""

from __future__ import annotations

import numpy as np
import pytest

from conftest import tone_word
from hri import _native
from hri.core.errors import FormatError, InvalidArgument
from hri.recognition import WordRecognizer
from hri.recognition.word import fillers
from hri.recognition.word.fillers import FillerWord, compress, embedding_filler_words, expand, filler_words


def test_words_of_the_package_are_speech():
    words = filler_words()
    labels = {word.label for word in words}
    assert len(labels) == 48 and len(words) == 4 * len(labels)
    for word in words:
        assert word.samples.dtype == np.float32 and word.sample_rate_hz == 16000
        assert 0.2 < len(word.samples) / 16000 < 2 and 0.1 < np.abs(word.samples).max() <= 1
        first, last = _native.find_speech(word.samples, 16000)
        assert last - first > 16000 // 10, word.label


def test_words_for_the_embedding_are_speech_of_other_words():
    words = embedding_filler_words()
    labels = {word.label for word in words}
    assert len(labels) == len(words) > 250 and not labels & {word.label for word in filler_words()}
    for word in words:
        assert word.samples.dtype == np.float32 and word.sample_rate_hz == 8000
        assert 0.2 < len(word.samples) / 8000 < 2 and 0.1 < np.abs(word.samples).max() <= 1
        first, last = _native.find_speech(word.samples, 8000)
        assert last - first > 8000 // 10, word.label


def test_words_for_the_embedding_need_it():
    clips = [tone_word(base, 800.0, take) for base in (500.0, 900.0) for take in range(2)]
    words = [FillerWord(tone_word(700.0, 0.0, 0), 16000, "flat")]
    with pytest.raises(InvalidArgument, match=r"front_end='cepstra' takes no fillers"):
        WordRecognizer().fit(clips, list("aabb"), sample_rate_hz=16000, embedding_fillers=words)


def test_compression_keeps_quiet_and_loud_samples_alike():
    x = np.random.default_rng(0).uniform(-1, 1, 10000).astype(np.float32)
    for level in (1.0, 0.01):
        error = expand(compress(level * x)) - level * x
        assert 10 * np.log10(np.mean((level * x) ** 2) / np.mean(error**2)) > (35 if level == 1 else 28)
    assert expand(compress(np.array([-1.0, 1.0], np.float32))).tolist() == [-1.0, 1.0]


def test_a_damaged_file_is_reported(tmp_path, monkeypatch):
    stored = {"codes": np.zeros(10, np.uint8), "ends": np.array([4, 9]), "labels": np.array(["a", "b"])}
    for name, change in {
        "short.npz": {},
        "labels.npz": {"labels": np.array(["a"])},
        "order.npz": {"ends": np.array([10, 9])},
    }.items():
        np.savez(tmp_path / name, **{**stored, **change})
        monkeypatch.setattr(fillers, "files", lambda package: tmp_path)
        monkeypatch.setattr(fillers, "_FILE", name)
        filler_words.cache_clear()
        with pytest.raises(FormatError, match=name):
            filler_words()
    (tmp_path / "text.npz").write_text("nothing")
    monkeypatch.setattr(fillers, "_FILE", "text.npz")
    with pytest.raises(FormatError, match=r"text\.npz"):
        filler_words()
    monkeypatch.undo()
    filler_words.cache_clear()
    assert filler_words()


def test_users_bring_their_own_or_none():
    clips = [tone_word(base, slope, take) for base in (500.0, 550.0) for slope in (800.0, -350.0) for take in range(3)]
    labels = 2 * (3 * ["rise"] + 3 * ["fall"])

    def train(others):
        return WordRecognizer().fit(clips, labels, sample_rate_hz=16000, fillers=others)

    own = [FillerWord(tone_word(700.0, 0.0, take), 16000, "flat") for take in range(3)]
    none, shipped, mine = train(()), train(None), train(own)
    score = [words.recognise(clips[0], 16000).score for words in (none, shipped, mine)]
    assert len(set(score)) == 3
    for words in (shipped, mine):
        np.testing.assert_array_equal(words.scores(clips[0], 16000), none.scores(clips[0], 16000))
    with pytest.raises(InvalidArgument, match=r"fillers\[0\] must have 1 dimension"):
        train([FillerWord(np.zeros((2, 2), np.float32), 16000, "flat")])


def test_the_command_takes_a_folder_of_other_words(hri, spoken, tmp_path):
    folder = tmp_path / "others"
    folder.mkdir()
    for take in range(3):
        for label, slope in (("flat", 0.0), ("steep", 1800.0)):
            _native.write_wav_pcm16(str(folder / f"{label}_low_{take}.wav"), tone_word(700.0, slope, take), 16000)
    score = {}
    for name, options in {
        "package": (),
        "own": ("--fillers", str(folder)),
        "none": ("--no-fillers",),
    }.items():
        model = tmp_path / f"{name}.hri"
        train = (
            "train",
            "speech",
            "--data",
            str(spoken),
            "--out",
            str(model),
            "--front-end",
            "cepstra",
            "--no-network",
        )
        assert hri(*train, *options).code == 0
        score[name] = WordRecognizer.load(model).recognise(tone_word(540.0, 800.0, 5), 16000).score
    assert len(set(score.values())) == 3
    both = hri("train", "speech", "--data", str(spoken), "--fillers", str(folder), "--no-fillers")
    assert both.code == 2 and "exclude" in both.err
    signs = hri("train", "gesture", "--data", str(spoken), "--no-fillers")
    assert signs.code == 2 and "for speech" in signs.err
