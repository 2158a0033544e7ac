# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Sentences in a session: signs between a start and an end, what is said then, and what the robot answers."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from hri.core.errors import InvalidArgument
from hri.language import KnowledgeBase, StoredSentence
from hri.recognition.decision import UNKNOWN
from hri.session import Dialogue, SessionOptions
from hri.session.dialogue import MAX_SENTENCE_WORDS
from test_session_logic import ask, kinds, pair, pairer, sign, word

OPTIONS = SessionOptions(sentence_begin_labels=("start",), sentence_end_labels=("end",), sentence_s=10.0)
KNOWLEDGE = KnowledgeBase(
    [
        StoredSentence(("you", "sad", "why"), {"en": "Why are you sad?", "hi": "तुम उदास क्यों हो?"}, ("5", "7")),
        StoredSentence(("your", "home", "big"), {"en": "Is your home big?"}),
        StoredSentence(("play", "ball"), {}, ("no such motion",)),
    ],
    max_distance=0.4,
)
MOTIONS = ("5", "7")


def talked(*labels: str, options: SessionOptions = OPTIONS, knowledge: Any = KNOWLEDGE) -> tuple[Dialogue, list[Any]]:
    """The dialogue after a start and these signs, and what the end gave."""
    talk = Dialogue(options, MOTIONS, knowledge)
    assert kinds(talk.decide(pair("start"), 1.0)) == [("state", "sentence")]
    for label in labels:
        assert talk.decide(pair(label), 2.0) == [] and talk.state == "sentence"
    return talk, talk.decide(pair("end"), 3.0)


def test_the_nearest_stored_sentence_is_said_and_answered_by_one_gesture_after_the_other() -> None:
    talk, done = talked("you", "why")
    (read, *rest) = done
    assert read.kind == "sentence" and read.words == ("you", "why")
    assert read.nearest.sentence.words == ("you", "sad", "why") and read.nearest.distance == pytest.approx(3 / 11)
    assert kinds(rest) == [("say", "Why are you sad?"), ("state", "acting"), ("move", "5")]
    assert kinds(talk.moved("", False)) == [("move", "7")] and talk.state == "acting"
    assert kinds(talk.moved("", False)) == [("state", "idle")]
    assert kinds(talked("you", "why", options=SessionOptions(sentence_begin_labels=("start",),
        sentence_end_labels=("end",), language="hi"))[1])[1] == ("say", "तुम उदास क्यों हो?")  # fmt: skip


def test_without_an_answer_the_robot_only_speaks() -> None:
    for signs, said in (("your home big", "Is your home big?"), ("play ball", "play ball")):
        talk, done = talked(*signs.split())
        assert kinds(done[1:]) == [("say", said), ("state", "idle")]
    talk, done = talked("house", "unknown", knowledge=None)
    assert done[0].words == ("house", "unknown") and done[0].nearest is None
    assert kinds(done[1:]) == [("say", "house unknown"), ("state", "idle")] and talk.state == "idle"


def test_what_is_far_from_every_stored_sentence_is_not_understood() -> None:
    _, done = talked("ball", "ball", "ball")
    assert done[0].nearest is not None and done[0].nearest.distance > 0.4
    assert kinds(done[1:]) == [("say", "I did not understand that."), ("state", "idle")]
    _, done = talked()
    assert done[0].words == () and kinds(done[1:])[0] == ("say", "I did not understand that.")


def test_words_of_a_signed_sentence_that_were_rejected_are_not_known() -> None:
    talk = Dialogue(SessionOptions(), MOTIONS, KNOWLEDGE)
    done = talk.signed(["you", "<unk>", "why"], 0.0, 1.0)
    assert done[0].words == ("you", "unknown", "why") and done[0].nearest.sentence.words == ("you", "sad", "why")
    talk = Dialogue(SessionOptions(), MOTIONS)
    assert kinds(talk.signed(["<unk>", "<unk>"], 2.0, 3.0))[1] == ("say", "I did not understand that.")
    assert talk.signing(["<unk>"]) == []
    (asked, _) = talk.decide(ask(), 4.0)
    assert talk.state == "confirming"
    assert kinds(talk.signed(["<unk>"], 5.0, 6.0)) == [("say", asked.text)]
    assert kinds(talk.signed(["5"], 6.0, 7.0))[-1] == ("move", "5")


def test_what_is_rejected_is_a_word_that_is_not_known() -> None:
    talk = Dialogue(OPTIONS, MOTIONS, KNOWLEDGE)
    talk.decide(pair("start"), 1.0)
    talk.decide(pair("5", status=UNKNOWN), 2.0)
    talk.decide(pair("7", confidence=0.1), 2.0)
    assert talk.decide(pair("end"), 3.0)[0].words == ("unknown", "7"), "an unsure command is asked for, a word is not"


def test_a_start_begins_anew_and_an_end_without_one_is_nothing() -> None:
    talk = Dialogue(OPTIONS, MOTIONS, KNOWLEDGE)
    assert kinds(talk.decide(pair("end"), 0.5)) == [("ignored", "end")]
    for label in ("start", "play", "start", "you", "sad", "why"):
        talk.decide(pair(label), 1.0)
    assert talk.decide(pair("end"), 3.0)[0].words == ("you", "sad", "why")
    assert ("move", "5") in kinds(Dialogue(OPTIONS, MOTIONS, KNOWLEDGE).decide(pair("5"), 1.0)), "else it is a command"


def test_a_sentence_without_an_end_is_dropped() -> None:
    talk = Dialogue(OPTIONS, MOTIONS, KNOWLEDGE)
    talk.decide(pair("start"), 1.0)
    talk.decide(pair("you"), 8.0)
    talk.activity(True, 17.0)
    assert talk.tick(18.1) == [], "a sign is being shown"
    talk.activity(False, 18.2)
    assert kinds(talk.tick(18.2)) == [("say", "The sentence has no end: I do nothing."), ("state", "idle")]
    talk.decide(pair("start"), 20.0)
    for _ in range(MAX_SENTENCE_WORDS):
        assert talk.decide(pair("you"), 21.0) == []
    assert "too long" in talk.decide(pair("you"), 21.0)[0].text and talk.state == "idle"


def test_stop_counts_in_a_sentence_and_between_answers() -> None:
    talk = Dialogue(OPTIONS, MOTIONS, KNOWLEDGE)
    talk.decide(pair("start"), 1.0)
    assert talk.decide(pair("stop"), 2.0)[0].kind == "stop" and talk.state == "stopped"
    assert kinds(talk.decide(pair("start"), 3.0)) == [("ignored", "start")]
    for stopped in ("stop", "no"):
        talk, _ = talked("you", "sad", "why")
        talk.decide(pair(stopped), 4.0)
        assert talk.moved("", False) == [], "no second gesture"
    talk, _ = talked("you", "sad", "why")
    assert [action.kind for action in talk.moved("no link", True)] == ["say", "stop", "state"]
    talk = Dialogue(OPTIONS, MOTIONS, KNOWLEDGE)
    talk.decide(pair("start"), 1.0)
    talk.decide(ask(), 2.0)
    assert talk.state == "confirming"


def test_what_waits_is_of_the_sentence_that_ends() -> None:
    made = pairer(sentence_begin_labels=("start",), sentence_end_labels=("end",))
    assert made.observe(sign("you", 1.0, 1.5), 1.6) == [], "a word may belong to it"
    found = made.observe(sign("end", 1.7, 2.0), 2.1)
    assert [one.fused.label for one in found] == ["you", "end"] and made.waiting == 0
    assert "a sentence begins or ends" in found[0].why
    made.observe(word("you", 3.0, 3.5), 3.6)
    assert [one.fused.label for one in made.observe(sign("end", 3.7, 4.0), 4.1)] == ["end"], "another mode's waits on"


def test_labels_and_stored_sentences_that_cannot_be_are_refused(tmp_path: Path) -> None:
    for options in (
        {"sentence_begin_labels": ("start",)},
        {"sentence_end_labels": ("end",)},
        {"sentence_begin_labels": ("stop",), "sentence_end_labels": ("end",)},
        {"sentence_begin_labels": ("end",), "sentence_end_labels": ("end",)},
    ):
        with pytest.raises(InvalidArgument, match="sentence_"):
            SessionOptions(**options)  # type: ignore[arg-type]
    with pytest.raises(InvalidArgument, match="sentence_s"):
        SessionOptions(sentence_s=0.0)
    table = tmp_path / "stored.csv"
    table.write_text("signs,en,answer\nyou sad,Are you sad?,no yes\nball,,\n", encoding="utf-8")
    first, second = KnowledgeBase.read(table).sentences
    assert (first.answer, second.answer) == (("no", "yes"), ()) and first.texts == {"en": "Are you sad?"}
