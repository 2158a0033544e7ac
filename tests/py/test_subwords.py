# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Words made of phones, added by their spelling: in Python and on the command line."""

from __future__ import annotations

import json
import shutil
from copy import copy
from pathlib import Path

import numpy as np
import pytest

from hri import Dataset, SubwordRecognizer, WordRecognizer, load
from hri.core.errors import FormatError, InvalidArgument
from hri.htk import Dictionary
from hri.io import write_wav_pcm16
from hri.language import closest_phone, pronounce, split_phones
from hri.media import Audio, read_audio
from hri.synthetic.speech import make_speaker, make_speech_corpus, speak

WORDS = ["go", "left", "stop", "no", "test", "float"]
OPTIONS = {"words": {"num_vtlp_factors": 1}, "num_folds": 2, "num_word_folds": 2, "num_passes": 2}


@pytest.fixture(scope="module")
def spoken(tmp_path_factory: pytest.TempPathFactory) -> Dataset:
    return make_speech_corpus(tmp_path_factory.mktemp("words"), {"en": WORDS}, num_speakers=3, takes=1)


@pytest.fixture(scope="module")
def words(spoken: Dataset) -> SubwordRecognizer:
    clips = [read_audio(sample.path) for sample in spoken.samples]
    labels, persons = zip(*((sample.label, sample.person) for sample in spoken.samples), strict=True)
    return SubwordRecognizer(**OPTIONS).fit(clips, labels, groups=persons)


def said(text: str, person: int = 0, take: int = 5) -> Audio:
    return speak(text, "en", make_speaker(person), take)


def test_phones_of_a_spelling() -> None:
    assert pronounce("stop") == ("s", "t", "ɒ", "p")
    assert pronounce("घर", "hi") == ("ɡʰ", "ʌ", "ɾ")
    assert pronounce("हिंदी", "hi")[1] == "i\u0303"
    assert split_phones("(en)ˈeɪt(hi) tʃ lˈʌr.kˌaː çʰ") == ("e", "ɪ", "t", "t", "ʃ", "l", "ʌ", "ɽ", "k", "aː", "çʰ")
    assert split_phones(" ˈ ") == ()
    with pytest.raises(InvalidArgument, match="xx-nowhere"):
        pronounce("stop", "xx-nowhere")
    with pytest.raises(InvalidArgument, match="no sound"):
        pronounce("  ")
    with pytest.raises(InvalidArgument, match="cannot be pronounced"):
        pronounce("a\0b")
    assert pronounce("--help")[0] == "h"  # a text, and no option of the program


def test_the_closest_phone_is_articulated_alike() -> None:
    known = ["p", "t", "s", "n", "aː", "i", "u"]
    assert closest_phone("s", known) == "s"
    assert closest_phone("z", known) == "s" and closest_phone("d", known) == "t"
    assert closest_phone("m", known) == "n" and closest_phone("bʰ", known) == "p"
    assert closest_phone("a", known) == "aː" and closest_phone("i\u0303", known) == "i"
    assert closest_phone("ʊ", known) == "u"
    for phone, others in (("a", ["t", "s"]), ("t", ["a"]), ("?", known), ("t", [])):
        with pytest.raises(InvalidArgument, match="no phone is known"):
            closest_phone(phone, others)


def test_a_word_never_recorded_is_recognised(words: SubwordRecognizer, tmp_path: Path) -> None:
    more = copy(words)
    assert more.add_word("slept") == {}
    assert list(more.classes_) == sorted([*WORDS, "slept"]) and "slept" not in words.classes_
    heard = [more.predict([said(text)])[0] for text in [*WORDS, "slept"]]
    assert heard == [*WORDS, "slept"]
    assert words.predict([said("slept")])[0] in WORDS
    more.save(tmp_path / "more.hri")
    read = load(tmp_path / "more.hri", "speech")
    assert isinstance(read, SubwordRecognizer)
    np.testing.assert_array_equal(read.scores(said("slept")), more.scores(said("slept")))
    assert more.remove_word("slept").classes_.tolist() == words.classes_.tolist()
    with pytest.raises(FormatError, match="made of units"):
        WordRecognizer.load(tmp_path / "more.hri")


def test_recordings_and_pronunciations_make_a_word_as_well(words: SubwordRecognizer) -> None:
    more = copy(words)
    assert more.add_word("stoat", pronunciations=[["s", "t", "ə", "ʊ", "t"]], clips=[said("stoat", take=1)]) == {}
    assert [entry.models[0] for entry in more.lexicon.entries if entry.word == "stoat"] == ["stoat/0"]
    assert more.units == words.units
    assert more.predict([said("stoat", take=2)])[0] == "stoat"
    with pytest.raises(InvalidArgument, match=r"clips\[0\]"):
        more.add_word("nothing", clips=[np.zeros(16000, np.float32)], sample_rate_hz=16000)
    with pytest.raises(InvalidArgument, match="already"):
        more.add_word("stop")
    with pytest.raises(InvalidArgument, match="no word 'sotp'"):
        more.remove_word("sotp")


def test_a_dictionary_comes_before_the_spelling(spoken: Dataset) -> None:
    chosen = [sample for sample in spoken.samples if sample.label in ("go", "stop")]
    lexicon = Dictionary.parse("go g o\n", "words")
    recognizer = SubwordRecognizer(num_folds=0, num_word_folds=0, num_passes=1)
    recognizer.fit([s.path for s in chosen], [s.label for s in chosen], dictionary=lexicon)
    assert recognizer.units == ("g", "o", "p", "s", "t", "ɒ")
    with pytest.raises(InvalidArgument, match="'sil'"):
        recognizer.fit(
            [s.path for s in chosen], [s.label for s in chosen], dictionary=Dictionary.parse("go sil o\n", "words")
        )


def test_a_dictionary_without_effect_is_refused(hri, spoken: Dataset, tmp_path: Path) -> None:
    few = tmp_path / "few"
    few.mkdir()
    for sample in spoken.samples:
        if sample.label in ("go", "stop"):
            shutil.copy(sample.path, few / f"{sample.label}_{sample.person}_0.wav")
    arguments = ["train-units", "--data", str(few), "--out", str(tmp_path / "units.hri"), "--dictionary"]
    options = [f"--option={name}" for name in ("words.num_vtlp_factors=1", "num_folds=0", "num_word_folds=0")]
    (tmp_path / "words").write_text(";;; comment\nGO G OW\nzebra z\n")
    refused = hri(*arguments, str(tmp_path / "words"), *options)
    assert refused.code == 3 and "words: the dictionary has none of the labels go stop; " in refused.err
    assert "letters differ in GO for go" in refused.err
    (tmp_path / "words").write_text(";;;\ngo G OW\n")
    trained = hri(*arguments, str(tmp_path / "words"), *options)
    assert trained.code == 0 and "words, pronounced by espeak-ng: stop\n" in trained.err and "G OW" in trained.err
    (tmp_path / "words").write_text(";;; comment\ngo\n")
    assert "words: line 2:" in hri(*arguments, str(tmp_path / "words"), *options).err


def test_the_command_line_adds_a_word_by_its_spelling(hri, spoken: Dataset, tmp_path: Path) -> None:
    model, more = str(tmp_path / "units.hri"), str(tmp_path / "more.hri")
    options = [f"--option={name}" for name in ("words.num_vtlp_factors=1", "num_folds=0", "num_word_folds=0")]
    trained = hri("train-units", "--data", str(spoken.root), "--out", model, *options, "--json", "-")
    assert trained.code == 0 and "ɒ" in json.loads(trained.out)["units"]
    added = hri("add-word", "--model", model, "--label", "rest", "--spelling", "slept", "-o", more, "--json", "-")
    assert added.code == 0 and "rest" in json.loads(added.out)["labels"]
    sound = said("slept")
    write_wav_pcm16(str(tmp_path / "slept.wav"), sound.samples, sound.sample_rate_hz)
    heard = hri("recognise", "--speech-model", more, str(tmp_path / "slept.wav"), "--json", "-")
    assert heard.code == 0 and json.loads(heard.out)["speech"]["nbest"][0]["label"] == "rest"
    buzz = hri("add-word", "--model", more, "--label", "buzz", "--spelling", "buzz")
    assert buzz.code == 0 and "no recording had the phone z: s stands for it" in buzz.err
    assert hri("remove-word", "--model", more, "--label", "rest").code == 0
    assert hri("add-word", "--model", model, "--label", "rest").code == 2
    wrong = hri("train-units", "--data", str(spoken.root), "--spelling", "gone=go")
    assert wrong.code == 3 and "gone" in wrong.err
    assert hri("train-units", "--data", str(spoken.root), "--spelling", "go").code == 3
