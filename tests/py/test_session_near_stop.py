# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A spoken STOP that is rejected by little: it halts a robot that moves, and is replayed as it was heeded."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import hri
from conftest import RATE_HZ
from hri.live import ArraySource, Event, Listener
from hri.recognition import Decision, NBest
from hri.robot import open_robot
from hri.session import McapRecorder, Session, SessionOptions, decisions, read_recording, replay
from hri.session.feeds import Arrival
from hri.session.logic import NoRobot, SessionLogic
from hri.session.mover import Cause
from session_people import TURN, speech, train_words

pytest.importorskip("cv2")
pytest.importorskip("mcap.writer")
pytest.importorskip("mcap_ros2")


@pytest.fixture(scope="module")
def words() -> hri.WordRecognizer:
    return train_words()


@pytest.mark.parametrize("speaks", [False, True])
@pytest.mark.parametrize(
    ("moving", "near", "stops"), [(True, "stop", True), (True, "tall", False), (False, "stop", False)]
)
def test_a_stop_that_was_rejected_by_little_halts_what_moves(
    moving: bool, near: str, stops: bool, speaks: bool
) -> None:
    logic = SessionLogic(SessionOptions(), NoRobot(reports=False), ("flat", "tall"))

    def heed(kind: str, time_s: float, decision: Decision | None = None, **fields: Any) -> list[str]:
        heeded = logic.process(Arrival(Event(time_s, kind, fields, decision, "speech"), 0.0))
        return [event.event for event in heeded]

    heed("listening", 0.0)
    if speaks:
        logic._own_voice.begin("flat.", 1.0)
    if moving:
        logic._do(logic.dialogue._move("flat"), Cause(0.0, 0.0, 0.0), [])
    heed("level", 1.0)
    rejected = Decision("speech", "unknown", "unknown", 0.9, nbest=(NBest(near, 0.9, 0.0), NBest("flat", 0.1, -2.0)))
    heard = heed("decision", 2.5, rejected, first_s=1.5, last_s=2.0, near=near)
    assert ("stop" in heard) is stops and ("fused" in heard) is (stops or not speaks)


def test_what_is_rejected_without_any_label_is_not_near(words: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    nothing = Decision("speech", "unknown", "unknown", 0.0)
    monkeypatch.setattr(hri.WordRecognizer, "recognise", lambda *_: nothing)
    found = list(Listener(words, urgent=("stop",)).listen(ArraySource(speech([("stop", 0.8)], 2.5), RATE_HZ)))
    assert [e.decision for e in found if e.event == "decision"] == [nothing]


@pytest.mark.parametrize("near", [0.5, -1.0])
def test_a_stop_that_was_rejected_by_little_is_replayed_as_it_was_heeded(
    words: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, near: float
) -> None:
    """Also where it was not: recordings may be older than the rule."""
    recognise = hri.WordRecognizer.recognise

    def barely_rejected(self: hri.WordRecognizer, *heard: Any) -> Decision:
        decision = recognise(self, *heard)
        if decision.label != "stop":
            return decision
        return replace(decision, label="unknown", status="unknown", score=self.threshold - 0.3)

    monkeypatch.setattr(hri.WordRecognizer, "recognise", barely_rejected)
    monkeypatch.setattr("hri.live.listener.NEAR", near)
    path = tmp_path / "near.mcap"
    with open_robot("kinematic") as robot:
        session = Session(words, None, robot, SessionOptions(confirm_below=0.2), motions={"tall": TURN})
        sound = ArraySource(speech([("tall", 1.5), ("stop", 3.5)], 6.0), RATE_HZ)
        found = decisions([e.to_dict() for e in session.run(sound, recorder=McapRecorder(path))])
    assert ("stop" in {e["event"] for e in found}) is (near > 0)
    monkeypatch.setattr("hri.live.listener.NEAR", 0.5)
    assert decisions([e.to_dict() for e in replay(read_recording(path), words)]) == json.loads(json.dumps(found))
