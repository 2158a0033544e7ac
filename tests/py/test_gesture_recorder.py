# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Recording gestures: what is asked for is kept, going back is not, and the folder is a data set that is understood."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hri as package
from hri.core.errors import InvalidArgument, IoError
from hri.datasets import Dataset
from hri.live import ClipSource, GestureRecorder, Watcher
from hri.live.spotting import SpottingStream
from hri.media import read_frames, write_video
from hri.recognition import GestureSegmenterOptions
from test_watching_movements import FAR, FPS, Frame, picture

cv2 = pytest.importorskip("cv2")

PAUSE_S = 2.0
HIDDEN = 170.0


def session(labels: list[str], seed: int = 0) -> list[Frame]:
    """The hand comes, rests, and makes every movement; after each it rests, goes back and rests again."""
    rng = np.random.default_rng(seed)
    home = np.array((80.0, 70.0))
    places = [*(home + np.array((0, y)) for y in np.linspace(HIDDEN - 70, 0, 10)), *[home] * 40]
    for label in labels:
        far = np.array(FAR[label])
        places += [home + share * far for share in (*np.linspace(0, 1, 12), *[1.0] * 20)]
        places += [home + share * far for share in (*np.linspace(1, 0, 10), *[0.0] * 40)]
    return [picture(x, y, rng) for x, y in places]


def steps(events: list[Any]) -> list[tuple[str, str]]:
    return [
        (e.event, e.fields["label"] if "label" in e.fields else e.fields["reason"])
        for e in events
        if e.event in ("prompt", "recorded", "refused")
    ]


LABELS = ["left", "up"]


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[Any]]:
    folder = tmp_path_factory.mktemp("recorded") / "signs"
    recorder = GestureRecorder(folder, LABELS, "asha", takes=3, pause_s=PAUSE_S)
    assert recorder.num_takes == 6
    events = list(recorder.record(ClipSource(session(LABELS * 3), FPS)))
    assert recorder.missing() == []
    return folder, events


def test_gestures_are_asked_for_in_rounds_and_going_back_is_not_recorded(recorded: tuple[Path, list[Any]]) -> None:
    folder, events = recorded
    assert steps(events) == [step for label in LABELS * 3 for step in (("prompt", label), ("recorded", label))]
    dataset = Dataset.load(folder)
    assert (dataset.kind, dataset.synthetic, dataset.ignored) == ("gesture", False, [])
    assert sorted((s.label, s.person, s.take) for s in dataset) == sorted(
        (label, "asha", str(take)) for label in LABELS for take in (1, 2, 3)
    )
    for event in events:
        if event.event == "recorded":
            assert event.fields["quality"] > 0.5 and event.fields["hand_seen"] == 1.0 and event.mode == "gesture"
            clip = read_frames(event.fields["path"])
            assert len(clip.frames) == event.fields["num_frames"]
            # The movement, what is kept of the rest before it, and the rest that ends it.
            assert event.fields["duration_s"] == pytest.approx(0.6 + 0.4 + 0.5 + 0.2, abs=0.25)
            assert clip.times_s[-1] == pytest.approx(event.fields["duration_s"], abs=0.1)


def test_what_was_recorded_is_understood_live(recorded: tuple[Path, list[Any]]) -> None:
    known = package.train(Dataset.load(recorded[0]))
    assert isinstance(known, package.GestureRecognizer) and known.starts_at_rest
    shown = ["up", "left", "left"]
    events = Watcher(known).watch(ClipSource(session(shown, seed=5), FPS))
    decided = [e.decision.nbest[0].label for e in events if e.event == "decision" and e.decision]
    assert decided[0::2] == shown  # between them, the hand goes back


def test_recording_goes_on_and_overwrites_nothing(tmp_path: Path) -> None:
    first = GestureRecorder(tmp_path, LABELS, "asha", takes=1, pause_s=PAUSE_S)
    list(first.record(ClipSource(session(["left"])[:100], FPS)))
    kept = tmp_path / "left" / "asha_1.avi"
    before = kept.read_bytes()
    assert first.missing() == [("up", 1)]
    again = GestureRecorder(tmp_path, LABELS, "asha", takes=1, pause_s=PAUSE_S)
    events = again.record(ClipSource(session(["up"]), FPS))
    reported = []
    for event in events:
        reported.append(event)
        if event.event == "prompt":
            (tmp_path / "up").mkdir()
            (tmp_path / "up" / "asha_1.avi").write_bytes(b"another program's")
            with pytest.raises(IoError, match="asha_1"):
                reported.extend(events)
            break
    assert (tmp_path / "up" / "asha_1.avi").read_bytes() == b"another program's"
    assert kept.read_bytes() == before and not list(tmp_path.rglob(".*"))
    assert list(again.record(ClipSource([], FPS))) == []  # nothing is missing


def test_bad_takes_are_refused_with_the_reason(tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    frames = session(["left"])
    begins = 52  # in the middle of the movement the hand is away for a moment
    wall = [picture(80, 400, rng) for _ in range(5)]
    frames[begins + 1 : begins + 6] = frames[begins + 7 : begins + 12] = wall
    reported = steps(
        list(GestureRecorder(tmp_path, ["left"], "asha", 1, pause_s=PAUSE_S).record(ClipSource(frames, FPS)))
    )
    assert reported[:2] == [("prompt", "left"), ("refused", "left")]
    assert not (tmp_path / "left").exists()

    class Losing(ClipSource):
        def read(self) -> Any:
            self.num_lost += 1
            return super().read()

    lost = list(GestureRecorder(tmp_path, ["left"], "ben", 1, pause_s=PAUSE_S).record(Losing(session(["left"]), FPS)))
    assert any("pictures were lost" in e.fields.get("reason", "") for e in lost)


def test_pictures_are_kept_for_the_longest_gesture_only() -> None:
    rng = np.random.default_rng(0)
    options = GestureSegmenterOptions()
    options.max_gesture_s = 1.0
    stream = SpottingStream(options, 1, dynamic=False)
    reasons, kept = [], []
    for index in range(90):  # the hand moves on and on
        x = (40, 100, 60, 120, 80)[index % 5]
        happened = stream.push(picture(x, 70, rng), index / FPS)
        reasons += [event.fields["reason"] for event in happened if event.event == "gesture_end"]
        kept.append(len(stream._kept))
    assert reasons == ["cut"]
    assert len(stream.gesture.frames) >= FPS * options.max_gesture_s
    assert max(kept) <= FPS * (options.max_gesture_s + options.context_s) + 2
    stream.finish()
    assert len(stream._kept) == 0


def test_signs_that_are_held_come_into_view(tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    come = list(np.linspace(HIDDEN, 70, 8))
    heights = [*[HIDDEN * 2] * 25, *come, *[70.0] * 22, *come[::-1], *[HIDDEN * 2] * 45] * 2
    frames = [picture(80, y, rng) for y in heights]
    recorder = GestureRecorder(tmp_path, ["five"], "asha", takes=2, held=True, pause_s=PAUSE_S)
    reported = steps(list(recorder.record(ClipSource(frames, FPS))))
    assert reported == [("prompt", "five"), ("recorded", "five")] * 2


def test_what_cannot_be_is_refused(tmp_path: Path) -> None:
    for labels, person, takes in ((["a/b"], "asha", 1), (["unknown"], "asha", 1), (["a"], "as_ha", 1), (["a"], "x", 0)):
        with pytest.raises(InvalidArgument):
            GestureRecorder(tmp_path, labels, person, takes)
    with pytest.raises(InvalidArgument, match="pause_s"):
        GestureRecorder(tmp_path, ["a"], "asha", pause_s=-1.0)
    (tmp_path / "dataset.toml").write_text('kind = "speech"\npattern = "{label}/{person}_{take}.wav"\n')
    with pytest.raises(InvalidArgument, match="another data set"):
        GestureRecorder(tmp_path, ["a"], "asha")


def test_the_command_records_from_a_video_and_from_a_camera(
    hri: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_video(tmp_path / "session.avi", session(LABELS), FPS)
    command = ("record", "gesture", *LABELS, "--person", "asha", "--takes", "1", "--pause", str(PAUSE_S))
    done = hri(*command, "--from", tmp_path / "session.avi", "--out", tmp_path / "signs")
    assert done.code == 0, done.err
    rows = [json.loads(line) for line in done.out.splitlines()]
    assert [row["label"] for row in rows if row["event"] == "recorded"] == LABELS
    assert "2 of 2 recordings by asha" in done.err
    short = hri(*command, "left", "--from", tmp_path / "session.avi", "--out", tmp_path / "other")
    assert short.code != 0 and "there twice" in short.err
    ended = hri(
        "record", "gesture", "down", *LABELS, "--person", "cem", "--takes", "1",
        "--from", tmp_path / "session.avi", "--out", tmp_path / "more",
    )  # fmt: skip
    assert ended.code != 0 and "ended before 'up'" in ended.err

    class Camera:
        """Shows the session again at its own pace, as fast as it is read."""

        def __init__(self, device: Any) -> None:
            self.frames = iter(session(LABELS))

        def isOpened(self) -> bool:
            return True

        def get(self, _: int) -> float:
            return FPS

        def read(self) -> tuple[bool, Any]:
            import time

            time.sleep(1 / FPS)
            frame = next(self.frames, None)
            return frame is not None, frame

        def release(self) -> None:
            pass

    of_files = cv2.VideoCapture  # a video that is written is read again
    monkeypatch.setattr(cv2, "VideoCapture", lambda given: (of_files if isinstance(given, str) else Camera)(given))
    live = hri(*command, "--out", tmp_path / "live", "--stall", "3")
    assert live.code == 0, live.err
    monkeypatch.undo()
    assert sorted(s.label for s in Dataset.load(tmp_path / "live")) == LABELS
