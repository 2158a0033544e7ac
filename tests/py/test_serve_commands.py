# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Commands of several words, and sentences, by the page: what is decided, and what is wrong, in words."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("serving")


import hri
from conftest import RATE_HZ
from hri.core.errors import InvalidArgument
from hri.fusion import FusionOptions
from hri.language import Grammar, KnowledgeBase, StoredSentence
from hri.recognition import ConnectedWordRecognizer
from hri.robot import Robot
from hri.serve import PageServer, ServeLimits, Stage
from hri.session import SessionOptions
from page_people import connected, request, text_of
from serving import Serving, own_origin
from session_people import MOTIONS, speech
from test_commands import GRAMMAR, OPTIONS, tone_rows, tones

LEFT = "#JSGF V1.0;\ngrammar left;\npublic <command> = 1 1 {side=left} {gesture=up};\n"
NEVER_ASKS = SessionOptions(confirm_below=0.0, retry_s=0.2)
SENTENCES = SessionOptions(
    confirm_below=0.0,
    retry_s=0.2,
    fusion=FusionOptions(stop_labels=("halt",)),
    sentence_begin_labels=("flat",),
    sentence_end_labels=("stop",),
)
pytest_plugins = ("serving",)


@pytest.fixture(scope="module")
def connected_words() -> ConnectedWordRecognizer:
    return ConnectedWordRecognizer(**OPTIONS).fit(*tone_rows(), sample_rate_hz=RATE_HZ)


@pytest.fixture
def commands(connected_words: ConnectedWordRecognizer) -> hri.CommandRecognizer:
    return hri.CommandRecognizer(connected_words, Grammar.parse(GRAMMAR, "tones.jsgf"))


def send(server: PageServer, cookie: str, grammar: bytes, origin: str = "") -> tuple[int, str]:
    """Status and text of what the page is answered."""
    status, _, body = request(server, "/grammar", cookie, "POST", grammar, Origin=origin or own_origin(server))
    return status, text_of(body)


def test_a_command_is_shown_with_its_slots_and_moves_the_robot(serving: Serving, commands: Any, robot: Robot) -> None:
    with connected(*serving(commands, None, robot, NEVER_ASKS)) as page:
        welcome = page.messages[0]
        assert welcome["grammar"] == GRAMMAR and welcome["teach"] == [] and "2 1 2" in welcome["words"]
        assert welcome["refused"] == {"2 2": "the robot's torso is held, and it cannot walk"}
        fused = page.command("fused", tones("2 1 2"), final="2 1 2")
        assert fused["slots"] == {"side": "right", "gesture": "up", "times": "2"} and fused["rule"]
        page.await_event("motion_start", label="2 1 2")
        page.say(type="teach", label="hum", mode="speech")
        page.await_message(lambda m: m["type"] == "teach" and "no recogniser of words" in m["text"])


def test_the_page_changes_the_commands(
    serving: Serving, commands: Any, robot: Robot, notes: pytest.LogCaptureFixture
) -> None:
    server, cookie = serving(commands, None, robot, NEVER_ASKS)
    with connected(server, cookie) as page:
        for text, error in (
            (b"public <command> = 1;", "the grammar"),
            (LEFT.replace("1 1", "1 (1").encode(), "the grammar: line 3: a bracket"),
            (LEFT.replace("1 1", "1 jump").encode(), "not trained on: jump; it knows: 1, 2"),
            (LEFT.replace("1 1", "1+").encode(), "no end"),
            (LEFT.replace("1 1", " ".join(["(1 | 2)"] * 9)).encode(), "500 sentences"),
            (b"\xff\xfe", "no text in UTF-8"),
        ):
            status, answer = send(server, cookie, text)
            assert status == 422 and answer.startswith("The commands stay as they are: ") and error in answer
            assert answer.removeprefix("The commands stay as they are: ") in notes.text  # on the terminal, too
        assert send(server, cookie, bytes(ServeLimits().max_grammar_bytes + 1))[0] == 413
        assert send(server, "", LEFT.encode())[0] == 403
        assert send(server, cookie, LEFT.encode(), "http://evil.example")[0] == 403
        page.command("motion_start", tones("2 1"), label="2 1")  # they are as they were
        page.await_event("motion_end")
        page.await_event("state", state="idle")
        assert send(server, cookie, LEFT.encode()) == (200, "Commands in use now: 1.")
        welcome = page.await_message(lambda m: m["type"] == "welcome")
        assert welcome["words"] == ["1 1"] and welcome["grammar"] == LEFT
        assert page.command("fused", tones("1 1"), final="1 1")["slots"] == {"side": "left", "gesture": "up"}
        page.await_event("motion_start", label="1 1")


def test_single_words_have_no_grammar(serving: Serving, words: Any) -> None:
    server, cookie = serving(words, None)
    status, answer = send(server, cookie, LEFT.encode())
    assert status == 422 and "no commands of several words" in answer


def test_commands_without_a_label_of_the_options_are_refused(commands: Any, robot: Robot) -> None:
    stage = Stage(commands, None, robot, SessionOptions(wake_labels=("1",)))
    try:
        with pytest.raises(InvalidArgument, match="'1' is in no vocabulary"):
            stage.command_by(Grammar.parse(LEFT, "left"))
        assert stage.words is commands and stage.session.options.wake_labels == ("1",)
    finally:
        stage.close()


def test_a_sentence_is_shown_with_the_nearest_stored_one(serving: Serving, words: Any, robot: Robot) -> None:
    stored = KnowledgeBase([StoredSentence(("tall", "tall"), {"en": "Twice tall."}, ("flat",))], max_distance=0.6)
    server, cookie = serving(words, None, robot, SENTENCES, motions=MOTIONS, knowledge=stored)
    with connected(server, cookie) as page:
        given = {"begin": ["flat"], "end": ["stop"], "stored": ["tall tall"], "more": 0}
        assert page.messages[0]["sentences"] == given
        sentence = page.command("sentence", speech([("flat", 0.8), ("tall", 2.6), ("stop", 4.4)], 6.4), words=["tall"])
        assert sentence["nearest"] == ["tall", "tall"]
        assert 0 < sentence["distance"] <= sentence["max_distance"] == 0.6
        page.await_event("say", text="Twice tall.")
        page.await_event("motion_end", label="flat")
    with connected(server, cookie, "b") as page:  # also for who comes later
        assert {m["max_distance"] for m in page.messages[0]["log"] if m.get("event") == "sentence"} == {0.6}


def test_the_command_line_says_what_is_wrong(hri: Any, connected_words: Any, tmp_path: Path) -> None:
    model, grammar, table = tmp_path / "words.hri", tmp_path / "g.jsgf", tmp_path / "sentences.csv"
    connected_words.save(model)
    table.write_text("sign,en\n1 2,Yes\n")
    given = ("--no-gesture", "--backend", "none", "--speech-model", model)
    for text, more, message in (
        (LEFT.replace("1 1", "1 ("), (), "g.jsgf:"),
        (LEFT.replace("1 1", "1 jump"), (), "g.jsgf: the grammar has words that the model was not trained on: jump"),
        (LEFT, ("--wake", "2"), "'2' is in no vocabulary"),
        (LEFT, ("--knowledge", table), "sentences.csv"),
    ):
        grammar.write_text(text)
        result = hri("serve", *given, "--grammar", grammar, *more)
        assert result.code == 3 and message in result.err, (text, more, result.err)
    half = hri("serve", *given, "--grammar", grammar, "--sentence-begin", "1 1")
    assert half.code == 2 and "--sentence-begin and --sentence-end go together" in half.err
