# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""An MCAP file of a session, read whole and checked."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path
from typing import Any

from hri.core.errors import Error, FormatError
from hri.core.files import parse_json, read_bytes
from hri.core.mcap_records import mcap_records
from hri.core.optional import import_optional
from hri.fusion import FusionOptions
from hri.live import events as kinds
from hri.session.options import SessionOptions
from hri.session.recording import EVENTS, FORMAT, PCM_16, PCM_FLOAT, PICTURES, SOUND, VERSION
from hri.signal import EndpointerOptions

MAX_BYTES = 1 << 31
_MAX_RATE_HZ = 1_000_000
_MAX_CHUNK_BYTES = 1 << 27
_NUMBERS = {
    kinds.SPEECH_START: ("first_s",),
    kinds.GESTURE_START: ("first_s",),
    kinds.SIGNED: ("first_s", "last_s"),
    kinds.SIGNING: ("num_stable",),
}
"""Fields of events that a replay goes by."""


@dataclass(frozen=True)
class Message:
    """Samples or a picture: when it was in its stream, by how much that is behind, its data in base64, their format."""

    time_s: float
    offset_s: float
    data: str
    format: str
    rate: int = 0


@dataclass
class Recording:
    """What an MCAP file of a session holds.

    Attributes
    ----------
    path : Path
    options : SessionOptions
    labels : list of str
        Labels that were commands.
    models : dict of mode to str
        Which models decided.
    endpointer, segmenter : dict or None
        Their options, where they were given.
    events : list of dict
        As `Event.to_dict` gives them, in the order in which they were heeded.
    sound, pictures : dict of int to list of Message
        Of each stream, in order.
    """

    path: Path
    options: SessionOptions
    labels: list[str]
    models: dict[str, str]
    endpointer: dict[str, Any] | None
    segmenter: dict[str, Any] | None
    events: list[dict[str, Any]] = field(default_factory=list)
    sound: dict[int, list[Message]] = field(default_factory=dict)
    pictures: dict[int, list[Message]] = field(default_factory=dict)


def wrong(name: str | Path, what: str) -> FormatError:
    """The error for a file that is no recording of a session."""
    return FormatError(f"{name}: not a recorded session: {what}")


def read_recording(path: str | PathLike[str]) -> Recording:
    """Read what `McapRecorder` wrote.

    Raises
    ------
    ImportError
        Without mcap.
    IoError
        For a file that cannot be read.
    FormatError
        For another file, one that is damaged, or one that holds more than 2 GB, or more than
        128 MB in a chunk; it names the message.
    """
    import_optional("mcap", "mcap", "to read a recorded session")
    path = Path(path)
    data = read_bytes(path, MAX_BYTES)
    try:
        recording = _begun(path, _about(path, data))
        for topic, message in _messages(data):
            _add(recording, topic, parse_json(message.decode(), f"{path}: {topic}"))
    except Error:
        raise
    except Exception as error:  # the library raises many kinds for what is damaged
        raise wrong(path, f"{type(error).__name__}: {error}") from error
    return recording


def _about(path: Path, data: bytes) -> dict[str, str]:
    from mcap.records import Metadata

    for record in mcap_records(data, MAX_BYTES, _MAX_CHUNK_BYTES):
        if isinstance(record, Metadata) and record.name == FORMAT:
            return record.metadata
    raise wrong(path, "it has no metadata of a session")


def _messages(data: bytes) -> Iterator[tuple[str, bytes]]:
    """Topic and content of what a replay needs, in the order of the file."""
    from mcap.records import Channel, Message

    topics: dict[int, str] = {}
    for record in mcap_records(data, MAX_BYTES, _MAX_CHUNK_BYTES):
        if isinstance(record, Channel) and record.topic in (EVENTS, SOUND, PICTURES):
            topics[record.id] = record.topic
        elif isinstance(record, Message) and record.channel_id in topics:
            yield topics[record.channel_id], record.data


def _begun(path: Path, about: dict[str, str]) -> Recording:
    fields = {name: parse_json(value, f"{path}: {name}") for name, value in about.items()}
    if fields.get("version") != VERSION:
        raise wrong(path, f"version {fields.get('version')!r} is not {VERSION}")
    try:
        options = dict(fields["options"])
        fusion = _with_tuples(options.pop("fusion"))
        labels, models = [str(label) for label in fields["labels"]], dict(fields["models"])
        chosen = SessionOptions(**_with_tuples(options), fusion=FusionOptions(**fusion))
        if fields["endpointer"] is not None:
            EndpointerOptions(**fields["endpointer"])  # refuses what is none
        if not isinstance(fields["segmenter"], dict | None):
            raise TypeError(f"segmenter: {fields['segmenter']!r} are no options")
        return Recording(path, chosen, labels, models, fields["endpointer"], fields["segmenter"])
    except (KeyError, TypeError, ValueError) as error:
        raise wrong(path, f"its options: {error}") from error


def _with_tuples(options: dict[str, Any]) -> dict[str, Any]:
    return {name: tuple(value) if isinstance(value, list) else value for name, value in options.items()}


def _add(recording: Recording, topic: str, message: Any) -> None:
    try:
        if topic == EVENTS:
            _number(message["time"])
            if not isinstance(message["event"], str) or not isinstance(message["mode"], str):
                raise TypeError("event and mode must be text")
            if message["event"] == "motion_end" and not isinstance(message["message"], str):
                raise TypeError("message must be text")
            if message["event"] in ("motion_end", "asked"):
                _ = message["fault"] if message["event"] == "motion_end" else message["command"]
            if message["event"] == "asked" and message["command"] == "only_stop":
                _number(message["for_s"])
            for name in _NUMBERS.get(message["event"], ()):
                _number(message[name])
            if message["event"] in (kinds.SIGNED, kinds.SIGNING):
                words = message["words"]
                if not isinstance(words, list) or not all(isinstance(word, str) for word in words):
                    raise TypeError(f"words: {words!r} are no list of text")
            recording.events.append(message)
            return
        rate = message["sample_rate"] if topic == SOUND else 0
        kept = Message(
            _number(message["time_s"]), _number(message["offset_s"]), message["data"], message["format"], rate
        )
        known = (PCM_16, PCM_FLOAT) if topic == SOUND else ("png",)
        if kept.format not in known or not isinstance(kept.data, str):
            raise ValueError(f"format {kept.format!r} is none of {', '.join(known)}")
        if topic == SOUND and not (isinstance(rate, int) and 1 <= rate <= _MAX_RATE_HZ):
            raise ValueError(f"sample_rate {rate!r} must lie in 1..{_MAX_RATE_HZ}")
        stream = message["stream"]
        if not isinstance(stream, int) or stream < 0:
            raise ValueError(f"stream {stream!r} must be 0 or more")
        (recording.sound if topic == SOUND else recording.pictures).setdefault(stream, []).append(kept)
    except (KeyError, TypeError, ValueError) as error:
        raise wrong(recording.path, f"{topic}: {type(error).__name__}: {error}") from error


def _number(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise TypeError(f"{value!r} is no number")
    return float(value)
