# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Sessions as MCAP files: what they hold, that a replay repeats them, and what is refused."""

from __future__ import annotations

import json
import tracemalloc
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import hri
from conftest import RATE_HZ
from drawn_hands import FPS
from hri.core.errors import FormatError, InvalidArgument, IoError
from hri.core.ros2_messages import message_encoder
from hri.live import ArraySource, ClipSource, Stalled
from hri.robot import open_robot
from hri.session import McapRecorder, Session, SessionOptions, decisions, event_schema, read_recording, replay
from session_people import MOTIONS, signing, speech, train_signs, train_words
from test_hostile_files import hostile, only_hri_s_errors

pytest.importorskip("cv2")
reader = pytest.importorskip("mcap.reader")
writer = pytest.importorskip("mcap.writer")
pytest.importorskip("mcap_ros2")


@pytest.fixture(scope="module")
def words() -> hri.WordRecognizer:
    return train_words()


@pytest.fixture(scope="module")
def signs() -> hri.GestureRecognizer:
    return train_signs()


def messages(path: Path, topic: str) -> list[Any]:
    """As a reader of others gives them: ROS 2's messages by the schemas in the file, and JSON."""
    from mcap_ros2.decoder import DecoderFactory

    with path.open("rb") as file:
        rows = reader.make_reader(file, decoder_factories=[DecoderFactory()])
        if topic in ("/hri/events", "/hri/times"):
            return [json.loads(message.data) for _, _, message in rows.iter_messages([topic])]
        return [row.decoded_message for row in rows.iter_decoded_messages([topic])]


def test_a_recorded_session_is_replayed_to_the_same_decisions(words: Any, signs: Any, tmp_path: Path) -> None:
    path = tmp_path / "session.mcap"
    stream = np.round(speech([("flat", 1.5), ("tall", 7.0), ("stop", 10.2)], 12.0) * 32768).astype("i2") / np.float32(
        32768
    )
    frames = signing([("flat", 1.2)], 12.0)
    with open_robot("kinematic") as robot:
        session = Session(words, signs, robot, SessionOptions(confirm_below=0.2), motions=MOTIONS)
        recorder = McapRecorder(path)
        events = [
            e.to_dict() for e in session.run(ArraySource(stream, RATE_HZ), ClipSource(frames, FPS), recorder=recorder)
        ]
    assert recorder.failure == "" and {e["event"] for e in events} >= {"fused", "motion_start", "halt", "stop"}
    recording = read_recording(path)
    assert recording.options == session.options and recording.labels == ["flat", "tall"]
    kept = list(recording.events())
    assert kept == json.loads(json.dumps(events))
    again = [e.to_dict() for e in replay(recording, words, signs)]
    assert decisions(again) == decisions(kept) and len(decisions(again)) > 8
    said = [(e["time"], e["nbest"]) for e in events if e["event"] == "decision"]
    assert [(e["time"], e["nbest"]) for e in again if e["event"] == "decision"] == said

    (info,) = messages(path, "/hri/sound_info")
    assert (info.channels, info.sample_rate, info.sample_format) == (1, RATE_HZ, "S16LE")
    assert info.bitrate == 16 * RATE_HZ and info.coding_format == "wave"
    sound = [np.frombuffer(message.data, "<i2") for message in messages(path, "/hri/sound")]
    assert np.array_equal(np.concatenate(sound), stream * 32768)
    pictures = messages(path, "/hri/pictures")
    assert len(pictures) == len(frames) and pictures[15].format == "png"
    stamp = pictures[15].header.stamp
    assert (stamp.sec, stamp.nanosec, pictures[15].header.frame_id) == (1, 0, "camera_optical")
    assert np.array_equal(hri.media.decode_image(pictures[20].data, ""), frames[20])
    times = [time for time in messages(path, "/hri/times") if time["topic"] == "/hri/pictures"]
    assert times[15] == {"topic": "/hri/pictures", "sequence": 15, "stream": 0, "time_s": 1.0, "offset_s": 0.0}
    joints, (first, _) = messages(path, "/hri/joint_states"), messages(path, "/hri/joint_trajectory")
    assert len(joints) > 100 and len(joints[0].name) == len(joints[0].position) == 25
    assert joints[0].header.frame_id == first.header.frame_id == "base_link"
    begun_s = next(e["time"] for e in events if e["event"] == "motion_start")
    assert first.header.stamp.sec + 1e-9 * first.header.stamp.nanosec == pytest.approx(begun_s, abs=1e-4)
    assert first.joint_names == ["head_joint_2"] and len(first.points) == 5
    after = first.points[1].time_from_start
    assert after.sec + 1e-9 * after.nanosec == pytest.approx(MOTIONS["flat"].period_s)


def test_what_is_recorded_is_as_ros_2_and_the_schemas_have_it(words: Any, signs: Any, tmp_path: Path) -> None:
    """By definitions and readers of others: rosbags has those of ROS 2 Humble, jsonschema reads our schemas."""
    jsonschema = pytest.importorskip("jsonschema")
    typesys = pytest.importorskip("rosbags.typesys")
    path = tmp_path / "session.mcap"
    sound, pictures = ArraySource(speech([("flat", 1.5)], 5.0), RATE_HZ), ClipSource(signing([("flat", 1.2)], 5.0), FPS)
    with open_robot("kinematic") as robot:
        session = Session(words, signs, robot, SessionOptions(confirm_below=0.2), motions=MOTIONS)
        list(session.run(sound, pictures, recorder=McapRecorder(path)))
    types = typesys.get_typestore(typesys.Stores.ROS2_HUMBLE)
    audio = {
        "AudioData": "uint8[] data",
        "AudioInfo": """# The audio meta data
uint8 channels
uint32 sample_rate
string sample_format
uint32 bitrate
string coding_format
""",
    }
    for name, text in audio.items():
        types.register(typesys.get_types_from_msg(text, f"audio_common_msgs/msg/{name}"))
    seen, validators = set(), {}
    with path.open("rb") as file:
        rows = reader.make_reader(file)
        for schema, channel, message in rows.iter_messages():
            seen.add(channel.topic)
            assert message.log_time < 8e9
            if channel.message_encoding == "json":
                if schema.id not in validators:
                    shape = json.loads(schema.data)
                    jsonschema.Draft202012Validator.check_schema(shape)
                    validators[schema.id] = jsonschema.Draft202012Validator(shape)
                validators[schema.id].validate(json.loads(message.data))
            else:
                assert (channel.message_encoding, schema.encoding) == ("cdr", "ros2msg")
                read = types.deserialize_cdr(message.data, schema.name)
                assert bytes(types.serialize_cdr(read, schema.name)) == message.data
        summary = rows.get_summary()
    assert seen == {channel.topic for channel in summary.channels.values()} and len(seen) == 7
    for schema in summary.schemas.values():
        if schema.encoding == "ros2msg":
            written = typesys.get_types_from_msg(schema.data.decode(), schema.name)
            assert all(types.fielddefs[name] == fields for name, fields in written.items()), schema.name
    with pytest.raises(jsonschema.ValidationError, match="'text' is a required property"):
        jsonschema.validate({"time": 0, "event": "say", "mode": "session"}, event_schema())


def test_buttons_that_begin_and_end_imitation_are_replayed(words: Any, tmp_path: Path) -> None:
    path = tmp_path / "buttons.mcap"
    session = Session(words, options=SessionOptions(imitate_labels=("tall",)))
    sound = ArraySource(speech([("flat", 1.5)], 4.0), RATE_HZ)
    for count, event in enumerate(session.run(sound, recorder=McapRecorder(path))):
        if count == 2:
            session.imitate()
            session.rest()  # nothing moves any more: without a robot it is carried out at once
        assert event.event != "rest"
    recording = read_recording(path)
    found = decisions(recording.events())
    assert next(e["text"] for e in found if e["event"] == "say") == "tall." and len(found) > 4
    assert [e["command"] for e in recording.events() if e["event"] == "asked"] == ["imitate", "rest"]
    assert decisions([e.to_dict() for e in replay(recording, words)]) == found


def test_devices_that_come_and_go_are_replayed_as_they_came(words: Any, signs: Any, tmp_path: Path) -> None:
    import cv2

    class Unplugged(ArraySource):
        def read(self) -> Any:
            block = super().read()
            if block is None:
                raise Stalled("unplugged")
            return block

    parts = [speech([("flat", 1.0)], 2.0), speech([("tall", 0.8)], 3.0)]
    frames = signing([("flat", 0.5)], 4.0)
    frames = [*frames[:50], *[cv2.resize(frame, (96, 96)) for frame in frames[50:]]]

    def open_sound() -> Unplugged:
        if not parts:
            raise IoError("away")
        return Unplugged(parts.pop(0), RATE_HZ, paced=True)

    path = tmp_path / "live.mcap"
    events = []
    session = Session(words, signs, options=SessionOptions(retry_s=0.1))
    run = session.run(open_sound, ClipSource(frames, FPS, paced=True), live=True, recorder=McapRecorder(path))
    for event in run:
        events.append(event.to_dict())
        if [(e["event"], e["mode"]) for e in events].count(("stall", "speech")) == 2:
            run.close()  # type: ignore[attr-defined]
            break
    recording = read_recording(path)
    kept = [e for e in recording.events() if e["event"] in ("stall", "reconnected")]
    assert [(e["event"], e["mode"]) for e in kept].count(("reconnected", "speech")) == 1
    assert ("stall", "gesture") in [(e["event"], e["mode"]) for e in kept]
    again = [e.to_dict() for e in replay(recording, words, signs)]
    assert decisions(again) == decisions(recording.events())
    assert [e["final"] for e in again if e["event"] == "fused"] == ["flat", "tall"]
    assert {info.sample_format for info in messages(path, "/hri/sound_info")} == {"F32LE"}


def test_a_recorder_takes_one_session_at_a_time_and_a_place_that_can_be_written(words: Any, tmp_path: Path) -> None:
    recorder = McapRecorder(tmp_path / "a.mcap")
    one, other = Session(words), Session(words)
    running = one.run(ArraySource(speech([], 1.0), RATE_HZ), recorder=recorder)
    next(running)
    with pytest.raises(InvalidArgument, match="another session is being recorded"):
        next(other.run(ArraySource(speech([], 1.0), RATE_HZ), recorder=recorder))
    assert len(list(running)) > 5 and list(read_recording(tmp_path / "a.mcap").events())
    assert list(other.run(ArraySource(speech([], 1.0), RATE_HZ), recorder=recorder))
    with pytest.raises(IoError, match="missing"):
        next(one.run(ArraySource(speech([], 1.0), RATE_HZ), recorder=McapRecorder(tmp_path / "missing" / "a.mcap")))
    assert list(one.run(ArraySource(speech([], 1.0), RATE_HZ)))


def test_a_full_disk_ends_the_recording_and_not_the_session(
    words: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from hri.session import recording

    written = recording._Counted.write

    def write(self: Any, data: bytes) -> int:
        if self.tell() > 20_000:
            raise IoError("No space left on device")
        return written(self, data)

    monkeypatch.setattr(recording._Counted, "write", write)
    recorder = McapRecorder(tmp_path / "a.mcap")
    rng = np.random.default_rng(0)
    loud = speech([("flat", 60.0)], 62.0)
    loud[: 50 * RATE_HZ] += 1e-4 * rng.standard_normal(50 * RATE_HZ).astype("f4")
    events = list(Session(words).run(ArraySource(loud, RATE_HZ), recorder=recorder))
    assert [e.fields["final"] for e in events if e.event == "fused"] == ["flat"]
    assert "No space left" in recorder.failure and list(tmp_path.iterdir()) == []


def made(path: Path, about: dict[str, str] | None, rows: list[tuple[str, bytes]]) -> Path:
    numbers: dict[str, int] = {}
    with path.open("wb") as file:
        out = writer.Writer(file)
        out.start()
        if about is not None:
            out.add_metadata("hri.session", about)
        for topic, data in rows:
            channel = out.register_channel(topic, "json" if topic in ("/hri/events", "/hri/times") else "cdr", 0)
            numbers[topic] = numbers.get(topic, -1) + 1
            out.add_message(channel, 0, data, 0, numbers[topic])
        out.finish()
    return path


def read_all(path: Path) -> None:
    recording = read_recording(path)
    for messages in (recording.events(), recording.sound(), recording.pictures()):
        list(messages)


def timed(topic: str = "/hri/sound", **other: Any) -> tuple[str, bytes]:
    times = {"topic": topic, "sequence": 0, "stream": 0, "time_s": 0.0, "offset_s": 0.0}
    return "/hri/times", json.dumps(times | other).encode()


def sound_info(**other: Any) -> tuple[str, bytes]:
    info = {"channels": 1, "sample_rate": 8000, "sample_format": "S16LE", "bitrate": 0, "coding_format": "wave"}
    return "/hri/sound_info", message_encoder("audio_common_msgs/AudioInfo")(info | other)


def heard(data: bytes = b"\0\0") -> tuple[str, bytes]:
    return "/hri/sound", message_encoder("audio_common_msgs/AudioData")({"data": data})


def shown(form: str) -> tuple[str, bytes]:
    fields = {"header": {}, "format": form, "data": b"-"}
    return "/hri/pictures", message_encoder("sensor_msgs/CompressedImage")(fields)


GOOD = {
    name: json.dumps(value)
    for name, value in {
        "version": 2,
        "options": {"fusion": {}},
        "labels": [],
        "models": {},
        "endpointer": None,
        "segmenter": None,
    }.items()
}


@pytest.mark.parametrize(
    ("about", "rows", "message"),
    [
        (None, [], "no metadata of a session"),
        (GOOD | {"version": "1"}, [], "version 1 is not 2"),
        (GOOD | {"options": '{"window_s": -1, "fusion": {}}'}, [], "window_s"),
        (GOOD | {"options": "[]"}, [], "options"),
        (GOOD | {"labels": "{"}, [], "not a JSON file"),
        (GOOD | {"endpointer": '{"hangover": 1}'}, [], "no field 'hangover'"),
        (GOOD | {"endpointer": '{"hangover_ms": "1"}'}, [], "hangover_ms must be a number"),
        (GOOD | {"endpointer": "[]"}, [], "its options"),
        (GOOD | {"segmenter": "[]"}, [], "segmenter"),
        (GOOD, [("/hri/events", b'{"time": 0, "event": "gesture_start", "mode": "gesture"}')], "KeyError: 'first_s'"),
        (
            GOOD,
            [
                (
                    "/hri/events",
                    b'{"time": 0, "event": "signed", "mode": "gesture", "first_s": 0, "last_s": 0, "words": 5}',
                )
            ],
            "words: 5",
        ),
        (GOOD, [("/hri/events", b"{}")], "KeyError: 'time'"),
        (GOOD, [("/hri/events", b"\xff")], "UnicodeDecodeError"),
        (GOOD, [("/hri/events", b'{"time": 1e999, "event": "a", "mode": "b"}')], "is no number"),
        (GOOD, [("/hri/events", b'"' + bytes(1 << 20) + b'"')], "a message of 1048578 bytes"),
        (GOOD, [heard()], "has no times before it"),
        (GOOD, [timed(), heard()], "has no /hri/sound_info before it"),
        (GOOD, [sound_info(), timed(sequence=1), heard()], "has no times before it"),
        (GOOD, [sound_info(), timed("/hri/pictures"), heard()], "has no times before it"),
        (GOOD, [sound_info(sample_format="opus")], "1 x 'opus' must be 1 x S16LE or F32LE"),
        (GOOD, [sound_info(channels=2)], "2 x 'S16LE'"),
        (GOOD, [sound_info(sample_rate=0)], "sample_rate 0"),
        (GOOD, [("/hri/sound_info", b"")], "/hri/sound_info"),
        (GOOD, [sound_info(), timed(stream=-1), heard()], "stream -1"),
        (GOOD, [sound_info(), timed(time_s=None), heard()], "None is no number"),
        (GOOD, [sound_info(), ("/hri/times", b"[]")], "/hri/times: TypeError"),
        (GOOD, [sound_info(), timed(stream=1), heard(), timed(sequence=1), heard()], "stream 0 comes after 1"),
        (GOOD, [timed("/hri/pictures"), shown("jpeg")], "format 'jpeg' is not png"),
    ],
)
def test_damaged_recordings_are_refused(
    about: dict[str, str] | None, rows: list[tuple[str, bytes]], message: str, tmp_path: Path
) -> None:
    path = made(tmp_path / "a.mcap", about, rows)
    with pytest.raises(FormatError, match=r"a\.mcap.*" + message):
        read_all(path)


@pytest.mark.parametrize("change", [lambda data: data[:200], lambda data: b"text", lambda data: b"", bytes.upper])
def test_files_of_another_kind_are_refused(change: Callable[[bytes], bytes], tmp_path: Path) -> None:
    rows = [row for number in range(30) for row in (timed(sequence=number), heard())]
    path = made(tmp_path / "a.mcap", GOOD, [sound_info(), *rows])
    assert len(list(read_recording(path).sound())) == 30
    path.write_bytes(change(path.read_bytes()))
    with pytest.raises(FormatError, match=r"a\.mcap"):
        read_all(path)
    with pytest.raises(IoError):
        read_recording(tmp_path / "none.mcap")


@pytest.mark.parametrize("compression", ["LZ4", "ZSTD"])
def test_a_small_file_that_unfolds_to_a_vast_one_is_refused_before_it_does(compression: str, tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    out = writer.Writer(str(path), compression=writer.CompressionType[compression])
    out.start()
    out.add_metadata("hri.session", GOOD)
    channel = out.register_channel("/hri/other", "json", 0)
    out.add_message(channel, 0, bytes((1 << 27) + 1), 0)
    out.finish()
    assert path.stat().st_size < 1 << 20
    tracemalloc.start()
    try:
        with pytest.raises(FormatError, match=r"a\.mcap.*in a chunk"):
            read_all(path)
        assert tracemalloc.get_traced_memory()[1] < 1 << 24
    finally:
        tracemalloc.stop()


NEAR_JSON = st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=3) | st.just([]) | st.just({})
EVENTS = [
    {"time": 1.0, "event": "motion_end", "mode": "robot", "message": "", "fault": False, "command": "flat"},
    {"time": 2.0, "event": "asked", "mode": "session", "command": "resume"},
    {"time": 2.5, "event": "asked", "mode": "session", "command": "only_stop", "for_s": 1.0},
    {"time": 3.0, "event": "tick", "mode": "session"},
    {"time": 4.0, "event": "overflow", "mode": "speech", "lost": 3},
]


@hostile
@given(
    changes=st.lists(st.tuples(st.sampled_from([*GOOD, "more"]), NEAR_JSON), max_size=2),
    option=st.tuples(st.sampled_from(["window_s", "fusion", "stop_labels"]), NEAR_JSON) | st.none(),
    events=st.lists(
        st.tuples(st.sampled_from(EVENTS), st.sampled_from([*EVENTS[0], "for_s", "x"]), NEAR_JSON), max_size=4
    ),
)
def test_whatever_a_recording_says_it_is_replayed_or_refused(
    tmp_path: Path, changes: list[Any], option: tuple[str, Any] | None, events: list[Any]
) -> None:
    about = GOOD | {name: json.dumps(value) for name, value in changes}
    if option is not None:
        about["options"] = json.dumps({"fusion": {}} | dict([option]))
    rows = [("/hri/events", json.dumps(event | {name: value}).encode()) for event, name, value in events]
    path = made(tmp_path / "a.mcap", about, rows)
    only_hri_s_errors(lambda: list(replay(read_recording(path))))


def test_a_replay_needs_the_recognisers_and_sound_samples(words: Any, tmp_path: Path) -> None:
    events = [{"time": 0.0, "event": "listening", "mode": "speech"}, {"time": 9.0, "event": "ended", "mode": "speech"}]
    rows = [("/hri/events", json.dumps(event).encode()) for event in events]
    path = made(tmp_path / "a.mcap", GOOD, [*rows, sound_info(), timed(), heard(b"!")])
    with pytest.raises(InvalidArgument, match="recogniser of words"):
        list(replay(read_recording(path)))
    broken = [e for e in replay(read_recording(path), words) if e.event == "stall"]
    assert "samples at 0 s" in broken[0].fields["message"], "a stream that is damaged ends its mode"
    path = made(tmp_path / "b.mcap", GOOD, [*rows, sound_info(), timed(), heard(), timed(sequence=7), heard()])
    with pytest.raises(FormatError, match="message 1 has no times"):
        list(replay(read_recording(path), words))


def test_memory_does_not_grow_with_the_recording(tmp_path: Path) -> None:
    block = bytes(320_000)  # 10 s
    tick = ("/hri/events", b'{"time": 0.0, "event": "tick", "mode": "session"}')

    def peak_bytes(num_blocks: int) -> int:
        rows = [row for number in range(num_blocks) for row in (timed(sequence=number), heard(block), tick)]
        recording = read_recording(made(tmp_path / "a.mcap", GOOD, [sound_info(sample_rate=16000), *rows]))
        tracemalloc.start()
        try:
            assert sum(len(message.data) for message in recording.sound()) == num_blocks * len(block)
            assert sum(1 for _ in recording.events()) == num_blocks
            return tracemalloc.get_traced_memory()[1]
        finally:
            tracemalloc.stop()

    peak_bytes(1)  # what is imported on the way
    few, many = peak_bytes(10), peak_bytes(80)
    assert many < 1.2 * few < 12 << 20, (few, many)


def test_a_recording_that_was_cut_is_said_to_end_early(tmp_path: Path) -> None:
    """Wherever it was cut, as by a copy that was interrupted."""
    path = made(tmp_path / "whole.mcap", GOOD, [sound_info(), timed(), heard()])
    data = path.read_bytes()
    for size in (*range(8, len(data), 37), len(data) - 1):
        (tmp_path / "cut.mcap").write_bytes(data[:size])
        with pytest.raises(FormatError, match=r"cut\.mcap: not a recorded session: the file ends early$"):
            read_all(tmp_path / "cut.mcap")
