# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The study of section 6.1 of the thesis: whom it trains and tests, and that its words are recognised."""

from __future__ import annotations

import pytest

from conftest import RATE_HZ, tone_word
from hri.core.errors import InvalidArgument
from hri.htk import FeatureExtractor
from hri.studies.htk_thesis import KINDS, _accuracy, _dependent, _Group, _groups, _Word

SLOPES = {"go-on": 800.0, "stop": -350.0}


@pytest.fixture(scope="module")
def words() -> list[_Word]:
    made = []
    for number, person in enumerate(("a", "b", "c")):
        for take in range(3):
            for label, slope in SLOPES.items():
                tone = tone_word(500 + 40 * number, slope, 100 * number + 10 * take)
                frames = {kind: FeatureExtractor(code, RATE_HZ).compute(tone) for kind, code in KINDS.items()}
                made.append(_Word(label, person, take, frames))
    return made


def test_strangers_are_not_trained_on() -> None:
    many = [f"{i:02d}" for i in range(24)]
    groups = _groups(many, 5)
    assert len(groups) == 4 and len({name for g in groups for name in (*g.train, g.stranger)}) == 24
    assert [g.train[:2] for g in groups] == [g.train for g in _groups(many, 2)]
    few = _groups(["a", "b", "c", "d"], 3)
    assert sorted(g.stranger or "" for g in few) == ["a", "b", "c", "d"]
    assert all(g.stranger not in g.train for g in few)
    assert all(g.stranger is None and len(g.train) == 4 for g in _groups(["a", "b", "c", "d"], 4))
    assert _groups(["a", "b"], 3) == []


@pytest.mark.parametrize("kind", KINDS)
def test_words_of_trained_speakers_and_of_a_stranger_are_recognised(words: list[_Word], kind: str) -> None:
    group = _Group("with a", ("a", "b"), "c")
    assert _dependent(words, group, kind) == 1.0
    train = [word for word in words if word.person != "c"]
    strangers = [word for word in words if word.person == "c"]
    assert _accuracy(train, strangers, kind) == 1.0
    wrong = [_Word("stop" if word.label == "go-on" else "go-on", "c", 0, word.frames) for word in strangers]
    assert _accuracy(train, wrong, kind) == 0.0


def test_a_word_without_frames_is_named(words: list[_Word]) -> None:
    empty = [_Word("go-on", "a", 0, {"MFCC": words[0].frames["MFCC"][:3]}), words[1]]
    with pytest.raises(InvalidArgument, match="'go-on'"):
        _accuracy(empty, words, "MFCC")
