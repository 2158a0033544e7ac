# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The session behind the page: STOP and resume, whenever they come."""

from __future__ import annotations

import queue
from copy import copy
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

pytest.importorskip("serving")


from conftest import RATE_HZ, WAIT_S, tone_word
from hri.core.errors import InvalidArgument
from hri.core.phrases import phrase_of
from hri.live import Stalled
from hri.robot import Robot
from hri.serve import Stage
from hri.serve.devices import PageMicrophone
from hri.serve.messages import with_phrases
from hri.session import Session
from serving import LIMITS
from session_people import MOTIONS

pytest_plugins = ("serving",)


def test_resume_ends_a_stop_that_came_while_a_session_began(
    words: Any, robot: Robot, monkeypatch: pytest.MonkeyPatch
) -> None:
    stage = Stage(words, None, robot, motions=MOTIONS, limits=LIMITS)
    run, refusals = Session.run, []

    def stopped_first(self: Session, *sources: Any, **options: Any) -> Any:
        if not refusals:
            refusals.append(True)
            stage.stop()
            try:
                return run(self, *sources, **options)
            finally:
                stage.resume()  # before the stage knows that it was refused
        return run(self, *sources, **options)

    monkeypatch.setattr(Session, "run", stopped_first)
    published: queue.Queue[dict[str, Any]] = queue.Queue()
    stage.publish = published.put
    try:
        stage.arrive()
        while published.get(timeout=WAIT_S).get("event") != "resumed":
            pass
        while published.get(timeout=WAIT_S).get("state") != "idle":
            pass
        assert not robot.stopped
    finally:
        stage.close()


def test_stop_after_resume_is_held_when_the_page_comes_again(words: Any, robot: Robot) -> None:
    stage = Stage(words, None, robot, motions=MOTIONS, limits=LIMITS)
    published: queue.Queue[dict[str, Any]] = queue.Queue()
    stage.publish = published.put
    try:
        stage.arrive()
        while published.get(timeout=WAIT_S).get("state") != "idle":
            pass
        stage.stop()
        stage.resume()
        stage.stop()  # before the session has heeded the others
        heeded: list[str] = []
        while heeded[-1:] != ["stop"] or len(heeded) < 2:
            event = published.get(timeout=WAIT_S).get("event")
            heeded += [event] if event in ("stop", "resumed") else []
        assert stage._held, "a page that comes again resumes only what was not held"
        stage.leave()
        stage.arrive()
        assert robot.stopped
    finally:
        stage.close()


def test_a_page_that_changes_its_rate_ends_the_stream_of_the_old_one() -> None:
    microphone = PageMicrophone(stall_s=5.0)
    microphone.put(np.zeros(160, np.float32))
    source = microphone.stream()
    microphone.start(48000)
    microphone.put(np.zeros(480, np.float32))  # sound comes on, of the other rate
    with pytest.raises(Stalled, match="another rate"):
        source.read()
    again = microphone.stream()
    microphone.put(np.ones(480, np.float32))
    assert again.sample_rate_hz == 48000 and len(again.read()) == 480


def test_a_label_that_is_added_moves_the_robot_where_it_has_a_gesture_of_that_name(words: Any, robot: Robot) -> None:
    changed = copy(words)
    stage = Stage(changed, None, robot)
    try:
        assert stage.welcome()["refused"] == dict.fromkeys(("flat", "tall"), "no gesture has this name")
        changed.add_word("5", [tone_word(700.0, 2000.0, take) for take in range(3)], RATE_HZ)
        stage.renew()
        assert stage.welcome()["motions"] == ["5"]
    finally:
        stage.close()


def test_what_the_stage_reports_is_said_in_both_languages(
    words: Any, robot: Robot, monkeypatch: pytest.MonkeyPatch
) -> None:
    stage = Stage(words, None, robot, motions=MOTIONS, limits=LIMITS)
    try:
        with monkeypatch.context() as patched:
            patched.setattr(Stage, "moving", True)
            with pytest.raises(InvalidArgument, match="until the robot rests") as refused:
                stage.renew()
        assert with_phrases({"text": phrase_of(refused.value)})["phrases"]["text"]["code"] == "wait_for_rest"
        published: queue.Queue[dict[str, Any]] = queue.Queue()
        stage.publish = published.put
        stage._report_failure(SimpleNamespace(failure="the disk is full"))  # type: ignore[arg-type]
        note = with_phrases(published.get(timeout=WAIT_S))
        assert note["text"] == "The session was not recorded: the disk is full"
        assert note["phrases"]["text"]["code"] == "not_recorded"
    finally:
        stage.close()


def test_what_a_page_may_have_missed_is_numbered(words: Any, robot: Robot) -> None:
    stage = Stage(words, None, robot, motions=MOTIONS, limits=LIMITS)
    published: queue.Queue[dict[str, Any]] = queue.Queue()
    stage.publish = published.put
    try:
        for text in ("one", "two", "three"):
            stage._report(text)
        log = stage.welcome()["log"]
        numbers = [message["log_number"] for message in log]
        assert numbers == list(range(numbers[0], numbers[0] + 3))
        assert [published.get(timeout=WAIT_S)["log_number"] for _ in log] == numbers
    finally:
        stage.close()
