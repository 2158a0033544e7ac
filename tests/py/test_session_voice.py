# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The robot's voice: its own words are no commands, a person's STOP is one; what is missing is said at once."""

from __future__ import annotations

import queue
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import hri as package
from conftest import RATE_HZ, WAIT_S
from hri.cli.session_screen import describe
from hri.core.errors import InvalidArgument, IoError
from hri.core.phrases import Phrase, in_language, phrase
from hri.live import Event, Loudspeaker
from hri.recognition.decision import Decision
from hri.robot import open_robot
from hri.session import McapRecorder, Session, SessionOptions, Voice, decisions, read_recording, replay
from hri.session.voice import OwnVoice, aloud
from session_people import MOTIONS, speech, train_words

pytest.importorskip("cv2")


@pytest.fixture(scope="module")
def words() -> package.WordRecognizer:
    return train_words()


def decided(label: str, status: str = "recognised") -> Decision:
    return Decision("speech", label, status, 0.9, nbest=())


@pytest.mark.parametrize(
    ("heard", "stops", "text", "moving", "own"),
    [
        (decided("flat"), False, "flat.", False, True),
        (decided("tall"), False, "flat.", False, True),  # misrecognised
        (decided("unknown", "unknown"), False, "flat.", True, True),
        (decided("stop"), True, "flat.", False, False),
        (decided("stop"), True, "flat.", True, False),
        (decided("stop"), False, "flat.", False, True),  # unsure
        (decided("stop"), False, "flat.", True, True),
        (decided("stop"), True, "Did you mean STOP?", False, True),
        (decided("stop"), True, "Did you mean stop?", True, False),
        (decided("stop"), True, phrase("did_you_mean", labels=("stop",)), False, True),
        (decided("stop"), True, "Nonstop.", False, False),
        (decided("unknown", "unknown"), False, "stop", False, True),
    ],
)
def test_which_words_may_be_the_robots_own(heard: Decision, stops: bool, text: str, moving: bool, own: bool) -> None:
    voice = OwnVoice()
    assert not voice.may_be(heard, 1.0, 2.0, stops, moving)
    voice.begin(text, 2.0)
    assert voice.may_be(heard, 1.0, 2.1, stops, moving) is own
    assert not voice.may_be(heard, 1.0, 1.9, stops, moving), "before it spoke"
    assert voice.may_be(heard, 60.0, 61.0, stops, moving) is own, "it speaks still"
    voice.end("another text", 2.5)
    assert voice.may_be(heard, 60.0, 61.0, stops, moving) is own, "it speaks still"
    voice.end(text, 3.0)
    assert voice.may_be(heard, 3.4, 5.0, stops, moving) is own, "a room echoes for half a second"
    assert not voice.may_be(heard, 3.6, 5.0, stops, moving)


def test_of_two_voices_that_say_the_same_one_may_go_on() -> None:
    voice = OwnVoice()
    voice.begin("flat.", 1.0)
    voice.begin("flat.", 1.1)
    voice.end("flat.", 2.0)
    assert voice.may_be(decided("tall"), 9.0, 9.5, False, False)
    voice.end("flat.", 3.0)
    assert not voice.may_be(decided("tall"), 9.0, 9.5, False, False)


def asked(*labels: str) -> Phrase:
    return phrase("did_you_mean", labels=labels)


STORED = Phrase("Please wait.", "stored", {"texts": {"en": "Please wait.", "de": "Stop, bitte."}})


@pytest.mark.parametrize(
    ("text", "said", "in_hindi"),
    [
        ("tall.", "tall.", ""),
        ("Nonstop.", "Nonstop.", ""),
        (asked("tall"), "Did you mean tall?", "क्या आपका मतलब tall था?"),
        (asked("stop"), "Shall I freeze?", "क्या मैं हिलना बंद करूँ?"),
        (asked("stop", "5"), "Did you mean 5, or shall I freeze?", "क्या आपका मतलब 5 था, या मैं हिलना बंद करूँ?"),
        (asked("रुको"), "Shall I freeze?", "क्या मैं हिलना बंद करूँ?"),
        ("Stop the bus.", "Please read what I answer.", "कृपया मेरा जवाब पढ़ लीजिए।"),
        ("रुको, मैं आता हूँ।", "Please read what I answer.", "कृपया मेरा जवाब पढ़ लीजिए।"),
        (STORED, "Please read what I answer.", "कृपया मेरा जवाब पढ़ लीजिए।"),
    ],
)
def test_what_is_said_aloud_does_not_name_stop(text: str, said: str, in_hindi: str) -> None:
    found = aloud(text, ("stop", "रुको"))
    assert found == said
    if isinstance(found, Phrase):
        assert in_language(found.code, "hi", found.values) == in_hindi
    assert aloud(text, ()) == text, "no microphone hears it"
    assert aloud(asked("freeze"), ("freeze",)) == "Please read what I answer."
    assert aloud("freeze", ("freeze", "read")) == ""


def test_a_voice_says_one_text_after_the_other_and_reports_what_it_could_not() -> None:
    said: list[str] = []

    def speak(text: str) -> None:
        if text == "b":
            raise RuntimeError("hoarse")
        said.append(text)

    reports: queue.Queue[tuple[str, str, str]] = queue.Queue()
    voice = Voice(speak)
    voice.attach(lambda *report: reports.put(report))
    with pytest.raises(InvalidArgument, match="another session speaks by it"):
        voice.attach(lambda *report: None)
    for text in "abc":
        voice.say(text)
    got = [reports.get(timeout=WAIT_S) for _ in range(6)]
    assert got == [
        ("voice_start", "a", ""), ("voice_end", "a", ""), ("voice_start", "b", ""),
        ("voice_end", "b", "RuntimeError: hoarse"), ("voice_start", "c", ""), ("voice_end", "c", ""),
    ]  # fmt: skip
    voice.close()
    voice.say("d")
    assert said == ["a", "c"]
    assert describe(Event(1.0, "voice_end", {"text": "b", "message": "hoarse"}, mode="session")).endswith(
        "not said: hoarse"
    )


class Room:
    """A microphone that hears what is put into `sounds`, and else nothing."""

    name, sample_rate_hz, num_lost = "room", RATE_HZ, 0

    def __init__(self) -> None:
        self.sounds: queue.Queue[np.ndarray] = queue.Queue()
        self.silent = np.zeros(RATE_HZ // 20, np.float32)
        self.rest: np.ndarray = np.zeros(0, np.float32)
        self.ended = threading.Event()
        self.next_s = time.monotonic()

    def read(self) -> np.ndarray | None:
        """The next 50 ms, when they have passed; late ones at once, as of a device, whose time goes on."""
        self.next_s += 0.05
        self.ended.wait(max(0.0, self.next_s - time.monotonic()))
        if self.ended.is_set():
            return None
        if not len(self.rest) and not self.sounds.empty():
            self.rest = self.sounds.get()
        block, self.rest = self.rest[: len(self.silent)], self.rest[len(self.silent) :]
        return block if len(block) else self.silent

    def close(self) -> None:
        self.ended.set()


def test_a_session_takes_no_command_from_its_own_voice_and_heeds_stop(words: Any, tmp_path: Path) -> None:
    pytest.importorskip("mcap_ros2")
    room, speaking = Room(), threading.Event()
    spoken: list[str] = []

    def speak(text: str) -> None:
        """The robot says "flat.", and the room hears "tall"; then it goes on while a person says STOP."""
        spoken.append(text)
        room.sounds.put(speech([("tall", 0.5)], 2.0))
        speaking.wait(120)

    voice = Voice(speak)
    path = tmp_path / "voice.mcap"
    ignored: list[str] = []
    stopped = resumed = False
    with open_robot("kinematic") as robot:
        session = Session(words, robot=robot, options=SessionOptions(confirm_below=0), motions=MOTIONS, voice=voice)
        room.sounds.put(speech([("flat", 0.5)], 2.0))
        run: Iterator[Event] = session.run(room, live=True, recorder=McapRecorder(path))
        for event in run:
            assert event.time < 120.0, "something did not come"
            if event.event == "ignored":
                ignored.append(event.fields["label"])
                assert event.fields["reason"] == "heard while the robot speaks"
                room.sounds.put(speech([("stop", 0.5)], 2.0))
            if event.event == "stop":
                stopped = True
                assert event.fields["label"] == "stop"
                speaking.set()
            if event.event == "voice_end" and stopped and not resumed:
                resumed = True
                break
        run.close()  # type: ignore[attr-defined]
    voice.close()
    assert ignored == ["tall"] and stopped and resumed and spoken == ["flat."]
    recording = read_recording(path)
    kept = list(recording.events())
    assert [e["final"] for e in kept if e["event"] == "fused"] == ["flat", "stop"]
    assert [e["event"] for e in kept if e["event"].startswith("voice")][:2] == ["voice_start", "voice_end"]
    assert decisions(e.to_dict() for e in replay(recording, words)) == decisions(kept)


@pytest.fixture
def loudspeaker(monkeypatch: pytest.MonkeyPatch) -> SimpleNamespace:
    """A sounddevice with one loudspeaker; `written` is what it played, `broken` that it is unplugged."""

    class PortAudioError(Exception):
        pass

    class OutputStream:
        def __init__(self, **options: Any) -> None:
            self.options = options

        def __enter__(self) -> OutputStream:
            return self

        def __exit__(self, *_: object) -> None:
            pass

        def write(self, samples: np.ndarray) -> None:
            if fake.broken:
                raise PortAudioError("unplugged")
            fake.written.append(samples)

    def query(device: Any, kind: str) -> dict[str, Any]:
        assert kind == "output"
        if fake.broken:
            raise PortAudioError("no default device")
        return {"name": "box", "default_samplerate": 48000.0}

    fake = SimpleNamespace(
        PortAudioError=PortAudioError, OutputStream=OutputStream, query_devices=query, written=[], broken=False,
        check_output_settings=lambda **_: None,
    )  # fmt: skip
    monkeypatch.setitem(sys.modules, "sounddevice", fake)
    return fake


def test_a_loudspeaker_plays_at_its_own_rate(loudspeaker: SimpleNamespace) -> None:
    box = Loudspeaker()
    box.play(np.full(8000, 2.0, np.float32), 16000)
    played = np.concatenate(loudspeaker.written)
    assert played.shape == (24000, 1) and played.dtype == np.float32 and played.max() == 1.0
    box.close()
    box.play(np.zeros(8000, np.float32), 16000)
    assert sum(len(block) for block in loudspeaker.written) == 24000
    other = Loudspeaker()
    loudspeaker.broken = True
    with pytest.raises(IoError, match="box plays nothing"):
        other.play(np.zeros(10, np.float32), 48000)


def test_what_a_voice_needs_is_said_at_the_start(
    hri: Any, words: Any, loudspeaker: SimpleNamespace, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    words.save(tmp_path / "words.hri")
    command = ("session", "--backend", "none", "--no-gesture", "--speech-model", tmp_path / "words.hri", "--speak")
    loudspeaker.broken = True
    mute = hri(*command)
    assert (mute.code, mute.out) == (3, "") and "no loudspeaker can be used" in mute.err
    loudspeaker.broken = False
    babble = hri(*command, "--language", "xx-none")
    assert babble.code == 3 and "xx-none" in babble.err
    monkeypatch.setenv("PATH", str(tmp_path))
    missing = hri(*command)
    assert missing.code == 3 and "espeak-ng" in missing.err
    for more in (("--replay", tmp_path / "words.hri"), ("--robot", "nao", "--url", "tcp://127.0.0.1:9")):
        refused = hri("session", "--speak", *more)
        assert refused.code == 2 and "--speak" in refused.err
