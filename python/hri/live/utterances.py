# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Endpointing of an audio stream: the same for a microphone and for a recording."""

from __future__ import annotations

from collections.abc import Generator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.live import events
from hri.live.events import Event
from hri.live.sources import AudioSource, Stalled, require_positive
from hri.signal import Endpoint, Endpointer, EndpointerOptions

Samples = NDArray[np.float32]
StreamResult = tuple[Event, Samples | None]
"""An event; with a pause and the end of speech, also the utterance, so far, and the noise around it."""

_KINDS = {
    "speech_start": events.SPEECH_START,
    "speech_end": events.SPEECH_END,
    "speech_dropped": events.SPEECH_DROPPED,
    "speech_pause": events.PAUSE,
}


class UtteranceFinder:
    """Finds every utterance in a stream.

    Parameters
    ----------
    options : EndpointerOptions, optional
        When an utterance begins, pauses and ends. A pause gives an event "pause" with the samples so far.
    level_interval_s : float
        Interval between level events.
    pauses : EndpointerOptions, optional
        When parts of an utterance end: gives events "pause" with the samples since the one before.
    """

    def __init__(
        self,
        options: EndpointerOptions | None = None,
        level_interval_s: float = 0.1,
        pauses: EndpointerOptions | None = None,
    ) -> None:
        require_positive("level_interval_s", level_interval_s)
        self._options = options or EndpointerOptions()
        self._pauses = pauses
        self._level_interval_s = level_interval_s

    def process(self, source: AudioSource, **metadata: Any) -> Generator[StreamResult, None, None]:
        """Events until the source ends; it is closed then, and also when the caller stops early.

        With an event "speech_end" come the samples of the utterance and the noise around it. They end at the time of
        the event, when it was known that the utterance has ended; all other events but pauses come with None.

        Parameters
        ----------
        source : AudioSource
        **metadata
            Fields of the first event, beside the name and the rate of the source.

        Raises
        ------
        Stalled
            When the source gives no more samples, after an event that says so.
        """
        try:
            yield from self._process(source, metadata)
        finally:
            source.close()

    def _process(self, source: AudioSource, metadata: dict[str, Any]) -> Generator[StreamResult, None, None]:
        rate = source.sample_rate_hz
        endpointer = Endpointer(rate, self._options)
        pauses = None if self._pauses is None else Endpointer(rate, self._pauses)
        kept_s = (self._options.max_utterance_ms + self._options.context_ms) / 1000
        history = _History(round(kept_s * rate) + 2 * rate)
        next_level_s, num_lost = 0.0, 0
        yield Event(0.0, events.LISTENING, {"source": source.name, "sample_rate_hz": rate, **metadata}), None
        try:
            while (block := source.read()) is not None:
                for begin in range(0, len(block), rate):  # longer blocks would outrun what is kept
                    part = block[begin : begin + rate]
                    history.append(part)
                    ends = [] if pauses is None else pauses.push(part)
                    found = [_pause(end, history, rate) for end in ends if end.kind == "speech_end"]
                    found += [_result(endpoint, history, rate) for endpoint in endpointer.push(part)]
                    yield from sorted(found, key=lambda result: result[0].time)  # a pause before an end
                time_s = history.num_samples / rate
                if source.num_lost > num_lost:
                    yield Event(time_s, events.OVERFLOW, {"lost_samples": source.num_lost - num_lost}), None
                    num_lost = source.num_lost
                if time_s >= next_level_s:
                    next_level_s = time_s + self._level_interval_s
                    yield _level(endpointer, time_s), None
            for endpoint in endpointer.finish():
                yield _result(endpoint, history, rate)
            yield Event(history.num_samples / rate, events.ENDED, {"lost_samples": source.num_lost}), None
        except Stalled as error:
            yield Event(history.num_samples / rate, events.STALL, {"message": str(error)}), None
            raise


def _result(endpoint: Endpoint, history: _History, rate: int) -> StreamResult:
    fields = {"first_s": round(endpoint.first / rate, 4), "last_s": round(endpoint.last / rate, 4)}
    event = Event(endpoint.at / rate, _KINDS[endpoint.kind], fields)
    if endpoint.kind == "speech_start":
        del fields["last_s"]
    if endpoint.kind == "speech_end":
        fields["cut"] = endpoint.cut
    elif endpoint.kind != "speech_pause":
        return event, None
    return event, history.between(endpoint.segment_first, endpoint.segment_last)


def _pause(endpoint: Endpoint, history: _History, rate: int) -> StreamResult:
    fields = {"first_s": round(endpoint.first / rate, 4), "last_s": round(endpoint.last / rate, 4)}
    said = history.between(endpoint.segment_first, endpoint.segment_last)
    return Event(endpoint.at / rate, events.PAUSE, fields), said


def _level(endpointer: Endpointer, time_s: float) -> Event:
    fields = {
        "level_db": round(endpointer.level_db, 1),
        "over_noise_db": round(endpointer.excess_db, 1),
        "in_speech": endpointer.in_speech,
    }
    return Event(time_s, events.LEVEL, fields)


class _History:
    """The last samples of a stream, by their number in it."""

    def __init__(self, num_kept: int) -> None:
        self._kept = np.zeros(2 * num_kept, dtype=np.float32)
        self._filled = 0
        self.num_samples = 0

    def append(self, samples: Samples) -> None:
        if self._filled + len(samples) > len(self._kept):
            half = len(self._kept) // 2
            self._kept[:half] = self._kept[self._filled - half : self._filled]
            self._filled = half
        self._kept[self._filled : self._filled + len(samples)] = samples
        self._filled += len(samples)
        self.num_samples += len(samples)

    def between(self, first: int, last: int) -> Samples:
        skipped = self.num_samples - self._filled
        return self._kept[max(0, first - skipped) : last - skipped].copy()
