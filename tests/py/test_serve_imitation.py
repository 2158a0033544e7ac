# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A robot that imitates who stands before the page's camera: by button or word, until STOP by whatever way."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from itertools import cycle
from typing import Any

import numpy as np
import pytest

pytest.importorskip("serving")

from websockets.exceptions import ConnectionClosed

from conftest import until
from drawn_hands import FPS, Frame
from hri.fusion import FusionOptions
from hri.robot import Robot
from hri.robot.imitation import live
from hri.serve import PageServer, Stage
from hri.session import Session, SessionOptions
from page_people import PICTURE, Page, connected, framed, jpeg
from serving import LIMITS, Serving, answer, stop_by_button, stop_by_request
from session_people import MOTIONS, signing, speech
from test_session_imitation import OneFace, picture, waving

pytest_plugins = ("serving",)

OPTIONS = SessionOptions(imitate_labels=("tall",), retry_s=0.2)
OTHERS = {label: motion for label, motion in MOTIONS.items() if label != "tall"}


@pytest.fixture(autouse=True)
def late_pictures_count(monkeypatch: pytest.MonkeyPatch) -> None:
    """On a loaded machine they come late."""
    monkeypatch.setattr(live, "_OUT_OF_DATE_S", 30.0)


@pytest.fixture
def stage(words: Any, signs: Any, robot: Robot) -> Iterator[Stage]:
    made = Stage(words, signs, robot, OPTIONS, motions=OTHERS, limits=LIMITS, faces=OneFace())
    yield made
    made.close()


@contextmanager
def before_the_camera(page: Page, frames: list[Frame] | None = None) -> Iterator[None]:
    """A person waves meanwhile, or what else the frames show, over and over."""
    frames = frames or [picture(*waving(count / FPS)) for count in range(40)]
    messages = [framed(PICTURE, jpeg(frame), 1000 * count / FPS) for count, frame in enumerate(frames)]
    over = threading.Event()

    def send() -> None:
        with suppress(ConnectionClosed):
            for message in cycle(messages):
                if over.wait(1 / FPS):
                    return
                page.socket.send(message)

    sender = threading.Thread(target=send, daemon=True)
    sender.start()
    try:
        yield
    finally:
        over.set()
        sender.join()


def imitate(page: Page) -> None:
    """By the button, which wants pictures to come."""
    page.await_event("hand")
    page.say(type="imitate")
    imitation(page, True)


def imitation(page: Page, on: bool) -> None:
    page.await_message(lambda m: m["type"] == "imitation" and m["on"] is on)


def moves_an_arm(message: dict[str, Any]) -> bool:
    return message["type"] == "robot" and abs(message["joints"]["larm_joint_2"]) > 10


def test_the_button_begins_imitation_and_ends_it(server: PageServer, cookie: str, stage: Stage) -> None:
    with connected(server, cookie) as page, before_the_camera(page):
        assert page.messages[0]["imitate"] == ["tall"] and page.messages[0]["imitating"] is False
        imitate(page)
        page.await_message(moves_an_arm)
        with connected(server, cookie) as again:  # the same page, whose line broke
            assert again.messages[0]["imitating"] is True
            again.say(type="rest")
            imitation(again, False)
            again.await_event("rest", reason="asked for")
            again.await_event("motion_end", label="tall")
            assert not stage.moving
            again.say(type="teach", label="hum", mode="speech")
            again.say(type="sample", mode="speech")
            answer(again, "Speak now")
            again.say(type="imitate")
            again.await_event("ignored", label="tall", reason="only STOP counts while a sample is recorded")


def stop_by_word(server: PageServer, cookie: str, page: Page) -> None:
    page.command("stop", speech([("stop", 0.8)], 2.6), label="stop")


@pytest.mark.parametrize("stop", [stop_by_button, stop_by_request, stop_by_word])
def test_stop_ends_imitation_at_once_and_wins(
    server: PageServer, cookie: str, robot: Robot, stop: Callable[..., None]
) -> None:
    with connected(server, cookie) as page, before_the_camera(page):
        imitate(page)
        page.await_message(moves_an_arm)
        stop(server, cookie, page)
        page.await_stopped()
        if not any(m.get("event") == "motion_end" for m in page.messages):
            page.await_event("motion_end", label="tall")
        assert robot.stopped and page.messages[-1].get("completed") is not True
        page.say(type="imitate")
        page.await_event("ignored", label="tall", reason="stopped until resume")
        assert [m["on"] for m in page.messages if m["type"] == "imitation"] == [True, False]
        page.say(type="resume")
        page.await_event("state", state="idle")
        imitate(page)
        page.await_event("motion_start", label="tall")


def test_a_word_begins_imitation_and_a_sign_stops_it(serving: Serving, words: Any, signs: Any, robot: Robot) -> None:
    options = SessionOptions(
        imitate_labels=("flat",), retry_s=0.2, confirm_below=0.0, fusion=FusionOptions(stop_labels=("tall",))
    )
    server, cookie = serving(words, signs, robot, options, motions={}, limits=LIMITS, faces=OneFace())
    with connected(server, cookie) as page:
        with before_the_camera(page, signing([], 1.0)):
            page.command("motion_start", speech([("flat", 0.8)], 3.0), label="flat")
            assert {"type": "imitation", "on": True} in page.messages[:-1]  # and after it where the robot is
        with before_the_camera(page, signing([("tall", 0.6)], 3.4)):
            page.await_event("stop", label="tall")
            page.await_stopped()
        assert robot.stopped


def test_a_fault_and_a_page_that_goes_end_imitation(
    server: PageServer, cookie: str, stage: Stage, robot: Robot, monkeypatch: pytest.MonkeyPatch
) -> None:
    follow = robot.follow

    def breaks(names: Any, target_at: Any, *more: Any) -> bool:
        calls = 0

        def counted(time_s: float) -> np.ndarray:
            nonlocal calls
            calls += 1
            if calls > 20:
                raise OSError("the link is lost")
            return target_at(time_s)

        return follow(names, counted, *more)

    with connected(server, cookie) as page, before_the_camera(page):
        with monkeypatch.context() as patch:
            patch.setattr(robot, "follow", breaks)
            imitate(page)
            page.await_event("stop", reason="The robot does not obey: the link is lost")
        assert [m["on"] for m in page.messages if m["type"] == "imitation"] == [True, False]
        page.say(type="resume")
        page.await_event("resumed")
        imitate(page)
    until(lambda: robot.stopped and stage.welcome()["state"] == "stopped")
    with connected(server, cookie, "b") as page:
        assert page.messages[0]["state"] == "stopped" and page.messages[0]["imitating"] is False


def test_without_a_label_or_a_robot_there_is_no_imitation(serving: Serving, signs: Any, robot: Robot) -> None:
    for parts, options in (((None, signs, robot), SessionOptions()), ((None, signs, None), OPTIONS)):
        server, cookie = serving(*parts, options, motions=OTHERS, limits=LIMITS)
        with connected(server, cookie) as page:
            assert page.messages[0]["imitate"] == []
            page.say(type="imitate")
            page.await_event("say", text="tall." if parts[2] is None else "I cannot imitate you.")


def test_who_asks_while_the_session_begins_is_heeded(
    serving: Serving, signs: Any, robot: Robot, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = Session.run

    def late(*given: Any, **options: Any) -> Any:
        time.sleep(0.5)
        return run(*given, **options)

    monkeypatch.setattr(Session, "run", late)
    server, cookie = serving(None, signs, robot, SessionOptions(), motions=OTHERS, limits=LIMITS)
    with connected(server, cookie) as page:
        page.say(type="imitate")
        page.await_event("say", text="I cannot imitate you.")
        assert sum(m.get("text") == "I cannot imitate you." for m in page.messages) == 1


def test_the_command_line_takes_it_as_hri_session_does(hri: Any, words: Any, tmp_path: Any) -> None:
    words.save(tmp_path / "words.hri")
    given = ("--no-gesture", "--speech-model", tmp_path / "words.hri", "--backend", "kinematic", "--imitate", "tall")
    for command in ("serve", "session"):
        result = hri(command, *given)
        assert result.code == 2 and "--imitate is of the arms of a person who is seen" in result.err, result.err
        assert "--imitate LABEL" in hri(command, "--help").out
