# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Live sound for ``hri htk vite``: utterances are cut out of a stream, coded as files are, and recognised."""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from typing import Any

import click
import numpy as np

from hri.cli.htk.data import check_kind, require_codewords
from hri.cli.htk.decoding import UNITS_PER_S, Find, Found, ResultFiles
from hri.cli.live_screen import describe_stream, report
from hri.cli.messages import note
from hri.core.errors import FormatError, InvalidArgument
from hri.htk import Configuration, FeatureExtractor, Label, ModelSet, observe_samples
from hri.live import AudioSource, Event, UtteranceFinder
from hri.recognition import ConnectedWordStreamOptions
from hri.recognition.decision import Decision
from hri.signal import EndpointerOptions, resample

SENTENCE = "sentence"
SUMMARY = "summary"
BUFFER_S = 60.0
"""Of sound that a microphone keeps while an utterance is recognised."""


@dataclass(frozen=True)
class SentenceEvent(Event):
    """What was recognised of an utterance.

    Attributes
    ----------
    decision : None
        Sentences of HTK are not decided on.
    found : Found or None
        None: no sentence of the network ends with it.
    """

    decision: Decision | None = None
    found: Found | None = None


class LiveRecognition:
    """Recognises every utterance of streams.

    Parameters
    ----------
    models : ModelSet
    configuration : Configuration
        Of live sound.
    find : callable
        Of frames, their period, the path of the lattice and the time of the first frame.
    results : ResultFiles
    is_saved : bool
        Whether label files, or a master label file, are written.

    Raises
    ------
    FormatError
        Where the configuration does not say how sound becomes what the models take.
    """

    def __init__(
        self, models: ModelSet, configuration: Configuration, find: Find, results: ResultFiles, is_saved: bool
    ) -> None:
        if configuration.target == "ANON":
            raise FormatError(
                f"TARGETKIND is not set in any configuration file (-C): it says what sound becomes, which is "
                f"{models.kind} for these models"
            )
        if not configuration.has_target_rate:
            raise FormatError(
                "TARGETRATE is not set in any configuration file (-C): it says how often there is a frame"
            )
        self._models = models
        self._configuration = configuration
        self._find = find
        self._results = results
        self._is_saved = is_saved
        self._finder = UtteranceFinder(_end_pointer(configuration))
        self._num_utterances = 0
        self._time_s = 0.0
        self._latencies_ms: list[tuple[float, float]] = []

    def require_rate(self) -> None:
        """Raises FormatError unless the configuration says at what rate models were trained, as microphones do not."""
        rate_hz = self._configuration.source_rate_hz
        if rate_hz == 0:
            raise FormatError(
                "SOURCERATE is not set in any configuration file (-C): it says at what rate the models' recordings "
                "were made, to which the microphone's sound is resampled; SOURCERATE = 625 is 16000 Hz"
            )
        self._check_coding(rate_hz)

    def run(self, sources: Iterable[AudioSource], as_json: bool, with_labels: bool) -> None:
        """Recognise and report until the sources end, or Ctrl-C; then write the master label file.

        Parameters
        ----------
        sources : iterable of AudioSource
        as_json : bool
            A line of JSON an event, in place of text.
        with_labels : bool
            Also print the labels of sentences, and mean times at the end.
        """
        describe = partial(_describe, with_labels=with_labels)
        try:
            for source in sources:
                report(self.listen(source), as_json, describe, plain=True)
        except BaseException:  # Ctrl-C, too; what was recognised is kept
            if self._num_utterances:
                self._results.finish()
                self._summarise(as_json, with_labels)
            raise
        self._results.finish()
        self._summarise(as_json, with_labels)

    def listen(self, source: AudioSource) -> Iterator[Event]:
        """Events until the source ends; raises Stalled where it gives no more samples."""
        from_hz = source.sample_rate_hz
        rate_hz = self._configuration.source_rate_hz or from_hz
        try:
            self._check_coding(rate_hz)
        except FormatError:
            source.close()
            raise
        if rate_hz != from_hz:
            missing = "" if from_hz > rate_hz else f", with nothing above {from_hz // 2} Hz"
            note(f"{source.name}: resampled from {from_hz} to {rate_hz} Hz, as SOURCERATE says{missing}")
        with closing(self._finder.process(source)) as results:
            for event, said in results:
                self._time_s = event.time
                yield event
                if said is not None:
                    begin = round((event.time - len(said) / from_hz) * UNITS_PER_S)
                    samples = said if rate_hz == from_hz else resample(said, from_hz, rate_hz)
                    yield self._recognise(event, np.asarray(samples), rate_hz, begin)

    def _recognise(self, event: Event, samples: Any, rate_hz: int, begin: int) -> SentenceEvent:
        """The sentence of an utterance whose samples begin at `begin`, in 100 ns."""
        started_s = time.perf_counter()
        self._num_utterances += 1
        configuration = self._configuration
        name = f"{configuration.record_prefix}{self._num_utterances:04}{configuration.record_suffix}"
        frames, period = self._observe(samples, rate_hz, f"the utterance from {begin / UNITS_PER_S:.2f} s on")
        found = self._find(frames, period, self._results.lattice_path(name), begin)
        compute_ms = 1000 * (time.perf_counter() - started_s)
        if found is not None and self._is_saved:
            self._results.add(name, found.transcription)
        wait_ms = 1000 * (event.time - event.fields["last_s"])
        self._latencies_ms.append((wait_ms, compute_ms))
        fields = {key: event.fields[key] for key in ("first_s", "last_s", "cut")} | {"name": name}
        fields |= {"num_frames": len(frames), **_sentence_fields(found)}
        fields |= {"wait_ms": round(wait_ms, 3), "compute_ms": round(compute_ms, 3)}
        return SentenceEvent(event.time, SENTENCE, fields, found=found)

    def _observe(self, samples: Any, rate_hz: int, name: str) -> tuple[Any, int]:
        try:
            frames, period = observe_samples(samples, rate_hz, self._models.kind, self._configuration, name)
        except InvalidArgument as error:
            raise FormatError(f"{name}: {error}") from error
        require_codewords(frames, self._models, name)
        return frames, period

    def _check_coding(self, rate_hz: int) -> None:
        """Raises FormatError unless sound of this rate can become what the models take."""
        kind = self._configuration.target
        try:
            extractor = FeatureExtractor(kind, rate_hz, self._configuration.features)
        except InvalidArgument as error:
            raise FormatError(f"sound of {rate_hz} Hz cannot become {kind}, as TARGETKIND says: {error}") from error
        check_kind("live sound", kind, extractor.num_columns, self._models, self._configuration)

    def _summarise(self, as_json: bool, with_labels: bool) -> None:
        if as_json or with_labels:
            event = self._summary()
            click.echo(event.to_json() if as_json else _describe(event, with_labels))

    def _summary(self) -> Event:
        fields: dict[str, Any] = {"num_utterances": self._num_utterances}
        if self._latencies_ms:
            wait_ms, compute_ms = np.mean(self._latencies_ms, axis=0)
            fields |= {"mean_wait_ms": round(float(wait_ms), 3), "mean_compute_ms": round(float(compute_ms), 3)}
        return Event(self._time_s, SUMMARY, fields)


def _end_pointer(configuration: Configuration) -> EndpointerOptions:
    """That of connected words, whose pauses end no utterance; with the silence that the configuration says."""
    fields = ConnectedWordStreamOptions().endpointer.as_dict()
    if configuration.silence_frames:
        fields["hangover_ms"] = configuration.silence_frames * configuration.features.frame_shift_ms
    try:
        return EndpointerOptions(**fields)
    except InvalidArgument as error:
        raise FormatError(f"SILSEQCOUNT = {configuration.silence_frames}, frames of silence: {error}") from error


def _sentence_fields(found: Found | None) -> dict[str, Any]:
    """What is recognised, as plain values; times in seconds."""
    if found is None:
        return {"words": [], "complete": False}
    best, *others = found.transcription.alternatives
    fields: dict[str, Any] = {"words": found.words, "complete": True, "score": round(found.log_score, 6)}
    fields["labels"] = [_label_fields(label) for label in best]
    if others:
        fields["alternatives"] = [[_label_fields(label) for label in labels] for labels in others]
    return fields


def _label_fields(label: Label) -> dict[str, Any]:
    times = {"first_s": label.first, "last_s": label.last}
    fields: dict[str, Any] = {"name": label.name}
    fields |= {key: value / UNITS_PER_S for key, value in times.items() if value is not None}
    if label.score is not None:
        fields["score"] = label.score
    if label.others:
        fields["others"] = [name for name, _ in label.others]
    return fields


def _describe(event: Event, with_labels: bool) -> str:
    """Lines for people; "" for events that are not shown."""
    fields = event.fields
    if isinstance(event, SentenceEvent):
        place = f"{fields['first_s']:8.2f} - {fields['last_s']:.2f} s  "
        if event.found is None:
            return f"{place}no sentence of the network ends with the utterance"
        cut = "  (cut)" if fields["cut"] else ""
        labels = f"\n{event.found.transcription.to_text().rstrip()}" if with_labels else ""
        return f"{place}{event.found.line}{cut}{labels}"
    if event.event == SUMMARY:
        if not fields["num_utterances"]:
            return "no utterance"
        count = fields["num_utterances"]
        return (
            f"{count} utterance{'s' if count > 1 else ''}; on average their end was found after "
            f"{fields['mean_wait_ms']:.0f} ms, and the sentence {fields['mean_compute_ms']:.0f} ms later"
        )
    if line := describe_stream(event):
        note(line)  # beside the results
    return ""
