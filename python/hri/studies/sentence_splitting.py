# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Joined webcam clips split at pauses of the pictures, as the thesis does it: a baseline beside the decoder."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.datasets import Dataset
from hri.media import read_frames
from hri.recognition import GestureRecognizer
from hri.studies.counted_words import CountedWords
from hri.studies.gesture_sentences import (
    GAPS,
    SEED,
    TOLERANCE,
    GestureClip,
    GestureSentence,
    name_whole,
    seen_rows,
    sentences_of,
)
from hri.studies.registry import GESTURE_SOURCES, Layout, Progress, Study
from hri.studies.webcam import CONDITIONS, FOLDER, PATTERN, read_conditions
from hri.vision.hands import find_silhouettes
from hri.vision.splitting import Span, direction_changes, key_frames, split_at_pauses, subsample

CHANGES = ("mean direction", "direction of every pixel")
"""The change between pictures: as the thesis writes it, and pixel by pixel."""
WHOLE, MIDDLE = "whole parts", "middle 15 frames"
SHARES, MIN_PAUSES = (0.02, 0.05, 0.1, 0.2, 0.35, 0.5), (2, 4, 8, 12)
"""What the conditions trained on choose from."""

Pictures = NDArray[np.float32]


_TO_AND_FRO = 4


@dataclass(frozen=True)
class _Split:
    share: float
    min_pause: int


def _read(data_dir: Path, progress: Progress) -> tuple[list[GestureClip], dict[Path, Pictures]]:
    """Clips with the features of every frame, and small pictures of what their masks show."""
    dataset = Dataset.load(data_dir / FOLDER, "gesture", PATTERN)
    own = data_dir / FOLDER / CONDITIONS
    names = [f"{sample.label}/{sample.take}" for sample in dataset.samples]
    conditions = read_conditions(names, own if own.exists() else None)
    recognizer = GestureRecognizer(source="silhouettes")
    clips, shown = [], {}
    for sample, condition in zip(dataset.samples, conditions, strict=True):
        frames = read_frames(sample.path).frames
        hands = find_silhouettes(frames, faces="never")
        found = [recognizer.observation_features([hand]) for hand in hands]
        width = max(rows.shape[1] for rows in found)
        rows = [row[0] if len(row) else np.full(width, np.nan, np.float32) for row in found]
        clips.append(GestureClip(sample.label, condition, np.asarray(rows, np.float32), sample.path))
        shown[sample.path] = np.stack([_hand_alone(*pair) for pair in zip(frames, hands, strict=True)])
        progress("finding hands", len(clips), len(dataset))
    return clips, shown


def _hand_alone(frame: NDArray[np.uint8], hand: Any) -> Pictures:
    grey = subsample(frame.mean(axis=2, dtype=np.float32))
    return np.where(subsample(np.asarray(hand.mask) > 0) > 0.5, grey, np.float32(0))


class _Changes:
    """Changes from picture to picture of joined clips, those within a clip worked out once.

    Between two clips the last pictures are played to and fro: the pause that the thesis's signers make, with the noise
    that a camera has.
    """

    def __init__(self, shown: dict[Path, Pictures], way: str) -> None:
        self._shown, self._per_pixel = shown, way == CHANGES[1]
        self._within = {path: direction_changes(pictures, self._per_pixel) for path, pictures in shown.items()}

    def of(self, sentence: GestureSentence, paths: Sequence[Path]) -> NDArray[np.float64]:
        parts = [self._within[paths[0]]]
        for before, path, (_, _, end), (_, first, _) in zip(
            paths, paths[1:], sentence.spans, sentence.spans[1:], strict=False
        ):
            last = self._shown[before][-_TO_AND_FRO:]
            order = np.concatenate([np.arange(len(last))[::-1], np.arange(len(last))[1:-1]])
            pause = last[np.resize(order, first - end + 1)]
            parts += [direction_changes([*pause, self._shown[path][0]], self._per_pixel), self._within[path]]
        return np.concatenate(parts)


def _near(sentence: GestureSentence, parts: Sequence[Span]) -> list[bool]:
    """As `gesture-sentences` counts boundaries."""
    firsts, ends = [first for first, _ in parts], [last for _, last in parts]
    wanted = [(last, ends) for _, _, last in sentence.spans[:-1]]
    wanted += [(first, firsts) for _, first, _ in sentence.spans[1:]]
    return [any(abs(frame - at) <= TOLERANCE for at in places) for frame, places in wanted]


def _choose(sentences: Sequence[GestureSentence], changes: Sequence[Any]) -> _Split:
    """What gives the right number of parts most often in the conditions trained on, then the most boundaries."""
    scored = []
    for share, min_pause in product(SHARES, MIN_PAUSES):
        parts = [split_at_pauses(one, share, min_pause) for one in changes]
        off = sum(abs(len(p) - len(s.spans)) for p, s in zip(parts, sentences, strict=True))
        near = sum(sum(_near(s, p)) for p, s in zip(parts, sentences, strict=True))
        scored.append((-off, near, share, min_pause))
    best = max(scored)
    return _Split(best[2], best[3])


def _made(clips: Sequence[GestureClip], gap: int, seed: int) -> list[tuple[GestureSentence, list[Path]]]:
    """Sentences as `gesture-sentences` makes them, with the files of their clips."""
    sentences = sentences_of(clips, gap, seed)
    by_rows = {clip.rows.tobytes(): clip.path for clip in clips}
    return [(s, [by_rows[s.rows[first:last].tobytes()] for _, first, last in s.spans]) for s in sentences]


def _run(data_dir: Path, progress: Progress, *, folds: int | None = None) -> dict[str, Any]:
    clips, shown = _read(data_dir, progress)
    conditions = list(dict.fromkeys(clip.condition for clip in clips))
    changes = {way: _Changes(shown, way) for way in CHANGES}
    counts: dict[tuple[int, str, str], CountedWords] = {}
    chosen: dict[str, dict[str, list[float]]] = {way: {} for way in CHANGES}
    for done, condition in enumerate(conditions[:folds]):
        train = [clip for clip in clips if clip.condition != condition]
        test = [clip for clip in clips if clip.condition == condition]
        names = [clip.label for clip in train]
        middle = [key_frames((0, len(seen_rows(clip.rows)))) for clip in train]
        models = {
            WHOLE: GestureRecognizer(source="silhouettes").fit_features([seen_rows(c.rows) for c in train], names),
            MIDDLE: GestureRecognizer(source="silhouettes").fit_features(
                [seen_rows(c.rows)[a:b] for c, (a, b) in zip(train, middle, strict=True)], names
            ),
        }
        others = [name for name in conditions if name != condition]
        known = [
            made
            for number, name in enumerate(others)
            for gap in GAPS
            for made in _made([clip for clip in train if clip.condition == name], gap, SEED + 1 + number)
        ]
        for way in CHANGES:
            split = _choose([s for s, _ in known], [changes[way].of(*made) for made in known])
            chosen[way][condition] = [split.share, split.min_pause]
            for gap in GAPS:
                made = _made(test, gap, SEED)
                parts = [split_at_pauses(changes[way].of(*one), split.share, split.min_pause) for one in made]
                near = [close for (s, _), found in zip(made, parts, strict=True) for close in _near(s, found)]
                for what, gestures in models.items():
                    spans = parts if what == WHOLE else [[key_frames(p) for p in found] for found in parts]
                    named = [
                        [name_whole(gestures, s.rows[a:b]) for a, b in found]
                        for (s, _), found in zip(made, spans, strict=True)
                    ]
                    counts.setdefault((gap, way, what), CountedWords()).add(
                        condition, [s.labels for s, _ in made], named, near
                    )
        progress("splitting", done + 1, len(conditions))
    rows = [counted.row(frames_between=gap, change=way, named=what) for (gap, way, what), counted in counts.items()]
    for row in rows:
        row |= {f"{name}_mean": row["over_all"][name] for name in ("words_right", "boundaries_near")}
    return {"seed": SEED, "share_and_min_pause": chosen, "rows": rows, "passed": None}


STUDIES = (
    Study(
        "sentence-splitting",
        "the joined clips of gesture-sentences split at pauses of the gradient between pictures, as the thesis does "
        "it, a condition of light and background left out: words right, word errors and boundaries within 5 frames",
        (FOLDER,),
        "none: a baseline beside the decoder of gesture-sentences",
        _run,
        Layout(columns="named", measure="word_error"),
        sources=GESTURE_SOURCES,
        folds=True,
    ),
)
