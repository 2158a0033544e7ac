# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Words that are added at the page: by its microphone, what they are confused with, and STOP meanwhile."""

from __future__ import annotations

import json
import queue
import threading
from collections.abc import Iterator
from copy import copy
from typing import Any

import numpy as np
import pytest

pytest.importorskip("serving")


import hri
from conftest import WAIT_S, tone_word
from hri.media import Audio
from hri.robot import Robot
from hri.serve import PageServer, Stage
from hri.serve.word_teacher import WordTeacher
from page_people import RATE_HZ, connected, request
from serving import LIMITS, answer
from session_people import MOTIONS, speech

pytest_plugins = ("serving",)


@pytest.fixture
def stage(words: Any, robot: Robot) -> Iterator[Stage]:
    made = Stage(copy(words), None, robot, motions=MOTIONS, limits=LIMITS)
    yield made
    made.close()


def test_a_word_is_added_by_three_samples_and_undone(
    server: PageServer, cookie: str, stage: Stage, robot: Robot, tmp_path: Any
) -> None:
    rng = np.random.default_rng(2)
    with connected(server, cookie) as page:
        for command, text in (
            ({"type": "undo"}, "nothing to undo"),
            ({"type": "sample"}, "first give the word a name"),
            ({"type": "teach", "label": "flat"}, "is a word already"),
            ({"type": "teach", "label": " hum "}, "3 times"),
        ):
            page.say(**command, mode="speech")
            answer(page, text)
        for number in range(4):
            page.say(type="sample", mode="speech")
            answer(page, "Speak now")
            said = 0.001 * rng.standard_normal(5 * RATE_HZ + 640).astype("f4")
            if number:  # the first time nothing is said
                said = said[: 2 * RATE_HZ]
                at = slice(RATE_HZ // 2, RATE_HZ)
                said[at] += 0.2 * np.sin(2 * np.pi * (1500 + 20 * number) * np.arange(RATE_HZ // 2) / RATE_HZ)
            page.perform(said)
            answer(page, ("I heard nothing", "Sample 1 of 3", "Sample 2 of 3", "is added")[number])
        assert "hum" in [m for m in page.messages if m["type"] == "welcome"][-1]["words"]
        happened = {m.get("event") for m in page.messages}
        assert "ignored" in happened and "motion_start" not in happened  # what is recorded is no command
        (tmp_path / "words.hri").write_bytes(request(server, "/words.hri", cookie)[2])
        assert "hum" in hri.WordRecognizer.load(tmp_path / "words.hri").classes_
        assert request(server, "/words.hri")[0] == 403 and request(server, "/words.hpp")[0] == 403
        assert b"Span<const std::uint8_t> words()" in request(server, "/words.hpp", cookie)[2]
        assert json.loads(request(server, "/words.json", cookie)[2])["kind"] == "word_recognizer"
        page.say(type="stop")
        page.await_event("state", state="stopped")
        page.say(type="undo", mode="speech")
        answer(page, "“hum” is removed")
        page.await_event("state", state="stopped")  # the new session is stopped, too
        page.say(type="resume")
        page.await_event("state", state="idle")
        assert not robot.stopped
        assert stage.words is not None and [str(label) for label in stage.words.classes_] == ["flat", "stop", "tall"]


def test_words_that_are_alike_are_named_both_ways(stage: Stage) -> None:
    messages: list[dict[str, Any]] = []
    stage.publish = messages.append
    teacher = WordTeacher(stage)
    rng = np.random.default_rng(3)
    for label in ("hum", "buzz"):
        teacher.obey({"type": "teach", "label": label})
        for take in range(3):
            said = 0.001 * rng.standard_normal(RATE_HZ).astype("f4")
            at = slice(RATE_HZ // 4, 3 * RATE_HZ // 4)
            said[at] += 0.2 * np.sin(2 * np.pi * (1500 + 20 * take) * np.arange(RATE_HZ // 2) / RATE_HZ)
            teacher._keep(Audio(said, RATE_HZ))
    added = [m for m in messages if "is added" in m.get("text", "")]
    assert [m["added"] for m in added] == [["hum"], ["hum", "buzz"]] and not added[0]["confused"]
    assert "may be confused with “hum”" in added[1]["text"]
    assert added[1]["confused"][0]["samples_of_other"] > 0
    assert stage.words is not None and {"hum", "buzz"} < set(stage.words.classes_)


def test_stop_is_heard_while_a_word_is_recorded(server: PageServer, cookie: str, robot: Robot) -> None:
    with connected(server, cookie) as page:
        page.say(type="teach", label="hum", mode="speech")
        page.say(type="sample", mode="speech")
        page.perform(speech([("stop", 0.8)], 3.0))
        stopped = page.await_message(lambda m: m["type"] == "teach" and m["text"].startswith("STOP"))
        assert stopped["samples"] == 0 and not stopped["recording"] and robot.stopped
        page.await_stopped()
        page.say(type="resume")
        page.await_event("state", state="idle")
        page.command("motion_start", speech([("flat", 0.8)], 3.0), label="flat")  # commands count again


def test_what_is_learned_counts_as_soon_as_the_robot_rests(stage: Stage, monkeypatch: pytest.MonkeyPatch) -> None:
    published: queue.Queue[dict[str, Any]] = queue.Queue()
    stage.publish = published.put
    moving = threading.Event()
    monkeypatch.setattr(Stage, "moving", property(lambda _: moving.is_set()))
    teacher = WordTeacher(stage)
    teacher.obey({"type": "teach", "label": "hum"})
    for take in range(2):
        teacher._keep(Audio(tone_word(1500.0, 0.0, take), RATE_HZ))
    moving.set()  # as by a command that was heard after the last sample
    adding = threading.Thread(target=lambda: teacher._keep(Audio(tone_word(1500.0, 0.0, 2), RATE_HZ)))
    adding.start()
    while "as soon as the robot rests" not in published.get(timeout=WAIT_S).get("text", ""):
        pass
    assert "hum" not in [str(label) for label in stage.session._labels]
    moving.clear()
    adding.join(WAIT_S)
    assert "hum" in [str(label) for label in stage.session._labels]
