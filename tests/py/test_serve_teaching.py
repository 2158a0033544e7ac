# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Samples of words and gestures that are added at the page outlive what fails, and Undo takes back what came last."""

from __future__ import annotations

import queue
import threading
from collections.abc import Iterator
from copy import copy
from typing import Any

import numpy as np
import pytest

pytest.importorskip("serving")

import hri
from conftest import RATE_HZ, WAIT_S, tone_word
from drawn_hands import stills
from hri.core.errors import InvalidArgument
from hri.media import Audio
from hri.serve import PageServer, Stage
from hri.serve.word_teacher import WordTeacher
from page_people import connected, enter, jpeg, request
from serving import LIMITS, answer, own_origin

pytest_plugins = ("serving",)


@pytest.fixture
def stage(words: Any) -> Iterator[Stage]:
    made = Stage(copy(words), None, None, limits=LIMITS)
    yield made
    made.close()


class Heard:
    """What a teacher without a page answers."""

    def __init__(self, stage: Stage) -> None:
        self._messages: queue.Queue[dict[str, Any]] = queue.Queue()
        stage.publish = self._messages.put

    def await_answer(self, text: str) -> dict[str, Any]:
        while True:
            message = self._messages.get(timeout=WAIT_S)
            if message["type"] == "teach" and text in message["text"]:
                return message


def sample(take: int, base_hz: float = 1500.0) -> Audio:
    return Audio(tone_word(base_hz, 0.0, take), RATE_HZ)


@pytest.mark.parametrize("error", [InvalidArgument("no memory"), ZeroDivisionError("by zero")])
def test_samples_are_kept_when_adding_fails_and_record_tries_again(
    stage: Stage, monkeypatch: pytest.MonkeyPatch, error: Exception
) -> None:
    heard = Heard(stage)
    teacher = WordTeacher(stage)
    teacher.obey({"type": "teach", "label": "hum"})

    def fail(*_: object) -> None:
        raise error

    with monkeypatch.context() as patched:
        patched.setattr(hri.WordRecognizer, "add_word", fail)
        for take in range(3):
            teacher._keep(sample(take))
        failed = heard.await_answer("“hum” could not be added: ")
        assert str(error) in failed["text"] and "samples are kept" in failed["text"]
        assert (failed["label"], failed["samples"], failed["added"]) == ("hum", 3, [])
        teacher.obey({"type": "sample"})
        heard.await_answer("“hum” could not be added: ")
    teacher.obey({"type": "sample"})
    assert heard.await_answer("“hum” is added")["added"] == ["hum"]
    assert stage.words is not None and "hum" in stage.words.classes_


def test_any_fault_is_answered(stage: Stage, monkeypatch: pytest.MonkeyPatch) -> None:
    heard = Heard(stage)
    teacher = WordTeacher(stage)
    monkeypatch.setattr(teacher, "_undo", lambda: 1 // 0)
    teacher.obey({"type": "undo"})
    heard.await_answer("That did not work: ZeroDivisionError")
    teacher.obey({"type": "sample"})
    heard.await_answer("first give the word a name")  # and nothing is kept waiting


def test_undo_takes_back_the_last_sample_the_name_and_then_the_last_word(stage: Stage) -> None:
    heard = Heard(stage)
    teacher = WordTeacher(stage)
    teacher.obey({"type": "teach", "label": "hum"})
    for take in range(3):
        teacher._keep(sample(take))
    assert heard.await_answer("“hum” is added")["added"] == ["hum"]
    teacher.obey({"type": "teach", "label": "buzz"})
    for take in range(2):
        teacher._keep(sample(take, 2400.0))
    teacher.obey({"type": "teach", "label": "flat"})  # one that is known leaves the samples of the other alone
    assert heard.await_answer("is a word already")["samples"] == 2
    teacher.obey({"type": "sample"})
    assert heard.await_answer("Speak now")["recording"]
    for text, label, samples, added in (
        ("The recording has ended", "buzz", 2, ["hum"]),
        ("The last sample of “buzz” is taken back: 1 of 3", "buzz", 1, ["hum"]),
        ("The last sample of “buzz” is taken back: 0 of 3", "buzz", 0, ["hum"]),
        ("“buzz” is not added", "", 0, ["hum"]),
        ("“hum” is removed", "", 0, []),
        ("there is nothing to undo", "", 0, []),
    ):
        teacher.obey({"type": "undo"})
        message = heard.await_answer(text)
        assert (message["label"], message["samples"], message["added"]) == (label, samples, added)
        assert not message["recording"]


def test_a_page_that_comes_is_sent_what_is_being_added(server: PageServer, cookie: str) -> None:
    with connected(server, cookie) as page:
        nothing = {"label": "", "samples": 0, "wanted": 3, "added": [], "recording": False, "busy": False}
        assert page.messages[0]["teaching"] == {"speech": nothing, "gesture": nothing}
        page.say(type="teach", label="hum", mode="speech")
        answer(page, "3 times")
        with connected(server, cookie) as again:  # the same page, whose line was lost
            assert again.messages[0]["teaching"]["speech"]["label"] == "hum"
            again.say(type="undo", mode="speech")
            answer(again, "“hum” is not added")
    with connected(server, cookie, "b") as page:
        assert page.messages[0]["teaching"]["speech"] == nothing


def test_a_welcome_says_what_was_added_and_that_something_is_learned(
    server: PageServer, cookie: str, stage: Stage, monkeypatch: pytest.MonkeyPatch
) -> None:
    learning, go_on = threading.Event(), threading.Event()
    add = hri.WordRecognizer.add_word

    def slowly(*arguments: Any) -> Any:
        learning.set()
        go_on.wait(WAIT_S)
        return add(*arguments)

    monkeypatch.setattr(hri.WordRecognizer, "add_word", slowly)
    with connected(server, cookie) as page:
        page.say(type="teach", label="hum", mode="speech")
        answer(page, "3 times")
        for take in range(3):
            page.say(type="sample", mode="speech")
            answer(page, "Speak now")
            page.perform(np.concatenate([tone_word(1500.0, 0.0, take), tone_word(0.0, 0.0, take)]))
            if take < 2:
                answer(page, f"Sample {take + 1} of 3")
        assert learning.wait(WAIT_S)
    try:
        with connected(server, cookie, "b") as page:
            assert page.messages[0]["teaching"]["speech"]["busy"]
            go_on.set()
            assert answer(page, "“hum” is added")["added"] == ["hum"]
    finally:
        go_on.set()
    with connected(server, cookie, "c") as page:
        state = page.messages[0]["teaching"]["speech"]
        assert state["added"] == ["hum"] and not state["busy"]


@pytest.mark.parametrize("model", ["svm", "rbf"])
def test_gestures_are_offered_only_where_the_model_learns_them(model: Any) -> None:
    rows = [(stills(sign, seed), sign, f"p{seed % 3}") for seed in range(6) for sign in ("flat", "tall")]
    x, y, persons = map(list, zip(*rows, strict=True))
    signs = hri.GestureRecognizer(model=model, false_reject_rate=0.0).fit(x, y, groups=persons)
    stage = Stage(None, signs, None, limits=LIMITS)
    try:
        welcome = stage.welcome()
        assert welcome["gesture"] and welcome["teach"] == (["gesture"] if model == "rbf" else [])
    finally:
        stage.close()


def test_files_are_kept_when_adding_fails(signs: hri.GestureRecognizer, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> None:
        raise InvalidArgument("no memory")

    stage = Stage(None, signs, None, limits=LIMITS)
    try:
        with PageServer(stage) as server, connected(server, enter(server)) as page:
            cookie = page.socket.request.headers["Cookie"]
            page.say(type="teach", label="wave", mode="gesture")
            answer(page, "3 times")
            with monkeypatch.context() as patched:
                patched.setattr(hri.GestureRecognizer, "add_gesture_features", fail)
                for seed, status in ((30, 200), (31, 200), (32, 200), (33, 422)):
                    body = jpeg(stills("flat", seed)[0])
                    given = request(server, "/sample?name=a.jpg", cookie, "POST", body, Origin=own_origin(server))
                    assert given[0] == status, given
                failed = answer(page, "“wave” could not be added: no memory.")
                assert failed["samples"] == 3 and failed["label"] == "wave"
            page.say(type="sample", mode="gesture")
            answer(page, "“wave” is added")
    finally:
        stage.close()
