# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""How near HOAP-2's hands come to the hands of people who sign sentences."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from hri.robot import HOAP2, check_pulse_csv, read_pulse_csv, write_pulse_csv
from hri.robot.imitation import FORMS, Imitation, ImitationOptions, imitate, read_hand_tracks
from hri.studies.registry import Layout, Progress, Study

TARGET_M = 0.02
_SIDES = ("left", "right")


def _run(data_dir: Path, progress: Progress, *, form: Sequence[str] = FORMS) -> dict[str, Any]:
    tracks = read_hand_tracks(data_dir / "asl_sentences" / "hands.csv")
    rows: list[dict[str, Any]] = []
    parts: dict[str, dict[str, Any]] = {}
    for chosen in form:
        options = ImitationOptions(form=chosen)
        made, limits = [], []
        for done, track in enumerate(tracks.values(), start=1):
            made.append(imitate(track, options))
            limits.append(_limits(made[-1]))
            progress(f"imitating, {chosen}", done, len(tracks))
        rows += [{"form": chosen, "hand": side, **_measured(made, i)} for i, side in enumerate(_SIDES)]
        slower = [m.report()["slower"] for m in made]
        parts[chosen] = {
            "sentences": len(made),
            "findings_in_files": sum(found["findings"] for found in limits),
            "top_speed_rad_s": max(found["speed"] for found in limits),
            "top_acceleration_rad_s2": max(found["acceleration"] for found in limits),
            "acceleration_limit_rad_s2": options.max_acceleration_rad_s2,
            "least_clearance_m": min(m.clearance_m for m in made),
            "slower_median": float(np.median(slower)),
            "slower_most": float(np.max(slower)),
        }
    best = [row for row in rows if row["form"] == form[0]]
    kept = all(
        part["findings_in_files"] == 0
        and part["top_speed_rad_s"] <= HOAP2.max_speed_rad_s
        and part["top_acceleration_rad_s2"] <= part["acceleration_limit_rad_s2"]
        for part in parts.values()
    )
    near = (
        all(row["rms_cm_mean"] is not None and row["rms_cm_mean"] <= 100.0 * TARGET_M for row in best)
        and parts[form[0]]["least_clearance_m"] > 0.0
    )
    return {"rows": rows, "limits": parts, "passed": bool(kept and near)}


def _limits(made: Imitation) -> dict[str, float]:
    """What a robot gets: the motion from the file, whole pulses; its greatest speed and acceleration as made."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "motion.csv"
        write_pulse_csv(path, made.trajectory)
        findings = len(check_pulse_csv(path))
        speeds = np.diff(read_pulse_csv(path).positions_rad, axis=0) / made.trajectory.period_s
    exact = np.diff(made.trajectory.positions_rad, 2, axis=0) / made.trajectory.period_s**2
    return {
        "findings": findings,
        "speed": float(np.abs(speeds).max()),
        "acceleration": float(np.abs(exact).max()),
    }


def _measured(made: Sequence[Imitation], hand: int) -> dict[str, float | None]:
    errors = np.concatenate([m.errors_m[hand] for m in made])
    reached = np.concatenate([m.reached[hand] for m in made])
    seen = np.isfinite(errors)
    return {
        "reached_percent_mean": 100.0 * float(reached.sum() / max(seen.sum(), 1)),
        "rms_cm_mean": _rms_cm(errors[reached]),
        "worst_cm_mean": 100.0 * float(errors[reached].max()) if reached.any() else None,
        "rms_all_frames_cm_mean": _rms_cm(errors[seen]),
    }


def _rms_cm(errors_m: np.ndarray[Any, np.dtype[np.float64]]) -> float | None:
    return 100.0 * float(np.sqrt(np.mean(errors_m**2))) if len(errors_m) else None


STUDIES = (
    Study(
        "imitation",
        "the robot's hands against the scaled hands of 161 signed sentences, as seen from the front: the share of "
        "frames within reach, and the distance there and in all frames; least-motion poses and plain angles",
        ("asl_sentences",),
        "within 2 cm RMS over all frames within reach, no limit of position, speed or acceleration exceeded",
        _run,
        layout=Layout(measure="rms_cm", percent=False),
        axes={"form": FORMS},
        quick={"form": FORMS[:1]},
    ),
)
