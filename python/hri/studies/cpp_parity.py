# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The C++ programs of ``examples/gestures`` against Python on real clips: equal to the bit, or not.

Clips are compared twice: as they were filmed, which each side decodes by an OpenCV of its own, and as Motion JPEG of
the frames that Python read, which every decoder reads alike.
"""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from hri.core.errors import InvalidArgument
from hri.datasets import Dataset
from hri.live import VideoSource, Watcher
from hri.media import read_frames, write_video
from hri.recognition import GestureRecognizer
from hri.studies.registry import GESTURE_SOURCES, Layout, Progress, Study
from hri.studies.tables import statistics
from hri.studies.webcam import FOLDER, PATTERN

NUM_FOLDS = 3
PROGRAMS = "HRI_PROGRAMS"
"""The environment variable that names the folder of the programs."""

Lines = list[tuple[str, ...]]


def _programs() -> Path:
    folder = Path(os.environ.get(PROGRAMS, ""))
    for name in _COMPARED:
        if not os.environ.get(PROGRAMS) or not (folder / name).is_file():
            raise InvalidArgument(
                f"{PROGRAMS} must name the folder of {', '.join(_COMPARED)}: install libhri, then "
                "cmake -S examples/gestures -B programs -DCMAKE_PREFIX_PATH=PREFIX && cmake --build programs"
            )
    return folder


def _run(program: Path, model: Path, video: Path) -> Lines:
    done = subprocess.run([str(program), str(model), str(video)], capture_output=True, text=True)
    if done.returncode != 0:
        return [("failed", done.stderr.strip())]
    return [tuple(_exact(text) for text in line.split("\t")) for line in done.stdout.splitlines()]


def _exact(text: str) -> str:
    """Numbers in hexadecimal in one way of writing them."""
    return float.fromhex(text).hex() if "0x" in text else text


def _recognised(recognizer: GestureRecognizer, video: Path) -> Lines:
    decision = recognizer.recognise(read_frames(video))
    nbest = [(n.label, float(n.probability).hex(), float(n.log_score).hex()) for n in decision.nbest]
    return [(decision.label, float(decision.confidence).hex(), float(decision.score).hex()), *nbest]


def _watched(recognizer: GestureRecognizer, video: Path) -> Lines:
    lines: Lines = []
    for event in Watcher(recognizer).watch(VideoSource(video)):
        if event.event in ("preliminary", "decision") and event.decision is not None:
            times = (f"{event.fields['first_s']:.4f}", f"{event.fields['last_s']:.4f}")
            lines.append((event.event, *times, event.decision.label, float(event.decision.score).hex()))
    return lines


_COMPARED: dict[str, Callable[[GestureRecognizer, Path], Lines]] = {
    "recognise_gesture": _recognised,
    "watch_video": _watched,
}


def _compare(data_dir: Path, progress: Progress, *, folds: int | None = None) -> dict[str, Any]:
    programs = _programs()
    dataset = Dataset.load(data_dir / FOLDER, "gesture", PATTERN)
    samples = dataset.samples
    features = []
    for done, sample in enumerate(samples):
        features.append(GestureRecognizer().features(read_frames(sample.path).frames))
        progress("finding hands", done + 1, len(samples))
    equal: dict[tuple[str, str], dict[str, float]] = {}
    different: list[str] = []
    with TemporaryDirectory() as directory:
        model = Path(directory) / "gestures.hri"
        for fold in dataset.folds_stratified(NUM_FOLDS, 0)[:folds]:
            labels = [samples[i].label for i in fold.train]
            GestureRecognizer().fit_features([features[i] for i in fold.train], labels).save(model)
            recognizer = GestureRecognizer.load(model)
            found: dict[tuple[str, str], list[bool]] = {}
            for done, i in enumerate(fold.test):
                for pictures, video in _videos(samples[i].path, Path(directory)).items():
                    for name, python in _COMPARED.items():
                        lines = _run(programs / name, model, video)
                        same = lines == python(recognizer, video)
                        found.setdefault((name, pictures), []).append(same)
                        if not same:
                            why = lines[0][-1] if lines and lines[0][0] == "failed" else "other numbers"
                            different.append(f"{name}, {pictures}, {samples[i].label}/{samples[i].path.name}: {why}")
                progress(fold.name, done + 1, len(fold.test))
            for key, each in found.items():
                equal.setdefault(key, {})[fold.name] = sum(each) / len(each)
    rows = [
        {"program": name, "pictures": pictures, **statistics(per_fold, "equal")}
        for (name, pictures), per_fold in equal.items()
    ]
    passed = all(row["equal_mean"] == 1 for row in rows if row["pictures"] == "motion jpeg")
    return {"num_folds": NUM_FOLDS, "rows": rows, "different": different, "passed": passed}


def _videos(path: Path, directory: Path) -> dict[str, Path]:
    clip = read_frames(path)
    copy = directory / "clip.avi"
    write_video(copy, clip.frames, clip.fps)
    return {"as filmed": path, "motion jpeg": copy}


STUDIES = (
    Study(
        "cpp-parity",
        f"C++ programs against Python on dynamic gestures before webcams, as clips and as streams, {NUM_FOLDS} folds: "
        "the share of clips whose output is equal to the bit",
        (FOLDER,),
        "every decision and every event equal to the bit where both sides read the same pictures",
        _compare,
        Layout(columns="pictures", measure="equal"),
        sources=GESTURE_SOURCES,
        folds=True,
    ),
)
