# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The page's server: who is let in, what a page is sent, and that what a page sends cannot harm the session."""

from __future__ import annotations

import contextlib
import http.client
import json
import signal
import socket as sockets
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

pytest.importorskip("serving")

from websockets.exceptions import ConnectionClosed, InvalidStatus

from conftest import WAIT_S, until
from drawn_hands import HIDDEN, picture
from hri.core.errors import InvalidArgument, IoError
from hri.robot import HOAP2, Robot
from hri.serve import PageServer, ServeLimits, Stage
from hri.serve.connection import BAD_RATE, LATE, NO_PAGE
from hri.serve.limits import RateLimit
from page_people import (
    PICTURE,
    RATE_HZ,
    SOUND,
    connected,
    enter,
    framed,
    jpeg,
    open_socket,
    request,
    sound_messages,
)
from serving import LIMITS, Serving, own_origin, stop_by_button, stop_by_request
from session_people import MOTIONS, signing, speech

pytest_plugins = ("serving",)


@pytest.fixture
def stage(words: Any, signs: Any, robot: Robot) -> Iterator[Stage]:
    made = Stage(words, signs, robot, motions=MOTIONS, limits=LIMITS)
    yield made
    made.close()


def test_the_address_lets_in_one_visitor(server: PageServer, notes: pytest.LogCaptureFixture) -> None:
    assert server.address.startswith("http://127.0.0.1:")
    path = server.address.partition(str(server.port))[2]
    assert request(server, "/")[0] == 403 and request(server, "/page.js")[0] == 403
    assert request(server, "/?token=guessed")[0] == 403
    key = enter(server)
    status, _, body = request(server, path)
    assert status == 403 and b"has been used" in body
    assert request(server, path, key)[0] == 303  # the same visitor may go there again
    status, headers, body = request(server, "/", key)
    assert status == 200 and b'id="stop"' in body and "default-src 'self'" in headers["content-security-policy"]
    assert request(server, "/page.js", key)[1]["content-type"].startswith("text/javascript")
    assert request(server, "/nothing.js", key)[0] == 404
    assert request(server, "/..%2f__init__.py", key)[0] == 404
    assert "a visitor was refused" in notes.text


def test_other_sites_and_names_are_refused(server: PageServer, cookie: str, stage: Stage, robot: Robot) -> None:
    for key, origin in (("", None), ("hri=1", None), (cookie, "http://evil.example"), (cookie, "null")):
        with pytest.raises(InvalidStatus) as refused, open_socket(server, key, origin):
            pass
        assert refused.value.response.status_code == 403
    assert request(server, "/", cookie, Host="evil.example")[0] == 400  # a name that leads here
    assert request(server, "/stop", cookie, "POST", Origin="http://evil.example")[0] == 403 and not robot.stopped
    assert request(server, "/stop", "", "POST", Origin=own_origin(server))[0] == 403


def test_a_word_moves_the_robot_and_the_page_sees_why(server: PageServer, cookie: str) -> None:
    with connected(server, cookie) as page:
        assert page.messages[0]["words"] == ["flat", "stop", "tall"] and page.messages[0]["robot"] == "HOAP-2"
        decision = page.command("decision", speech([("tall", 0.8)], 3.2), mode="speech", final="tall")
        assert abs(sum(n["probability"] for n in decision["nbest"]) - 1) < 1e-6
        assert page.await_event("fused")["rule"]
        page.await_event("motion_start", label="tall")
        page.await_message(lambda m: m["type"] == "robot" and abs(m["joints"]["head_joint_1"]) > 3)
        kinds = {m.get("event") for m in page.messages}
        assert {"level", "state"} <= kinds


def test_a_sign_is_shown_with_the_time_of_its_picture(server: PageServer, cookie: str) -> None:
    with connected(server, cookie) as page:
        decision = page.command("decision", frames=signing([("tall", 0.6)], 3.4), mode="gesture", final="tall")
        assert 1500 < decision["sent_ms"] < 3400
        hands = [m for m in page.messages if m.get("event") == "hand" and m["x"] is not None]
        assert hands and abs(hands[len(hands) // 2]["x"] - 0.5) < 0.15


def test_a_page_is_sent_what_the_camera_does_not_see(server: PageServer, cookie: str) -> None:
    with connected(server, cookie) as page:
        page.command("hand", frames=signing([("tall", 5.4)], 7.6), missing="hand", x=None)
        page.await_event("hand", missing="")
        page.command("decision", frames=signing([("tall", 0.6)], 3.4), mode="gesture", final="tall")


@pytest.mark.parametrize("press", [stop_by_button, stop_by_request])
def test_stop_stops_in_mid_motion_and_resume_goes_on(server: PageServer, cookie: str, robot: Robot, press: Any) -> None:
    with connected(server, cookie) as page:
        page.command("motion_start", speech([("tall", 0.8)], 3.0), label="tall")
        press(server, cookie, page)
        page.await_event("state", state="stopped")
        ended = [m for m in page.messages if m.get("event") == "motion_end"]  # it may come before the state
        assert not (ended or [page.await_event("motion_end")])[0]["completed"] and robot.stopped
        page.say(type="resume")
        page.await_event("resumed")
        page.await_event("state", state="idle")
        assert not robot.stopped


def test_a_page_that_goes_stops_the_robot_and_comes_back(
    server: PageServer, cookie: str, stage: Stage, robot: Robot
) -> None:
    with connected(server, cookie) as page:
        page.command("motion_start", speech([("tall", 0.8)], 3.0), label="tall")
    until(lambda: robot.stopped)  # no page could show it, or press STOP
    until(lambda: stage.welcome()["state"] == "stopped" and "in mid-motion" in json.dumps(stage.welcome()["log"]))
    with connected(server, cookie, "b") as page:
        assert page.messages[0]["state"] == "stopped"
        assert "in mid-motion" in json.dumps(page.messages[0]["log"])
        page.say(type="resume")
        page.await_event("state", state="idle")
    with connected(server, cookie, "c") as page:  # at rest: it goes on by itself
        page.command("motion_start", speech([("flat", 0.8)], 3.2), label="flat")


@pytest.mark.parametrize("spoken", [True, False])
def test_stop_outlives_a_page_that_goes_at_once(server: PageServer, cookie: str, robot: Robot, spoken: bool) -> None:
    with connected(server, cookie) as page:
        if spoken:
            page.command("stop", speech([("stop", 0.8)], 2.6))
        else:
            page.say(type="stop")
    with connected(server, cookie, "b") as page:
        with pytest.raises(TimeoutError):
            page.await_event("resumed", timeout_s=0.7)
        assert robot.stopped
        page.say(type="resume")
        page.await_event("resumed")


def test_a_second_page_is_refused_and_the_same_page_takes_over(
    server: PageServer, cookie: str, notes: pytest.LogCaptureFixture
) -> None:
    with connected(server, cookie) as page:
        with open_socket(server, cookie) as other:
            other.send(json.dumps({"type": "hello", "page": "another"}))
            with pytest.raises(ConnectionClosed) as closed:
                other.recv(timeout=WAIT_S)
            assert closed.value.rcvd is not None and closed.value.rcvd.code == 4409
            assert "Another page uses the robot" in closed.value.rcvd.reason
        page.say(type="stop")
        page.await_event("state", state="stopped")
        with connected(server, cookie) as again:  # its line broke, and the server has not seen it yet
            again.say(type="resume")
            again.await_event("resumed")
            with pytest.raises(ConnectionClosed):
                page.await_message(lambda m: False)
            assert page.socket.close_code == 4409
    assert "a second page was refused" in notes.text


def test_nonsense_is_reported_and_ignored(server: PageServer, cookie: str, notes: pytest.LogCaptureFixture) -> None:
    picture_bytes = jpeg(picture("flat", 0.5, np.random.default_rng(1)))
    big = jpeg(np.zeros((2000, 2000, 3), np.uint8))
    nan = float("nan")
    with connected(server, cookie) as page:
        for message, error in (
            ("hello, robot", "not a JSON file"),
            ('{"type": "explode"}', "no command"),
            ("[" * 3000, "too deep"),
            ('{"type": "hello", "rate": 1e9}', "samples a second"),
            ('{"type": "teach", "label": "", "mode": "speech"}', "letters"),
            ('{"type": "teach", "label": "up", "mode": "smell"}', "a word (speech) or a gesture"),
            ('{"type": "' + 5000 * "x" + '"}', "too long"),
            (b"", "without sound or a picture"),
            (b"text in a binary socket", "neither sound nor a picture"),
            (framed(SOUND, b"\0\0", nan), "time is no number"),
            (framed(SOUND, b"odd"), "16-bit"),
            (framed(SOUND, bytes(200_000)), "longer than a second"),
            (framed(PICTURE, b"GIF89a"), "no JPEG"),
            (framed(PICTURE, picture_bytes[:300]), "damaged"),
            (framed(PICTURE, bytes(600_000)), "585 KB"),
            (framed(PICTURE, big), "2000 x 2000"),
        ):
            page.socket.send(message)
            page.error(error)
            assert error in notes.text
        page.command("decision", speech([("flat", 0.8)], 3.2), final="flat")  # the session has taken no harm


def test_pictures_of_changing_size_leave_the_session_alive(
    server: PageServer, cookie: str, notes: pytest.LogCaptureFixture
) -> None:
    rng = np.random.default_rng(4)
    with connected(server, cookie) as page:
        for side in (160, 120, 64, 33, 160, 1, 160):
            frame = np.ascontiguousarray(picture("flat", HIDDEN, rng)[:side, :side])
            page.socket.send(framed(PICTURE, jpeg(frame)))
            time.sleep(0.02)
        warning = page.await_message(lambda m: m.get("event") == "stall" and "are now" in m["message"])["message"]
        assert warning.startswith("camera: pictures of ") and notes.text.count(f"gesture: {warning}") == 1
        said, shown = speech([("flat", 0.8)], 3.4), signing([("flat", 0.6)], 3.4)
        page.command("fused", said, shown, final="flat", carried_by="both")


def test_an_oversized_message_ends_the_connection_alone(
    server: PageServer, cookie: str, notes: pytest.LogCaptureFixture
) -> None:
    with connected(server, cookie) as page:
        page.socket.send(bytes(LIMITS.max_message_bytes + 1))
        with pytest.raises(ConnectionClosed) as closed:
            page.await_message(lambda m: False)
        # The rest of the message, which is not read any more, may reset the connection before the reason is there.
        assert closed.value.rcvd is None or closed.value.rcvd.code == 1009
    until(lambda: "too large" in notes.text)
    with connected(server, cookie) as page:
        page.command("motion_start", speech([("flat", 0.8)], 3.2), label="flat")


def test_ten_thousand_messages_a_second_are_sent_away(
    server: PageServer, cookie: str, stage: Stage, robot: Robot, notes: pytest.LogCaptureFixture
) -> None:
    message = next(sound_messages(np.zeros(640, np.float32)))
    with connected(server, cookie) as page:
        with contextlib.suppress(ConnectionClosed):
            for _ in range(20_000):
                page.socket.send(message)
        with pytest.raises(ConnectionClosed):
            page.await_message(lambda m: False)
    assert page.socket.close_code == 1008 and "too many messages" in str(page.socket.close_reason)
    assert "too many messages" in notes.text
    until(lambda: robot.stopped)  # without a page nothing moves
    with connected(server, cookie) as page:
        page.command("motion_start", speech([("flat", 0.8)], 3.2), label="flat")


def test_pictures_above_their_rate_are_left_out(
    server: PageServer, cookie: str, stage: Stage, notes: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    taken: list[float] = []
    monkeypatch.setattr(stage.camera, "put", lambda picture: taken.append(picture.sent_ms))
    message = framed(PICTURE, jpeg(picture("flat", HIDDEN, np.random.default_rng(4))))
    warning = "more than 30 pictures a second: some were left out"
    with connected(server, cookie) as page:
        begun_s = time.monotonic()
        for _ in range(90):
            page.socket.send(message)
        page.error(warning)
        page.say(type="nonsense")  # answered after what came before it
        page.error("no command")
        assert 30 <= len(taken) <= 30 + 30 * (time.monotonic() - begun_s) and len(taken) < 90
        monkeypatch.undo()
        page.command("decision", frames=signing([("tall", 0.6)], 3.4), mode="gesture", final="tall")
    assert warning in notes.text


def test_more_sound_than_a_microphone_gives_is_left_out(
    server: PageServer, cookie: str, stage: Stage, notes: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    taken: list[int] = []
    monkeypatch.setattr(stage.microphone, "put", lambda samples: taken.append(len(samples)))
    warning = "more sound than a microphone gives was ignored"
    with connected(server, cookie) as page:
        begun_s = time.monotonic()
        for _ in range(12):
            page.socket.send(framed(SOUND, bytes(2 * RATE_HZ)))  # a second
        page.error(warning)
        page.say(type="nonsense")
        page.error("no command")
        most_s = 4 + 2 * (time.monotonic() - begun_s)
        assert 4 * RATE_HZ <= sum(taken) <= most_s * RATE_HZ and sum(taken) < 12 * RATE_HZ
        monkeypatch.undo()
        page.command("decision", speech([("flat", 0.8)], 3.2), final="flat")
    assert warning in notes.text


def test_who_does_not_begin_as_the_page_does_is_sent_away(serving: Serving, words: Any) -> None:
    server, cookie = serving(words, limits=replace(LIMITS, hello_s=1.0))
    for first, code in (
        ("nonsense", NO_PAGE),
        ('{"type": "resume"}', NO_PAGE),
        (b"\x01", NO_PAGE),
        ('{"type": "hello", "rate": 96000}', BAD_RATE),
        (None, LATE),
    ):
        with open_socket(server, cookie) as other:
            if first is not None:
                other.send(first)
            with pytest.raises(ConnectionClosed) as closed:
                other.recv(timeout=WAIT_S)
            assert closed.value.rcvd is not None and closed.value.rcvd.code == code, first


def test_a_microphone_that_falls_silent_is_reported_and_comes_back(
    server: PageServer, cookie: str, notes: pytest.LogCaptureFixture
) -> None:
    with connected(server, cookie) as page:
        page.perform(speech([], 0.4))
        page.await_event("stall", mode="speech", message="microphone: no sound for 2 s")
        page.command("reconnected", speech([("flat", 1.6)], 4.0), mode="speech")
        page.command("decision", speech([("flat", 0.8)], 3.2), final="flat")
    assert notes.text.count("speech: microphone: no sound for 2 s") == 1


def test_a_fault_of_the_robot_is_told_on_page_and_terminal(
    server: PageServer, cookie: str, robot: Robot, notes: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    def gone(*_: object) -> bool:
        raise IoError("it is switched off")

    monkeypatch.setattr(robot, "perform", gone)
    with connected(server, cookie) as page:
        message = page.command("motion_end", speech([("flat", 0.8)], 3.2), fault=True)["message"]
        assert message == "The robot does not obey: it is switched off"
        assert page.await_event("stop")["reason"] == message
    assert notes.text.count(f"robot: {message}") == 1


def test_another_rate_of_sound_is_converted(server: PageServer, cookie: str) -> None:
    samples = np.repeat(speech([("flat", 0.8)], 3.2), 3)  # 48 kHz
    with connected(server, cookie, rate=3 * RATE_HZ) as page:
        for timeout_s in (10.0, 10.0, WAIT_S):
            for message in sound_messages(samples):
                page.socket.send(message)
                time.sleep(0.0133)
            with contextlib.suppress(TimeoutError):  # on a loaded machine a word may be lost
                page.await_event("decision", final="flat", timeout_s=timeout_s)
                return
    pytest.fail("no decision came")


def test_a_port_in_use_is_named(stage: Stage) -> None:
    with sockets.create_server(("127.0.0.1", 0)) as taken, pytest.raises(IoError, match="--port"):
        PageServer(stage, taken.getsockname()[1])


def test_limits_are_checked() -> None:
    with pytest.raises(InvalidArgument, match="stall_s"):
        ServeLimits(stall_s=0)
    now = [0.0]
    limit = RateLimit(10.0, burst_s=2.0, clock=lambda: now[0])
    assert sum(limit.take() for _ in range(50)) == 20
    now[0] += 1.0
    assert sum(limit.take() for _ in range(50)) == 10


def test_the_command_line_reports_what_is_missing(hri, words: Any, tmp_path: Any) -> None:
    model = tmp_path / "words.hri"
    words.save(model)
    (tmp_path / "no.hri").write_bytes(b"no model")
    with sockets.create_server(("127.0.0.1", 0)) as taken:
        for arguments, code, message in (
            (("--no-speech", "--no-gesture"), 2, "leave nothing"),
            (("--no-gesture",), 3, "there is no speech model yet"),
            (("--no-gesture", "--speech-model", tmp_path / "no.hri"), 3, "no.hri"),
            (("--no-gesture", "--speech-model", tmp_path / "gone.hri"), 2, "gone.hri"),
            (("--no-speech", "--gesture-model", model), 3, "words.hri is a"),
            (("--no-gesture", "--speech-model", model, "--wake", "robot"), 3, "'robot' is in no vocabulary"),
            (("--no-gesture", "--speech-model", model, "--port", taken.getsockname()[1]), 3, "--port"),
        ):
            result = hri("serve", "--backend", "none", *arguments)
            assert result.code == code and message in result.err, (arguments, result.err)


def test_ctrl_c_ends_the_command_and_the_robot_rests(words: Any, tmp_path: Any) -> None:
    model = tmp_path / "words.hri"
    words.save(model)
    arguments = ("--no-gesture", "--speech-model", str(model), "--backend", "kinematic", "--port", "0")
    process = subprocess.Popen(
        [sys.executable, "-m", "hri", "serve", *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    try:
        assert process.stdout is not None
        address = process.stdout.readline().split()[-1]
        port = int(address.partition("127.0.0.1:")[2].partition("/")[0])
        link = http.client.HTTPConnection("127.0.0.1", port, timeout=WAIT_S)
        link.request("GET", address.partition(str(port))[2])
        assert link.getresponse().status == 303
        link.close()
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=WAIT_S)
        assert process.returncode == 130 and "Traceback" not in errors and "lets in one visitor" in errors
    finally:
        process.kill()


def test_the_figure_is_the_robot_from_the_front() -> None:
    from hri.page import figure

    rest = figure(HOAP2.rest_rad, HOAP2)
    xs = [x for stroke in rest["strokes"] for x in (stroke[0], stroke[2])]
    ys = [y for stroke in rest["strokes"] for y in (stroke[1], stroke[3])]
    assert abs(min(xs) + max(xs)) < 0.02 and min(ys) > -0.01 and 0.4 < max(ys) < rest["height"] < 0.8
    raised = figure({**HOAP2.rest_rad, "larm_joint_1": -np.pi / 2}, HOAP2)
    assert rest["height"] == raised["height"] and raised["joints"]["larm_joint_1"] == -90.0
    assert rest["strokes"] != raised["strokes"]
    assert len(json.dumps(rest)) < 10_000
