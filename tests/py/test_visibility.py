# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What pictures lack for a hand to be seen is said in plain words, without flicker."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import groupby
from typing import Any

import numpy as np
import pytest

pytest.importorskip("cv2")

import hri
from drawn_hands import FPS, HIDDEN, picture, shown
from hri.cli.live_screen import hand_line
from hri.live import MISSING_TEXTS, ClipSource, Event, GestureRows, SignWatcher, Visibility, Watcher, missing_text
from session_people import train_signs
from signing_people import FPS as SIGNING_FPS
from signing_people import DrawnFace, film, signed, train_sentences

LIT = np.full((48, 64, 3), 120, np.uint8)
DARK = np.full((48, 64, 3), 12, np.uint8)


class CountedFace:
    """Finds a face or none, and counts how often it is asked."""

    def __init__(self, seen: bool = False) -> None:
        self.seen, self.num_asked = seen, 0

    def find(self, bgr: Any) -> Any:
        self.num_asked += 1
        return object() if self.seen else None


def changes(
    seen: Iterable[bool], visibility: Visibility, frame: Any = LIT, face_seen: bool | None = None, first: int = 0
) -> list[Any]:
    """What is said one after the other, and from which second on."""
    said = [(visibility.push(frame, t / FPS, hand, face_seen), t / FPS) for t, hand in enumerate(seen, first)]
    runs = (next(run) for _, run in groupby(said, key=lambda one: one[0]))
    return [(missing, round(time_s, 1)) for missing, time_s in runs]


def test_a_hand_is_missing_after_a_while_and_found_at_once() -> None:
    seen = [True] * 30 + [False] * 120 + [True] * 30
    (_, first), (missing, lost_s), (found, found_s) = changes(seen, Visibility())
    assert (first, missing, found) == (0.0, "hand", "")
    assert 5.5 < lost_s < 6.5 and 10.0 < found_s < 10.8


def test_a_hand_that_flickers_changes_nothing() -> None:
    rng = np.random.default_rng(0)
    assert changes(rng.random(900) < 0.5, Visibility()) == [("", 0.0)]
    gone = [False] * 120
    rarely = list(rng.random(900) < 0.04)  # a wall in which a hand is found now and then
    assert [missing for missing, _ in changes([*gone, *rarely], Visibility())] == ["", "hand"]


def test_darkness_is_said_where_no_hand_is_found() -> None:
    assert changes([False] * 120, Visibility(), DARK)[-1][0] == "light"
    assert changes([True] * 120, Visibility(), DARK) == [("", 0.0)]
    dim = Visibility()
    levels = [30, 45, 50, 45, 50, 60, 50, 45, 50]  # around the threshold
    said = [dim.push(np.full_like(LIT, 30), t / 2, False) for t in range(20)]
    said += [dim.push(np.full_like(LIT, level), 10 + t / 2, False) for t, level in enumerate(levels)]
    assert [missing for missing, _ in groupby(said)] == ["", "light", "hand"]


def test_a_face_is_missed_only_where_hands_are_found_by_it() -> None:
    needed = CountedFace()
    visibility = Visibility(needed, needs_face=True)
    assert [missing for missing, _ in changes([True] * 90, visibility)] == ["", "face"]
    assert needed.num_asked <= 13  # twice a second
    needed.seen = True
    assert [missing for missing, _ in changes([True] * 90, visibility, first=90)] == ["face", ""]
    helpful = CountedFace()
    assert changes([True] * 90, Visibility(helpful)) == [("", 0.0)] and helpful.num_asked == 0
    assert [missing for missing, _ in changes([False] * 90, Visibility(helpful))] == ["", "face"], "not the hand first"
    assert [missing for missing, _ in changes([False] * 90, Visibility(CountedFace(True)))] == ["", "hand"]
    assert [missing for missing, _ in changes([True] * 90, Visibility(), face_seen=False)] == [""]
    known = Visibility(needs_face=True)
    assert [missing for missing, _ in changes([True] * 90, known, face_seen=False)] == ["", "face"]


def missed(events: Iterable[Event]) -> list[str]:
    """What events of the hand say is missing, one after the other."""
    hands = [event.fields["missing"] for event in events if event.event == "hand"]
    return [missing for missing, _ in groupby(hands)]


def test_a_watcher_says_what_is_missing() -> None:
    rng = np.random.default_rng(1)
    empty = [picture("flat", HIDDEN, rng) for _ in range(90)]
    signs = train_signs()
    events = list(Watcher(signs).watch(ClipSource([*empty, *shown(["flat"])], FPS)))
    assert missed(events) == ["", "hand", ""]
    assert [event.decision.label for event in events if event.event == "decision" and event.decision] == ["flat"]
    lines = [hand_line(event) for event in events if event.event == "hand" and event.fields["missing"]]
    assert lines and all(line.startswith("No hand seen: ") and "हाथ नहीं दिख रहा है" in line for line in lines)
    assert missed(Watcher(signs).watch(ClipSource([DARK] * 90, FPS))) == ["", "light"]


def test_signed_sentences_need_a_face() -> None:
    words = train_sentences()
    frames = film(signed(["cat", "ball"], 1, 3.0)[0], 120)
    hands = hri.live.PersonTracks(DrawnFace(False))
    assert missed(SignWatcher(words, hands=hands).watch(ClipSource(frames, SIGNING_FPS))) == ["", "face"]
    hands = hri.live.PersonTracks(DrawnFace())
    assert missed(SignWatcher(words, hands=hands).watch(ClipSource(frames, SIGNING_FPS))) == [""]


def test_rows_of_a_hand_miss_a_face_only_without_a_hand() -> None:
    class Rows(GestureRows):
        """With another finder of faces."""

        def reset(self) -> None:
            super().reset()
            self.faces = CountedFace()

    spans = [[("flat", 4, 10), ("tall", 12, 20)]] * 4
    rng = np.random.default_rng(0)
    words = hri.SentenceRecognizer(input="rows", choose_weights=False, language_order=0)
    words.fit([rng.normal(size=(24, 2)) for _ in spans], spans)
    hands = Rows(hri.GestureRecognizer(), lambda found: found[:, :2], faces="never")
    empty = [picture("flat", HIDDEN, rng) for _ in range(90)]
    held = [picture("flat", 0.5, rng) for _ in range(90)]
    assert missed(SignWatcher(words, hands=hands).watch(ClipSource(held, FPS))) == [""]
    assert missed(SignWatcher(words, hands=hands).watch(ClipSource(empty, FPS))) == ["", "face"]


def test_texts_are_in_both_languages() -> None:
    assert set(MISSING_TEXTS) == {"light", "face", "hand"} and missing_text("") == ""
    for texts in MISSING_TEXTS.values():
        assert list(texts) == ["en", "hi"]
        assert texts["en"].isascii() and any("\u0900" <= letter <= "\u097f" for letter in texts["hi"])
