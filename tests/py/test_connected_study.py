# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The study of connected digits: what it joins, and how it counts."""

from __future__ import annotations

import numpy as np
import pytest

from conftest import RATE_HZ, tone_word
from hri.media.audio import Audio
from hri.recognition import TranscribedWord, Transcript
from hri.studies.clips import Clip
from hri.studies.connected_words import EDGE_MS, MAX_DIGITS, _close, strings_of


@pytest.fixture(scope="module")
def clips() -> list[Clip]:
    return [(str(i % 3), "low", Audio(tone_word(500, 100 * (i % 3), i), RATE_HZ)) for i in range(20)]


@pytest.mark.parametrize("pause_ms", [0, 300])
def test_strings_hold_every_clip_once(clips: list[Clip], pause_ms: int) -> None:
    strings = strings_of(clips, pause_ms)
    assert sorted(label for string in strings for label in string.labels) == sorted(label for label, _, _ in clips)
    assert all(1 <= len(string.labels) <= MAX_DIGITS for string in strings)
    for string in strings:
        expected_s = 2 * EDGE_MS / 1000 + len(string.labels) * (1.0 + pause_ms / 1000)
        assert len(string.samples) / RATE_HZ == pytest.approx(expected_s)
        for number, (first_s, last_s) in enumerate(string.times_s):
            begins_s = EDGE_MS / 1000 + number * (1.0 + pause_ms / 1000)
            assert first_s == pytest.approx(begins_s + 0.25, abs=0.03)
            assert last_s == pytest.approx(begins_s + 0.75, abs=0.03)


def test_pauses_change_neither_order_nor_length_of_strings(clips: list[Clip]) -> None:
    assert [s.labels for s in strings_of(clips, 0)] == [s.labels for s in strings_of(clips, 300)]


def test_times_count_where_the_words_are_right(clips: list[Clip]) -> None:
    string = strings_of(clips, 100)[0]
    shifts = np.zeros(2 * len(string.labels))
    shifts[0], shifts[-1] = 0.04, -0.06
    shifts = shifts.reshape(-1, 2)
    times = np.asarray(string.times_s) + shifts
    words = [TranscribedWord(label, *pair, 0.0) for label, pair in zip(string.labels, times.tolist(), strict=True)]
    close = _close(string, Transcript(tuple(words)))
    assert close == [True] * (2 * len(words) - 1) + [False]
    assert _close(string, Transcript(tuple(words[1:]))) == []
