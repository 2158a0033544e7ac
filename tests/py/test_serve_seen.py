# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The outline and the track of the hand, as the page draws them."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

pytest.importorskip("serving")

from hri.live import FrameResult
from hri.serve import PageServer, Stage
from hri.serve.seen import MAX_OUTLINE, MAX_TRACK, SeenHands, seen_message
from page_people import connected
from serving import LIMITS
from session_people import signing

pytest_plugins = ("serving",)


@pytest.fixture
def stage(signs: Any) -> Iterator[Stage]:
    made = Stage(None, signs, limits=LIMITS)
    yield made
    made.close()


def disk(radius: float = 40.0) -> np.ndarray:
    y, x = np.mgrid[:120, :160]
    return np.where((x - 80) ** 2 + (y - 60) ** 2 < radius**2, 255, 0).astype(np.uint8)


def result(mask: np.ndarray | None, num_track: int = 0, time_s: float = 0.0) -> FrameResult:
    track = [(i / 100, 0.5) for i in range(num_track)]
    return FrameResult(time_s, frame=np.zeros((240, 320, 3), np.uint8), mask=mask, track=track)


def test_the_outline_of_a_disk_is_about_it() -> None:
    message = seen_message(result(disk()))
    outline = np.array(message["outline"]) * (160, 120)
    assert len(outline) == MAX_OUTLINE
    assert np.abs(np.hypot(*(outline - (80, 60)).T) - 40).max() < 3


@pytest.mark.parametrize("mask", [None, np.zeros((120, 160), np.uint8), np.full((1, 1), 255, np.uint8)])
def test_without_a_hand_there_is_no_outline(mask: np.ndarray | None) -> None:
    assert seen_message(result(mask))["outline"] == []


def test_a_message_is_small_whatever_is_seen() -> None:
    rough = (np.random.default_rng(3).random((480, 640)) < 0.6).astype(np.uint8) * 255
    full = np.full((480, 640), 255, np.uint8)
    for mask in (rough, full, disk(2.0)):
        message = seen_message(result(mask, 200))
        assert len(message["outline"]) <= MAX_OUTLINE and len(message["track"]) == MAX_TRACK
        assert message["track"][-1] == [1.99, 0.5] and len(json.dumps(message)) < 2000


def test_no_more_than_twelve_are_sent_a_second() -> None:
    sent: list[Any] = []
    hands = SeenHands(sent.append)
    for count in range(60):
        hands.heed(result(disk(), time_s=count / 30))
    hands.heed(FrameResult(9.0))  # between two pictures
    assert 20 <= len(sent) <= 25


def test_the_page_is_sent_the_hand_that_is_shown(server: PageServer, cookie: str) -> None:
    with connected(server, cookie) as page:
        page.perform(frames=signing([("tall", 0.6)], 3.4))
        seen = page.await_message(lambda m: m["type"] == "seen" and len(m["track"]) > 3)
        outline = np.array(seen["outline"])
        assert 10 < len(outline) <= MAX_OUTLINE
        x, y = seen["track"][-1]
        assert outline[:, 0].min() <= x <= outline[:, 0].max() and outline[:, 1].min() <= y <= outline[:, 1].max()
