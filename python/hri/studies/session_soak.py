# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Two hours of a session with a robot, faster than they would last: memory, the same decisions, the same replayed."""

from __future__ import annotations

import math
from collections.abc import Iterable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from hri.live import Event
from hri.live.sources import BLOCK_S
from hri.robot import gesture_trajectory, open_robot
from hri.session import McapRecorder, Session, SessionOptions, decisions, read_recording, replay
from hri.studies.endurance import (
    MAX_GROWTH,
    SEED,
    RepeatedPictures,
    RepeatedSound,
    endure,
    signs_and_pictures,
    words_and_stream,
)
from hri.studies.registry import GESTURE_SOURCES, WORD_SOURCES, Layout, Progress, Study
from hri.studies.tables import statistics

HOURS = 2
REPLAYS = 3
"""Of a recording of one round."""
EVERY = 2
"""So many frames of the clips make a picture."""
MOTION = "wave"


def decision_of_session(event: Event) -> tuple[str, str] | None:
    """What a session decided; None for another event."""
    return (event.fields["final"], event.fields["status"]) if event.event == "fused" else None


def _run(data_dir: Path, progress: Progress, *, folds: int | None = None) -> dict[str, Any]:
    hours = folds or HOURS
    signs, timed, end_s = signs_and_pictures(data_dir, progress)
    timed = timed[::EVERY]
    round_s = math.ceil(end_s / BLOCK_S) * BLOCK_S
    words, stream, rate = words_and_stream(data_dir, round_s)
    labels = [str(label) for recogniser in (words, signs) for label in recogniser.classes_]
    # Both modes decide apart: digits and gestures share no label, and what they mean together is not asked here.
    options = SessionOptions(confirm_below=0)
    moved = 0
    with open_robot("kinematic") as robot:
        session = Session(words, signs, robot, options, motions=dict.fromkeys(labels, gesture_trajectory(MOTION)))

        def listen(num_rounds: int) -> Iterable[Event]:
            nonlocal moved
            sound, pictures = RepeatedSound(stream, rate, num_rounds), RepeatedPictures(timed, round_s, num_rounds)
            for event in session.run(sound, pictures):
                moved += event.event == "motion_end" and event.fields["completed"]
                yield event

        found = endure(listen, round_s, hours, lambda done, total: progress("hours", done, total), decision_of_session)
        with TemporaryDirectory() as folder:
            path = Path(folder) / "session.mcap"
            recorder = McapRecorder(path)
            sources = RepeatedSound(stream, rate, 1), RepeatedPictures(timed, round_s, 1)
            first = decisions([event.to_dict() for event in session.run(*sources, recorder=recorder)])
            again = {}
            for turn in range(REPLAYS):
                events = [event.to_dict() for event in replay(read_recording(path), words, signs)]
                again[f"replay {turn + 1}"] = float(decisions(events) == first)
                progress("replays", turn + 1, REPLAYS)
    rows = [
        {"session": "hours", **statistics(found.pop("same"), "same")},
        {"session": "replayed", **statistics(again, "same")},
    ]
    passed = all(row["same_mean"] == 1 for row in rows) and found["growth"] <= MAX_GROWTH and moved > 0
    return {"seed": SEED, "rows": rows, **found, "motions": moved, "decisions_replayed": len(first), "passed": passed}


STUDIES = (
    Study(
        "session-soak",
        f"{HOURS} hours of a session of words and gestures that move a robot, the same minute again and again, faster "
        "than they would last; and a recorded minute replayed",
        ("fsdd/recordings", "webcam_gestures"),
        f"memory at the end within {100 * MAX_GROWTH:.0f} % of that after the first hour, every round and every replay "
        "decided alike",
        _run,
        Layout(measure="same"),
        sources=(
            *dict.fromkeys(
                (
                    *WORD_SOURCES,
                    "cpp/signal/stream",
                    *GESTURE_SOURCES,
                )
            ),
        ),
        folds=True,
    ),
)
