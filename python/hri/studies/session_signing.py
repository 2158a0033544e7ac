# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Gestures that follow on one another, as a stream of pictures of a session, against the same clips as files."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from hri.core.optional import import_opencv
from hri.live import ClipSource, Event, GestureRows, Watcher
from hri.live.frames import TimedFrame
from hri.media import read_frames
from hri.recognition import GestureRecognizer, SentenceRecognizer, SentenceStreamOptions
from hri.session import Session
from hri.studies.counted_words import CountedWords
from hri.studies.gesture_sentences import (
    ONE_MODEL,
    GestureClip,
    Shapes,
    clips_together,
    join,
    name_whole,
    read_gesture_clips,
    seen_rows,
    train_words,
)
from hri.studies.registry import GESTURE_SOURCES, Layout, Progress, Study
from hri.studies.webcam import FOLDER

SEED = 0
FILE, STREAM, SINGLE = "as a file", "as a stream", "one by one"
"""`SINGLE`: the same stream, by a recogniser of single gestures, which need a rest between them."""
MAX_GAP = 0.05
OPTIONS: dict[str, Any] = {"rest_s": 5.0, "leave_s": 5.0, "context_s": 10.0}
"""Clips begin with a hand that is still for up to 4 s, or out of view, and end so: nothing of that ends a sentence, and
what the models know as part of a gesture is part of the sentence."""


class _Filmed(ClipSource):
    """Clips one after the other, with the times they were filmed at, all of the size of the first."""

    def __init__(self, clips: Sequence[GestureClip]) -> None:
        super().__init__((), 25.0, "joined clips")
        self._clips = clips
        self._timed = self._joined()

    def _joined(self) -> Iterator[TimedFrame]:
        cv2 = import_opencv("to bring clips to one size")
        begin_s, size = 0.0, None
        for clip in self._clips:
            read = read_frames(clip.path)
            times_s = [begin_s + time_s - read.times_s[0] for time_s in read.times_s]
            size = size or read.frames[0].shape[1::-1]
            for frame, time_s in zip(read.frames, times_s, strict=True):
                yield (frame if frame.shape[1::-1] == size else cv2.resize(frame, size)), time_s
            begin_s = times_s[-1] + (times_s[-1] - times_s[0]) / max(1, len(times_s) - 1)


@dataclass
class _Partial:
    """When words were reported, against their ends, in s; how many stable ones were kept; signed sentences a stream."""

    first_s: list[float] = field(default_factory=list)
    stable_s: list[float] = field(default_factory=list)
    kept: list[bool] = field(default_factory=list)
    parts: list[int] = field(default_factory=list)
    compute_ms: list[float] = field(default_factory=list)

    def add(self, events: Sequence[Event]) -> None:
        so_far: list[Event] = []
        ends = [event for event in events if event.event == "signed"]
        self.parts.append(len(ends))
        for event in events:
            if event.event == "signing":
                so_far.append(event)
            elif event.event == "signed":
                self._compare(so_far, event)
                so_far = []

    def _compare(self, so_far: Sequence[Event], end: Event) -> None:
        self.compute_ms.append(end.fields["compute_ms"])
        for k, (label, (_, last_s)) in enumerate(zip(end.fields["words"], end.fields["times_s"], strict=True)):
            named = [e for e in so_far if len(e.fields["words"]) > k and e.fields["words"][k] == label]
            self.first_s.append((named[0] if named else end).time - last_s)
            stable = [e for e in so_far if e.fields["num_stable"] > k]
            self.stable_s.append((stable[0] if stable else end).time - last_s)
            self.kept += [stable[0].fields["words"][k] == label] if stable else []


def _streamed(words: SentenceRecognizer, rows: GestureRows, clips: Sequence[GestureClip]) -> list[Event]:
    return list(
        Session(None, words, segmenter=SentenceStreamOptions(**OPTIONS), hands=rows).run(pictures=_Filmed(clips))
    )


def _one_by_one(gestures: GestureRecognizer, clips: Sequence[GestureClip]) -> list[str]:
    events = Watcher(gestures).watch(_Filmed(clips))
    return [e.decision.nbest[0].label for e in events if e.event == "decision" and e.decision and e.decision.nbest]


def _run(data_dir: Path, progress: Progress, *, folds: int | None = None) -> dict[str, Any]:
    clips = read_gesture_clips(data_dir, progress)
    conditions = list(dict.fromkeys(clip.condition for clip in clips))[:folds]
    counts = {way: CountedWords() for way in (FILE, STREAM, SINGLE)}
    agree, partial, num_frames, duration_s = CountedWords(), _Partial(), 0, 0.0
    for done, condition in enumerate(conditions):
        train = [clip for clip in clips if clip.condition != condition]
        test = [clip for clip in clips if clip.condition == condition]
        shapes = Shapes(train)
        gestures = GestureRecognizer(source="silhouettes")
        gestures.fit_features([seen_rows(clip.rows) for clip in train], [clip.label for clip in train])
        words = train_words(train, shapes, "hmm", **ONE_MODEL)
        rows = GestureRows(gestures, shapes, names=True, faces="never")
        together = clips_together(test, np.random.default_rng(SEED))
        found: dict[str, list[list[str]]] = {way: [] for way in counts}
        for some in together:
            joined = join(some, [0] * len(some))
            parts = words.recognise(shapes(joined.rows)).words
            found[FILE].append([name_whole(gestures, joined.rows[w.first_frame : w.last_frame]) for w in parts])
            events = _streamed(words, rows, some)
            partial.add(events)
            found[STREAM].append([label for e in events if e.event == "signed" for label in e.fields["words"]])
            found[SINGLE].append(_one_by_one(gestures, some))
            num_frames += len(joined.rows)
            duration_s += events[-1].time
        truth = [[clip.label for clip in some] for some in together]
        for way, count in counts.items():
            count.add(condition, truth, found[way])
        agree.add(condition, found[FILE], found[STREAM])
        progress("signing", done + 1, len(conditions))
    fps = num_frames / duration_s
    return {
        "seed": SEED,
        "stream": OPTIONS,
        "rows": [count.row(clips=way) for way, count in counts.items()],
        "stream_against_file": vars(agree.total),
        "signed_sentences_a_stream": float(np.mean(partial.parts)),
        "pictures_a_second": fps,
        "frames_to_first_report": _median_frames(partial.first_s, fps),
        "frames_to_stable_report": _median_frames(partial.stable_s, fps),
        "stable_words_kept": float(np.mean(partial.kept)) if partial.kept else None,
        "median_compute_ms": float(np.median(partial.compute_ms)) if partial.compute_ms else None,
        "passed": bool(_right(counts[FILE]) - _right(counts[STREAM]) <= MAX_GAP),
    }


def _right(counts: CountedWords) -> float:
    return counts.words_right


def _median_frames(delays_s: Sequence[float], fps: float) -> float | None:
    """From the end of a word, in frames; below 0: before it."""
    return float(np.median(delays_s) * fps) if delays_s else None


STUDIES = (
    Study(
        "session-signing",
        "clips of 8 webcam gestures, two to five at a time, as pictures of a session, within a condition of light and "
        "background that is left out of training: words against those of the same clips as files",
        (FOLDER,),
        f"of the words as many are right as from files, less {100 * MAX_GAP:.0f} points",
        _run,
        Layout(measure="word_error"),
        sources=(
            *GESTURE_SOURCES,
            "cpp/language",
            "cpp/recognition/sentence",
        ),
        folds=True,
    ),
)
