# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The page's own voice: the microphone goes on while it speaks, and of what it hears only a person's STOP counts."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from typing import Any

import pytest

pytest.importorskip("serving")

from conftest import WAIT_S
from hri.robot import Robot, Trajectory
from hri.serve import PageServer, Stage
from hri.serve.voice import PageVoice
from hri.session import SessionOptions
from hri.session.voice import TAIL_S
from page_people import Microphone, Page, connected
from serving import LIMITS, answer
from session_people import MOTIONS, speech

pytest_plugins = ("serving",)
OWN = "heard while the robot speaks"


@pytest.fixture
def stage(words: Any, robot: Robot) -> Iterator[Stage]:
    made = Stage(words, None, robot, motions=MOTIONS, limits=replace(LIMITS, voice_s=120.0))
    yield made
    made.close()


def said_until(page: Page, mic: Microphone, word: str, kind: str, **fields: Any) -> dict[str, Any]:
    """Say a word until that event comes: on a loaded machine it may be lost."""
    for timeout_s in (15.0, 15.0, WAIT_S):
        mic.say(speech([(word, 0.6)], 1.8))
        with suppress(TimeoutError):
            return page.await_event(kind, timeout_s=timeout_s, **fields)
    raise TimeoutError(f"{word}: no {kind}")


def hearing(page: Page) -> None:
    """Until the session hears the microphone."""
    page.await_event("level")


def test_a_word_spoken_while_the_page_speaks_is_none_and_stop_is(server: PageServer, cookie: str, robot: Robot) -> None:
    with connected(server, cookie) as page, page.microphone() as mic:
        hearing(page)
        page.say(type="voice", text="Ready.")
        page.await_event("voice_start", text="Ready.")
        assert said_until(page, mic, "tall", "ignored", label="tall")["reason"] == OWN and not robot.stopped
        said_until(page, mic, "stop", "stop", label="stop")
        assert robot.stopped
        assert not any(m.get("event") == "motion_start" for m in page.messages)


def test_words_count_again_when_the_page_has_spoken(server: PageServer, cookie: str) -> None:
    with connected(server, cookie) as page, page.microphone() as mic:
        page.say(type="voice", text="Ready.")
        page.say(type="voice", text="I do nothing.")  # in place of the first
        page.say(type="voice", text="")
        for text in ("Ready.", "I do nothing."):
            page.await_event("voice_end", text=text)
        said_until(page, mic, "tall", "motion_start", label="tall")


def test_stop_that_is_said_over_the_robots_voice_ends_its_motion(serving: Any, words: Any, robot: Robot) -> None:
    slow = Trajectory(["head_joint_1"], 30.0, [[0.0], [0.5], [0.0]])
    server, cookie = serving(words, None, robot, motions={"tall": slow}, limits=replace(LIMITS, voice_s=60.0))
    with connected(server, cookie) as page, page.microphone() as mic:
        said_until(page, mic, "tall", "motion_start", label="tall")
        page.say(type="voice", text="tall.")
        page.await_event("voice_start")
        said_until(page, mic, "stop", "stop", label="stop")
        assert page.await_event("motion_end")["completed"] is False and robot.stopped


def test_what_the_page_says_aloud_does_not_name_stop(serving: Any, words: Any) -> None:
    options = SessionOptions(stop_at_rest=1.0, confirm_s=60.0, retry_s=0.2)
    server, cookie = serving(words, None, None, options, limits=LIMITS)
    with connected(server, cookie) as page, page.microphone() as mic:
        asked = said_until(page, mic, "stop", "say", text="Did you mean stop?")
        assert asked["aloud"] == "Shall I freeze?"
        assert asked["phrases"]["text"]["code"] == "did_you_mean"
        assert asked["phrases"]["aloud"] == {"code": "shall_i_freeze", "values": {}}
        page.say(type="voice", text=asked["aloud"])
        page.await_event("voice_start", text="Shall I freeze?")
        said_until(page, mic, "stop", "stop", label="stop")  # as it is no word of the robot's


def test_a_session_that_begins_while_the_page_speaks_knows(server: PageServer, cookie: str, stage: Stage) -> None:
    with connected(server, cookie) as page, page.microphone() as mic:
        page.say(type="voice", text="Ready.")
        page.await_event("voice_start")
        before = stage.session
        stage.renew()
        page.await_message(lambda m: m["type"] == "welcome")
        assert stage.session is not before
        page.await_event("voice_start", text="Ready.")
        assert said_until(page, mic, "tall", "ignored", label="tall")["reason"] == OWN


def test_no_sample_of_a_word_is_of_the_robots_voice(server: PageServer, cookie: str) -> None:
    with connected(server, cookie) as page, page.microphone() as mic:
        page.say(type="teach", mode="speech", label="fall")
        answer(page, "3 times")
        page.say(type="voice", text="Ready.")
        page.say(type="sample", mode="speech")
        answer(page, "Speak now")
        mic.say(speech([("tall", 1.0)], 2.0))
        answer(page, "I heard nothing")


def test_the_button_stops_while_it_speaks(server: PageServer, cookie: str, robot: Robot) -> None:
    with connected(server, cookie) as page:
        page.say(type="voice", text="stop")
        page.say(type="stop")
        page.await_event("state", state="stopped")
        assert robot.stopped


class Heard:
    """In place of a session: what a voice reported."""

    def __init__(self) -> None:
        self.reports: list[tuple[str, str]] = []

    def voiced(self, kind: str, text: str, message: str = "") -> None:
        self.reports.append((kind, text))


def test_a_page_that_does_not_say_that_the_voice_has_ended_is_heard_again() -> None:
    now = [0.0]
    voice, session, next_one = PageVoice(3600.0, lambda: now[0]), Heard(), Heard()
    voice.attach(session)  # type: ignore[arg-type]
    assert not voice.may_be_heard
    voice.begins("a")
    voice.ends()
    voice.ends()
    voice.begins("b")
    assert session.reports == [("voice_start", "a"), ("voice_end", "a"), ("voice_start", "b")]
    voice.attach(next_one)  # type: ignore[arg-type]
    assert voice.may_be_heard
    voice._expires(-1.0)  # that of "a"
    voice._expires(3600.0)
    assert next_one.reports == [("voice_start", "b"), ("voice_end", "b")]
    now[0] = 0.9 * TAIL_S
    assert voice.may_be_heard
    now[0] = 1.1 * TAIL_S
    assert not voice.may_be_heard


def test_the_longest_time_of_a_text_is_kept(serving: Any, words: Any) -> None:
    server, cookie = serving(words, None, None, limits=replace(LIMITS, voice_s=0.2))
    with connected(server, cookie) as page:
        page.say(type="voice", text="Ready.")
        page.await_event("voice_end", text="Ready.")


@pytest.mark.parametrize("text", [None, 7, ["stop"]])
def test_a_voice_that_says_no_text_is_refused(server: PageServer, cookie: str, text: Any) -> None:
    with connected(server, cookie) as page:
        page.say(type="voice", text=text)
        page.error("no command")
