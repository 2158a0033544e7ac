# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The events of each mode in one time, the session's, from sources that may vanish and come back."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Generator, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from typing import Any, Generic, Protocol, TypeVar

from hri.core.errors import Error, IoError
from hri.core.phrases import phrase, phrase_of
from hri.live import AudioSource, Event, FrameSource
from hri.live.events import ENDED, RECONNECTED, STALL
from hri.live.frames import TimedFrame
from hri.live.sources import Stalled
from hri.robot import Trajectory

LEAK = 5e-4
"""By how much of a second the clock of a sound card or a camera may lose against the computer's in a second."""
_GAP_S = 0.3
"""Shorter gaps that nothing counts pass for delays."""
_GAP_SPAN_S, _STEADY_S = 1.25, 0.1
"""The least delays of two such spans may differ by so much after a gap."""
_TIMES = ("first_s", "last_s")

_in_use: set[int] = set()
"""Sources that a feed reads, by identity: two readers would each get a part of what comes."""
_taking = threading.Lock()

Clock = Callable[[], float]
Source = TypeVar("Source", AudioSource, FrameSource)


class Recorder(Protocol):
    """Keeps what a session hears, sees and does; called by several threads."""

    def sound(self, samples: Any, sample_rate_hz: int, stream_s: float, offset_s: float, stream: int) -> None:
        """Samples, when the first was in the stream of this number, and by how much its clock is behind."""
        ...

    def picture(self, frame: Any, stream_s: float, offset_s: float, stream: int) -> None:
        """A picture and its time in the stream."""
        ...


class SessionRecorder(Recorder, Protocol):
    """Keeps a session; called by several threads."""

    def begin(self, about: Mapping[str, Any]) -> None:
        """A session begins; what a replay needs to know of it. Raises InvalidArgument while another one is recorded."""
        ...

    def event(self, event: Event) -> None:
        """What happened, in the order in which it was heeded."""
        ...

    def joints(self, time_s: float, positions_rad: Mapping[str, float]) -> None:
        """Where the joints are sent."""
        ...

    def motion(self, time_s: float, label: str, trajectory: Trajectory) -> None:
        """A motion begins."""
        ...

    def end(self) -> None:
        """The session is over."""
        ...


@dataclass
class Alignment:
    """By how much the session's time is ahead of a stream's.

    What comes from a device comes late, by more or less: the least delay seen is the offset. It may grow by `LEAK`, as
    clocks differ, and grows with what was lost, which the stream's clock does not count. What was lost and not counted,
    as by a driver, shows in delays that are longer from then on, and do not change: then it becomes the least of these.
    Where this computer is late, delays fall again as it makes up for it.
    """

    offset_s: float
    clock: Clock | None = None
    _least_s: float = field(default=math.inf, init=False, repr=False)
    _before_s: float = field(default=math.inf, init=False, repr=False)
    _since_s: float = field(default=math.inf, init=False, repr=False)

    def note(self, stream_s: float, passed_s: float, lost_s: float = 0.0) -> None:
        """Something with this time in the stream has come, so much after what came before it."""
        if self.clock is None:
            return
        now_s = self.clock()
        delay_s = now_s - stream_s
        self.offset_s = min(self.offset_s + LEAK * passed_s + lost_s, delay_s)
        self._since_s = min(self._since_s, now_s)
        self._least_s = min(self._least_s, delay_s)
        if now_s - self._since_s >= _GAP_SPAN_S:
            steady = abs(self._least_s - self._before_s) < _STEADY_S
            if steady and min(self._least_s, self._before_s) > self.offset_s + _GAP_S:
                self.offset_s = min(self._least_s, self._before_s)
            self._before_s, self._least_s, self._since_s = self._least_s, math.inf, math.inf


class _SizeChanged(Stalled):
    """Pictures have another size than those before; the source goes on."""


class TappedSound:
    """A source of sound whose samples are timed, and recorded, as they are read."""

    def __init__(self, source: AudioSource, alignment: Alignment, recorder: Recorder | None, stream: int) -> None:
        self.name, self.sample_rate_hz = source.name, source.sample_rate_hz
        self.alignment = alignment
        self._source = source
        self._recorder = recorder
        self._stream = stream
        self._num_samples = 0
        self._num_lost = 0

    @property
    def num_lost(self) -> int:
        """As of the source."""
        return self._source.num_lost

    def read(self) -> Any:
        """As of the source."""
        samples = self._source.read()
        if samples is not None:
            rate = self.sample_rate_hz
            lost, self._num_lost = self._source.num_lost - self._num_lost, self._source.num_lost
            self._num_samples += len(samples)
            self.alignment.note(self._num_samples / rate, len(samples) / rate, lost / rate)
            if self._recorder is not None:
                first_s = (self._num_samples - len(samples)) / rate
                self._recorder.sound(samples, rate, first_s, self.alignment.offset_s, self._stream)
        return samples

    def close(self) -> None:
        """As of the source."""
        self._source.close()


class TappedPictures:
    """A source of pictures that are timed, and recorded, as they are read; between two stalls they are of one size."""

    def __init__(self, source: FrameSource, alignment: Alignment, recorder: Recorder | None, stream: int) -> None:
        self.name, self.fps = source.name, source.fps
        self.alignment = alignment
        self._source = source
        self._recorder = recorder
        self._stream = stream
        self._last_s = 0.0
        self._shape: tuple[int, ...] | None = None
        self._first: TimedFrame | None = None

    @property
    def num_lost(self) -> int:
        """As of the source."""
        return self._source.num_lost

    def read(self) -> TimedFrame | None:
        """As of the source. Raises Stalled where the size changes, and goes on with the first of another size."""
        first, self._first = self._first, None
        if first is not None:
            return first
        timed = self._source.read()
        if timed is None:
            return None
        frame, time_s = timed
        self.alignment.note(time_s, time_s - self._last_s)
        self._last_s = time_s
        if self._recorder is not None:
            self._recorder.picture(frame, time_s, self.alignment.offset_s, self._stream)
        before, self._shape = self._shape, frame.shape
        if before is not None and before != frame.shape:
            self._first = timed
            sizes = [f"{shape[1]} x {shape[0]}" for shape in (before, frame.shape)]
            raise _SizeChanged(phrase("size_changed", device=self.name, before=sizes[0], after=sizes[1]))
        return timed

    def reconnect(self) -> bool:
        """Never: the feed opens another source."""
        return False

    def close(self) -> None:
        """As of the source, unless a picture of another size waits."""
        if self._first is None:
            self._source.close()


class Feed(Generic[Source]):
    """The events of one mode.

    Parameters
    ----------
    mode : "speech" or "gesture"
    source : AudioSource, FrameSource, or callable that opens one
        One that is given open does not come back once it has vanished.
    watch : callable
        Gives the events of a source, as `Listener.listen`, `Watcher.watch` and `SignWatcher.watch` do.
    clock : callable, optional
        The session's time, where it goes on by itself.
    recorder : Recorder, optional
    """

    def __init__(
        self,
        mode: str,
        source: Source | Callable[[], Source],
        watch: Callable[[Any], Iterator[Event]],
        clock: Clock | None = None,
        recorder: Recorder | None = None,
    ) -> None:
        self.mode = mode
        self._open: Callable[[], Any] | None = source if callable(source) else None
        self._source: Any = None if callable(source) else source
        self._watch = watch
        self._clock = clock
        self._recorder = recorder
        self._num_streams = 0
        self.time_s = 0.0
        """Of the last event."""
        self.lost = False
        """The source has vanished, and may come back."""

    def events(self) -> Generator[Event, None, None]:
        """Events until the source ends or vanishes; then `lost` says which.

        Raises
        ------
        IoError
            When a source cannot be opened for the first time, or another session reads it.
        """
        returned = self._num_streams > 0
        source = self._source if self._source is not None else self._opened()
        self._source = None
        if not _take(source):
            self.lost = False
            raise IoError(f"{source.name} is in use: another session reads it; give each session a source of its own")
        alignment = self._alignment(source)
        tapped: Any = (TappedSound if self.mode == "speech" else TappedPictures)(
            source, alignment, self._recorder, self._num_streams
        )
        self._num_streams += 1
        self.lost = False
        try:
            while True:
                if returned:
                    yield Event(self.time_s, RECONNECTED, {"source": source.name}, mode=self.mode)
                try:
                    for event in self._watch(tapped):
                        yield self._shifted(event, alignment.offset_s)
                    return
                except _SizeChanged:
                    returned = True
        except Stalled:
            self.lost = self._open is not None
        except Exception as error:  # a stream that is broken ends this mode, and not the session
            if self._clock is None and not isinstance(error, Error):
                raise
            self.lost = self._open is not None
            yield Event(self.time_s, STALL, {"message": what_failed(error)}, mode=self.mode)
        finally:
            _give_back(source)
            source.close()

    def returns(self, time_s: float | None = None) -> bool:
        """Try once to open a source that vanished; `events` then goes on from this time, by default the clock's."""
        try:
            self._source = self._opened()
        except (Error, OSError):
            return False
        if time_s is None:
            time_s = self.time_s if self._clock is None else self._clock()
        self.time_s = max(self.time_s, time_s)
        return True

    def _opened(self) -> Any:
        if self._open is None:
            raise IoError(f"the source of {self.mode} has ended")
        return self._open()

    def _alignment(self, source: Any) -> Alignment:
        recorded = getattr(source, "alignment", None)
        if isinstance(recorded, Alignment):
            return recorded
        if self._clock is None:
            return Alignment(self.time_s)
        return Alignment(math.inf, self._clock)  # a page's microphone may begin long after its source was opened

    def _shifted(self, event: Event, offset_s: float) -> Event:
        """The event in the session's time, which never falls."""
        offset_s = offset_s if math.isfinite(offset_s) else self.time_s
        self.time_s = max(self.time_s, event.time + offset_s)
        moved: dict[str, Any] = {n: round(event.fields[n] + offset_s, 4) for n in _TIMES if n in event.fields}
        if "times_s" in event.fields:  # of the words of a signed sentence
            moved["times_s"] = [[round(t + offset_s, 4) for t in span] for span in event.fields["times_s"]]
        return replace(event, time=self.time_s, fields=event.fields | moved)


@contextmanager
def closing_unread_if_refused(*sources: Any) -> Iterator[None]:
    """After an exception close those that were given open, and that no feed reads."""
    try:
        yield
    except BaseException:
        for source in sources:
            if source is not None and not callable(source) and _take(source):
                try:
                    source.close()
                finally:
                    _give_back(source)
        raise


def _take(source: Any) -> bool:
    """Whether no other feed reads this source; it is this one's then, until it is given back."""
    with _taking:
        free = id(source) not in _in_use
        _in_use.add(id(source))
        return free


def _give_back(source: Any) -> None:
    with _taking:
        _in_use.discard(id(source))


@dataclass(frozen=True)
class Arrival:
    """An event, and what `time.perf_counter` gave when it had been worked out."""

    event: Event
    at_s: float


def what_failed(error: Exception) -> str:
    """An error in words; of one that is not ours, its kind too."""
    return phrase_of(error) if isinstance(error, Error | OSError | ImportError) else f"{type(error).__name__}: {error}"


def merge(feeds: list[Feed[Any]], retry_s: float) -> Generator[Arrival, None, None]:
    """The events of recordings by their time; of the same time those of the first feed first.

    Ends when every feed has ended. A source that vanished is opened again every `retry_s` of the others' time; when
    they have ended, for as long as every attempt brings something new.
    """
    streams = [feed.events() for feed in feeds]
    retry_at_s = [math.inf] * len(feeds)
    alone_from_s = [-math.inf] * len(feeds)
    try:
        heads = [next(stream, None) for stream in streams]
        while True:
            times = [math.inf if head is None else head.time for head in heads]
            now_s = min(times)
            for i, feed in enumerate(feeds):
                alone = not math.isfinite(now_s)
                if heads[i] is None and feed.lost and (now_s >= retry_at_s[i] or alone):
                    if alone and feed.time_s <= alone_from_s[i]:
                        continue
                    begin_s = feed.time_s + retry_s if alone else now_s
                    retry_at_s[i] = begin_s + retry_s
                    alone_from_s[i] = begin_s if alone else -math.inf
                    if feed.returns(begin_s):
                        streams[i] = feed.events()
                        heads[i] = next(streams[i], None)
                        break
            else:
                i = times.index(now_s)
                head = heads[i]
                if head is None:
                    return
                begun_s = time.perf_counter()
                yield Arrival(head, begun_s - 1e-3 * float(head.fields.get("compute_ms", 0.0)))
                heads[i] = next(streams[i], None)
                if heads[i] is None and feeds[i].lost:
                    retry_at_s[i] = head.time + retry_s
    finally:
        for stream in streams:
            stream.close()


def is_over(event: Event) -> bool:
    """Whether a mode has no source any more, for now at least."""
    return event.event in (ENDED, STALL)
