# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A recorded session once more: the same samples and pictures in the same order give the same decisions."""

from __future__ import annotations

import time
from base64 import b64decode
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import FormatError, InvalidArgument, IoError
from hri.fusion import LearnedFusion
from hri.language import KnowledgeBase
from hri.live import Event, HandFrames, Listener
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
from hri.session.live import PASSING
from hri.session.logic import ASKED, MOTION_END, TICK, NoRobot, SessionLogic
from hri.session.reading import Message, Recording, wrong
from hri.session.recording import PCM_16, PCM_FLOAT
from hri.session.watching import watcher_of
from hri.signal import EndpointerOptions
from hri.vision.persons import Faces

REPEATED = ("fused", "state", "say", "ignored", "stop", "rest", "resumed", "sentence")
"""Events of a session that a replay repeats."""
_GIVEN = (MOTION_END, ASKED, TICK, OVERFLOW)
_SAME_S = 1e-3
_BYTES = {PCM_16: ("<i2", 32768.0), PCM_FLOAT: ("<f4", 1.0)}


def decisions(events: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Those of `events`, as `Event.to_dict` gives them, that a replay repeats."""
    return [event for event in events if event["event"] in REPEATED]


def replay(
    recording: Recording,
    words: WordRecognizer | CommandRecognizer | None = None,
    signs: GestureRecognizer | SentenceRecognizer | None = None,
    fusion: LearnedFusion | None = None,
    knowledge: KnowledgeBase | None = None,
    *,
    hands: HandFrames | None = None,
    faces: Faces | None = None,
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

    Raises
    ------
    InvalidArgument
        For a recogniser, a fusion or stored sentences that are missing, or are there and were not then.
    FormatError
        For samples or pictures that are damaged.
    """
    feeds: dict[str, Feed[Any]] = {}
    needed = (("fusion", fusion, "a learned fusion", "it"), ("knowledge", knowledge, "stored sentences", "them"))
    for name, present, what, them in needed:
        if (present is None) != (name not in recording.models):
            needs = f"with {what}, and needs {them}" if present is None else f"without {what}"
            raise InvalidArgument(f"{recording.path}: was recorded {needs}")
    if recording.sound:
        if words is None:
            raise InvalidArgument(f"{recording.path}: sound was recorded, and needs a recogniser of words")
        endpointer = None if recording.endpointer is None else EndpointerOptions(**recording.endpointer)
        stops = recording.options.fusion.stop_labels
        heard = Listener(words, endpointer, model_id=recording.models.get("speech", ""), urgent=stops)
        feeds["speech"] = Feed("speech", _Streams(recording, "speech"), heard.listen)
    if recording.pictures:
        if signs is None:
            raise InvalidArgument(f"{recording.path}: pictures were recorded, and need a recogniser of gestures")
        segmenter = (
            None if recording.segmenter is None else _segmenter_of(recording, isinstance(signs, SentenceRecognizer))
        )
        seen = watcher_of(signs, segmenter, hands, faces, recording.models.get("gesture", ""))
        feeds["gesture"] = Feed("gesture", _Streams(recording, "gesture"), seen.watch)
    logic = SessionLogic(
        recording.options,
        NoRobot(reports=False),
        recording.labels,
        fusion=fusion,
        knowledge=knowledge,
        whole_sentences=isinstance(signs, SentenceRecognizer),
    )
    streams = {mode: feed.events() for mode, feed in feeds.items()}
    for given in recording.events:
        if given["mode"] in ("session", "robot") and given["event"] not in _GIVEN:
            continue
        event = None
        if given["event"] not in _GIVEN and given["mode"] in feeds:
            event = _next(streams, feeds[given["mode"]], given)
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


def _next(streams: dict[str, Any], feed: Feed[Any], given: dict[str, Any]) -> Event | None:
    """The next event of a mode; None when its stream has ended sooner. What passed unheeded does so again."""
    while True:
        event: Event | None = next(streams[feed.mode], None)
        if event is None:
            if not (feed.lost and feed.returns(given["time"])):
                return None
            streams[feed.mode] = feed.events()
        elif event.event not in PASSING or _is(event, given):
            return event


def _is(event: Event, given: dict[str, Any]) -> bool:
    return event.event == given["event"] and abs(event.time - given["time"]) <= _SAME_S


class _Streams:
    """Opens one recorded stream of a mode after the other."""

    def __init__(self, recording: Recording, mode: str) -> None:
        self._recording = recording
        self._kind: Any = _Sound if mode == "speech" else _Pictures
        messages = recording.sound if mode == "speech" else recording.pictures
        self._left = [messages[number] for number in sorted(messages)]
        ends = [e["event"] for e in recording.events if e["mode"] == mode and e["event"] in ("ended", "stall")]
        self._stalls = ends[-1:] == ["stall"]

    def __call__(self) -> Any:
        if not self._left:
            raise IoError("nothing more was recorded")
        messages = self._left.pop(0)
        return self._kind(str(self._recording.path), messages, bool(self._left) or self._stalls)


class _Recorded:
    """What sound and pictures have in common."""

    def __init__(self, name: str, messages: list[Message], stalls: bool) -> None:
        self.name = name
        self.num_lost = 0
        self.alignment = Alignment(0.0)
        self._messages = iter(messages)
        self._stalls = stalls

    def _take(self) -> Message | None:
        message = next(self._messages, None)
        if message is None:
            if self._stalls:
                raise Stalled(f"{self.name}: the source vanished here")
            return None
        self.alignment.offset_s = message.offset_s
        return message

    def close(self) -> None:
        """What has not been read is dropped."""
        self._messages = iter(())


class _Sound(_Recorded):
    def __init__(self, name: str, messages: list[Message], stalls: bool) -> None:
        super().__init__(name, messages, stalls)
        self.sample_rate_hz = messages[0].rate

    def read(self) -> NDArray[np.float32] | None:
        message = self._take()
        if message is None:
            return None
        dtype, scale = _BYTES[message.format]
        try:
            samples = np.frombuffer(b64decode(message.data, validate=True), dtype)
        except ValueError as error:
            raise wrong(self.name, f"samples at {message.time_s:g} s: {error}") from error
        if message.rate != self.sample_rate_hz or not len(samples) or not np.isfinite(samples).all():
            raise wrong(self.name, f"samples at {message.time_s:g} s are none, or of another rate")
        return (samples / np.float32(scale)).astype(np.float32)


class _Pictures(_Recorded):
    def __init__(self, name: str, messages: list[Message], stalls: bool) -> None:
        super().__init__(name, messages, stalls)
        self.fps = max(1.0, (len(messages) - 1) / max(1e-3, messages[-1].time_s - messages[0].time_s))

    def read(self) -> TimedFrame | None:
        message = self._take()
        if message is None:
            return None
        try:
            data = b64decode(message.data, validate=True)
        except ValueError as error:
            raise wrong(self.name, f"picture at {message.time_s:g} s: {error}") from error
        if not data:
            raise FormatError(f"{self.name}: picture at {message.time_s:g} s is empty")
        return decode_image(data, self.name), message.time_s

    def reconnect(self) -> bool:
        """What was recorded comes as it came."""
        return False
