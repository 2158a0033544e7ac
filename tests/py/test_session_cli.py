# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri session``: JSON lines, a screen, recordings that repeat, and messages for what is missing."""

from __future__ import annotations

import io
import json
import sys
from pathlib import Path
from typing import Any

import pytest

from conftest import RATE_HZ
from drawn_hands import FPS
from hri.cli.session_screen import describe, show_session
from hri.io import write_wav_pcm16
from hri.live import Event
from hri.media import write_video
from session_people import signing, speech, train_signs, train_words

pytest.importorskip("cv2")


@pytest.fixture(scope="module")
def scene(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with both models, a recording and a video."""
    folder = tmp_path_factory.mktemp("scene")
    train_words().save(folder / "words.hri")
    train_signs().save(folder / "signs.hri")
    write_wav_pcm16(str(folder / "said.wav"), speech([("flat", 1.5), ("stop", 6.0)], 8.0), RATE_HZ)
    write_video(folder / "shown.avi", signing([("flat", 1.2)], 8.0), FPS)
    return folder


def models(scene: Path) -> tuple[object, ...]:
    return ("--speech-model", scene / "words.hri", "--gesture-model", scene / "signs.hri")


def rows(out: str) -> list[dict[str, Any]]:
    return [json.loads(line) for line in out.splitlines()]


def test_a_scene_is_printed_recorded_and_replayed(hri, scene: Path, tmp_path: Path) -> None:
    pytest.importorskip("mcap")
    files = (scene / "said.wav", scene / "shown.avi")
    kept = tmp_path / "kept.mcap"
    done = hri("session", *models(scene), "--backend", "none", "--record", kept, *files)
    assert done.code == 0
    printed = rows(done.out)
    assert [row["final"] for row in printed if row["event"] == "fused"] == ["flat", "stop"]
    assert {"fused", "state", "say", "stop", "level", "hand", "motion_end"} <= {row["event"] for row in printed}
    fused = next(row for row in printed if row["event"] == "fused")
    assert fused["mode"] == "session" and fused["carried_by"] == "both" and fused["speech"]["label"] == "flat"
    assert fused["rule"].startswith("table 6.9") and "at once" in fused["why"]
    again = hri("session", *models(scene), "--replay", kept)
    assert again.code == 0 and "all as recorded" in again.err
    assert [row["final"] for row in rows(again.out) if row["event"] == "fused"] == ["flat", "stop"]


def test_a_sentence_is_looked_up_recorded_and_replayed(hri, scene: Path, tmp_path: Path) -> None:
    pytest.importorskip("mcap")
    stored, said, kept = tmp_path / "stored.csv", tmp_path / "sentence.wav", tmp_path / "kept.mcap"
    stored.write_text("signs,en,hi,answer\nflat flat,Flat and flat.,दो बार,wave\nfar away,Far.,,\n", encoding="utf-8")
    stream = speech([("stop", 1.5), ("flat", 3.5), ("flat", 5.5), ("tall", 7.5)], 9.5)
    write_wav_pcm16(str(said), stream, RATE_HZ)
    known = ("--knowledge", stored, "--max-distance", "0.3")
    asked = ("--sentence-begin", "stop", "--sentence-end", "tall", "--stop", "halt", "--language", "hi", *known)
    model = ("--speech-model", scene / "words.hri")
    done = hri("session", *model, "--backend", "kinematic", *asked, "--record", kept, said)
    assert done.code == 0 and "WARNING: " + str(stored) + ": words that no recogniser knows: far, away" in done.err
    printed = rows(done.out)
    (sentence,) = [row for row in printed if row["event"] == "sentence"]
    assert (sentence["words"], sentence["nearest"], sentence["distance"]) == (["flat", "flat"],) * 2 + (0.0,)
    assert [row["text"] for row in printed if row["event"] == "say"] == ["दो बार"]
    assert [(r["label"], r["completed"]) for r in printed if r["event"] == "motion_end"] == [("wave", True)]
    shown = describe(Event(3.0, "sentence", {"words": ["a"], "nearest": ["a", "b"], "distance": 0.4}, mode="session"))
    assert "sentence: a  (nearest: a b, 0.40)" in shown
    again = hri("session", *model, *known, "--replay", kept)
    assert again.code == 0 and "all as recorded" in again.err and "replayed with" not in again.err
    without = hri("session", *model, "--replay", kept)
    assert without.code == 3 and "was recorded with stored sentences, and needs them" in without.err
    refused = hri("session", *model, "--backend", "none", *known, said)
    assert refused.code == 2 and "--knowledge needs --sentence-begin and --sentence-end" in refused.err
    half = hri("session", *model, "--backend", "none", "--sentence-begin", "stop", said)
    assert half.code == 2 and "--sentence-begin and --sentence-end go together" in half.err


def test_a_replay_by_other_models_that_decides_otherwise_fails(hri, scene: Path, tmp_path: Path) -> None:
    pytest.importorskip("mcap")
    import hri as package
    from conftest import tone_word

    kept, other = tmp_path / "kept.mcap", tmp_path / "other.hri"
    model = ("--speech-model", scene / "words.hri")
    assert hri("session", *model, "--backend", "none", "--record", kept, scene / "said.wav").code == 0
    swapped = [
        (tone_word(500.0 + 50 * (take % 3), slope, take), label, f"p{take % 3}")
        for take in range(6)
        for label, slope in (("stop", 800.0), ("flat", 0.0))
    ]
    x, y, persons = map(list, zip(*swapped, strict=True))
    package.WordRecognizer(false_reject_rate=0.0).fit(x, y, sample_rate_hz=RATE_HZ, groups=persons).save(other)
    again = hri("session", "--speech-model", other, "--replay", kept)
    assert (
        again.code == 1 and "differs from what was recorded at" in again.err and "replayed with other.hri" in again.err
    )
    assert {row["model"].split(":")[0] for row in rows(again.out) if "model" in row} == {"other.hri"}


def test_the_robot_moves_and_reports_labels_without_a_motion(hri, scene: Path) -> None:
    done = hri("session", "--speech-model", scene / "words.hri", "--backend", "kinematic", scene / "said.wav")
    assert done.code == 0 and "no motion for flat: no gesture has this name" in done.err
    assert "I have no motion for flat." in [row.get("text") for row in rows(done.out)]


def test_a_file_says_what_the_robot_does_for_a_label(hri, scene: Path, tmp_path: Path) -> None:
    table = tmp_path / "motions.toml"
    table.write_text('flat = "agree"\nstop = "up"\nturn = "up"\n', encoding="utf-8")
    moved = ("--speech-model", scene / "words.hri", "--backend", "kinematic", "--motions", table)
    done = hri("session", *moved, scene / "said.wav")
    assert done.code == 0 and "no motion for flat" not in done.err and "no motion for tall: no gesture" in done.err
    assert f"WARNING: {table}: no word or sign is turn\n" in done.err
    assert f"WARNING: {table}: stop moves nothing" in done.err
    assert [(row["label"], row["completed"]) for row in rows(done.out) if row["event"] == "motion_end"] == [
        ("flat", True)
    ]
    table.write_text('flat = "agre"\n', encoding="utf-8")
    for command in ("session", "serve"):
        refused = hri(command, *moved, *([scene / "said.wav"] if command == "session" else ["--no-gesture"]))
        assert refused.code == 3 and f"{table}: flat: no gesture 'agre'; did you mean 'agree'" in refused.err


def test_what_is_missing_is_said_in_a_line(hri, scene: Path, tmp_path: Path) -> None:
    said, shown = scene / "said.wav", scene / "shown.avi"
    (tmp_path / "no.hri").write_bytes(b"no model")
    words = ("--speech-model", scene / "words.hri")
    for arguments, code, message in (
        ((said, said), 2, "are both sound files"),
        ((scene / "words.hri",), 2, "neither a sound file nor a video"),
        (("--no-speech", "--no-gesture"), 2, "leave nothing"),
        ((said,), 3, "there is no speech model yet"),
        (("--speech-model", tmp_path / "no.hri", said), 3, "no.hri"),
        (("--speech-model", scene / "signs.hri", said), 3, "signs.hri is a gesture recogniser"),
        ((*models(scene), "--wake", "robot", said, shown), 3, "'robot' is in no vocabulary"),
        ((*words, "--confirm-below", "2", said), 3, "confirm_below"),
        ((*models(scene), "--record", tmp_path / "kept.txt", said), 2, ".mcap"),
        ((*models(scene), said), 2, "--gesture-model is of signs, and nothing is seen"),
        ((*models(scene), shown), 2, "--speech-model is of words, and nothing is heard"),
        ((*models(scene), "--no-gesture"), 2, "--gesture-model is of signs, and nothing is seen"),
        (("--no-speech", "--grammar", said), 2, "--grammar is of words, and nothing is heard"),
        ((*words, "--stand", said), 2, "--stand has no effect without a robot"),
        ((*words, "--motions", said, said), 2, "--motions has no effect without a robot"),
        ((*words, "--gui", said), 2, "--gui has no effect without a robot"),
        ((*words, "--robot", "nao", said), 2, "--robot has no effect without a robot"),
        ((*words, "--fusion", said, "--rule", "product", said), 2, "--rule has no effect: --fusion takes its place"),
        ((*models(scene), "--no-speech", said), 2, "leave out what FILE brings"),
        ((*models(scene), "--no-gesture", said, shown), 2, "leave out what FILE brings"),
        ((*models(scene), "--microphone", "1", said), 2, "FILE takes their place"),
        ((*models(scene), "--min-confidence", "0.5", said), 2, "--min-confidence goes with --grammar"),
        ((*models(scene), "--max-distance", "0.5", said), 2, "--max-distance goes with --knowledge"),
        ((*models(scene), "--language", "hi", said), 2, "--language goes with --knowledge"),
        ((*words, "--imitate", "1", said), 2, "--imitate has no effect without a robot"),
        (("--robot", "nao", "--url", "tcp://127.0.0.1:9"), 2, "--url is of a real one"),
    ):
        result = hri("session", "--backend", "none", *arguments)
        assert result.code == code and message in result.err, (arguments, result.err)


@pytest.mark.parametrize(
    "more",
    [
        ("said.wav",),
        ("--record", "a.mcap"),
        ("--wake", "robot"),
        ("--stop", "halt"),
        ("--confirm-below", "0.9"),
        ("--window", "2"),
        ("--rule", "product"),
        ("--resume", "start"),
        ("--backend", "none"),
        ("--camera", "1"),
        ("--no-gesture",),
    ],
)
def test_a_replay_refuses_what_the_recording_determines(hri, scene: Path, tmp_path: Path, more: tuple[str, ...]):
    (tmp_path / "no.mcap").write_bytes(b"no recording")
    replayed = ("session", "--replay", tmp_path / "no.mcap")
    assert "not a recorded session" in hri(*replayed, "--speech-model", scene / "words.hri", "--json-lines").err
    refused = hri(*replayed, *(scene / one if one == "said.wav" else one for one in more))
    assert refused.code == 2 and "has no effect: --replay takes what was recorded" in refused.err


@pytest.mark.parametrize("live", [False, True])
def test_output_that_nobody_reads_any_more_ends_the_session_and_keeps_the_recording(
    hri, scene: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, live: bool
) -> None:
    pytest.importorskip("mcap")
    from hri.live import ArraySource
    from hri.media import read_audio
    from hri.session import read_recording

    kept, shown = tmp_path / "new" / "folder" / "kept.mcap", []
    to_json = Event.to_json

    def read(event: Event) -> str:
        if len(shown) == 3:
            raise BrokenPipeError
        shown.append(event)
        return to_json(event)

    monkeypatch.setattr(Event, "to_json", read)
    said = read_audio(scene / "said.wav")
    source = ArraySource(said.samples, said.sample_rate_hz, paced=True)
    monkeypatch.setattr("hri.cli.session.open_microphone", lambda *_: source)
    heard = ("--no-gesture",) if live else (scene / "said.wav",)
    model = ("--speech-model", scene / "words.hri")
    done = hri("session", *model, "--backend", "kinematic", "--record", kept, *heard)
    assert done.code == 141 and len(rows(done.out)) == 3
    assert len(list(read_recording(kept).events())) >= 3


def test_a_session_that_nothing_stops_warns(hri, scene: Path) -> None:
    model, said = ("--speech-model", scene / "words.hri", "--backend", "none"), scene / "said.wav"
    for stops, message in (
        ((), ""),
        (
            ("--stop", "stpo"),
            "WARNING: no word or sign stops the robot: none is stpo; choose by --stop, there are",
        ),
        (("--stop", "stop", "--stop", "stpo"), "WARNING: no word or sign is stpo, as --stop asks"),
    ):
        done = hri("session", *model, *stops, said)
        assert done.code == 0 and message in done.err and ("WARNING" in done.err) == bool(message)


def test_devices_that_are_missing_end_the_session_in_words(hri, scene: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from hri.cli import session_devices as command
    from hri.core.errors import IoError

    def missing(*_: object) -> Any:
        raise IoError("no microphone can be opened: connect one")

    monkeypatch.setattr(command, "microphone", missing)
    model = ("--speech-model", scene / "words.hri")
    done = hri("session", *model, "--backend", "none", "--no-gesture")
    assert done.code == 3 and "no microphone can be opened" in done.err
    assert [row["event"] for row in rows(done.out)] == ["stall"]


@pytest.mark.parametrize(
    ("command", "option"),
    [(("session", "--no-speech", "--backend", "none"), "--camera"), (("watch", "--stall", "1"), "--device")],
    ids=lambda value: value[0] if isinstance(value, tuple) else "",
)
def test_a_camera_that_is_missing_is_named_by_the_option_of_the_command(
    hri, scene: Path, command: tuple[str, ...], option: str
) -> None:
    model = "--gesture-model" if command[0] == "session" else "--model"
    done = hri(*command, model, scene / "signs.hri", option, "77")
    assert done.code == 3 and f"or give a video instead; {option} names another" in done.err
    other = "--device" if option == "--camera" else "--camera"
    assert other not in done.err


def test_the_screen_shows_decisions_and_why(monkeypatch: pytest.MonkeyPatch) -> None:
    events = [
        Event(0.0, "listening", {"source": "microphone", "sample_rate_hz": 16000}),
        Event(0.5, "level", {"level_db": -40.0, "over_noise_db": 3.0, "in_speech": True}),
        Event(0.6, "state", {"state": "listening", "before": "idle"}, mode="session"),
        Event(1.0, "fused", {
            "final": "7", "status": "recognised", "rule": "table 6.9: x", "why": "at once", "gesture": None,
            "speech": {"label": "7", "status": "recognised", "confidence": 0.9}}, mode="session"),
        Event(1.0, "say", {"text": "7."}, mode="session"),
        Event(1.0, "motion_start", {"label": "7", "wait_ms": 312.0, "compute_ms": 4.2}, mode="robot"),
        Event(2.0, "stop", {"label": "stop", "reason": "stop: recognised in speech"}, mode="session"),
        Event(2.1, "motion_end", {"label": "7", "completed": False, "message": "", "fault": False}, mode="robot"),
    ]  # fmt: skip
    lines = [describe(event) for event in events]
    assert "7  (word 7 0.90; table 6.9: x; at once)" in lines[3] and lines[4].endswith("robot: 7.")
    assert "after 312 ms to be decided on, 4 ms of computing" in lines[5]
    assert "STOP stop: stop: recognised in speech" in lines[6] and "has stopped: 7" in lines[7]
    out = io.StringIO()
    monkeypatch.setattr(out, "isatty", lambda: True)
    monkeypatch.setattr(sys, "stdout", out)
    assert show_session(iter(events), False, lambda: False) == ""
    assert "LISTENING" in out.getvalue() and "robot: 7." in out.getvalue()
    assert show_session(iter([Event(0.0, "stall", {"message": "gone"})]), False, lambda: False) == "gone"
