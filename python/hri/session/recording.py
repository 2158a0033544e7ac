# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A session as an MCAP file, by the package mcap (the extra "mcap"): what was heard, seen, decided and moved.

Messages are JSON. Sound and pictures have the schemas of Foxglove, joints and motions those of ROS, events our own
(docs/session.md). Samples and pictures are kept without loss, so that a replay decides as the session did.
"""

from __future__ import annotations

import json
import threading
from base64 import b64encode
from collections.abc import Mapping
from contextlib import ExitStack, suppress
from os import PathLike, fspath
from pathlib import Path
from typing import IO, Any, cast

import numpy as np

from hri.core.errors import InvalidArgument
from hri.core.files import AtomicFile, atomic_file
from hri.core.optional import import_optional
from hri.live import Event
from hri.media import encode_png
from hri.robot import Trajectory

FORMAT = "hri.session"
VERSION = 1
EVENTS, SOUND, PICTURES = "/hri/events", "/hri/sound", "/hri/pictures"
JOINTS, MOTIONS = "/hri/joint_states", "/hri/joint_trajectory"
SCHEMAS = {
    EVENTS: "hri.Event",
    SOUND: "foxglove.RawAudio",
    PICTURES: "foxglove.CompressedImage",
    JOINTS: "sensor_msgs/JointState",
    MOTIONS: "trajectory_msgs/JointTrajectory",
}
PCM_16, PCM_FLOAT = "pcm-s16", "pcm-f32"
_JOINT_PERIOD_S = 0.02
_TIME = {"type": "object", "properties": {"sec": {"type": "integer"}, "nsec": {"type": "integer"}}}
_NUMBERS = {"type": "array", "items": {"type": "number"}}
_NAMES = {"type": "array", "items": {"type": "string"}}
_BYTES = {"type": "string", "contentEncoding": "base64"}
_FIELDS: dict[str, dict[str, Any]] = {
    EVENTS: {"time": {"type": "number"}, "event": {"type": "string"}, "mode": {"type": "string"}},
    SOUND: {
        "timestamp": _TIME,
        "data": _BYTES,
        "format": {"type": "string"},
        "sample_rate": {"type": "integer"},
        "number_of_channels": {"type": "integer"},
        "time_s": {"type": "number"},
        "offset_s": {"type": "number"},
        "stream": {"type": "integer"},
    },
    PICTURES: {
        "timestamp": _TIME,
        "frame_id": {"type": "string"},
        "data": _BYTES,
        "format": {"type": "string"},
        "time_s": {"type": "number"},
        "offset_s": {"type": "number"},
        "stream": {"type": "integer"},
    },
    JOINTS: {"header": {"type": "object"}, "name": _NAMES, "position": _NUMBERS},
    MOTIONS: {
        "header": {"type": "object"},
        "joint_names": _NAMES,
        "points": {
            "type": "array",
            "items": {"type": "object", "properties": {"positions": _NUMBERS, "time_from_start": _TIME}},
        },
    },
}


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
        Without mcap.
    """

    def __init__(self, path: str | PathLike[str]) -> None:
        self._mcap = import_optional("mcap.writer", "mcap", "to record a session")
        self._path = Path(path)
        self._lock = threading.Lock()
        self._busy = False
        self._writer: Any = None
        self._stack = ExitStack()
        self._channels: dict[str, int] = {}
        self._sequences = dict.fromkeys(SCHEMAS, 0)
        self._joints_at_s = -1.0
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
            self._busy, self.failure, self._joints_at_s = True, "", -1.0
            self._sequences = dict.fromkeys(SCHEMAS, 0)
            try:
                file = self._stack.enter_context(atomic_file(self._path))
                out = cast(IO[Any], _Counted(file))
                self._writer = self._mcap.Writer(out, compression=self._mcap.CompressionType.LZ4)
                self._writer.start(profile="", library="libhri")
                facts = {name: json.dumps(value) for name, value in {"version": VERSION, **about}.items()}
                self._writer.add_metadata(FORMAT, facts)
                for topic, schema in SCHEMAS.items():
                    properties = {"title": schema, "type": "object", "properties": _FIELDS[topic]}
                    number = self._writer.register_schema(schema, "jsonschema", json.dumps(properties).encode())
                    self._channels[topic] = self._writer.register_channel(topic, "json", number)
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
        self._write(EVENTS, event.time, event.to_dict())

    def sound(self, samples: Any, sample_rate_hz: int, stream_s: float, offset_s: float, stream: int) -> None:
        """Keep samples, as 16-bit numbers where these are the same."""
        whole = np.asarray(samples, np.float32) * np.float32(32768)
        exact = bool((whole == np.rint(whole)).all() and (np.abs(whole + 0.5) < 32768).all())
        data = whole.astype("<i2") if exact else np.asarray(samples, "<f4")
        message = {
            "timestamp": _stamp(stream_s + offset_s),
            "data": b64encode(data.tobytes()).decode(),
            "format": PCM_16 if exact else PCM_FLOAT,
            "sample_rate": sample_rate_hz,
            "number_of_channels": 1,
            "time_s": stream_s,
            "offset_s": offset_s,
            "stream": stream,
        }
        self._write(SOUND, stream_s + offset_s, message)

    def picture(self, frame: Any, stream_s: float, offset_s: float, stream: int) -> None:
        """Keep a picture, as PNG."""
        message = {
            "timestamp": _stamp(stream_s + offset_s),
            "frame_id": "camera",
            "data": b64encode(encode_png(frame)).decode(),
            "format": "png",
            "time_s": stream_s,
            "offset_s": offset_s,
            "stream": stream,
        }
        self._write(PICTURES, stream_s + offset_s, message)

    def joints(self, time_s: float, positions_rad: Mapping[str, float]) -> None:
        """Keep where joints are sent, 50 times a second at most."""
        if self._joints_at_s <= time_s < self._joints_at_s + _JOINT_PERIOD_S - 1e-9:
            return
        self._joints_at_s = time_s
        names, positions = list(positions_rad), list(positions_rad.values())
        self._write(JOINTS, time_s, {"header": _header(time_s), "name": names, "position": positions})

    def motion(self, time_s: float, label: str, trajectory: Trajectory) -> None:
        """Keep a motion that begins; the frame of its header names it."""
        points = [
            {"positions": row, "time_from_start": _stamp(i * trajectory.period_s)}
            for i, row in enumerate(trajectory.positions_rad.tolist())
        ]
        names = list(trajectory.joint_names)
        self._write(MOTIONS, time_s, {"header": _header(time_s, label), "joint_names": names, "points": points})

    def _write(self, topic: str, time_s: float, message: dict[str, Any]) -> None:
        data = json.dumps(message, ensure_ascii=False).encode("utf-8", "backslashreplace")
        time_ns = round(max(0.0, time_s) * 1e9)
        with self._lock:
            if self._writer is None:
                return
            try:
                sequence = self._sequences[topic]
                self._writer.add_message(self._channels[topic], time_ns, data, time_ns, sequence)
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


def _stamp(time_s: float) -> dict[str, int]:
    time_ns = round(max(0.0, time_s) * 1e9)
    return {"sec": time_ns // 10**9, "nsec": time_ns % 10**9}


def _header(time_s: float, frame: str = "") -> dict[str, Any]:
    return {"stamp": _stamp(time_s), "frame_id": frame}
