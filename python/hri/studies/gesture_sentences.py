# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Sentences of gestures: webcam clips of one condition of light and background, joined, of a condition held out."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.datasets import Dataset
from hri.media import read_frames
from hri.recognition import GestureRecognizer, RecognisedSentence, SentenceRecognizer
from hri.studies.counted_words import CountedWords
from hri.studies.registry import GESTURE_SOURCES, Layout, Progress, Study
from hri.studies.tables import Row
from hri.studies.webcam import CONDITIONS, FOLDER, PATTERN, read_conditions
from hri.vision.hands import find_silhouettes

GAPS = (0, 5, 15)
"""Frames between two clips, in which the hand goes straight from the last pose to the first."""
MAX_GESTURES = 5
NUM_ORDERS = 3
"""How often every clip stands in a sentence."""
NUM_COMPONENTS = 10
"""Of the hand's shape, principal components of the clips trained on."""
TRACK_COLUMNS = 3
TRACK_SCALE = 10.0
"""A tenth of the picture counts as much as one unit of shape."""
TOLERANCE = 5
ONE_MODEL: dict[str, Any] = {"max_variant_frames": 0}
"""A word has one model: as in the thesis, and fast enough for a stream of pictures."""
SEED = 0
MODELS = ("hmm", "ptbhmm")
FRAMES, WHOLE = "word models", "word models, then whole gestures"
"""Words as the decoder names them; or the decoder's splitting, each part named by `GestureRecognizer`."""
ISOLATED = "isolated"

Rows = NDArray[np.float32]


@dataclass(frozen=True)
class GestureClip:
    """A gesture; `rows` has a row of hand features for every frame, NaN without a hand."""

    label: str
    condition: str
    rows: Rows
    path: Path = Path()


@dataclass(frozen=True)
class GestureSentence:
    """Joined clips; `spans` are (label, first frame, frame after the last)."""

    rows: Rows
    spans: list[tuple[str, int, int]]

    @property
    def labels(self) -> list[str]:
        """The gestures alone."""
        return [label for label, _, _ in self.spans]


class Shapes:
    """Rows of hand features to principal components of the shape and the track beside them."""

    def __init__(self, clips: Sequence[GestureClip]) -> None:
        shapes = np.concatenate([seen_rows(clip.rows)[::6, :-TRACK_COLUMNS] for clip in clips]).astype(np.float64)
        self._mean = shapes.mean(axis=0)
        centred = shapes - self._mean
        # Of the small side: there are fewer rows than columns.
        _, vectors = np.linalg.eigh(centred @ centred.T)
        directions = centred.T @ vectors[:, -NUM_COMPONENTS:]
        self._directions = directions / np.linalg.norm(directions, axis=0)

    def __call__(self, rows: Rows) -> Rows:
        shape = (rows[:, :-TRACK_COLUMNS] - self._mean) @ self._directions
        return np.hstack([shape, TRACK_SCALE * rows[:, -TRACK_COLUMNS:]]).astype(np.float32)


def seen_rows(rows: Rows) -> Rows:
    """Those that show a hand."""
    return rows[~np.isnan(rows[:, 0])]


def join(clips: Sequence[GestureClip], gaps: Sequence[int]) -> GestureSentence:
    """The clips one after the other; between two of them the features go in a straight line for `gaps` frames."""
    parts, spans, length = [clips[0].rows], [(clips[0].label, 0, len(clips[0].rows))], len(clips[0].rows)
    for before, clip, gap in zip(clips, clips[1:], gaps, strict=False):
        share = (np.arange(1, gap + 1) / (gap + 1))[:, None]
        first, last = seen_rows(before.rows)[-1], seen_rows(clip.rows)[0]
        parts += [((1 - share) * first + share * last).astype(np.float32), clip.rows]
        spans.append((clip.label, length + gap, length + gap + len(clip.rows)))
        length += gap + len(clip.rows)
    return GestureSentence(np.concatenate(parts), spans)


def clips_together(clips: Sequence[GestureClip], rng: np.random.Generator) -> list[list[GestureClip]]:
    """Every clip once, two to `MAX_GESTURES` at a time."""
    left, together = [clips[i] for i in rng.permutation(len(clips))], []
    while left:
        count = int(rng.integers(2, MAX_GESTURES + 1))
        if len(left) == count + 1:  # no clip stays alone
            count += 1 if count == 2 else -1
        together.append(left[:count])
        left = left[count:]
    return together


def sentences_of(clips: Sequence[GestureClip], gap: int | None, seed: int) -> list[GestureSentence]:
    """Every clip `NUM_ORDERS` times, in sentences of 2 to `MAX_GESTURES`, the same for every gap; None: of any gap."""
    rng = np.random.default_rng(seed)
    together = [some for _ in range(NUM_ORDERS) for some in clips_together(clips, rng)]
    gaps = [[int(rng.choice(GAPS)) if gap is None else gap for _ in some] for some in together]
    return [join(some, each) for some, each in zip(together, gaps, strict=True)]


def read_gesture_clips(data_dir: Path, progress: Progress) -> list[GestureClip]:
    """All clips of `FOLDER`, hands found in each by itself."""
    dataset = Dataset.load(data_dir / FOLDER, "gesture", PATTERN)
    own = data_dir / FOLDER / CONDITIONS
    names = [f"{sample.label}/{sample.take}" for sample in dataset.samples]
    conditions = read_conditions(names, own if own.exists() else None)
    recognizer = GestureRecognizer(source="silhouettes")
    clips = []
    for sample, condition in zip(dataset.samples, conditions, strict=True):
        hands = find_silhouettes(read_frames(sample.path).frames, faces="never")
        found = [recognizer.observation_features([hand]) for hand in hands]
        width = max(rows.shape[1] for rows in found)
        rows = [row[0] if len(row) else np.full(width, np.nan, np.float32) for row in found]
        clips.append(GestureClip(sample.label, condition, np.asarray(rows, np.float32), sample.path))
        progress("finding hands", len(clips), len(dataset))
    return clips


def train_words(clips: Sequence[GestureClip], shapes: Shapes, model: Any, **options: Any) -> SentenceRecognizer:
    """On joined clips of one condition each; the insertion penalty is chosen on conditions held out."""
    sentences, groups = [], []
    for number, condition in enumerate(sorted({clip.condition for clip in clips})):
        made = sentences_of([clip for clip in clips if clip.condition == condition], None, SEED + 1 + number)
        sentences += made
        groups += [condition] * len(made)
    recognizer = SentenceRecognizer(input="rows", model=model, language_order=0, **options)
    return recognizer.fit([shapes(s.rows) for s in sentences], [s.spans for s in sentences], groups=groups)


def name_whole(gestures: GestureRecognizer, rows: Rows) -> str:
    """The best name of a part, rejected or not; "" where it shows no hand."""
    seen = seen_rows(rows)
    nbest = gestures.recognise_features(seen).nbest if len(seen) else ()
    return nbest[0].label if nbest else ""


def _near(sentence: GestureSentence, found: RecognisedSentence) -> list[bool]:
    """Whether each end of a gesture before another, and each beginning after one, is found within the tolerance."""
    ends, firsts = [w.last_frame for w in found.words], [w.first_frame for w in found.words]
    wanted = [(last, ends) for _, _, last in sentence.spans[:-1]]
    wanted += [(first, firsts) for _, first, _ in sentence.spans[1:]]
    return [any(abs(frame - at) <= TOLERANCE for at in places) for frame, places in wanted]


def _run(
    data_dir: Path, progress: Progress, *, model: Sequence[str] = MODELS, folds: int | None = None
) -> dict[str, Any]:
    clips = read_gesture_clips(data_dir, progress)
    conditions = list(dict.fromkeys(clip.condition for clip in clips))[:folds]
    counts: dict[tuple[int | str, str, str], CountedWords] = {}
    penalties: dict[str, dict[str, float]] = {name: {} for name in model}
    took_s, num_frames = dict.fromkeys(model, 0.0), dict.fromkeys(model, 0)
    for done, condition in enumerate(conditions):
        train = [clip for clip in clips if clip.condition != condition]
        test = [clip for clip in clips if clip.condition == condition]
        shapes = Shapes(train)
        gestures = GestureRecognizer(source="silhouettes")
        gestures.fit_features([seen_rows(clip.rows) for clip in train], [clip.label for clip in train])
        labels = [[clip.label] for clip in test]
        alone = [[name_whole(gestures, clip.rows)] for clip in test]
        counts.setdefault((ISOLATED, "", "whole gestures"), CountedWords()).add(condition, labels, alone)
        for name in model:
            words = train_words(train, shapes, name)
            penalties[name][condition] = words.trained_options.decoder.insertion_penalty
            known = [list(words.recognise_spans(shapes(c.rows), [(0, len(c.rows))]).labels) for c in test]
            counts.setdefault((ISOLATED, name, FRAMES), CountedWords()).add(condition, labels, known)
            for gap in GAPS:
                sentences = sentences_of(test, gap, SEED)
                inputs = [shapes(s.rows) for s in sentences]
                begun_s = time.process_time()
                found = [words.recognise(rows) for rows in inputs]
                took_s[name] += time.process_time() - begun_s
                num_frames[name] += sum(len(rows) for rows in inputs)
                near = [close for s, f in zip(sentences, found, strict=True) for close in _near(s, f)]
                truth = [s.labels for s in sentences]
                named = [
                    [name_whole(gestures, s.rows[w.first_frame : w.last_frame]) for w in f.words]
                    for s, f in zip(sentences, found, strict=True)
                ]
                counts.setdefault((gap, name, FRAMES), CountedWords()).add(
                    condition, truth, [list(f.labels) for f in found], near
                )
                counts.setdefault((gap, name, WHOLE), CountedWords()).add(condition, truth, named, near)
        progress("training", done + 1, len(conditions))
    rows = [counted.row(frames_between=gap, model=name, names=names) for (gap, name, names), counted in counts.items()]
    return {
        "seed": SEED,
        "options": SentenceRecognizer(input="rows", language_order=0).options.as_dict(),
        "insertion_penalty": penalties,
        "ms_a_frame": {name: 1000 * took_s[name] / num_frames[name] for name in model},
        "rows": rows,
        "passed": _passed(rows),
    }


def _passed(rows: Sequence[Row]) -> bool | None:
    by_gap = {r["frames_between"]: r["over_all"] for r in rows if (r["model"], r["names"]) == ("hmm", WHOLE)}
    if not by_gap:
        return None
    near = min(row["boundaries_near"] for row in by_gap.values())
    return bool(by_gap[15]["words_right"] >= 0.90 and by_gap[0]["words_right"] >= 0.85 and near >= 0.90)


STUDIES = (
    Study(
        "gesture-sentences",
        "clips of 8 webcam gestures joined two to five at a time with 0, 5 and 15 frames between, within a condition "
        "of light and background that is left out of training: word errors, words right, boundaries within 5 frames",
        (FOLDER,),
        "with hmm and whole gestures, at least 90 % of words right with 15 frames between and 85 % with none, and 90 % "
        "of boundaries within 5 frames",
        _run,
        Layout(columns="names", measure="word_error"),
        axes={"model": MODELS},
        sources=(
            *GESTURE_SOURCES,
            "cpp/language",
            "cpp/recognition/sentence",
        ),
        folds=True,
    ),
)
