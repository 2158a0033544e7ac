# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A real NAO behind the page, by services on the loopback: its ears, its eyes, its voice; it goes, and comes back.

And the sessions of a page as recordings.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("serving")
pytest.importorskip("qi")
pytest.importorskip("mcap_ros2")

import hri as package
from conftest import until
from hri.cli.serve import _numbered
from hri.robot import NaoqiRobot, Robot, Trajectory
from hri.serve import PageServer, Stage
from hri.session import McapRecorder, NaoMicrophone, Voice, decisions, read_recording, replay
from nao_services import Nao
from page_people import connected, enter
from serving import LIMITS
from session_people import MOTIONS, speech

pytest_plugins = ("serving",)
LONG = Trajectory(["HeadYaw"], 10.0, [[0.0], [0.5], [0.0]])


@pytest.fixture
def nao() -> Iterator[Nao]:
    made = Nao()
    yield made
    made.close()


def said(samples: np.ndarray) -> np.ndarray:
    return (32767 * samples).astype("<i2")


@pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning")  # of the service that is cut off
def test_a_nao_hears_speaks_and_moves_behind_the_page_until_it_is_switched_off(
    serving: Callable[..., tuple[PageServer, str]], words: Any, nao: Nao, notes: pytest.LogCaptureFixture
) -> None:
    nao.audio.samples = said(speech([("flat", 1.0)], 4.0))
    url = nao.url
    with NaoqiRobot(url, timeout_s=20.0) as robot:
        voice = Voice(robot.say_cleaned)
        server, cookie = serving(
            words, None, robot, motions={"flat": LONG}, limits=LIMITS, voice=voice,
            hear=lambda: NaoMicrophone(url, stall_s=5.0),
        )  # fmt: skip
        with connected(server, cookie) as page:
            page.await_event("motion_start", label="flat")
            # The voice has a thread of its own, which may be later than the motion.
            until(lambda: nao.voice.said and any("HeadYaw" in asked for _, asked in list(nao.motion.sent)))
            nao.close()  # in mid-motion
            ended = page.await_event("motion_end", fault=True)
            assert "does not obey" in ended["message"] and url in ended["message"]
            page.await_event("stop", reason=ended["message"])
            assert robot.stopped
            stall = page.await_event("stall", mode="speech")
            page.say(type="resume")
            page.await_event("resumed")
        voice.close()
    assert [text for text, _ in nao.voice.said] == ["flat."]
    assert f"robot: {ended['message']}" in notes.text and f"speech: {stall['message']}" in notes.text


def test_a_nao_that_cannot_be_reached_is_told(hri: Any, words: Any, nao: Nao, tmp_path: Path) -> None:
    words.save(tmp_path / "words.hri")
    url = nao.url
    nao.close()
    serve = ("serve", "--no-gesture", "--speech-model", tmp_path / "words.hri", "--robot", "nao")
    failed = hri(*serve, "--url", url, "--microphone", "nao")
    assert (failed.code, failed.out) == (3, "") and "no NAO can be reached" in failed.err
    for wrong, message in (
        (("--microphone", "nao"), "name its --url"),
        (("--url", url, "--stand"), "--url is of a real one"),
        (("--url", url, "--camera", "nao"), "leave out --microphone and --camera"),
    ):
        refused = hri(*serve, *wrong)
        assert refused.code == 2 and message in refused.err
    refused = hri("serve", "--url", url)
    assert refused.code == 2 and "add --robot nao" in refused.err


def test_each_session_of_a_page_is_a_recording(
    words: Any, robot: Robot, tmp_path: Path, notes: pytest.LogCaptureFixture
) -> None:
    paths = _numbered(str(tmp_path / "class.mcap"))
    (tmp_path / "class-2.mcap").write_bytes(b"kept before")
    stage = Stage(words, None, robot, motions=MOTIONS, limits=LIMITS, record=lambda: McapRecorder(next(paths)))
    try:
        with PageServer(stage) as server, connected(server, enter(server)) as page:
            page.command("motion_start", speech([("flat", 0.8)], 3.2), label="flat")
            page.await_event("motion_end", completed=True)
            stage.renew()
            page.await_message(lambda m: m["type"] == "welcome")
            page.command("fused", speech([("tall", 0.8)], 3.2), final="tall")
    finally:
        stage.close()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["class-2.mcap", "class-3.mcap", "class.mcap"]
    assert (tmp_path / "class-2.mcap").read_bytes() == b"kept before"
    for name, label in (("class", "flat"), ("class-3", "tall")):
        recording = read_recording(tmp_path / f"{name}.mcap")
        kept = decisions(recording.events())
        assert {event["final"] for event in kept if event["event"] == "fused"} == {label}
        assert decisions(event.to_dict() for event in replay(recording, words)) == kept


def test_a_recording_that_fails_is_told(
    serving: Callable[..., tuple[PageServer, str]],
    words: package.WordRecognizer,
    tmp_path: Path,
    notes: pytest.LogCaptureFixture,
) -> None:
    def record() -> McapRecorder:
        return McapRecorder(tmp_path / "missing" / "class.mcap")

    server, cookie = serving(words, None, None, limits=LIMITS, record=record)
    with connected(server, cookie) as page:
        note = page.await_message(lambda m: m["type"] == "note" and "not recorded" in m["text"])
        assert "missing" in note["text"]
        page.await_message(lambda m: m["type"] == "note" and "Press Resume" in m["text"])
    assert note["text"] in notes.text
