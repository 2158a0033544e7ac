# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Live watching: a stream gives the decisions of its gestures, failing cameras say so and come back."""

from __future__ import annotations

import json
import math
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hri
from conftest import WAIT_S
from drawn_hands import FPS, picture, shown, stills
from hri import _native
from hri.core.errors import FormatError, InvalidArgument, IoError
from hri.live import (
    CameraSource,
    ClipSource,
    FrameQueue,
    Stalled,
    VideoSource,
    Watcher,
    draw_result,
)
from hri.media import read_frames, write_video

cv2 = pytest.importorskip("cv2")


@pytest.fixture(scope="module")
def signs() -> hri.GestureRecognizer:
    rows = [(stills(sign, seed), sign, f"p{seed % 3}") for seed in range(6) for sign in ("flat", "tall")]
    x, y, persons = map(list, zip(*rows, strict=True))
    return hri.GestureRecognizer(false_reject_rate=0.0).fit(x, y, groups=persons)


def test_a_stream_gives_the_decisions_of_its_signs(signs: hri.GestureRecognizer) -> None:
    labels = ["tall", "flat", "flat", "tall"]
    events = list(Watcher(signs, locale="en", model_id="hands").watch(ClipSource(shown(labels), FPS)))
    kinds = [e.event for e in events if e.event not in ("hand", "partial")]
    once = ["gesture_start", "gesture_end", "decision", "gesture_start", "gesture_dropped"]
    assert kinds == ["watching", *(once * 4), "ended"]
    decided = [e for e in events if e.event == "decision"]
    assert [e.decision.nbest[0].label for e in decided if e.decision] == labels
    period_s = len(shown(["flat"])) / FPS
    for number, event in enumerate(decided):
        # It rests 17 frames after the wall was last alone; that is seen compare_s and rest_s later.
        assert event.time - number * period_s == pytest.approx(17 / FPS + 0.7, abs=0.2)
        assert event.fields["compute_ms"] > 0 and event.fields["model"] == "hands" and event.mode == "gesture"
    partial = [e for e in events if e.event == "partial"]
    assert partial and all(e.fields["final"] == "" and e.fields["nbest"] for e in partial)
    assert [e.time for e in events] == sorted(e.time for e in events)


def test_a_video_gives_what_its_frames_give_and_every_event_is_a_line(
    signs: hri.GestureRecognizer, tmp_path: Path
) -> None:
    write_video(tmp_path / "session.avi", shown(["tall", "flat"]), FPS)
    events = list(Watcher(signs).watch(VideoSource(tmp_path / "session.avi")))
    rows = [json.loads(e.to_json()) for e in events]
    assert all("\n" not in e.to_json() for e in events) and {row["mode"] for row in rows} == {"gesture"}
    decided = [row for row in rows if row["event"] == "decision"]
    assert [row["nbest"][0]["label"] for row in decided] == ["tall", "flat"]
    for row in decided:
        assert {"final", "incremental", "confidence", "locale", "nbest", "rejected", "model"} <= set(row)
        assert row["final"] == ("" if row["rejected"] else row["nbest"][0]["label"])
    (tmp_path / "broken.avi").write_bytes(b"no video")
    with pytest.raises(FormatError, match=r"broken\.avi"):
        VideoSource(tmp_path / "broken.avi")


def test_what_is_no_video_is_said_to_be_what_it_is(
    request: pytest.FixtureRequest, signs: hri.GestureRecognizer, tmp_path: Path
) -> None:
    signs.save(tmp_path / "signs.hri")
    for name, message in (
        ("seven.jpg", "seven.jpg is a picture, and a video is needed here; 'hri recognise' takes pictures"),
        ("seven.wav", "seven.wav is a sound file, and a video is needed here"),
    ):
        (tmp_path / name).touch()
        done = request.getfixturevalue("hri")("watch", "--model", tmp_path / "signs.hri", tmp_path / name)
        assert done.code == 3 and message in done.err, done.err


def test_a_wall_gives_no_decision_and_a_hand_the_recogniser_does_not_see_no_input(
    signs: hri.GestureRecognizer,
) -> None:
    rng = np.random.default_rng(0)
    wall = [picture("flat", 3.0, rng) for _ in range(30)]
    assert {e.event for e in Watcher(signs).watch(ClipSource(wall, FPS))} == {"watching", "hand", "ended"}

    picky = hri.GestureRecognizer(false_reject_rate=0.0, min_quality=1.0)
    stills_of = [(stills(sign, seed), sign) for seed in range(3) for sign in ("flat", "tall")]
    rows = [signs.features(clip) for clip, _ in stills_of]
    picky.fit_features(rows, [sign for _, sign in stills_of])
    decided = [e for e in Watcher(picky).watch(ClipSource(shown(["flat"]), FPS)) if e.event == "decision"]
    assert [(e.fields["status"], e.fields["final"], e.fields["rejected"]) for e in decided] == [("no_input", "", True)]


def test_segmenter_options_are_checked_when_they_are_used(signs: hri.GestureRecognizer) -> None:
    for fields in ({"rest_s": 0.0}, {"still_change": 1.0}, {"max_gesture_s": 0.1}):
        with pytest.raises(InvalidArgument, match=next(iter(fields))):
            Watcher(signs, _native.GestureSegmenterOptions(**fields))
    with pytest.raises(InvalidArgument, match="max_pause_s"):
        Watcher(signs, max_pause_s=-1.0)
    with pytest.raises(InvalidArgument, match="partial_interval_s"):
        Watcher(signs, partial_interval_s=0.0)


def test_a_caller_that_stops_at_the_first_event_closes_the_source(signs: hri.GestureRecognizer) -> None:
    source = ClipSource(shown(["flat"]), FPS)
    events = Watcher(signs).watch(source)
    assert next(events).event == "watching"
    events.close()  # type: ignore[attr-defined]
    assert source.read() is None


def test_time_that_runs_backwards_is_refused(signs: hri.GestureRecognizer) -> None:
    class Backwards(ClipSource):
        def read(self) -> Any:
            timed = super().read()
            return None if timed is None else (timed[0], -timed[1])

    with pytest.raises(FormatError, match="time runs backwards"):
        list(Watcher(signs).watch(Backwards(shown(["flat"]), FPS)))


def test_a_full_queue_loses_the_oldest_and_counts() -> None:
    queue = FrameQueue(3)
    for number in range(5):
        queue.put(np.zeros((2, 2, 3), np.uint8), float(number))
    assert queue.num_lost == 2
    assert [timed[1] for timed in iter(lambda: queue.get(0.01), None)] == [2.0, 3.0, 4.0]
    with pytest.raises(InvalidArgument, match="capacity"):
        FrameQueue(0)


class FakeCapture:
    """A camera that gives noise, and fails after `plugged` pictures as the test says."""

    plugged = 10**9
    fault = "none"
    opens = 0
    openable = True
    gate = threading.Event()

    def __init__(self, device: Any) -> None:
        type(self).opens += 1
        self.count = 0
        self.rng = np.random.default_rng(type(self).opens)

    def isOpened(self) -> bool:
        return self.openable

    def get(self, _: int) -> float:
        return 20.0

    def read(self) -> tuple[bool, Any]:
        time.sleep(0.005)
        self.count += 1
        broken = self.opens == 1 and self.count > self.plugged
        if broken and self.fault == "blocks":
            self.gate.wait(2 * WAIT_S)
        if broken and self.fault == "fails":
            return False, None
        if not (broken and self.fault == "repeats"):
            self.frame = self.rng.integers(0, 255, (64, 64, 3), np.uint8)
        return True, self.frame.copy()

    def release(self) -> None:
        pass


@pytest.fixture
def camera(monkeypatch: pytest.MonkeyPatch) -> type[FakeCapture]:
    fake = type("Fake", (FakeCapture,), {"gate": threading.Event()})
    monkeypatch.setattr(cv2, "VideoCapture", fake)
    return fake


class TakenCapture(FakeCapture):
    """A camera that one capture at a time may have open, as drivers of cameras have it."""

    holder: Any = None

    def __init__(self, device: Any) -> None:
        super().__init__(device)
        self.openable = type(self).holder is None
        if self.openable:
            type(self).holder = self

    def release(self) -> None:
        if type(self).holder is self:
            type(self).holder = None


def test_a_camera_in_use_is_told_as_such(monkeypatch: pytest.MonkeyPatch) -> None:
    taken = type("Taken", (TakenCapture,), {})
    monkeypatch.setattr(cv2, "VideoCapture", taken)
    first = CameraSource(0)
    with pytest.raises(IoError, match="camera 0 is in use: another session of this program"):
        CameraSource(0)
    first.close()
    other_program = taken("/dev/null")  # a device that is there
    with pytest.raises(IoError, match="it is there, but does not open; another program may use it"):
        CameraSource("/dev/null")
    other_program.release()
    CameraSource("/dev/null").close()
    again = CameraSource(0)
    again.close()
    taken.holder = other_program
    with pytest.raises(IoError, match="connect a camera"):
        CameraSource("/dev/hri-no-such-camera")


@pytest.mark.parametrize("stall_s", [1e10, math.inf])
def test_a_camera_may_be_waited_for_without_end(camera: type[FakeCapture], stall_s: float) -> None:
    source = CameraSource(0, stall_s=stall_s)
    assert source.read() is not None and source.reconnect() and camera.opens == 2
    source.close()


def test_a_camera_whose_opening_fails_is_given_back(camera: type[FakeCapture], monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(grabber: Any, _: float) -> bool:
        raise KeyboardInterrupt

    with monkeypatch.context() as patched:
        patched.setattr("hri.live.camera._Grabber.wait_open", interrupted)
        with pytest.raises(KeyboardInterrupt):
            CameraSource(0)
    assert not [thread for thread in threading.enumerate() if thread.name == "hri-camera"]
    CameraSource(0).close()


def test_a_number_that_no_camera_can_have_is_said_once(
    hri: Any, signs: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    raised: list[Any] = []
    monkeypatch.setattr(threading, "excepthook", raised.append)
    signs.save(tmp_path / "signs.hri")
    missing = hri("watch", "--model", tmp_path / "signs.hri", "--device", 10**20)
    assert missing.code == 3 and f"camera {10**20} cannot be opened: connect a camera" in missing.err
    assert not raised


@pytest.mark.parametrize(
    ("fault", "message"), [("blocks", "no picture"), ("fails", "no picture"), ("repeats", "the same picture")]
)
def test_an_unplugged_camera_is_told_and_comes_back(
    camera: type[FakeCapture], signs: hri.GestureRecognizer, fault: str, message: str
) -> None:
    camera.plugged, camera.fault = 5, fault
    source = CameraSource(0, stall_s=0.3)
    begun = time.monotonic()
    reported: list[str] = []
    for event in Watcher(signs, reconnect_s=WAIT_S).watch(source):
        reported.append(event.event)
        if event.event == "stall":
            assert message in event.fields["message"]
        if "reconnected" in reported and event.event == "hand":
            break
    assert [kind for kind in reported if kind in ("watching", "stall", "reconnected")] == [
        "watching",
        "stall",
        "reconnected",
    ]
    camera.gate.set()
    source.close()
    assert source.read() is None and camera.opens == 2 and time.monotonic() - begun < WAIT_S


def test_a_camera_that_stays_away_ends_the_watch(camera: type[FakeCapture], signs: hri.GestureRecognizer) -> None:
    camera.plugged, camera.fault = 5, "fails"
    reported: list[str] = []
    with pytest.raises(Stalled, match=r"camera 0: no picture for 0\.2 s"):
        reported.extend(e.event for e in Watcher(signs).watch(CameraSource(0, stall_s=0.2)))
    camera.openable = False
    with pytest.raises(IoError, match="give a video instead"):
        CameraSource(3)


def test_a_gesture_that_a_stall_interrupts_is_dropped(signs: hri.GestureRecognizer) -> None:
    class Interrupted(ClipSource):
        def read(self) -> Any:
            timed = super().read()
            if timed is None:
                raise Stalled("unplugged")
            return timed

    reported: list[Any] = []
    with pytest.raises(Stalled):
        reported.extend(iter(Watcher(signs).watch(Interrupted(shown(["flat"])[:16], FPS)).__next__, None))
    assert [e.event for e in reported if e.event not in ("hand", "partial")] == [
        "watching",
        "gesture_start",
        "gesture_dropped",
        "stall",
    ]


def test_a_slow_reader_is_told_what_was_lost(camera: type[FakeCapture], signs: hri.GestureRecognizer) -> None:
    source = CameraSource(0, buffer_frames=2)
    time.sleep(0.2)
    events = Watcher(signs).watch(source)
    lost = next(e for e in events if e.event == "overflow")
    assert lost.fields["lost_frames"] > 0
    events.close()  # type: ignore[attr-defined]


def test_what_is_seen_is_drawn(signs: hri.GestureRecognizer) -> None:
    drawn = []
    frames = shown(["tall"])
    watcher = Watcher(signs, on_result=lambda result, decision: drawn.append((draw_result(result, decision), decision)))
    list(watcher.watch(ClipSource(frames, FPS)))
    pictures = [one for one, _ in drawn if one is not None]
    assert len(pictures) == len(frames)
    assert drawn[0][1] is None and drawn[-1][1].nbest[0].label == "tall"
    middle = pictures[26][85, 90].astype(int) - frames[26][85, 90]  # the hand is tinted green
    assert middle[2] < -20 and middle[1] > 0
    corner = pictures[26][:40, 120:]  # strokes along the edges of the hand, on black
    assert (corner == 0).all(axis=2).mean() > 0.2 and corner.max() > 150 and np.ptp(frames[26][:40, 120:]) < 40
    np.testing.assert_array_equal(pictures[0][120:], frames[0][120:])  # where there is neither hand nor text


def test_the_command_watches_and_films(
    hri: Any, signs: Any, tmp_path: Path, camera: type[FakeCapture], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.undo()  # a real decoder for the files
    signs.save(tmp_path / "signs.hri")
    write_video(tmp_path / "session.avi", shown(["flat"]), FPS)
    command = ("watch", "--model", tmp_path / "signs.hri")
    done = hri(*command, tmp_path / "session.avi", "--video", tmp_path / "seen.mp4")
    assert done.code == 0, done.err
    rows = [json.loads(line) for line in done.out.splitlines()]
    decided = [row for row in rows if row["event"] == "decision"]
    assert [row["nbest"][0]["label"] for row in decided] == ["flat"]
    assert decided[0]["model"].startswith("signs.hri:")
    assert len(read_frames(tmp_path / "seen.mp4").frames) == len(shown(["flat"]))
    monkeypatch.setattr(cv2, "VideoCapture", camera)
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    assert "--video FILE films the same" in hri(*command, "--show").err
    camera.openable = False
    missing = hri(*command, "--device", "97")
    assert missing.code == 3 and "camera 97 cannot be opened: connect a camera" in missing.err


def test_the_screen_tells_hands_signs_and_trouble(signs: hri.GestureRecognizer) -> None:
    from hri.cli.live_screen import hand_line
    from hri.cli.watch import describe
    from hri.live import Event

    events = list(Watcher(signs).watch(ClipSource(shown(["tall"]), FPS)))
    lines = [line for line in (describe(event, 2) for event in events) if line]
    assert lines[0].startswith("watching frames") and "tall" in lines[1] and len(lines) == 2
    reported = [hand_line(event) for event in events if event.event in ("hand", "partial")]
    assert any(line.startswith("no hand") for line in reported) and any("gesture" in line for line in reported)
    assert any(line.startswith("so far  ") for line in reported)
    assert "12 frames lost" in describe(Event(1.0, "overflow", {"lost_frames": 12}), 1)
    assert "camera is back" in describe(Event(1.0, "reconnected", mode="gesture"), 1)
    assert "microphone is back" in describe(Event(1.0, "reconnected", mode="speech"), 1)
