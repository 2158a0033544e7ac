# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The clips of `webcam` on a screen, as the simulated NAO sees them, against the clips themselves."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from hri.datasets import Dataset
from hri.live import ClipSource, Watcher
from hri.live.frames import TimedFrame
from hri.media import read_frames
from hri.media.video import Clip
from hri.recognition import GestureRecognizer
from hri.robot import NAO, Screen
from hri.robot.simulation.pybullet_backend import PyBulletRobot
from hri.studies.registry import GESTURE_SOURCES, Progress, Study
from hri.studies.tables import statistics
from hri.studies.webcam import FOLDER, PATTERN

NUM_FOLDS = 3
SEED = 0
CAMERA, CAMERA_FPS = "CameraTop", 15.0
MAX_GAP = 0.05


class _Timed(ClipSource):
    """Pictures with their times."""

    def __init__(self, name: str, fps: float, timed: Iterator[TimedFrame]) -> None:
        super().__init__((), fps, name)
        self._timed = timed


def _clip(clip: Clip) -> _Timed:
    return _Timed(clip.path.name, 25.0, iter(list(zip(clip.frames, clip.times_s, strict=True))))


def _seen(clip: Clip, robot: PyBulletRobot, screen: Screen) -> _Timed:
    """What NAO takes of the clip while it is played: BGR, as its camera gives it."""

    def pictures() -> Iterator[TimedFrame]:
        for time_s in np.arange(0.0, clip.times_s[-1] + 1e-9, 1.0 / CAMERA_FPS):
            shown = int(np.searchsorted(clip.times_s, time_s + 1e-9, side="right")) - 1
            screen.show(clip.frames[max(0, shown)][..., ::-1])
            yield np.ascontiguousarray(robot.see(CAMERA)[..., ::-1]), float(time_s)

    return _Timed(clip.path.name, CAMERA_FPS, pictures())


def _best(source: ClipSource, signs: GestureRecognizer) -> str:
    """The best class of the last decision; "" without any."""
    decided = [event.decision for event in Watcher(signs).watch(source) if event.event == "decision"]
    last = decided[-1] if decided else None
    return last.nbest[0].label if last is not None and last.nbest else ""


def _measure(data_dir: Path, progress: Progress, *, folds: int | None = None) -> dict[str, Any]:
    dataset = Dataset.load(data_dir / FOLDER, "gesture", PATTERN)
    labels = [sample.label for sample in dataset.samples]
    features = []
    for done, sample in enumerate(dataset.samples):
        features.append(GestureRecognizer().features(read_frames(sample.path).frames))
        progress("finding hands", done + 1, len(dataset))
    per_fold: dict[str, dict[str, float]] = {"clip": {}, "seen by NAO": {}, "agree": {}}
    parts = dataset.folds_stratified(NUM_FOLDS, SEED)[:folds]
    screen = Screen()
    with PyBulletRobot(table=NAO) as robot:
        robot.put_screen(screen)
        for part, fold in enumerate(parts):
            signs = GestureRecognizer().fit_features([features[i] for i in fold.train], [labels[i] for i in fold.train])
            found: dict[str, list[bool]] = {name: [] for name in per_fold}
            for i in fold.test:
                clip = read_frames(dataset.samples[i].path)
                direct, seen = _best(_clip(clip), signs), _best(_seen(clip, robot, screen), signs)
                rights = (direct == labels[i], seen == labels[i], direct == seen)
                for name, right in zip(per_fold, rights, strict=True):
                    found[name].append(right)
            for name, each in found.items():
                per_fold[name][fold.name] = float(np.mean(each))
            progress("watching", part + 1, len(parts))
    rows = [{"pictures": name, **statistics(values)} for name, values in per_fold.items()]
    gap = rows[0]["accuracy_mean"] - rows[1]["accuracy_mean"]
    return {
        "seed": SEED,
        "num_folds": NUM_FOLDS,
        "camera": CAMERA,
        "camera_fps": CAMERA_FPS,
        "screen_m": list(screen.size_m),
        "distance_m": screen.centre_m[0],
        "rows": rows,
        "passed": bool(gap <= MAX_GAP),
    }


STUDIES = (
    Study(
        "nao-camera",
        f"the clips of webcam-live on a screen before the simulated NAO, {NUM_FOLDS} folds",
        (FOLDER,),
        f"what NAO's camera sees is recognised as often as the clips as streams, less {100 * MAX_GAP:.0f} points",
        _measure,
        sources=GESTURE_SOURCES,
        folds=True,
    ),
)
