# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The robot's own voice, which the page's microphone hears: no command, but a person's STOP is one where it can be."""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

pytest.importorskip("serving")

from hri.robot import Robot
from hri.serve import PageServer, ServeLimits, Stage
from hri.serve.voice import RobotVoice
from page_people import connected
from serving import LIMITS
from session_people import MOTIONS, speech

pytest_plugins = ("serving",)
SAID = speech([("stop", 0.6)], 2.4)


@pytest.fixture
def stage(words: Any, robot: Robot) -> Iterator[Stage]:
    made = Stage(words, None, robot, motions=MOTIONS, limits=LIMITS)
    yield made
    made.close()


def test_its_own_question_about_stop_does_not_stop_it(server: PageServer, cookie: str, robot: Robot) -> None:
    with connected(server, cookie) as page:
        page.say(type="voice", text="Did you mean Stop or tall?")
        page.perform(SAID)
        page.say(type="voice", text="")
        assert not robot.stopped
        assert not any(m.get("event") in ("decision", "speech_start", "stop") for m in page.messages)
        page.command("motion_start", speech([("tall", 0.8)], 3.0), label="tall")  # words count again
        assert not any(m.get("event") == "stop" for m in page.messages)


def test_a_word_beside_another_text_counts_only_where_it_is_stop(server: PageServer, cookie: str, robot: Robot) -> None:
    with connected(server, cookie) as page:
        page.say(type="voice", text="Ready.")
        page.perform(speech([("tall", 0.6)], 2.4))
        assert not robot.stopped
        page.perform(SAID)
        page.await_event("state", state="stopped")
        assert robot.stopped and not any(m.get("event") == "decision" for m in page.messages)


def test_the_button_stops_while_it_speaks(server: PageServer, cookie: str, robot: Robot) -> None:
    with connected(server, cookie) as page:
        page.say(type="voice", text="stop")
        page.say(type="stop")
        page.await_event("state", state="stopped")
        assert robot.stopped


def test_a_page_that_does_not_say_that_the_voice_has_ended_is_heard_again(words: Any) -> None:
    now = [0.0]
    stage = Stage(words, limits=ServeLimits(voice_s=3.0))
    try:
        voice = RobotVoice(stage, lambda: now[0])
        sound = np.full(640, 0.5, np.float32)
        assert voice.filtered(sound) is sound
        voice.speaks("stop")
        assert not voice.filtered(sound).any()
        now[0] = 3.1
        assert voice.filtered(sound) is sound
        voice.speaks("stop")
        voice.ends()
        assert voice.filtered(sound) is sound
    finally:
        stage.close()


@pytest.mark.parametrize("text", [None, 7, ["stop"]])
def test_a_voice_that_says_no_text_is_refused(server: PageServer, cookie: str, text: Any) -> None:
    with connected(server, cookie) as page:
        page.say(type="voice", text=text)
        page.error("no command")
        time.sleep(0.05)
