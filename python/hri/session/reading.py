# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""An MCAP file of a session, read and checked message by message: it may be larger than memory."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Collection, Generator, Iterator
from contextlib import closing
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import IO, Any, TypeVar

from hri.core.errors import Error, FormatError
from hri.core.files import parse_json, regular_file
from hri.core.mcap_records import mcap_records
from hri.core.optional import import_optional
from hri.core.ros2_messages import ENCODING, message_decoder
from hri.fusion import FusionOptions
from hri.live import events as kinds
from hri.session.options import SessionOptions
from hri.session.recording import (
    EVENTS,
    FORMAT,
    MESSAGES,
    PICTURES,
    SAMPLE_BYTES,
    SOUND,
    SOUND_INFO,
    TIMES,
    VERSION,
)
from hri.signal import EndpointerOptions

MAX_JSON_BYTES = 1 << 20
"""Of an event, or another text."""
MAX_CHUNK_BYTES = 1 << 27
"""Of a message, and of what is decompressed at once."""
_MAGIC = b"\x89MCAP0\r\n"
_MAX_RATE_HZ = 1_000_000
_NUMBERS = {
    kinds.SPEECH_START: ("first_s",),
    kinds.GESTURE_START: ("first_s",),
    kinds.SIGNED: ("first_s", "last_s"),
    kinds.SIGNING: ("num_stable",),
}
"""Fields of events that a replay goes by."""
Read = TypeVar("Read")


@dataclass(frozen=True)
class Message:
    """Samples or a picture.

    Attributes
    ----------
    stream : int
        Of the mode, from 0; it never falls.
    time_s, offset_s : float
        When it was in its stream, and by how much the session's time is ahead of that.
    data : bytes
        Samples as `format` says, or a file of a picture.
    format : str
        "S16LE", "F32LE" or "png".
    rate_hz : int
        Of samples.
    """

    stream: int
    time_s: float
    offset_s: float
    data: bytes
    format: str
    rate_hz: int = 0


@dataclass(frozen=True)
class Recording:
    """What an MCAP file of a session holds; its messages are read when they are asked for, and never all at once.

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
    """

    path: Path
    options: SessionOptions
    labels: list[str]
    models: dict[str, str]
    endpointer: dict[str, Any] | None
    segmenter: dict[str, Any] | None

    def events(self) -> Iterator[dict[str, Any]]:
        """As `Event.to_dict` gives them, in the order in which they were heeded.

        Raises
        ------
        IoError
            For a file that cannot be read any more.
        FormatError
            For one that is damaged, an event without what a replay goes by, and one of more than 1 MB.
        """
        return _reading(self.path, lambda records: _events(self.path, records))

    def sound(self) -> Iterator[Message]:
        """Samples, in order; errors as of `events`, and for more than 128 MB in a message."""
        return _reading(self.path, lambda records: _media(self.path, records, SOUND))

    def pictures(self) -> Iterator[Message]:
        """Pictures, in order; errors as of `sound`."""
        return _reading(self.path, lambda records: _media(self.path, records, PICTURES))


def wrong(name: str | Path, what: str) -> FormatError:
    """The error for a file that is no recording of a session."""
    return FormatError(f"{name}: not a recorded session: {what}")


def read_recording(path: str | PathLike[str]) -> Recording:
    """Open what `McapRecorder` wrote; its messages are checked as they are read.

    Raises
    ------
    ImportError
        Without mcap and mcap-ros2-support.
    IoError
        For a file that cannot be read.
    FormatError
        For another file, one that is damaged before its first message, and another version.
    """
    import_optional("mcap_ros2", "mcap", "to read a recorded session")
    path = Path(path)
    with closing(_reading(path, lambda records: iter([_begun(path, _about(path, records))]))) as found:
        return next(found)


def _reading(path: Path, read: Callable[[Iterator[Any]], Iterator[Read]]) -> Generator[Read, None, None]:
    """What `read` makes of the records of a file, with errors of ours."""
    with regular_file(path) as file:
        try:
            yield from read(_records(file))
        except Error:
            raise
        except Exception as error:  # the libraries raise many kinds for what is damaged
            what = "the file ends early" if _is_cut(file) else f"{type(error).__name__}: {error}"
            raise wrong(path, what) from error


def _is_cut(file: IO[bytes]) -> bool:
    """Whether a file begins as MCAP files do, and does not end as they do: by the same bytes."""
    file.seek(0)
    if file.read(len(_MAGIC)) != _MAGIC:
        return False
    size = file.seek(0, os.SEEK_END)
    file.seek(-len(_MAGIC), os.SEEK_END)
    return size < 2 * len(_MAGIC) or file.read() != _MAGIC


def _records(file: IO[bytes]) -> Iterator[Any]:
    return mcap_records(file, MAX_CHUNK_BYTES)


def _about(path: Path, records: Iterator[Any]) -> dict[str, str]:
    from mcap.records import Message, Metadata

    for record in records:
        if isinstance(record, Metadata) and record.name == FORMAT:
            return record.metadata
        if isinstance(record, Message):
            break
    raise wrong(path, "it has no metadata of a session before its messages")


def _messages(records: Iterator[Any], topics: Collection[str]) -> Iterator[tuple[str, int, bytes]]:
    """Topic, number and content of messages of these topics, in the order of the file."""
    from mcap.records import Channel, Message

    known: dict[int, str] = {}
    for record in records:
        if isinstance(record, Channel):
            encoding = ENCODING if record.topic in MESSAGES else "json"
            if record.topic in topics and record.message_encoding == encoding:
                known[record.id] = record.topic
        elif isinstance(record, Message) and record.channel_id in known:
            yield known[record.channel_id], record.sequence, record.data


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


def _events(path: Path, records: Iterator[Any]) -> Iterator[dict[str, Any]]:
    for topic, _, data in _messages(records, (EVENTS,)):
        event = _json(path, topic, data)
        try:
            _require_event(event)
        except (KeyError, TypeError) as error:
            raise wrong(path, f"{topic}: {type(error).__name__}: {error}") from error
        yield event


def _require_event(event: Any) -> None:
    """Raises KeyError or TypeError for an event without what a replay goes by."""
    _number(event["time"])
    if not isinstance(event["event"], str) or not isinstance(event["mode"], str):
        raise TypeError("event and mode must be text")
    for kind, name in (("motion_end", "message"), ("voice_start", "text")):
        if event["event"] == kind and not isinstance(event[name], str):
            raise TypeError(f"{name} must be text")
    if event["event"] in ("motion_end", "asked"):
        _ = event["fault"] if event["event"] == "motion_end" else event["command"]
    if event["event"] == "asked" and event["command"] == "only_stop":
        _number(event["for_s"])
    for name in _NUMBERS.get(event["event"], ()):
        _number(event[name])
    if event["event"] in (kinds.SIGNED, kinds.SIGNING):
        words = event["words"]
        if not isinstance(words, list) or not all(isinstance(word, str) for word in words):
            raise TypeError(f"words: {words!r} are no list of text")


def _media(path: Path, records: Iterator[Any], topic: str) -> Iterator[Message]:
    """Messages of sound or pictures, each by the times before it; of sound also by what was said of it last."""
    info, timing, last_stream = None, None, 0
    decode_info, decode = message_decoder(MESSAGES[SOUND_INFO]), message_decoder(MESSAGES[topic])
    topics = (TIMES, SOUND, SOUND_INFO) if topic == SOUND else (TIMES, PICTURES)
    for name, sequence, data in _messages(records, topics):
        try:
            if name == TIMES:
                times = _json(path, name, data)
                timing = times if times["topic"] == topic else timing
            elif name == SOUND_INFO:
                info = _info(decode_info(data))
            else:
                kept = _message(topic, decode(data), timing, sequence, info)
                if kept.stream < last_stream:
                    raise ValueError(f"stream {kept.stream} comes after {last_stream}")
                timing, last_stream = None, kept.stream
                yield kept
        except Error:
            raise
        except Exception as error:  # the library raises many kinds for what is damaged
            raise wrong(path, f"{name}: {type(error).__name__}: {error}") from error


def _info(decoded: Any) -> tuple[str, int]:
    """Format and rate of samples. Raises ValueError."""
    if decoded.sample_format not in SAMPLE_BYTES or decoded.channels != 1:
        known = " or ".join(SAMPLE_BYTES)
        raise ValueError(f"{decoded.channels} x {decoded.sample_format!r} must be 1 x {known}")
    if not 1 <= decoded.sample_rate <= _MAX_RATE_HZ:
        raise ValueError(f"sample_rate {decoded.sample_rate} must lie in 1..{_MAX_RATE_HZ}")
    return decoded.sample_format, decoded.sample_rate


def _message(topic: str, decoded: Any, timing: Any, sequence: int, info: tuple[str, int] | None) -> Message:
    if timing is None or timing["sequence"] != sequence:
        raise ValueError(f"message {sequence} has no times before it")
    stream = timing["stream"]
    if type(stream) is not int or stream < 0:
        raise ValueError(f"stream {stream!r} must be 0 or more")
    times = (stream, _number(timing["time_s"]), _number(timing["offset_s"]))
    if topic == PICTURES:
        if decoded.format != "png":
            raise ValueError(f"format {decoded.format!r} is not png")
        return Message(*times, decoded.data, decoded.format)
    if info is None:
        raise ValueError(f"message {sequence} has no {SOUND_INFO} before it")
    return Message(*times, decoded.data, *info)


def _json(path: Path, topic: str, data: bytes) -> Any:
    if len(data) > MAX_JSON_BYTES:
        raise wrong(path, f"{topic}: a message of {len(data)} bytes; {MAX_JSON_BYTES} at most")
    return parse_json(data.decode(), f"{path}: {topic}")


def _number(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise TypeError(f"{value!r} is no number")
    return float(value)
