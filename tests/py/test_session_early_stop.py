# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A spoken STOP counts at the first pause behind it, before the end of the word is certain, and counts once."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hri
from conftest import PERSONS, RATE_HZ, tone_word
from hri.fusion import FusionOptions
from hri.live import ArraySource, Attention, Event, Listener
from hri.live.listener import endpointer_of
from hri.recognition import Decision
from hri.robot import open_robot
from hri.session import McapRecorder, Session, SessionOptions, decisions, read_recording, replay
from hri.signal import EndpointerOptions
from session_people import SLOPES, TURN, speech, train_words

pytest.importorskip("cv2")

PAUSE = EndpointerOptions(pause_ms=80)
SAID = [("tall", 1.5), ("stop", 3.5)]
STOP_ENDS_S = 4.0


@pytest.fixture(scope="module")
def words() -> hri.WordRecognizer:
    return train_words()


def stop_and_more(gap_s: float, label: str = "tall") -> np.ndarray:
    """STOP, and after a gap that does not end an utterance another word."""
    person = list(PERSONS.values())[-1]
    stop, other = (tone_word(person, SLOPES[name], 50)[RATE_HZ // 4 : -RATE_HZ // 4] for name in ("stop", label))
    stream = 0.001 * np.random.default_rng(5).standard_normal(4 * RATE_HZ).astype("f4")
    for at, word in ((RATE_HZ, stop), (RATE_HZ + len(stop) + round(gap_s * RATE_HZ), other)):
        stream[at : at + len(word)] += word
    return stream


def heard(listener: Listener, stream: np.ndarray) -> list[Event]:
    return [event for event in listener.listen(ArraySource(stream, RATE_HZ)) if event.event != "level"]


def kinds(events: list[Event]) -> list[tuple[str, str]]:
    return [(event.event, event.fields.get("final", "")) for event in events[1:-1]]


def test_stop_halts_the_robot_before_the_end_of_the_word_is_certain(words: Any) -> None:
    times = {}
    for pause_ms in (0, 150):
        with open_robot("kinematic") as robot:
            endpointer = None if pause_ms else EndpointerOptions()
            session = Session(
                words,
                robot=robot,
                options=SessionOptions(confirm_below=0),
                motions={"tall": TURN},
                endpointer=endpointer,
            )
            events = list(session.run(ArraySource(speech(SAID, 6.0), RATE_HZ)))
            assert robot.stopped
        (stop,) = [event for event in events if event.event == "stop"]
        (halt,) = [event for event in events if event.event == "halt"]
        (end,) = [event for event in events if event.event == "speech_end" and event.fields["last_s"] > 3.5]
        assert [e.fields["final"] for e in events if e.event == "decision"] == ["tall", "stop"]
        assert stop.time <= halt.time < stop.time + 0.05 and "whole" not in end.fields
        times[pause_ms] = stop.time, end.time
    assert times[0][0] == times[0][1] == times[150][1]  # what ends a word is the same
    assert STOP_ENDS_S < times[150][0] < STOP_ENDS_S + 0.2 < times[0][0]


def test_a_word_that_was_stop_too_early_is_logged_and_the_robot_stays_stopped(words: Any) -> None:
    with open_robot("kinematic") as robot:
        session = Session(words, robot=robot, options=SessionOptions(confirm_below=0), motions={"tall": TURN})
        events = list(session.run(ArraySource(stop_and_more(0.22), RATE_HZ)))
        assert robot.stopped
    decided = [event.fields["final"] for event in events if event.event == "decision"]
    assert decided == ["stop"] and len([event for event in events if event.event == "stop"]) == 1
    (ignored,) = [event for event in events if event.event == "ignored"]
    (end,) = [event for event in events if event.event == "speech_end"]
    assert (ignored.mode, ignored.time) == ("session", end.time)
    assert ignored.fields["label"] == end.fields["whole"] != "stop"
    assert ignored.fields["reason"] == "STOP was decided on before it ended"


def test_only_a_sure_urgent_word_counts_at_a_pause(words: Any) -> None:
    stream = speech(SAID, 6.0)
    plain = kinds(heard(Listener(words, PAUSE), stream))
    assert plain == [
        (kind, label)
        for word in ("tall", "stop")
        for kind, label in (("speech_start", ""), ("speech_end", ""), ("decision", word))
    ]
    assert kinds(heard(Listener(words, PAUSE, urgent=("stop",), sure=lambda _: False), stream)) == plain
    assert kinds(heard(Listener(words, urgent=("stop",)), stream)) == plain
    asked: list[Decision] = []
    early = heard(Listener(words, PAUSE, urgent=("stop",), sure=lambda d: not asked.append(d)), stream)
    assert kinds(early) == [*plain[:4], ("decision", "stop"), ("speech_end", "")]
    assert [decision.label for decision in asked] == ["stop"]  # once for a pause
    unsure = Attention(min_score=1e9)
    assert kinds(heard(Listener(words, PAUSE, urgent=("stop",), attention=unsure), stream))[-1] == ("decision", "")
    asleep = Attention(wake="flat", always=("tall",))
    assert kinds(heard(Listener(words, PAUSE, urgent=("stop",), attention=asleep), stream))[-1] == ("ignored", "")


@pytest.mark.parametrize(
    ("options", "early"),
    [
        (SessionOptions(), True),
        (SessionOptions(fusion=FusionOptions(stop_threshold=0.9)), False),
        (SessionOptions(stop_at_rest=0.9), False),
    ],
)
def test_an_early_stop_is_as_sure_as_the_session_asks(
    words: Any, monkeypatch: pytest.MonkeyPatch, options: SessionOptions, early: bool
) -> None:
    recognise = hri.WordRecognizer.recognise
    monkeypatch.setattr(
        hri.WordRecognizer, "recognise", lambda *heard: replace(recognise(*heard), confidence=0.8, class_threshold=0.6)
    )
    events = list(Session(words, options=options).run(ArraySource(speech([("stop", 1.5)], 4.0), RATE_HZ)))
    order = [event.event for event in events if event.event in ("decision", "speech_end")]
    assert order == (["decision", "speech_end"] if early else ["speech_end", "decision"])


@pytest.mark.parametrize("more", [False, True])
@pytest.mark.parametrize("pauses", [True, False])
def test_a_replay_stops_when_the_session_did(words: Any, tmp_path: Path, more: bool, pauses: bool) -> None:
    pytest.importorskip("mcap.writer")
    pytest.importorskip("mcap_ros2")
    path = tmp_path / "early.mcap"
    stream = stop_and_more(0.22) if more else speech(SAID, 6.0)
    endpointer = None if pauses else endpointer_of(words)
    with open_robot("kinematic") as robot:
        session = Session(
            words, robot=robot, options=SessionOptions(confirm_below=0), motions={"tall": TURN}, endpointer=endpointer
        )
        found = [e.to_dict() for e in session.run(ArraySource(stream, RATE_HZ), recorder=McapRecorder(path))]
    recording = read_recording(path)
    if not pauses:  # as it was recorded before there were pauses
        recording = replace(recording, endpointer=None)
    again = [e.to_dict() for e in replay(recording, words)]
    assert decisions(again) == decisions(json.loads(json.dumps(found)))
    assert ("ignored" in {e["event"] for e in again}) is (more and pauses)
