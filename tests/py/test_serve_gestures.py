# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Gestures that are added at the page: by its camera, by files, and what is refused."""

from __future__ import annotations

import contextlib
import json
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("serving")


import hri
from drawn_hands import FPS, SIDE_PX, Frame, picture, stills
from hri.core.errors import FormatError
from hri.fusion import FusionOptions
from hri.media import write_image, write_video
from hri.serve import PageServer, ServeLimits, Stage
from hri.serve.messages import read_command
from hri.session import SessionOptions
from page_people import PICTURE, Page, connected, enter, framed, jpeg, request, sound_messages, text_of
from serving import answer, own_origin
from session_people import signing

pytest_plugins = ("serving",)

LIMITS = ServeLimits(stall_s=2.0, hello_s=1.0, max_clip_bytes=1 << 20, max_clip_pictures=40)
HINDI = "नमस्ते"
CONJUNCT = "क्\u200dष"


@pytest.fixture
def stage(signs: hri.GestureRecognizer) -> Iterator[Stage]:
    made = Stage(None, signs, None, limits=LIMITS)
    yield made
    made.close()


def cross(seed: int) -> Frame:
    """A hand of both bars, held in the middle."""
    flat, tall = (picture(sign, 0.5, np.random.default_rng(seed)) for sign in ("flat", "tall"))
    red = (flat[..., 2] > 165)[..., None]
    return np.where(red, flat, tall)


def upload(server: PageServer, cookie: str, body: bytes, name: str = "clip.jpg") -> tuple[int, str]:
    status, _, text = request(server, f"/sample?name={name}", cookie, "POST", body, Origin=own_origin(server))
    return status, text_of(text)


def teach(page: Page, label: str) -> None:
    page.say(type="teach", label=label, mode="gesture")
    answer(page, "3 times")


def show(page: Page, frames: list[Frame]) -> dict[str, Any]:
    """The answer to a sample; on a loaded machine pictures may be lost, and it is shown again."""
    for _ in range(4):
        page.say(type="sample", mode="gesture")
        asked = answer(page, "Show it now: bring your hand into view")
        assert asked["recording"] and asked["label"] == HINDI
        page.perform(frames=frames)
        shown = page.await_message(lambda m: m["type"] == "teach")
        if "too busy" not in shown["text"]:
            break
    return shown


def test_a_gesture_is_added_by_three_samples_of_the_camera_and_undone(
    server: PageServer, cookie: str, stage: Stage, signs: hri.GestureRecognizer, tmp_path: Path
) -> None:
    with connected(server, cookie) as page:
        teach(page, HINDI)
        for number in range(3):
            shown = show(page, signing([("flat", 0.6)], 3.0))
            if number < 2:
                assert f"Sample {number + 1} of 3. It looks like “flat”" in shown["text"]
        assert shown["progress"] == 0 and "step 1 of 4" in shown["text"]
        assert [answer(page, f"step {step} of 4")["progress"] for step in (2, 3, 4)] == [0.25, 0.5, 0.75]
        done = answer(page, f"“{HINDI}” is added. It may be confused with “flat”")
        assert done["added"] == [HINDI] and done["confused"][0]["label"] == "flat"
        assert done["confused"][0]["samples"] >= 3 and not done["recording"]
        assert HINDI in [m for m in page.messages if m["type"] == "welcome"][-1]["signs"]
        happened = {m.get("event") for m in page.messages}
        assert "ignored" in happened and "motion_end" not in happened  # what is recorded is no command
        assert any(m.get("event") == "hand" and m["x"] is not None for m in page.messages)
        (tmp_path / "signs.hri").write_bytes(request(server, "/signs.hri", cookie)[2])
        assert HINDI in hri.GestureRecognizer.load(tmp_path / "signs.hri").classes_
        assert request(server, "/signs.hri")[0] == 403 and request(server, "/words.hri", cookie)[0] == 404
        assert b"Span<const std::uint8_t> signs()" in request(server, "/signs.hpp", cookie)[2]
        assert json.loads(request(server, "/signs.json", cookie)[2])["kind"] == "gesture_recognizer"
        page.say(type="undo", mode="gesture")
        assert answer(page, f"“{HINDI}” is removed")["added"] == []
        assert stage.signs is not None
        assert stage.signs.to_model_file().to_bytes() == signs.to_model_file().to_bytes()  # to the bit
        page.say(type="undo", mode="gesture")
        answer(page, "there is nothing to undo")


def test_a_gesture_is_added_by_files_and_recognised(
    server: PageServer, cookie: str, stage: Stage, tmp_path: Path
) -> None:
    write_video(tmp_path / "a.avi", [cross(seed) for seed in range(10)], FPS)
    write_image(tmp_path / "b.png", cross(20))
    with connected(server, cookie) as page:
        teach(page, "cross")
        assert upload(server, cookie, (tmp_path / "a.avi").read_bytes(), "a.avi") == (200, "")
        assert upload(server, cookie, (tmp_path / "b.png").read_bytes(), "b.png") == (200, "")
        assert upload(server, cookie, jpeg(cross(21)), "../c.jpg") == (200, "")
        answer(page, "“cross” is added.")
        status, why = upload(server, cookie, jpeg(cross(22)))
        assert status == 422 and "“cross” has its 3 samples: give the next gesture a name" in why
        assert stage.signs is not None
        assert stage.signs.recognise([cross(30)]).nbest[0].label == "cross"
        for sign in ("flat", "tall"):
            assert stage.signs.recognise(stills(sign, 40)).label == sign


def test_stop_is_seen_while_a_gesture_is_recorded(signs: hri.GestureRecognizer) -> None:
    options = SessionOptions(retry_s=0.2, fusion=FusionOptions(stop_labels=("tall",)))
    stage = Stage(None, signs, None, options, limits=LIMITS)
    with contextlib.closing(stage), PageServer(stage) as server, connected(server, enter(server)) as page:
        teach(page, HINDI)
        page.say(type="sample", mode="gesture")
        answer(page, "Show it now")
        page.perform(frames=signing([("tall", 0.6)], 3.0))
        assert answer(page, "STOP: this sample is not kept")["samples"] == 0
        page.await_stopped()
        page.say(type="resume")
        page.await_event("state", state="idle")
        shown = show(page, signing([("flat", 0.6)], 3.0))
        assert "Sample 1 of 3" in shown["text"]
        page.perform(frames=signing([("tall", 0.3)], 2.5))  # while the hand may go back
        page.await_event("state", state="stopped")
        page.say(type="sample", mode="gesture")
        answer(page, "Show it now")
        page.say(type="stop")  # by button
        assert answer(page, "STOP: this sample is not kept")["samples"] == 1


def test_gestures_that_are_alike_are_named_both_ways(server: PageServer, cookie: str) -> None:
    with connected(server, cookie) as page:
        for label, seeds in (("cross", (1, 2, 3)), ("bend", (4, 5, 6))):
            teach(page, label)
            for seed in seeds:
                assert upload(server, cookie, jpeg(cross(seed))) == (200, "")
            done = answer(page, f"“{label}” is added.")
        assert "may be confused with “cross”" in done["text"]
        assert any("Trying “cross” beside “bend”" in m.get("text", "") for m in page.messages)
        (found,) = (one for one in done["confused"] if one["label"] == "cross")
        assert found["samples"] > 0 and found["samples_of_other"] > 0


def test_what_is_no_gesture_is_refused_in_words(server: PageServer, cookie: str) -> None:
    with connected(server, cookie) as page:
        for command, text in (
            ({"type": "sample", "mode": "gesture"}, "first give the gesture a name"),
            ({"type": "teach", "label": "flat", "mode": "gesture"}, "“flat” is a gesture already"),
            ({"type": "sample", "mode": "gesture"}, "first give the gesture a name"),
            ({"type": "teach", "label": "word", "mode": "speech"}, "there is no recogniser of words"),
            ({"type": "undo", "mode": "gesture"}, "there is nothing to undo"),
        ):
            page.say(**command)
            answer(page, text)
        for _ in range(50):  # an answer says that the next command is taken
            page.say(type="undo", mode="gesture")
            answer(page, "there is nothing to undo")
            teach(page, "wave")
            page.say(type="undo", mode="gesture")
            answer(page, "“wave” is not added")
        teach(page, "wave")
        page.say(type="sample", mode="gesture")
        answer(page, "Show it now")
        page.say(type="teach", label="other", mode="gesture")
        answer(page, "wait until the last sample is added")
        answer(page, "No pictures come. Press Start camera and microphone")  # the camera is off
        page.say(type="sample", mode="gesture")
        answer(page, "Show it now")
        for side in (SIDE_PX, SIDE_PX // 2):
            page.socket.send(framed(PICTURE, jpeg(np.full((side, side, 3), 120, np.uint8))))
        answer(page, "The pictures changed their size")
        page.say(type="sample", mode="gesture")
        answer(page, "Show it now")
        for frame in signing([("flat", 0.6)], 3.0)[::4]:  # a slow camera
            page.socket.send(framed(PICTURE, jpeg(frame)))
            time.sleep(4 / FPS)
        assert answer(page, "pictures: move more slowly")["samples"] == 0


def test_files_that_are_no_samples_are_refused_in_words(server: PageServer, cookie: str, tmp_path: Path) -> None:
    wall = np.full((SIDE_PX, SIDE_PX, 3), 120, np.uint8)
    write_video(tmp_path / "long.avi", [wall] * 41, FPS)
    with connected(server, cookie) as page:
        assert upload(server, cookie, jpeg(cross(1)))[0] == 422  # no name is given yet
        teach(page, "cross")
        for body, name, status, text in (
            (b"text in a video", "clip.avi", 422, "clip.avi: "),
            (b"", "empty.jpg", 422, "empty.jpg"),
            (b"%PDF-1.4", "paper", 422, "paper"),
            (jpeg(cross(1))[:200], "cut.jpg", 422, "cut.jpg"),
            (jpeg(np.zeros((2000, 2000, 3), np.uint8)), "big.jpg", 422, "2000 x 2000"),
            ((tmp_path / "long.avi").read_bytes(), "long.avi", 422, "more than 40 pictures"),
            (jpeg(wall), "wall.jpg", 422, "no hand"),
            (bytes((1 << 20) + 1), "vast.avi", 413, "more than 1 MB"),
        ):
            got, why = upload(server, cookie, body, name)
            assert got == status and text in why and "/" not in why, (name, got, why)
        for key, origin in (("", own_origin(server)), (cookie, "http://evil.example")):
            assert request(server, "/sample?name=a.jpg", key, "POST", jpeg(cross(1)), Origin=origin)[0] == 403
        page.say(type="teach", label="cross", mode="gesture")  # the session has taken no harm
        answer(page, "3 times")
    assert upload(server, cookie, jpeg(cross(1)))[0] in (409, 422)  # the page is gone


def test_a_page_that_goes_while_it_records_leaves_nothing_behind(server: PageServer, cookie: str) -> None:
    with connected(server, cookie) as page:
        teach(page, "cross")
        assert upload(server, cookie, jpeg(cross(1))) == (200, "")
        page.say(type="sample", mode="gesture")
        answer(page, "Show it now")
    with connected(server, cookie, "b") as page:
        for _ in range(40):
            page.say(type="sample", mode="gesture")
            shown = answer(page, "")
            if "first give the gesture a name" in shown["text"]:
                break
            with contextlib.suppress(TimeoutError):
                page.await_message(lambda m: False, timeout_s=0.2)
        else:
            pytest.fail("the sample of the page that is gone was not ended")


@pytest.mark.parametrize(
    "label", ["", "   ", 41 * "x", "two\nlines", None, 7, "\u200d", "a\u200d", "\u200ca", "a\u202eb", "र\u200d\u200dम"]
)
def test_a_name_of_no_or_too_many_letters_is_refused(label: Any) -> None:
    with pytest.raises(FormatError, match="1 to 40 letters"):
        read_command(json.dumps({"type": "teach", "mode": "gesture", "label": label}), LIMITS)
    for name in (HINDI, CONJUNCT, "नमस्\u200c", "می\u200cخواهم"):
        command = read_command(json.dumps({"type": "teach", "mode": "gesture", "label": f" {name} "}), LIMITS)
        assert command["label"] == name
    for command in ({"type": "sample"}, {"type": "undo", "mode": None}, {"type": "sample", "mode": "smell"}):
        with pytest.raises(FormatError, match=r"a word .speech. or a gesture"):
            read_command(json.dumps(command), LIMITS)


def test_words_have_no_camera_and_gestures_no_microphone(server: PageServer, cookie: str) -> None:
    with connected(server, cookie) as page:
        page.socket.send(next(sound_messages(np.zeros(640, np.float32))))
        page.say(type="undo", mode="gesture")
        answer(page, "there is nothing to undo")
