# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""STOP said while the robot moves, by speakers that were not trained on."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from hri.datasets import Dataset
from hri.evaluation import make_noise
from hri.live import ArraySource, Event
from hri.media import read_audio
from hri.recognition import WordRecognizer
from hri.robot import HOAP2, Robot, Trajectory, gesture_trajectory, open_robot, rest_positions
from hri.session import Session, SessionOptions
from hri.session.pairing import CHANCE
from hri.studies.registry import WORD_SOURCES, Layout, Progress, Study
from hri.studies.tables import statistics

SEED = 0
WORDS = ("stop", "start", "forward", "backward", "left", "right", "up", "down", "yes", "no")
NUM_FOLDS = 3
NUM_TRIES = 200
MOTION = "wave"
INTO_S = (0.2, 2.2)
"""When STOP begins, from when the motion does."""
AFTER_S = 0.4
"""Roughly from the end of a command to the motion."""
FLOOR_DB = -65.0
MAX_STOP_MS = 150.0
MEASURES = ("motion_wait_ms", "motion_compute_ms", "stop_wait_ms", "stop_compute_ms", "stop_after_ms")
"""Of the events, but for the last: from the end of STOP as it was found when the word was over, computing included."""


class Commands:
    """Keeps where the joints are sent, as a recorder of the session."""

    def __init__(self) -> None:
        self.times_s: list[float] = []
        self.rows: list[list[float]] = []

    def joints(self, time_s: float, positions_rad: Mapping[str, float]) -> None:
        """Keep a row, in the order of the joint table."""
        self.times_s.append(time_s)
        self.rows.append([positions_rad[name] for name in HOAP2.names])

    def begin(self, about: Mapping[str, Any]) -> None:
        """Do nothing."""

    def end(self) -> None:
        """Do nothing."""

    def event(self, event: Event) -> None:
        """Do nothing."""

    def motion(self, time_s: float, label: str, trajectory: Trajectory) -> None:
        """Do nothing."""

    def sound(self, samples: Any, sample_rate_hz: int, stream_s: float, offset_s: float, stream: int) -> None:
        """Do nothing."""

    def picture(self, frame: Any, stream_s: float, offset_s: float, stream: int) -> None:
        """Do nothing."""


def within_limits(rows: list[list[float]], step_s: float) -> bool:
    """Whether positions, speeds and accelerations of all commands lie within the limits, and the joints end at rest."""
    positions = np.array(rows)
    speeds = np.diff(positions, axis=0) / step_s
    accelerations = np.diff(speeds, axis=0) / step_s
    tolerance = 1e-4
    low, high = HOAP2.limits_rad.T
    return bool(
        (positions >= low - tolerance).all()
        and (positions <= high + tolerance).all()
        and np.abs(speeds).max() <= HOAP2.max_speed_rad_s * 1.001
        and np.abs(accelerations).max() <= HOAP2.max_acceleration_rad_s2 * 1.001
        and np.abs(speeds[-1]).max() < 1e-9
    )


def play_try(
    session: Session, robot: Robot, command: Any, stop: Any, rate: int, rng: np.random.Generator
) -> dict[str, Any]:
    """One motion by a command, and STOP in the middle of it."""
    robot.resume()
    robot.reset(rest_positions())
    pause = round(0.5 * rate)
    begin = pause + len(command) + round((AFTER_S + rng.uniform(*INTO_S)) * rate)
    stream = make_noise("pink", begin + len(stop) + 2 * rate, rate, rng)
    stream *= np.float32(10 ** (FLOOR_DB / 20) / np.std(stream))
    stream[pause : pause + len(command)] += command
    stream[begin : begin + len(stop)] += stop
    sent = Commands()
    events = list(session.run(ArraySource(stream.clip(-1, 1).astype(np.float32), rate), recorder=sent))
    found: dict[str, Any] = {"started": False, "halted": False}
    for event in events:
        if event.event == "motion_start":
            found |= {"started": True, **{f"motion_{k}": event.fields[k] for k in ("wait_ms", "compute_ms")}}
        if event.event == "halt":
            found |= {"halted": robot.stopped, **{f"stop_{k}": event.fields[k] for k in ("wait_ms", "compute_ms")}}
        if event.event == "motion_end":
            found["over"] = event.fields["completed"] and event.time < begin / rate
    if found["halted"]:
        # STOP counts before its end is certain, so that its event has an end that may have been too early.
        (halt_s,) = [event.time for event in events if event.event == "halt"]
        last_s = [event.fields["last_s"] for event in events if event.event == "speech_end"][-1]
        found["stop_after_ms"] = 1000 * (halt_s - last_s) + found["stop_compute_ms"]
    found["safe"] = len(sent.rows) > 2 and within_limits(sent.rows, robot.step_s)
    return found


def _run(data_dir: Path, progress: Progress, *, folds: int | None = None) -> dict[str, Any]:
    dataset = Dataset.load(data_dir / "commands", "speech")
    chosen = [sample for sample in dataset.samples if sample.label in WORDS]
    persons = sorted({sample.person for sample in chosen})
    order = np.random.default_rng(SEED).permutation(len(persons))
    groups = [{persons[i] for i in order[part::NUM_FOLDS]} for part in range(NUM_FOLDS)][:folds]
    stopped: dict[str, float] = {}
    figures: dict[str, list[float]] = {name: [] for name in MEASURES}
    counts = dict.fromkeys(("stop_recordings", "clear", "tries", "halted", "safe", "no_motion"), 0)
    motions = dict.fromkeys((word for word in WORDS if word not in ("stop", "yes", "no")), gesture_trajectory(MOTION))
    for part, group in enumerate(groups):
        rng = np.random.default_rng(SEED + part)
        train = [s for s in chosen if s.person not in group]
        words = WordRecognizer().fit(
            [s.path for s in train], [s.label for s in train], groups=[s.person for s in train]
        )
        progress(f"part {part + 1}: trained", 2 * part + 1, 2 * NUM_FOLDS)
        clear: dict[bool, list[Any]] = {True: [], False: []}
        rate = 0
        for sample in (s for s in chosen if s.person in group):
            audio = read_audio(sample.path)
            rate = audio.sample_rate_hz
            decision = words.recognise(audio)
            right = decision.label == sample.label and decision.confidence >= max(CHANCE, decision.class_threshold)
            counts["stop_recordings"] += sample.label == "stop"
            counts["clear"] += right and sample.label == "stop"
            if right and (sample.label == "stop" or sample.label in motions):
                clear[sample.label == "stop"].append(audio.samples)
        halted: list[bool] = []
        with open_robot("kinematic") as robot:
            session = Session(words, robot=robot, options=SessionOptions(confirm_below=0), motions=motions)
            wanted = len(range(part, NUM_TRIES, NUM_FOLDS))
            while len(halted) < wanted:
                pair = (clear[False][int(rng.integers(len(clear[False])))], clear[True][len(halted) % len(clear[True])])
                found = play_try(session, robot, *pair, rate, rng)
                if not found["started"] or found.get("over"):
                    counts["no_motion"] += 1
                    if counts["no_motion"] > NUM_TRIES:
                        break
                    continue
                halted.append(found["halted"])
                counts["safe"] += found["safe"]
                for name in MEASURES:
                    if name in found:
                        figures[name].append(found[name])
        counts["tries"] += len(halted)
        counts["halted"] += sum(halted)
        stopped[f"part {part + 1} of {NUM_FOLDS}"] = float(np.mean(halted))
        progress(f"part {part + 1}: stopped", 2 * part + 2, 2 * NUM_FOLDS)
    quantiles = {
        name: {"median": float(np.median(values)), "95 %": float(np.quantile(values, 0.95)), "most": max(values)}
        for name, values in figures.items()
    }
    return {
        "seed": SEED,
        "rows": [{"tries": "all", **statistics(stopped)}],
        **counts,
        "latency": quantiles,
        "passed": bool(
            counts["halted"] == counts["safe"] == counts["tries"] > 0
            and quantiles["stop_after_ms"]["95 %"] < MAX_STOP_MS
        ),
    }


STUDIES = (
    Study(
        "session-stop",
        f"STOP said {NUM_TRIES} times in the middle of a motion, by speakers that were not trained on",
        ("commands",),
        "every clear STOP halts the robot, joints within their limits; from the end of the word to the first command "
        f"of stopping less than {MAX_STOP_MS:.0f} ms (95 %)",
        _run,
        Layout(),
        sources=(*WORD_SOURCES, "cpp/signal/stream"),
        folds=True,
    ),
)
