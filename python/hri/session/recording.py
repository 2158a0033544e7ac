# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A session as an MCAP file, by the packages of the extra "mcap": what was heard, seen, decided and moved.

Sound, pictures, joints and motions are messages of ROS 2 in CDR, events and times our own in JSON (docs/session.md).
Samples and pictures are kept without loss, so that a replay decides as the session did.
"""

from __future__ import annotations

import json
import threading
from collections.abc import Callable, Mapping
from contextlib import ExitStack, suppress
from os import PathLike, fspath
from pathlib import Path
from typing import IO, Any, cast

import numpy as np

from hri.core.errors import InvalidArgument
from hri.core.files import AtomicFile, atomic_file
from hri.core.optional import import_optional
from hri.core.ros2_messages import (
    DEFINITIONS,
    ENCODING,
    SCHEMA_ENCODING,
    message_definition,
    message_encoder,
    message_type,
)
from hri.live import Event
from hri.live.events import json_line
from hri.media import encode_png
from hri.robot import Trajectory, joint_trajectory_message
from hri.session.event_schema import EVENT, TIMING, event_schema, timing_schema

FORMAT = "hri.session"
VERSION = 2
EVENTS, TIMES = "/hri/events", "/hri/times"
SOUND, SOUND_INFO, PICTURES = "/hri/sound", "/hri/sound_info", "/hri/pictures"
JOINTS, MOTIONS = "/hri/joint_states", "/hri/joint_trajectory"
MESSAGES = {
    SOUND: "audio_common_msgs/AudioData",
    SOUND_INFO: "audio_common_msgs/AudioInfo",
    PICTURES: "sensor_msgs/CompressedImage",
    JOINTS: "sensor_msgs/JointState",
    MOTIONS: "trajectory_msgs/JointTrajectory",
}
"""Of ROS 2, by topic; the other topics hold JSON."""
SAMPLE_BYTES = {"S16LE": ("<i2", 32768.0), "F32LE": ("<f4", 1.0)}
"""How samples are kept, and what they are divided by."""
BASE, CAMERA = "base_link", "camera_optical"
"""Frames: the robot's base (x forward, y to the left, z up), and the camera's picture (z forward, x right, y down)."""
_EXACT, _FLOAT = SAMPLE_BYTES
_JOINT_PERIOD_S = 0.02


class McapRecorder:
    """Writes a session; the file appears whole when the session is over.

    What cannot be written (a full disk) ends the recording and not the session: `failure` says why, no file appears.

    Parameters
    ----------
    path : path-like
        An existing file is replaced.

    Raises
    ------
    ImportError
        Without mcap and mcap-ros2-support.
    """

    def __init__(self, path: str | PathLike[str]) -> None:
        self._mcap = import_optional("mcap.writer", "mcap", "to record a session")
        self._encoders = {topic: message_encoder(name) for topic, name in MESSAGES.items()}
        self._path = Path(path)
        self._lock = threading.Lock()
        self._busy = False
        self._writer: Any = None
        self._stack = ExitStack()
        self._channels: dict[str, int] = {}
        self._sequences: dict[str, int] = {}
        self._joints_at_s = -1.0
        self._info: tuple[int, int, str] | None = None
        self.failure = ""
        """Why nothing more is recorded."""

    def begin(self, about: Mapping[str, Any]) -> None:
        """Open the file, and keep what a replay needs to know; as values that JSON holds.

        Raises
        ------
        InvalidArgument
            While another session is being recorded.
        IoError
            For a place that cannot be written.
        """
        with self._lock:
            if self._busy:
                raise InvalidArgument(f"{fspath(self._path)}: another session is being recorded by this recorder")
            self._busy, self.failure, self._joints_at_s, self._info = True, "", -1.0, None
            try:
                file = self._stack.enter_context(atomic_file(self._path))
                out = cast(IO[Any], _Counted(file))
                self._writer = self._mcap.Writer(out, compression=self._mcap.CompressionType.LZ4)
                self._writer.start(profile="", library="libhri")
                facts = {name: json.dumps(value) for name, value in {"version": VERSION, **about}.items()}
                self._writer.add_metadata(FORMAT, facts)
                self._channels = self._registered()
                self._sequences = dict.fromkeys(self._channels, 0)
            except BaseException as error:
                self._abandon(error)
                self._busy = False
                raise

    def end(self) -> None:
        """Give the file its name. Raises IoError when that fails."""
        with self._lock:
            self._busy = False
            writer, self._writer = self._writer, None
            if writer is None:
                return
            with self._stack.pop_all():
                writer.finish()

    def event(self, event: Event) -> None:
        """Keep an event."""
        self._write(event.time, lambda: [(EVENTS, event.to_dict())])

    def sound(self, samples: Any, sample_rate_hz: int, stream_s: float, offset_s: float, stream: int) -> None:
        """Keep samples, as 16-bit numbers where these are the same as all of the stream so far."""

        def messages() -> list[tuple[str, Mapping[str, Any]]]:
            whole = np.asarray(samples, np.float32) * np.float32(32768)
            exact = bool((whole == np.rint(whole)).all() and (np.abs(whole + 0.5) < 32768).all())
            if self._info is not None and self._info[0] == stream:
                exact = exact and self._info[2] == _EXACT
            form = _EXACT if exact else _FLOAT
            data = whole.astype("<i2") if exact else np.asarray(samples, "<f4")
            made: list[tuple[str, Mapping[str, Any]]] = []
            if self._info != (stream, sample_rate_hz, form):
                self._info = (stream, sample_rate_hz, form)
                made.append((SOUND_INFO, _sound_info(sample_rate_hz, form, data.itemsize)))
            return [*made, self._timing(SOUND, stream_s, offset_s, stream), (SOUND, {"data": data.tobytes()})]

        self._write(stream_s + offset_s, messages)

    def picture(self, frame: Any, stream_s: float, offset_s: float, stream: int) -> None:
        """Keep a picture, as PNG."""
        data = encode_png(frame)  # which takes its time, beside what others write
        header = _header(stream_s + offset_s, CAMERA)
        self._write(
            stream_s + offset_s,
            lambda: [
                self._timing(PICTURES, stream_s, offset_s, stream),
                (PICTURES, {"header": header, "format": "png", "data": data}),
            ],
        )

    def joints(self, time_s: float, positions_rad: Mapping[str, float]) -> None:
        """Keep where joints are sent, 50 times a second at most."""
        if self._joints_at_s <= time_s < self._joints_at_s + _JOINT_PERIOD_S - 1e-9:
            return
        self._joints_at_s = time_s
        fields = {"name": list(positions_rad), "position": [float(value) for value in positions_rad.values()]}
        self._write(time_s, lambda: [(JOINTS, {"header": _header(time_s, BASE), **fields})])

    def motion(self, time_s: float, label: str, trajectory: Trajectory) -> None:
        """Keep a motion that begins; the event "motion_start" before it has its label."""
        self._write(
            time_s, lambda: [(MOTIONS, {**joint_trajectory_message(trajectory), "header": _header(time_s, BASE)})]
        )

    def _registered(self) -> dict[str, int]:
        """Channels by topic."""
        schemas = {topic: _ros2_schema(name) for topic, name in MESSAGES.items()}
        for topic, name, schema in ((EVENTS, EVENT, event_schema()), (TIMES, TIMING, timing_schema())):
            schemas[topic] = ("json", name, "jsonschema", json.dumps(schema).encode())
        channels = {}
        for topic, (encoding, name, schema_encoding, text) in schemas.items():
            number = self._writer.register_schema(name, schema_encoding, text)
            channels[topic] = self._writer.register_channel(topic, encoding, number)
        return channels

    def _timing(self, topic: str, stream_s: float, offset_s: float, stream: int) -> tuple[str, Mapping[str, Any]]:
        """When the next message of a topic was in its stream."""
        times = {"stream": stream, "time_s": stream_s, "offset_s": offset_s}
        return TIMES, {"topic": topic, "sequence": self._sequences[topic], **times}

    def _write(self, time_s: float, messages: Callable[[], list[tuple[str, Mapping[str, Any]]]]) -> None:
        """Write messages one right after the other."""
        time_ns = round(max(0.0, time_s) * 1e9)
        with self._lock:
            if self._writer is None:
                return
            try:
                for topic, message in messages():
                    encode = self._encoders.get(topic, _json_of)
                    sequence = self._sequences[topic]
                    self._writer.add_message(self._channels[topic], time_ns, encode(message), time_ns, sequence)
                    self._sequences[topic] = sequence + 1
            except Exception as error:  # whatever a full disk makes of it: what listens for STOP goes on
                self._abandon(error)

    def _abandon(self, error: BaseException) -> None:
        """Leave no file behind."""
        self._writer, self.failure = None, str(error) or type(error).__name__
        with suppress(BaseException), self._stack.pop_all():
            raise error


class _Counted:
    """What a writer of MCAP needs of a file."""

    def __init__(self, file: AtomicFile) -> None:
        self._file = file
        self._num_bytes = 0

    def write(self, data: bytes) -> int:
        self._file.write(bytes(data))
        self._num_bytes += len(data)
        return len(data)

    def tell(self) -> int:
        return self._num_bytes

    def flush(self) -> None:
        """Do nothing: every write goes to the file."""


def _ros2_schema(name: str) -> tuple[str, str, str, bytes]:
    return ENCODING, message_type(name), SCHEMA_ENCODING, message_definition(DEFINITIONS[name]).encode()


def _json_of(message: Mapping[str, Any]) -> bytes:
    return json_line(message).encode("utf-8")


def _sound_info(rate_hz: int, form: str, sample_bytes: int) -> dict[str, Any]:
    bits = 8 * sample_bytes * rate_hz
    return {"channels": 1, "sample_rate": rate_hz, "sample_format": form, "bitrate": bits, "coding_format": "wave"}


def _header(time_s: float, frame: str) -> dict[str, Any]:
    time_ns = round(max(0.0, time_s) * 1e9)
    return {"stamp": {"sec": time_ns // 10**9, "nanosec": time_ns % 10**9}, "frame_id": frame}
