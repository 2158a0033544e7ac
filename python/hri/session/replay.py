# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A recorded session once more: the same samples and pictures in the same order give the same decisions."""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import Error, FormatError, InvalidArgument, IoError
from hri.fusion import LearnedFusion
from hri.language import KnowledgeBase
from hri.live import Event, HandFrames
from hri.live.events import OVERFLOW
from hri.live.frames import TimedFrame
from hri.live.sources import Stalled
from hri.media import decode_image
from hri.recognition import (
    CommandRecognizer,
    GestureRecognizer,
    GestureSegmenterOptions,
    SentenceRecognizer,
    SentenceStreamOptions,
    WordRecognizer,
)
from hri.session.feeds import Alignment, Arrival, Feed
from hri.session.hearing import listener_of
from hri.session.live import PASSING
from hri.session.logic import ASKED, MOTION_END, TICK, NoRobot, SessionLogic
from hri.session.reading import Message, Recording, wrong
from hri.session.recording import SAMPLE_BYTES
from hri.session.voice import VOICE_END, VOICE_START
from hri.session.watching import watcher_of
from hri.signal import EndpointerOptions
from hri.vision.persons import Faces

REPEATED = ("fused", "state", "say", "ignored", "stop", "rest", "resumed", "sentence")
"""Events of a session that a replay repeats."""
_GIVEN = (MOTION_END, ASKED, TICK, OVERFLOW, VOICE_START, VOICE_END)
_SAME_S = 1e-3
_FPS = 15.0
"""What "watching" reports; nothing is decided by it."""


def decisions(events: Iterable[dict[str, Any]]) -> list[dict[str, Any]]:
    """Those of `events`, as `Event.to_dict` gives them, that a replay repeats."""
    return [event for event in events if is_repeated(event)]


def is_repeated(event: dict[str, Any]) -> bool:
    """Whether a replay repeats an event, as `Event.to_dict` gives it."""
    return event["event"] in REPEATED


def replay(
    recording: Recording,
    words: WordRecognizer | CommandRecognizer | None = None,
    signs: GestureRecognizer | SentenceRecognizer | None = None,
    fusion: LearnedFusion | None = None,
    knowledge: KnowledgeBase | None = None,
    *,
    hands: HandFrames | None = None,
    faces: Faces | None = None,
    model_ids: Mapping[str, str] | None = None,
) -> Iterator[Event]:
    """The events of a recorded session, recognised and decided on anew; no robot moves.

    What came from outside the streams, as that a motion ended or a person asked for something, comes as recorded.

    Parameters
    ----------
    recording : Recording
    words, signs : recogniser, optional
        Needed where sound or pictures were recorded.
    fusion : LearnedFusion, optional
        Needed where one decided.
    knowledge : KnowledgeBase, optional
        Needed where sentences were looked up in one.
    hands : HandFrames, optional
    faces : FaceFinder, optional
        As of `Session`, both.
    model_ids : mapping of mode to str, optional
        Names of the models that are given, which their events carry; without it those of the recording.

    Raises
    ------
    InvalidArgument
        For a recogniser, a fusion or stored sentences that are missing, or are there and were not then.
    FormatError
        For what is damaged, when it is reached; samples and pictures that cannot be decoded end their mode.
    """
    feeds: dict[str, Feed[Any]] = {}
    ids = recording.models if model_ids is None else model_ids
    needed = (("fusion", fusion, "a learned fusion", "it"), ("knowledge", knowledge, "stored sentences", "them"))
    for name, present, what, them in needed:
        if (present is None) != (name not in recording.models):
            needs = f"with {what}, and needs {them}" if present is None else f"without {what}"
            raise InvalidArgument(f"{recording.path}: was recorded {needs}")
    sound, pictures = _Streams(recording, "speech"), _Streams(recording, "gesture")
    if sound:
        if words is None:
            raise InvalidArgument(f"{recording.path}: sound was recorded, and needs a recogniser of words")
        endpointer = None if recording.endpointer is None else EndpointerOptions(**recording.endpointer)
        heard = listener_of(words, endpointer, recording.options, ids.get("speech", ""))
        feeds["speech"] = Feed("speech", sound, heard.listen)
    if pictures:
        if signs is None:
            raise InvalidArgument(f"{recording.path}: pictures were recorded, and need a recogniser of gestures")
        segmenter = (
            None if recording.segmenter is None else _segmenter_of(recording, isinstance(signs, SentenceRecognizer))
        )
        seen = watcher_of(signs, segmenter, hands, faces, ids.get("gesture", ""))
        feeds["gesture"] = Feed("gesture", pictures, seen.watch)
    logic = SessionLogic(
        recording.options,
        NoRobot(reports=False),
        recording.labels,
        fusion=fusion,
        knowledge=knowledge,
        whole_sentences=isinstance(signs, SentenceRecognizer),
    )
    streams = {mode: feed.events() for mode, feed in feeds.items()}
    early: dict[str, Event] = {}
    recorded = {"speech": sound, "gesture": pictures}
    for given in recording.events():
        if given["mode"] in ("session", "robot") and given["event"] not in _GIVEN:
            continue
        event = None
        if given["event"] not in _GIVEN and given["mode"] in feeds:
            event = _next(streams, early, feeds[given["mode"]], given)
            failure = recorded[given["mode"]].failure
            if failure is not None:  # which a feed makes a stall of
                raise failure
            if event is not None and "near" in event.fields and "near" not in given:  # recorded before there was any
                event = replace(event, fields={k: v for k, v in event.fields.items() if k != "near"})
        yield from logic.process(Arrival(event or as_event(given), time.perf_counter()))


def _segmenter_of(recording: Recording, of_sentences: bool) -> GestureSegmenterOptions | SentenceStreamOptions:
    """Raises InvalidArgument where the model is of another kind than the recorded one."""
    kind = SentenceStreamOptions if of_sentences else GestureSegmenterOptions
    try:
        return kind(**(recording.segmenter or {}))
    except TypeError as error:
        raise InvalidArgument(f"{recording.path}: was recorded with another kind of signs: {error}") from error


def as_event(given: dict[str, Any]) -> Event:
    """A recorded event, without its decision."""
    fields = {name: value for name, value in given.items() if name not in ("time", "event", "mode")}
    return Event(given["time"], given["event"], fields, mode=given["mode"])


def _next(streams: dict[str, Any], early: dict[str, Event], feed: Feed[Any], given: dict[str, Any]) -> Event | None:
    """The next event of a mode; None where that is no such event that passes, and when its stream has ended sooner.

    What passed unheeded does so again. Other models may decide earlier or later among events that pass: what comes in
    place of one of these is kept in `early` for the next that does not pass.
    """
    while True:
        event: Event | None = early.pop(feed.mode, None) or next(streams[feed.mode], None)
        if event is None:
            if not (feed.lost and feed.returns(given["time"])):
                return None
            streams[feed.mode] = feed.events()
        elif event.event not in PASSING and given["event"] in PASSING:
            early[feed.mode] = event
            return None
        elif event.event not in PASSING or _is(event, given):
            return event


def _is(event: Event, given: dict[str, Any]) -> bool:
    return event.event == given["event"] and abs(event.time - given["time"]) <= _SAME_S


class _Streams:
    """Opens one recorded stream of a mode after the other; false where none was recorded."""

    def __init__(self, recording: Recording, mode: str) -> None:
        self._recording, self._mode = recording, mode
        self._kind: Any = _Sound if mode == "speech" else _Pictures
        self._messages = recording.sound() if mode == "speech" else recording.pictures()
        self._ahead: Message | None = next(self._messages, None)
        self._opened = -1
        self.failure: Error | None = None
        """Why nothing more can be read."""

    def __bool__(self) -> bool:
        return self._ahead is not None

    def __call__(self) -> Any:
        while self.take(self._opened) is not None:
            pass  # what of the last one was not read
        if self._ahead is None:
            raise IoError("nothing more was recorded")
        self._opened = self._ahead.stream
        return self._kind(str(self._recording.path), self, self._ahead)

    def take(self, stream: int) -> Message | None:
        """The next message of a stream; None at its end."""
        message = self._ahead
        if message is None or message.stream != stream:
            return None
        try:
            self._ahead = next(self._messages, None)
        except Error as error:
            self._ahead, self.failure = None, error
            raise
        return message

    def stalls(self) -> bool:
        """Whether the stream that is over vanished: another one followed, or the session said so."""
        if self._ahead is not None:
            return True
        last = ""
        for event in self._recording.events():
            if event["mode"] == self._mode and event["event"] in ("ended", "stall"):
                last = event["event"]
        return last == "stall"


class _Recorded:
    """What sound and pictures have in common."""

    def __init__(self, name: str, streams: _Streams, first: Message) -> None:
        self.name = name
        self.num_lost = 0
        self.alignment = Alignment(0.0)
        self._streams = streams
        self._stream = first.stream
        self._closed = False

    def _take(self) -> Message | None:
        if self._closed:
            return None
        message = self._streams.take(self._stream)
        if message is None:
            if self._streams.stalls():
                raise Stalled(f"{self.name}: the source vanished here")
            return None
        self.alignment.offset_s = message.offset_s
        return message

    def close(self) -> None:
        """What has not been read is dropped."""
        self._closed = True


class _Sound(_Recorded):
    def __init__(self, name: str, streams: _Streams, first: Message) -> None:
        super().__init__(name, streams, first)
        self.sample_rate_hz = first.rate_hz

    def read(self) -> NDArray[np.float32] | None:
        message = self._take()
        if message is None:
            return None
        dtype, scale = SAMPLE_BYTES[message.format]
        try:
            samples = np.frombuffer(message.data, dtype)
        except ValueError as error:
            raise wrong(self.name, f"samples at {message.time_s:g} s: {error}") from error
        if message.rate_hz != self.sample_rate_hz or not len(samples) or not np.isfinite(samples).all():
            raise wrong(self.name, f"samples at {message.time_s:g} s are none, or of another rate")
        return (samples / np.float32(scale)).astype(np.float32)


class _Pictures(_Recorded):
    fps = _FPS

    def read(self) -> TimedFrame | None:
        message = self._take()
        if message is None:
            return None
        if not message.data:
            raise FormatError(f"{self.name}: picture at {message.time_s:g} s is empty")
        return decode_image(message.data, self.name), message.time_s

    def reconnect(self) -> bool:
        """What was recorded comes as it came."""
        return False
