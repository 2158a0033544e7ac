# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""End points: missed words, noise detected as speech, and errors of start and end in noise."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.datasets import Dataset
from hri.evaluation import active_power, make_noise
from hri.evaluation.noise import noise_at
from hri.media import read_audio
from hri.signal import Endpointer, find_speech
from hri.studies.noise import noise_paths
from hri.studies.registry import Layout, Progress, Study
from hri.studies.tables import Row, further_statistics
from hri.studies.word_features import WORD_FOLDERS

SEED = 0
SNRS_DB = (20, 10, 5)
CLIP_S = (1, 2, 3, 5)
SURROUNDINGS_S = 1.0
DEPTH_DB = 30.0
"""The truth of a clean recording: frames (10 ms) no further than this below the loudest."""
EVERY = 5
"""Of the recordings, every fifth is laid into noise."""
TARGETS = {"start_95_ms": 100.0, "end_95_ms": 150.0}
"""White noise at 10 dB: 95 % of the errors are smaller."""

Samples = NDArray[np.float32]


def word_span(samples: Samples, sample_rate_hz: int) -> tuple[int, int]:
    """First and last sample of the word in a clean recording, by its level alone."""
    length = sample_rate_hz // 100
    frames = samples[: len(samples) // length * length].reshape(-1, length).astype(np.float64)
    level = 10 * np.log10((frames**2).mean(axis=1) + 1e-12)
    loud = np.flatnonzero(level > level.max() - DEPTH_DB)
    return int(loud[0]) * length, (int(loud[-1]) + 1) * length


def noise_taken_for_speech(data_dir: Path) -> dict[str, dict[str, Any]]:
    """By noise: pieces of 1 to 5 s, and how many of them hold speech if the detector is to be believed."""
    found = {}
    for name, path in noise_paths(data_dir).items():
        audio = read_audio(path)
        rate = audio.sample_rate_hz
        pieces = [
            audio.samples[at : at + seconds * rate]
            for seconds in CLIP_S
            for at in range(0, len(audio.samples) - seconds * rate + 1, seconds * rate // 2)
        ]
        endpointer = Endpointer(rate)
        events = [*endpointer.push(audio.samples), *endpointer.finish()]
        starts = sum(e.kind == "speech_start" for e in events)
        clips = sum(find_speech(piece, rate) is not None for piece in pieces)
        found[name] = {"pieces": len(pieces), "taken_for_speech": clips, "starts_in_the_stream": starts}
    return found


def words_missed(dataset: Dataset, name: str, progress: Progress) -> dict[str, Any]:
    """Recordings in which no speech is found, as they are and in white noise."""
    rng = np.random.default_rng(SEED)
    missed = {"clean": 0, "10 dB": 0, "5 dB": 0}
    for done, sample in enumerate(dataset.samples):
        audio = read_audio(sample.path)
        x, rate = audio.samples, audio.sample_rate_hz
        noise = make_noise("white", len(x), rate, rng)
        power = active_power(x, rate)
        for level, snr_db in (("clean", None), ("10 dB", 10), ("5 dB", 5)):
            y = x if snr_db is None else (x + noise_at(noise, power, snr_db)).astype(np.float32)
            missed[level] += find_speech(y, rate) is None
        progress(f"words, {name}", done + 1, len(dataset.samples))
    return {"recordings": len(dataset.samples), "missed": missed}


def _errors(x: Samples, rate: int, noise: str, snr_db: float, rng: np.random.Generator) -> tuple[float, float] | None:
    """Start and end, in ms later than the truth, of a word with noise over and around it; None when it is missed."""
    around = round(SURROUNDINGS_S * rate)
    first, last = word_span(x, rate)
    y = noise_at(make_noise(noise, len(x) + 2 * around, rate, rng), active_power(x, rate), snr_db)
    y[around : around + len(x)] += x
    bounds = find_speech(y, rate)
    if bounds is None:
        return None
    return 1000 * (bounds[0] - around - first) / rate, 1000 * (bounds[1] - around - last) / rate


def _row(noise: str, snr_db: float, by_person: dict[str, list[tuple[float, float] | None]]) -> Row:
    measures: dict[str, dict[str, float]] = {}
    for person, errors in by_person.items():
        found = np.array([e for e in errors if e is not None])
        start, end = found[:, 0], found[:, 1]
        for name, value in (
            ("start_ms", np.median(start)),
            ("start_95_ms", np.percentile(np.abs(start), 95)),
            ("end_ms", np.median(end)),
            ("end_95_ms", np.percentile(np.abs(end), 95)),
            ("missed", np.mean([e is None for e in errors])),
        ):
            measures.setdefault(name, {})[person] = float(value)
    row: Row = {"noise": noise, "snr_db": snr_db}
    for name, per_person in measures.items():
        row |= further_statistics(per_person, name)
    return row


def _run(data_dir: Path, progress: Progress) -> dict[str, Any]:
    noises = noise_taken_for_speech(data_dir)
    datasets = {name: Dataset.load(data_dir / folder, "speech") for name, folder in WORD_FOLDERS.items()}
    missed = {name: words_missed(dataset, name, progress) for name, dataset in datasets.items()}
    chosen = datasets["fsdd"].samples[::EVERY]
    rows = []
    for name, path in noise_paths(data_dir).items():
        for snr_db in SNRS_DB:
            rng = np.random.default_rng((SEED, snr_db))
            by_person: dict[str, list[tuple[float, float] | None]] = {}
            for done, sample in enumerate(chosen):
                audio = read_audio(sample.path)
                errors = _errors(audio.samples, audio.sample_rate_hz, path, snr_db, rng)
                by_person.setdefault(sample.person, []).append(errors)
                progress(f"{name} at {snr_db} dB", done + 1, len(chosen))
            rows.append(_row(name, snr_db, by_person))
    at_10 = next(row for row in rows if (row["noise"], row["snr_db"]) == ("white", 10))
    passed = (
        all(n["taken_for_speech"] == 0 for n in noises.values())
        and all(m["missed"]["clean"] == 0 for m in missed.values())
        and all(at_10[f"{name}_mean"] < most for name, most in TARGETS.items())
    )
    return {"seed": SEED, "noise": noises, "words": missed, "rows": rows, "passed": passed}


STUDIES = (
    Study(
        "endpoints",
        "Start and end of words laid into a second of noise on either side, against the clean recording; noise taken "
        "for words, and words missed",
        ("fsdd/recordings", "hindi_words", "noise"),
        "no noise is speech, no clean word is missed; white noise at 10 dB: 95 % of starts within 100 ms, of ends "
        "within 150 ms",
        _run,
        Layout(x="snr_db", panel="noise", measure="end_95_ms", percent=False),
        sources=("cpp/signal", "cpp/signal/stream"),
    ),
)
