# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Live listening: a stream gives the decisions of its words, failing microphones say so, every event is a line."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import hri
from conftest import PERSONS, RATE_HZ, WAIT_S, tone_word
from hri import _native
from hri.core.errors import InvalidArgument, IoError
from hri.live import (
    ArraySource,
    Attention,
    FileSource,
    Listener,
    MicrophoneSource,
    SampleRing,
    Stalled,
    list_microphones,
)


@pytest.fixture(scope="module")
def words() -> hri.WordRecognizer:
    rows = [
        (tone_word(base_hz, slope, 7 * take + number), label, person)
        for number, (person, base_hz) in enumerate(PERSONS.items())
        for take in range(3)
        for label, slope in (("rise", 800.0), ("fall", -350.0))
    ]
    x, y, persons = map(list, zip(*rows, strict=True))
    return hri.WordRecognizer(false_reject_rate=0.0).fit(x, y, sample_rate_hz=RATE_HZ, groups=persons)


@pytest.fixture(scope="module")
def session() -> tuple[np.ndarray, list[str], list[float]]:
    """Four words of the highest person with pauses: the stream, the labels and when each begins."""
    labels, starts, parts = ["rise", "fall", "fall", "rise"], [], []
    rng = np.random.default_rng(5)
    base_hz = list(PERSONS.values())[-1]
    at = 0
    for number, label in enumerate(labels):
        pause = 0.001 * rng.standard_normal(RATE_HZ // 2).astype("f4")
        word = tone_word(base_hz, 800.0 if label == "rise" else -350.0, 50 + number)
        starts.append((at + len(pause)) / RATE_HZ + 0.25)
        parts += [pause, word]
        at += len(pause) + len(word)
    return np.concatenate(parts), labels, starts


def test_models_are_warm_before_the_first_word_is_said(
    words: hri.WordRecognizer, session: tuple[np.ndarray, list[str], list[float]], monkeypatch: pytest.MonkeyPatch
) -> None:
    heard: list[hri.Decision] = []
    plain = hri.WordRecognizer.recognise

    def recognise(self: hri.WordRecognizer, *args: Any) -> hri.Decision:
        heard.append(plain(self, *args))
        return heard[-1]

    monkeypatch.setattr(hri.WordRecognizer, "recognise", recognise)
    samples, labels, _ = session
    listener = Listener(words)
    for stream in (1, 2):
        decided = [event for event in listener.listen(ArraySource(samples, RATE_HZ)) if event.decision is not None]
        assert len(decided) == len(labels) and len(heard) == stream * len(labels) + 1
    assert heard[0].status != "no_input", "a buzz that is no speech would warm nothing"


def test_a_stream_gives_the_decisions_of_its_words(
    words: hri.WordRecognizer, session: tuple[np.ndarray, list[str], list[float]]
) -> None:
    stream, labels, starts = session
    events = list(Listener(words, locale="en", model_id="tones").listen(ArraySource(stream, RATE_HZ)))
    kinds = [e.event for e in events if e.event != "level"]
    assert kinds == ["listening", *(["speech_start", "speech_end", "decision"] * 4), "ended"]
    decided = [e for e in events if e.decision is not None]
    assert [e.decision.nbest[0].label for e in decided if e.decision] == labels
    padding_s = 1e-3 * words.options.activity.padding_ms
    for event, start in zip(decided, starts, strict=True):
        assert event.fields["first_s"] == pytest.approx(start - padding_s, abs=0.03)
        assert event.fields["last_s"] == pytest.approx(start + 0.5 + padding_s, abs=0.05)
        assert event.fields["compute_ms"] > 0 and event.fields["model"] == "tones" and event.fields["locale"] == "en"
    assert [e.time for e in events] == sorted(e.time for e in events)


def test_an_urgent_word_that_is_rejected_by_little_is_named(
    words: hri.WordRecognizer, session: tuple[np.ndarray, list[str], list[float]]
) -> None:
    assert words.held_out is not None

    def first(listener: Listener) -> Any:
        return next(e for e in listener.listen(ArraySource(session[0], RATE_HZ)) if e.decision is not None)

    accepted = first(Listener(words, attention=Attention(min_score=-1e6), urgent=("rise",)))
    assert accepted.fields["final"] == "rise" and "near" not in accepted.fields
    score = accepted.fields["score"]
    for missed_by, urgent, near in ((0.4, ("rise",), "rise"), (0.6, ("rise",), None), (0.4, ("fall",), None)):
        attention = Attention(min_score=score + missed_by)
        rejected = first(Listener(words, attention=attention, urgent=urgent))
        assert rejected.fields["rejected"] and rejected.fields.get("near") == near


def test_nothing_is_near_where_no_words_were_held_out(session: tuple[np.ndarray, list[str], list[float]]) -> None:
    one_each = [tone_word(500.0, slope, 1) for slope in (800.0, -350.0)]
    words = hri.WordRecognizer().fit(one_each, ["rise", "fall"], sample_rate_hz=RATE_HZ)
    assert words.held_out is None

    def first(min_score: float) -> hri.live.Event:
        listener = Listener(words, attention=Attention(min_score=min_score), urgent=("rise", "fall"))
        return next(e for e in listener.listen(ArraySource(session[0], RATE_HZ)) if e.decision is not None)

    rejected = first(first(-1e6).fields["score"] + 0.1)
    assert rejected.fields["rejected"] and "near" not in rejected.fields


def test_events_do_not_depend_on_blocks(
    words: hri.WordRecognizer, session: tuple[np.ndarray, list[str], list[float]]
) -> None:
    class Blocks(ArraySource):
        def __init__(self, samples: np.ndarray, sizes: list[int]) -> None:
            super().__init__(samples, RATE_HZ)
            self.blocks = np.split(samples, np.cumsum(sizes)[:-1])

        def read(self) -> np.ndarray | None:
            return self.blocks.pop(0) if self.blocks else None

    stream = session[0]
    reported = []
    for sizes in ([len(stream)], [7, 10000, 1, len(stream) - 10008]):
        events = Listener(words).listen(Blocks(stream, sizes))
        reported.append([(e.time, e.decision) for e in events if e.event == "decision"])
    assert len(reported[0]) == 4 and reported[0] == reported[1]


def test_every_event_is_one_line_of_json(words: hri.WordRecognizer, session: Any, tmp_path: Path) -> None:
    _native.write_wav_pcm16(str(tmp_path / "session.wav"), session[0], RATE_HZ)
    for event in Listener(words).listen(FileSource(tmp_path / "session.wav")):
        line = event.to_json()
        assert "\n" not in line
        row = json.loads(line)
        assert row["mode"] == "speech" and row["time"] >= 0
        if row["event"] == "decision":
            assert {"final", "incremental", "confidence", "locale", "nbest", "rejected", "model"} <= set(row)
            assert row["final"] == ("" if row["rejected"] else row["nbest"][0]["label"])


def test_lines_of_json_are_utf8_whatever_a_file_is_called(word_model: Path, tmp_path: Path) -> None:
    """As of a name that another system wrote; text of a terminal shows the byte as it is."""
    place = tmp_path / os.fsdecode(b"s\xffven.wav")
    _native.write_wav_pcm16(str(tmp_path / "seven.wav"), tone_word(180.0, 800.0, 1), RATE_HZ)
    (tmp_path / "seven.wav").rename(place)
    command = (sys.executable, "-m", "hri", "listen", "--model", word_model, place)
    done = subprocess.run(command, capture_output=True, check=True)
    sources = [row["source"] for row in map(json.loads, done.stdout.decode().splitlines()) if "source" in row]
    assert sources == [place.name]


def test_silence_and_noise_give_no_decision(words: hri.WordRecognizer) -> None:
    rng = np.random.default_rng(0)
    for stream in (np.zeros(80000, "f4"), (0.1 * rng.standard_normal(80000)).astype("f4")):
        kinds = {e.event for e in Listener(words).listen(ArraySource(stream, RATE_HZ))}
        assert kinds == {"listening", "level", "ended"}


def test_a_caller_that_stops_at_the_first_event_closes_the_source(words: hri.WordRecognizer) -> None:
    class Closed(ArraySource):
        closed = False

        def close(self) -> None:
            self.closed = True

    source = Closed(np.zeros(RATE_HZ, np.float32), RATE_HZ)
    events = Listener(words).listen(source)
    assert next(events).event == "listening"
    events.close()  # type: ignore[attr-defined]
    assert source.closed
    odd = Closed(np.zeros(9, np.float32), 1)  # a rate that end points cannot be found at
    with pytest.raises(InvalidArgument):
        next(Listener(words).listen(odd))
    assert odd.closed


def test_paced_recordings_take_their_time() -> None:
    source = ArraySource(np.zeros(4800, "f4"), 16000, paced=True)
    begun = time.monotonic()
    while source.read() is not None:
        pass
    assert time.monotonic() - begun >= 0.29


def test_a_full_ring_counts_what_it_loses() -> None:
    ring = SampleRing(10)
    ring.write(np.arange(6, dtype="f4"))
    assert list(ring.read(4, 1)) == [0, 1, 2, 3]
    ring.write(np.arange(6, 20, dtype="f4"))
    assert ring.num_lost == 6
    assert list(ring.read(100, 1)) == [4, 5, 6, 7, 8, 9, 10, 11, 12, 13]
    assert len(ring.read(1, 0.01)) == 0
    with pytest.raises(InvalidArgument, match="capacity"):
        SampleRing(0)


class FakeStream:
    """Calls back from a thread as PortAudio does, until it is asked to stop or "unplugged"."""

    def __init__(self, blocks: int | None, close_s: float, **settings: Any) -> None:
        self.settings, self.blocks, self.close_s = settings, blocks, close_s
        self.stopped = threading.Event()
        self.thread = threading.Thread(target=self._run, daemon=True)

    def _run(self) -> None:
        count = self.settings["blocksize"]
        sent = 0
        while not self.stopped.is_set() and (self.blocks is None or sent < self.blocks):
            self.settings["callback"](np.full((count, 1), 0.01, "f4"), count, None, None)
            sent += 1
            time.sleep(0.002)

    def start(self) -> None:
        self.thread.start()

    def abort(self) -> None:
        self.stopped.set()
        time.sleep(self.close_s)

    def close(self) -> None:
        self.stopped.set()


class FakePortAudioError(Exception):
    pass


@pytest.fixture
def sounddevice(monkeypatch: pytest.MonkeyPatch) -> SimpleNamespace:
    """A sounddevice with one microphone; `fake.blocks` is how many blocks it gives before it is unplugged."""
    devices = [
        {"name": "loudspeaker", "max_input_channels": 0, "default_samplerate": 48000.0},
        {"name": "microphone", "max_input_channels": 1, "default_samplerate": 16000.0},
    ]
    fake = SimpleNamespace(blocks=None, close_s=0.0, PortAudioError=FakePortAudioError)
    fake.default = SimpleNamespace(device=[1, 0])

    def query_devices(device: Any = None, kind: str | None = None) -> Any:
        if kind is None:
            return devices
        if device not in (None, 1, "micro"):
            raise FakePortAudioError("Error querying device -1")
        return devices[1]

    fake.query_devices = query_devices
    fake.InputStream = lambda **settings: FakeStream(fake.blocks, fake.close_s, **settings)
    monkeypatch.setitem(sys.modules, "sounddevice", fake)
    return fake


def test_a_microphone_is_heard(sounddevice: SimpleNamespace, words: hri.WordRecognizer) -> None:
    assert [(m.index, m.name, m.is_default) for m in list_microphones()] == [(1, "microphone", True)]
    source = MicrophoneSource("micro")
    events = Listener(words, level_interval_s=0.05).listen(source)
    heard = [next(events) for _ in range(5)]
    assert [e.event for e in heard] == ["listening", *["level"] * 4]
    events.close()  # type: ignore[attr-defined]
    assert source.read() is None and source.num_lost == 0


def test_an_unplugged_microphone_is_told_and_closes(sounddevice: SimpleNamespace, words: hri.WordRecognizer) -> None:
    sounddevice.blocks, sounddevice.close_s = 20, 2 * WAIT_S  # and the driver hangs
    begun = time.monotonic()
    reported = []
    events = Listener(words).listen(MicrophoneSource(stall_s=0.3))
    reported.extend(iter(lambda: next(events).event, "stall"))
    with pytest.raises(Stalled, match=r"microphone: no sound for 0\.3 s"):
        next(events)
    assert reported[0] == "listening"
    assert time.monotonic() - begun < WAIT_S


def test_a_slow_reader_is_told_what_was_lost(sounddevice: SimpleNamespace, words: hri.WordRecognizer) -> None:
    sounddevice.blocks = 100
    source = MicrophoneSource(stall_s=0.3, buffer_s=0.1)
    source._stream.thread.join()
    events = Listener(words).listen(source)
    lost = [e.fields["lost_samples"] for e in _until_stall(events) if e.event == "overflow"]
    assert sum(lost) == source.num_lost == 100 * 320 - 1600


def _until_stall(events: Iterator[Any]) -> Iterator[Any]:
    try:
        yield from events
    except Stalled:
        return


def test_no_microphone_says_what_to_do(sounddevice: SimpleNamespace, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(IoError, match="give a recording instead"):
        MicrophoneSource(device=7)
    with pytest.raises(InvalidArgument, match="stall_s"):
        MicrophoneSource(stall_s=0)
    monkeypatch.setitem(sys.modules, "sounddevice", None)
    with pytest.raises(ImportError, match=r"libhri\[live\]"):
        MicrophoneSource()


@pytest.mark.usefixtures("sounddevice")
def test_the_command_listens(
    words: hri.WordRecognizer, session: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    from hri.cli.main import main

    words.save(tmp_path / "words.hri")
    _native.write_wav_pcm16(str(tmp_path / "session.wav"), session[0], RATE_HZ)
    assert main(["listen", "--model", str(tmp_path / "words.hri"), str(tmp_path / "session.wav")]) == 0
    rows = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    decided = [row for row in rows if row["event"] == "decision"]
    assert [row["nbest"][0]["label"] for row in decided] == session[1]
    assert decided[0]["model"].startswith("words.hri:")
    assert main(["listen", "--list-devices"]) == 0
    assert capsys.readouterr().out == "* 1\tmicrophone\t16000 Hz\n"
    assert main(["listen", "--model", str(tmp_path / "words.hri"), "--device", "7"]) == 3
    assert "no microphone can be opened" in capsys.readouterr().err


def test_the_screen_tells_level_words_and_trouble(words: hri.WordRecognizer, session: Any) -> None:
    from hri.cli.listen import describe
    from hri.cli.live_screen import meter
    from hri.live import Event

    lines = [describe(e, 2) for e in Listener(words).listen(ArraySource(session[0], RATE_HZ))]
    shown = [line for line in lines if line]
    assert shown[0].startswith("listening to samples") and len(shown) == 5
    assert all(label in line for label, line in zip(session[1], shown[1:], strict=True))
    level = {"level_db": -40.0, "over_noise_db": 3.0, "in_speech": True}
    assert meter(Event(1.0, "level", level)).count("█") == 20
    assert "12 samples lost" in describe(Event(1.0, "overflow", {"lost_samples": 12}), 1)
    assert "unplugged" in describe(Event(1.0, "stall", {"message": "unplugged"}), 1)
