# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The study of HTK's training without times: what it trains on, and that all its models recognise tones."""

from __future__ import annotations

import pytest

from conftest import RATE_HZ, tone_word
from hri.media.audio import Audio
from hri.studies import htk_training
from hri.studies.clips import Clip
from hri.studies.htk_training import BOTH, NO_TIMES, TIMES, _coded, _errors, _String, _trained

SLOPES = {"1": 800.0, "2": -350.0}


@pytest.fixture(scope="module")
def strings() -> list[_String]:
    clips: list[Clip] = []
    for number, person in enumerate(("a", "b")):
        for take in range(8):
            for label, slope in SLOPES.items():
                tone = tone_word(500 + 40 * number, slope, 100 * number + 10 * take)
                clips.append((label, person, Audio(tone, RATE_HZ)))
    return _coded(clips)


def test_words_are_cut_where_they_are_said(strings: list[_String]) -> None:
    assert sum(len(s.labels) for s in strings) == 32
    for string in strings:
        assert len(string.words) == len(string.labels)
        assert all(55 <= len(word) <= 66 for word in string.words)
        assert string.units[:2] == ["sil", string.labels[0]] and string.units[-1] == "sil"
        assert string.units.count("sp") == len(string.labels) - 1


def test_every_training_gives_models_that_recognise(strings: list[_String], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(htk_training, "MIXTURES", (1, 2))
    trained = list(_trained(strings[::2], list(SLOPES)))
    assert [(kind, count) for kind, count, _ in trained] == [(k, m) for m in (1, 2) for k in (NO_TIMES, TIMES, BOTH)]
    for kind, mixtures, models in trained:
        assert models.hmm("1").weights.shape == (htk_training.WORD_STATES, mixtures)
        assert _errors(models, strings[1::2], list(SLOPES)).rate == 0, kind
