# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""From a stream of sound to decisions: the same path for a microphone and for a recording."""

from __future__ import annotations

import time
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from hri import _native
from hri.live import events
from hri.live.events import Event, decision_fields
from hri.live.sources import AudioSource, Stalled, require_positive
from hri.recognition import WordRecognizer

_KINDS = {
    _native.EndpointKind.speech_start: events.SPEECH_START,
    _native.EndpointKind.speech_end: events.SPEECH_END,
    _native.EndpointKind.speech_dropped: events.SPEECH_DROPPED,
}


class Listener:
    """Recognises every word in a stream.

    Parameters
    ----------
    recognizer : WordRecognizer
        Trained or loaded.
    options : EndpointerOptions, optional
        When an utterance begins and ends. By default its `activity` is the recogniser's own.
    level_interval_s : float
        How often the level is told.
    locale : str
        Language of the vocabulary, such as "hi" or "en"; passed on with decisions.
    model_id : str
        Which model decided; passed on with decisions.
    """

    def __init__(
        self,
        recognizer: WordRecognizer,
        options: _native.EndpointerOptions | None = None,
        *,
        level_interval_s: float = 0.1,
        locale: str = "",
        model_id: str = "",
    ) -> None:
        require_positive("level_interval_s", level_interval_s)
        self._recognizer = recognizer
        self._options = options or _native.EndpointerOptions(activity=recognizer.options.activity)
        self._level_interval_s = level_interval_s
        self._locale = locale
        self._model_id = model_id

    def listen(self, source: AudioSource) -> Iterator[Event]:
        """Events until the source ends; it is closed then, and also when the caller stops early.

        Raises
        ------
        Stalled
            When the source gives no more samples, after an event that says so.
        """
        rate = source.sample_rate_hz
        endpointer = _native.Endpointer(rate, self._options)
        heard = _History(round((self._options.max_utterance_ms + self._options.context_ms) / 1000 * rate) + 2 * rate)
        next_level_s, num_lost = 0.0, 0
        yield Event(0.0, events.LISTENING, {"source": source.name, "sample_rate_hz": rate, "model": self._model_id})
        try:
            while (block := source.read()) is not None:
                for begin in range(0, len(block), rate):  # longer blocks would outrun what is kept
                    part = block[begin : begin + rate]
                    heard.append(part)
                    for endpoint in endpointer.push(part):
                        yield from self._answer(endpoint, heard, rate)
                time_s = heard.num_samples / rate
                if source.num_lost > num_lost:
                    yield Event(time_s, events.OVERFLOW, {"lost_samples": source.num_lost - num_lost})
                    num_lost = source.num_lost
                if time_s >= next_level_s:
                    next_level_s = time_s + self._level_interval_s
                    yield _level(endpointer, time_s)
            for endpoint in endpointer.finish():
                yield from self._answer(endpoint, heard, rate)
            yield Event(heard.num_samples / rate, events.ENDED, {"lost_samples": source.num_lost})
        except Stalled as error:
            yield Event(heard.num_samples / rate, events.STALL, {"message": str(error)})
            raise
        finally:
            source.close()

    def _answer(self, endpoint: _native.Endpoint, heard: _History, rate: int) -> Iterator[Event]:
        time_s = endpoint.at / rate
        fields = {"first_s": round(endpoint.first / rate, 4), "last_s": round(endpoint.last / rate, 4)}
        if endpoint.kind == _native.EndpointKind.speech_start:
            del fields["last_s"]
        if endpoint.kind == _native.EndpointKind.speech_end:
            fields["cut"] = endpoint.cut
        yield Event(time_s, _KINDS[endpoint.kind], fields)
        if endpoint.kind != _native.EndpointKind.speech_end:
            return
        # With the noise around it: the recogniser finds the end points as it did in training.
        segment = heard.between(endpoint.segment_first, endpoint.segment_last)
        begun = time.perf_counter()
        decision = self._recognizer.recognise(segment, rate)
        compute_ms = 1000 * (time.perf_counter() - begun)
        fields |= decision_fields(decision, self._locale, self._model_id) | {"compute_ms": round(compute_ms, 3)}
        del fields["cut"]
        yield Event(time_s, events.DECISION, fields, decision)


def _level(endpointer: _native.Endpointer, time_s: float) -> Event:
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

    def append(self, samples: NDArray[np.float32]) -> None:
        if self._filled + len(samples) > len(self._kept):
            half = len(self._kept) // 2
            self._kept[:half] = self._kept[self._filled - half : self._filled]
            self._filled = half
        self._kept[self._filled : self._filled + len(samples)] = samples
        self._filled += len(samples)
        self.num_samples += len(samples)

    def between(self, first: int, last: int) -> NDArray[np.float32]:
        skipped = self.num_samples - self._filled
        return self._kept[max(0, first - skipped) : last - skipped].copy()
