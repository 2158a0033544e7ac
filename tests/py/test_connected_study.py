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
from hri.studies.connected_words import (
    EDGE_MS,
    MAX_DIGITS,
    _close,
    clip_end_points,
    end_points,
    level_end_points,
    strings_of,
)


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
        for number, (first_s, last_s) in enumerate(string.times_s["times"]):
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
    times = np.asarray(string.times_s["times"]) + shifts
    words = [TranscribedWord(label, *pair, 0.0) for label, pair in zip(string.labels, times.tolist(), strict=True)]
    close = _close(string, Transcript(tuple(words)))
    assert close == [True] * (2 * len(words) - 1) + [False]
    assert _close(string, Transcript(tuple(words[1:]))) == []


def test_end_points_of_a_clip_cut_close_are_those_of_its_word() -> None:
    """Found in the clip as it is they lie within the word, whose quiet end is all that there is of noise."""
    time_s = np.arange(round(0.45 * RATE_HZ)) / RATE_HZ
    level = np.where(time_s < 0.3, 0.3, 0.03)
    clip = (level * np.sin(2 * np.pi * 200 * time_s)).astype(np.float32)
    for find in (end_points, level_end_points):
        first, last = find(clip, RATE_HZ)
        assert first == pytest.approx(0, abs=0.03 * RATE_HZ)
        assert last == pytest.approx(len(clip), abs=0.03 * RATE_HZ)
    assert clip_end_points(clip, RATE_HZ)[1] < 0.4 * RATE_HZ
