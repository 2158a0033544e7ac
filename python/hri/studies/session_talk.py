# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Hours of talk before a session: how often it stops the robot, or moves it, without a command."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from hri.datasets import Dataset, Sample
from hri.live import ArraySource, Event
from hri.media import read_audio
from hri.recognition import WordRecognizer
from hri.recognition.decision import RECOGNISED
from hri.recognition.keywords import WordRecognizerKeywords
from hri.session import Session
from hri.signal import resample
from hri.studies.commands import FRONT_ENDS as TWO_FRONT_ENDS
from hri.studies.false_alarms import Samples, compose_words
from hri.studies.registry import WORD_SOURCES, Layout, Progress, Study
from hri.studies.session_stop import NUM_FOLDS, WORDS
from hri.studies.tables import further_statistics, statistics

SEED = 0
FRONT_ENDS: dict[str, WordRecognizerKeywords] = {**TWO_FRONT_ENDS, "embedding": {"front_end": "embedding"}}
STOP = "stop"
OTHERS = "other_words"
STREAM_S = 300
NUM_STREAMS = 12
"""Of talk, for every group of speakers: an hour."""
MAX_STOPS_PER_HOUR = 1.0


def _clips(samples: Sequence[Sample], rate: int) -> list[Samples]:
    found = []
    for sample in samples:
        audio = read_audio(sample.path)
        same = audio.sample_rate_hz == rate
        found.append(audio.samples if same else np.asarray(resample(audio.samples, audio.sample_rate_hz, rate)))
    return found


def alarms(events: Iterator[Event]) -> Counter[str]:
    """How often a session stopped, and how often it took what it heard as another command."""
    found: Counter[str] = Counter()
    for event in events:
        if event.event == "fused" and event.fields["status"] == RECOGNISED and event.fields["final"] != STOP:
            found["commands"] += 1
        found["stops"] += event.event == "stop"
    return found


def _run(
    data_dir: Path, progress: Progress, *, front_end: Sequence[str] = tuple(FRONT_ENDS), folds: int | None = None
) -> dict[str, Any]:
    dataset = Dataset.load(data_dir / "commands", "speech")
    strangers = Dataset.load(data_dir / OTHERS, "speech").samples
    persons = sorted({sample.person for sample in dataset.samples})
    order = np.random.default_rng(SEED).permutation(len(persons))
    groups = [{persons[i] for i in order[part::NUM_FOLDS]} for part in range(NUM_FOLDS)][:folds]
    hours = NUM_STREAMS * STREAM_S / 3600
    rows = []
    for name in front_end:
        shares: dict[str, dict[str, float]] = {"heard": {}, "commands": {}, "stops": {}}
        for part, group in enumerate(groups):
            place = f"part {part + 1} of {NUM_FOLDS}"
            train = [s for s in dataset.samples if s.label in WORDS and s.person not in group]
            words = WordRecognizer(**FRONT_ENDS[name]).fit(
                [s.path for s in train], [s.label for s in train], groups=[s.person for s in train]
            )
            rng = np.random.default_rng(SEED + part)
            rate = read_audio(train[0].path).sample_rate_hz
            said = [s for s in dataset.samples if s.person in group]
            own = _clips([s for s in said if s.label == STOP], rate)
            talk = _clips([s for s in said if s.label not in WORDS] + strangers, rate)
            session = Session(words)
            stream, spans = compose_words(own, rate, STREAM_S * rate, rng)
            shares["heard"][place] = alarms(session.run(ArraySource(stream, rate)))["stops"] / len(spans)
            found: Counter[str] = Counter()
            for number in range(NUM_STREAMS):
                stream, _ = compose_words(talk, rate, STREAM_S * rate, rng)
                found += alarms(session.run(ArraySource(stream, rate)))
                progress(f"{name}, {place}: listening to talk", number + 1, NUM_STREAMS)
            for kind in ("stops", "commands"):
                shares[kind][place] = found[kind] / hours
        row: dict[str, Any] = {"front_end": name}
        for kind, values in shares.items():
            shown = {p: 100 * v if kind == "heard" else v for p, v in values.items()}
            row |= statistics(shown, kind) if kind == "stops" else further_statistics(shown, kind)
        rows.append(row)
    return {
        "seed": SEED,
        "hours": hours * len(groups),
        "rows": rows,
        "passed": all(row["stops_mean"] < MAX_STOPS_PER_HOUR for row in rows),
    }


STUDIES = (
    Study(
        "session-talk",
        "an hour of words that are no commands, by each of three groups of speakers that were not trained on and by "
        "strangers: false STOPs and false commands an hour, and the share of STOPs that are heard, in percent",
        ("commands", OTHERS),
        f"fewer than {MAX_STOPS_PER_HOUR:g} false STOP an hour",
        _run,
        Layout(measure="stops", percent=False),
        axes={"front_end": tuple(FRONT_ENDS)},
        sources=(*WORD_SOURCES, "cpp/signal/stream"),
        folds=True,
        quick={"front_end": ("cepstra",)},
    ),
)
