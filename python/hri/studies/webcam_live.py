# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The clips of `webcam`, watched as a camera would show them, against the same clips recognised as files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from hri.datasets import Dataset
from hri.live import ClipSource, Watcher
from hri.media import read_frames
from hri.media.video import Clip
from hri.recognition import Decision, GestureRecognizer
from hri.studies.registry import GESTURE_SOURCES, Progress, Study
from hri.studies.tables import statistics
from hri.studies.webcam import FOLDER, PATTERN

NUM_FOLDS = 3
SEEDS = (0,)
MAX_GAP = 0.05


class _Filmed(ClipSource):
    """A clip with the times it was filmed at."""

    def __init__(self, clip: Clip) -> None:
        super().__init__((), 25.0, clip.path.name)
        self._timed = iter(list(zip(clip.frames, clip.times_s, strict=True)))


def _best(decision: Decision | None) -> str:
    return decision.nbest[0].label if decision is not None and decision.nbest else ""


def _live(data_dir: Path, progress: Progress, *, folds: int | None = None) -> dict[str, Any]:
    dataset = Dataset.load(data_dir / FOLDER, "gesture", PATTERN)
    labels = [sample.label for sample in dataset.samples]
    features = []
    for done, sample in enumerate(dataset.samples):
        features.append(GestureRecognizer().features(read_frames(sample.path).frames))
        progress("finding hands", done + 1, len(dataset))
    per_fold: dict[str, dict[str, float]] = {"file": {}, "live": {}, "agree": {}}
    decisions, wrong, preliminary, compute_ms = [], [], [], []
    for seed in SEEDS:
        for part, fold in enumerate(dataset.folds_stratified(NUM_FOLDS, seed)[:folds]):
            signs = GestureRecognizer().fit_features([features[i] for i in fold.train], [labels[i] for i in fold.train])
            found: dict[str, list[bool]] = {name: [] for name in per_fold}
            for i in fold.test:
                file = _best(signs.recognise_features(features[i]))
                events = list(Watcher(signs).watch(_Filmed(read_frames(dataset.samples[i].path))))
                decided = [event for event in events if event.event == "decision"]
                decisions.append(len(decided))
                preliminary.append(sum(event.event == "preliminary" for event in events))
                obeyed = [event.fields["final"] for event in decided if event.fields["final"]]
                wrong.append(sum(label != labels[i] for label in obeyed))
                compute_ms += [event.fields["compute_ms"] for event in decided]
                live = _best(decided[-1].decision) if decided else ""
                for name, right in (("file", file == labels[i]), ("live", live == labels[i]), ("agree", live == file)):
                    found[name].append(right)
            for name, each in found.items():
                per_fold[name][f"seed {seed}, {fold.name}"] = float(np.mean(each))
            progress("watching", seed * NUM_FOLDS + part + 1, len(SEEDS) * NUM_FOLDS)
    rows = [{"clips": name, **statistics(values)} for name, values in per_fold.items()]
    gap = rows[0]["accuracy_mean"] - rows[1]["accuracy_mean"]
    return {
        "seeds": list(SEEDS),
        "num_folds": NUM_FOLDS,
        "rows": rows,
        "decisions_a_clip": float(np.mean(decisions)),
        "wrong_decisions_a_clip": float(np.mean(wrong)),
        "preliminary_a_clip": float(np.mean(preliminary)),
        "median_compute_ms": float(np.median(compute_ms)) if compute_ms else None,
        "passed": bool(gap <= MAX_GAP),
    }


STUDIES = (
    Study(
        "webcam-live",
        f"dynamic gestures before webcams: trained on two thirds, the rest as files and as streams, {NUM_FOLDS} folds",
        (FOLDER,),
        f"the last decision of the stream is right as often as that of the file, less {100 * MAX_GAP:.0f} points",
        _live,
        sources=GESTURE_SOURCES,
        folds=True,
    ),
)
