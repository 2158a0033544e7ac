# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Recordings of people who were not trained on, in a browser: said into its microphone, and dropped on the page."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("browsing")

import hri
from browsing import MARKS, await_motion, expect
from conftest import RATE_HZ
from hri.serve import PageServer, Stage
from hri.session import SessionOptions
from session_people import TURN

pytest_plugins = ("serving", "browsing")
pytestmark = [*MARKS, pytest.mark.data]

WORDS, SIGNS = ("stop", "left", "yes"), ("1", "5")
SPEAKER, PERSONS = "01", range(1, 40)


def folder(name: str) -> Path:
    found = Path(os.environ["HRI_DATA"]) / name
    if not found.is_dir():
        pytest.skip(f"HRI_DATA has no folder {name}")
    return found


@pytest.fixture(scope="module")
def words() -> hri.WordRecognizer:
    """Trained on every second speaker but one."""
    clips = [(clip, word) for word in WORDS for clip in sorted((folder("commands") / word).glob("*.flac"))]
    rows = [(clip, word, clip.stem.split("_")[1]) for clip, word in clips]
    others = sorted({speaker for _, _, speaker in rows} - {SPEAKER})[::2]
    x, y, speakers = map(list, zip(*(row for row in rows if row[2] in others), strict=True))
    return hri.WordRecognizer().fit(x, y, groups=speakers)


@pytest.fixture(scope="module")
def digits() -> hri.GestureRecognizer:
    people = folder("sign_digits")
    rows = [(people / f"person{one:03d}" / f"{sign}.jpg", sign, str(one)) for one in PERSONS for sign in SIGNS]
    x, y, persons = map(list, zip(*rows, strict=True))
    return hri.GestureRecognizer(false_reject_rate=0.0).fit(x, y, groups=persons)


@pytest.fixture
def stage(words: Any, digits: Any, robot: Any) -> Iterator[Stage]:
    made = Stage(words, digits, robot, SessionOptions(retry_s=0.2), motions={"left": TURN})
    yield made
    made.close()


def clip(word: str, take: str = "01") -> Path:
    return folder("commands") / word / f"{word}_{SPEAKER}_{take}.flac"


def test_words_that_a_person_says_move_the_robot_and_stop_stops_it(visit: Any, robot: Any) -> None:
    left, stop = (hri.read_audio(clip(word)).samples for word in ("left", "stop"))
    quiet = (1e-4 * np.random.default_rng(2).standard_normal(4 * RATE_HZ)).astype(np.float32)
    page = visit(np.concatenate([quiet, left, quiet[: 2 * RATE_HZ], stop, quiet]))
    page.click("#start")
    await_motion(page, "left")
    expect(page, "#log").to_contain_text("STOP stop: stop: recognised in speech.")
    expect(page, "#log").to_contain_text("The robot has stopped: left")
    expect(page, "#state").to_have_text("stopped")
    assert robot.stopped and page.failures == []


@pytest.mark.parametrize("word", ["left", "yes"])
def test_a_recording_that_is_dropped_is_decided_on_rightly(visit: Any, word: str) -> None:
    page = visit()
    page.set_input_files("#source-file", str(clip(word, "04")))
    expect(page, "#bars-speech li:first-child span:first-child").to_have_text(word)
    expect(page, "#decided").to_have_text(word)
    assert page.failures == []


@pytest.mark.parametrize("sign", SIGNS)
def test_a_photo_of_a_hand_is_decided_on_rightly(visit: Any, server: PageServer, sign: str) -> None:
    page = visit()
    page.set_input_files("#source-file", str(folder("sign_digits") / "person101" / f"{sign}.jpg"))
    expect(page, "#bars-gesture li:first-child span:first-child").to_have_text(sign)
    assert page.failures == []
