# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""American signed sentences as streams of tracks, against the same tracks as files."""

from __future__ import annotations

import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from hri.datasets.asl_sentences import SignedSentence, read_asl_sentences
from hri.language import WordErrors, count_word_errors
from hri.recognition import SentenceEvent, SentenceRecognizer, SentenceStream
from hri.studies.registry import Layout, Progress, Study, within
from hri.studies.sentences import (
    FOLDER,
    NUM_GROUPS,
    RECORDINGS,
    SEED,
    SOURCES,
    groups_of,
    labels_of,
    scales_of,
    train_signs,
)
from hri.studies.tables import statistics

FPS = 30.0
FILE, STREAM = "as a file", "as a stream"
MIN_SAME = 0.95
PARTIAL_MS = 100.0
"""Within so long after its last frame a partial result is there."""


@dataclass
class _Counts:
    errors: dict[str, dict[str, float]] = field(default_factory=lambda: {FILE: {}, STREAM: {}})
    same: list[bool] = field(default_factory=list)
    num_cut: int = 0
    changed: WordErrors = field(default_factory=WordErrors)
    stable_frames: list[float] = field(default_factory=list)
    kept: list[bool] = field(default_factory=list)
    partial_ms: list[float] = field(default_factory=list)

    def add(self, group: str, truth: list[list[str]], found: dict[str, list[list[str]]]) -> None:
        for way, words in found.items():
            self.errors[way][group] = count_word_errors(truth, words).rate
        self.same += [file == stream for file, stream in zip(found[FILE], found[STREAM], strict=True)]
        self.changed += count_word_errors(found[FILE], found[STREAM])


def _stream(recognizer: SentenceRecognizer, sentence: SignedSentence, scale_px: float, counts: _Counts) -> list[str]:
    stream = SentenceStream(recognizer, scale_px=scale_px)
    events = []
    for number, frame in enumerate(sentence.positions):
        begin = time.perf_counter()
        events.append(stream.push(frame, number / FPS))
        if events[-1] is not None and events[-1].kind == "partial":
            counts.partial_ms.append(1000.0 * (time.perf_counter() - begin))
    words: list[str] = []
    stable: list[tuple[str, float]] = []
    ends = 0
    for event in (*events, stream.finish()):
        if event is None:
            continue
        if event.kind == "partial":
            stable += [_settled(event, place) for place in range(len(stable), event.num_stable)]
        elif event.kind == "end":
            ends += 1
            words += event.labels
            counts.stable_frames += [frames for _, frames in stable]
            counts.kept += [event.labels[i : i + 1] == (label,) for i, (label, _) in enumerate(stable)]
            stable = []
    counts.num_cut += ends > 1
    return words


def _settled(event: SentenceEvent, place: int) -> tuple[str, float]:
    """A word that is stable now, and how many frames after its end."""
    word = event.words[place]
    return word.label, FPS * (event.last_s - word.last_s)


def _run(data_dir: Path, progress: Progress, *, folds: int | None = None) -> dict[str, Any]:
    sentences = read_asl_sentences(data_dir / FOLDER)
    groups = groups_of(sentences, RECORDINGS)
    counts = _Counts()
    for number in range(NUM_GROUPS)[:folds]:
        train = [s for s, group in zip(sentences, groups, strict=True) if group != number]
        test = [s for s, group in zip(sentences, groups, strict=True) if group == number]
        scales = scales_of(train)
        recognizer = train_signs(train, scales, within(progress, f"group {number + 1}"))
        found: dict[str, list[list[str]]] = {FILE: [], STREAM: []}
        for sentence in test:
            scale_px = scales.get(sentence.signer, 0.0)
            found[FILE].append(list(recognizer.recognise(sentence.positions, scale_px=scale_px).labels))
            found[STREAM].append(_stream(recognizer, sentence, scale_px, counts))
        counts.add(str(number + 1), [labels_of(s) for s in test], found)
    return {
        "seed": SEED,
        "frames_a_second": FPS,
        "rows": [{"tracks": way, **statistics(errors, "word_error")} for way, errors in counts.errors.items()],
        "num_sentences": len(counts.same),
        "same_as_file": int(np.sum(counts.same)),
        "cut_by_a_rest": counts.num_cut,
        "stream_against_file": vars(counts.changed),
        "frames_to_stable": float(np.median(counts.stable_frames)) if counts.stable_frames else None,
        "stable_words": len(counts.kept),
        "stable_words_kept": float(np.mean(counts.kept)) if counts.kept else None,
        "partial_ms": {
            "count": len(counts.partial_ms),
            "median": float(np.median(counts.partial_ms)),
            "95 %": float(np.percentile(counts.partial_ms, 95)),
            "most": float(np.max(counts.partial_ms)),
        },
        "passed": bool(np.mean(counts.same) >= MIN_SAME and np.percentile(counts.partial_ms, 95) <= PARTIAL_MS),
    }


STUDIES = (
    Study(
        "asl-stream",
        "161 sentences of American signs (RWTH-BOSTON-104) held out in 5 groups, frame by frame as streams of tracks: "
        "words against those of the same tracks as files",
        (FOLDER,),
        f"at least {100 * MIN_SAME:.0f} % of the sentences have the words of the file; partial results within "
        f"{PARTIAL_MS:.0f} ms of their last frame, 95 % of them",
        _run,
        Layout(measure="word_error"),
        sources=SOURCES,
        folds=True,
    ),
)
