# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Figure 5.1 of the thesis over the wire: the simulated NAO sees a signer, says the sentence, answers by gestures."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

pytest.importorskip("qi")
pytest.importorskip("pybullet")
pytest.importorskip("cv2")

import hri
from drawn_hands import FPS
from hri.language import KnowledgeBase, StoredSentence
from hri.robot import NAO, NaoqiRobot, Trajectory
from hri.session import NaoCamera, Session, SessionOptions
from hri.synthetic.signer import CLIP_FPS, draw_clip, draw_still, make_signer
from hri.vision import find_cascade
from nao_services import Nao
from nao_simulated import SimulatedNao
from session_people import signing, train_signs
from test_nao_robot import in_mid_motion

BEGIN, END, STOP = "5", "0", "9"
SIGNS = (BEGIN, END, STOP, "1", "2", "3")
KNOWLEDGE = KnowledgeBase(
    [
        StoredSentence(("1", "2"), {"en": "One and two."}, ("namaste", "2")),
        StoredSentence(("3", "3", "1"), {"en": "Three, three and one."}),
    ],
    max_distance=0.3,
)


@pytest.fixture
def nao() -> Iterator[SimulatedNao]:
    made = SimulatedNao()
    yield made
    made.close()


def test_the_simulated_nao_moves_within_its_limits_and_sees_its_screen(nao: SimulatedNao) -> None:
    nao.video.frames = [np.full((60, 80, 3), (10 * i, 0, 250), dtype=np.uint8) for i in range(4)]
    source = NaoCamera(nao.url, stall_s=20.0)
    frames = [source.read()[0] for _ in range(3)]  # type: ignore[index]
    source.close()
    for number, frame in enumerate(frames, start=1):
        assert tuple(frame[240, 320]) == (10 * number, 0, 250), "the middle of the screen"
        shown = np.abs(frame.astype(int) - (10 * number, 0, 250)).max(axis=2) < 3
        assert 0.5 < shown.mean() < 0.9
    with NaoqiRobot(nao.url, timeout_s=20.0) as robot:
        assert robot.perform(Trajectory(["HeadYaw", "RElbowRoll"], 0.5, [[0.0, 0.4], [0.4, 0.9], [0.4, 0.9]]))
        for _ in range(10):
            there = robot.joint_positions_rad()
    assert (there["HeadYaw"], there["RElbowRoll"]) == pytest.approx((0.4, 0.9), abs=0.03), "joints with weight"
    assert nao.motion.clamped == [] and nao.robot.events == []


def signer_shows(*labels: str) -> list[np.ndarray]:
    """A drawn person, of those not trained on, who shows one sign after the other."""
    person = make_signer(50, seed=7)
    return [frame for label in labels for frame in draw_clip(person, label, size_px=(420, 315))]


@pytest.fixture(scope="module")
def drawn_signs() -> hri.GestureRecognizer:
    """Trained on close-ups of twelve drawn people."""
    rows = [(draw_still(make_signer(number, seed=7), label), label, number) for number in range(12) for label in SIGNS]
    stills, labels, people = zip(*rows, strict=True)
    return hri.GestureRecognizer(use_faces=True).fit([[still] for still in stills], list(labels), groups=list(people))


@pytest.mark.slow
@pytest.mark.skipif(find_cascade() is None, reason="no cascade of faces is installed")
def test_nao_sees_a_sentence_says_it_and_answers_by_gestures(nao: SimulatedNao, drawn_signs: Any) -> None:
    nao.video.frames = signer_shows("3", BEGIN, "1", "2", END)
    options = SessionOptions(sentence_begin_labels=(BEGIN,), sentence_end_labels=(END,), confirm_below=0.0)
    with NaoqiRobot(nao.url, timeout_s=20.0) as robot:
        session = Session(
            signs=drawn_signs, robot=robot, options=options, on_say=robot.say_later, knowledge=KNOWLEDGE,
            motions={label: hri.robot.nao_gesture_trajectory(label) for label in ("namaste", "2")},
        )  # fmt: skip
        source = NaoCamera(nao.url, fps=round(CLIP_FPS), stall_s=5.0)
        events = list(session.run(pictures=source))
        robot.say("the end")  # after what was to be said before
    fused = [event for event in events if event.event == "fused"]
    begun_s = next(event.time for event in events if event.fields.get("state") == "sentence")
    (sentence,) = [event.fields for event in events if event.event == "sentence"]
    assert sentence == {"words": ["1", "2"], "nearest": ["1", "2"], "distance": 0.0}
    assert [text for text, _ in nao.voice.said][-2:] == ["One and two.", "the end"]
    assert all(event.fields["gesture"]["label"] in ("3", "unknown") for event in fused if event.time < begun_s)
    moved = [(e.fields["label"], e.fields["completed"]) for e in events if e.event == "motion_end"]
    assert moved == [("namaste", True), ("2", True)] and robot.events == []
    assert nao.motion.clamped == [] and nao.robot.self_contacts == []
    for asked_name in NAO.names:
        asked = np.array([angles[asked_name] for _, angles in nao.motion.sent if asked_name in angles])
        assert len(asked) < 2 or np.abs(np.diff(asked)).max() / robot.step_s <= NAO.max_speed_rad_s


def test_a_nao_switched_off_in_mid_motion_leaves_the_session_alive_until_it_is_back() -> None:
    frames = [frame[20:140] for frame in signing([("flat", 0.4)], 3.0, hold_s=1.2)]
    first = Nao()
    first.video.frames, first.video.paced = frames, True
    url = first.url
    sway = Trajectory(["HeadYaw"], 3.0, [[0.0], [0.4], [0.0]])
    stall, texts, moved, later = [], [], [], None
    with NaoqiRobot(url, timeout_s=20.0) as robot:
        session = Session(signs=train_signs(), robot=robot, motions={"flat": sway}, on_say=robot.say_later)
        assert "flat" in session.motions
        thread = in_mid_motion(first, first.close)
        for event in session.run(pictures=lambda: NaoCamera(url, size=(160, 120), fps=round(FPS)), live=True):
            stall += [event.fields["message"]] if event.event == "stall" else []
            texts += [event.fields["text"]] if event.event == "say" else []
            moved += [event.fields] if event.event == "motion_end" else []
            if (event.event, event.fields.get("state")) == ("state", "stopped"):
                thread.join()
                assert robot.stopped and len(first.motion.sent) < 300
                later = Nao(url=url)
                later.video.frames, later.video.paced = frames, True
                session.resume()
            assert event.time < 150.0
            if len(moved) == 2:
                break
        assert not robot.stopped
    assert later is not None
    later.close()
    assert [one["completed"] for one in moved] == [False, True] and moved[0]["fault"]
    assert any("does not obey" in text and url in text for text in texts) and "Ready." in texts
    assert any("NAO at" in message for message in stall), "the camera went with it"
    begun = [asked["HeadYaw"] for _, asked in later.motion.sent]
    assert abs(begun[0]) < 0.01 and max(begun) > 0.35 and later.motion.clamped == []
