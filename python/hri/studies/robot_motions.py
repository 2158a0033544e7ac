# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Whether HOAP-2 walks and stands up by its factory's motions in simulation, as it is and when it is a little off."""

from __future__ import annotations

import multiprocessing
import os
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from hri.robot import HOAP2, MotionLog, Physics, Robot, open_robot, read_pulse_csv
from hri.robot.control.state import RobotState
from hri.studies.registry import Layout, Progress, Study

MOTIONS = {"walk.csv": "standing", "stand_up_back.csv": "back"}
_LEAST_WAY_M = 1.8
_MOST_YAW_DEG = 5.0
_LEAST_HEIGHT_M = 0.27
_HOLD_S = 2.0
_LOG_S = 0.02

CONDITIONS: dict[str, Physics] = {
    "as built": Physics(),
    "friction 0.6": Physics(friction=0.6),
    "friction 1.2": Physics(friction=1.2),
    "mass -10 %": Physics(mass_scale=0.9),
    "mass +10 %": Physics(mass_scale=1.1),
}
SEEDS = tuple(range(600, 608))
_OFFSET_DEG = 1.0
_NEEDED = 7


@dataclass(frozen=True)
class Outcome:
    """How a motion went: forward is along the first heading; the height is the least while it held its last pose."""

    forward_m: float
    yaw_deg: float
    lean_deg: float
    height_m: float
    fallen: bool
    self_contacts: tuple[str, ...]

    def success(self, motion: str) -> bool:
        """Whether it met the target of this motion."""
        if self.fallen or self.height_m < _LEAST_HEIGHT_M:
            return False
        if motion != "walk.csv":
            return True
        return self.forward_m >= _LEAST_WAY_M and abs(self.yaw_deg) < _MOST_YAW_DEG and not self.self_contacts


def play(path: Path, posture: str, physics: Physics) -> Outcome:
    """Carry out one file from one posture and hold its end for two seconds."""
    trajectory = read_pulse_csv(path)
    idle = [name for name in HOAP2.names if name not in trajectory.joint_names]
    with open_robot("pybullet", fixed_base=False, locked=idle, physics=physics) as robot:
        first = trajectory.positions_rad[0].tolist()
        robot.reset(dict(zip(trajectory.joint_names, first, strict=True)), posture)
        begin = robot.state()
        log = MotionLog(_LOG_S)
        robot.perform(trajectory, log=log)
        held = len(log.states)
        robot.hold(_HOLD_S, log)
        return _outcome(robot, begin, log, held)


def _outcome(robot: Robot, begin: RobotState, log: MotionLog, held: int) -> Outcome:
    end = log.states[-1]
    way = np.subtract(end.base_position_m, begin.base_position_m)
    yaw = begin.base_rpy_rad[2]
    turned = (np.degrees(end.base_rpy_rad[2] - yaw) + 180.0) % 360.0 - 180.0
    touching = {f"{contact.link} - {contact.other}" for contact in robot.self_contacts}
    return Outcome(
        forward_m=float(way[0] * np.cos(yaw) + way[1] * np.sin(yaw)),
        yaw_deg=float(turned),
        lean_deg=float(np.degrees(np.abs([state.base_rpy_rad[:2] for state in log.states]).max())),
        height_m=min((state.base_position_m[2] for state in log.states[held:]), default=0.0),
        fallen=any(event.kind == "fall" for event in robot.events),
        self_contacts=tuple(sorted(touching)),
    )


def offsets(seed: int) -> dict[str, float]:
    """Every joint is off by an angle between -1 and 1 degree, each as likely."""
    drawn = np.random.default_rng(seed).uniform(-_OFFSET_DEG, _OFFSET_DEG, len(HOAP2))
    return dict(zip(HOAP2.names, np.radians(drawn).tolist(), strict=True))


def _factory_motions(data_dir: Path, progress: Progress) -> dict[str, Any]:
    rows, passed = [], True
    for number, (motion, posture) in enumerate(MOTIONS.items()):
        progress(motion, number, len(MOTIONS))
        outcome = play(data_dir / motion, posture, Physics())
        passed &= outcome.success(motion)
        rows.append(_row(motion, outcome))
    return {"passed": passed, "rows": rows}


def _row(motion: str, outcome: Outcome) -> dict[str, Any]:
    measured = {f"{name}_mean": value for name, value in asdict(outcome).items() if isinstance(value, float)}
    return {
        "motion": motion,
        **measured,
        "fallen": outcome.fallen,
        "self contacts": ", ".join(outcome.self_contacts) or "none",
    }


def _factory_robustness(data_dir: Path, progress: Progress, **chosen: Any) -> dict[str, Any]:
    motions = chosen.get("motion", tuple(MOTIONS))
    conditions = chosen.get("condition", tuple(CONDITIONS))
    jobs = {(m, c, s): _with_offsets(CONDITIONS[c], s) for m in motions for c in conditions for s in SEEDS}
    found: dict[tuple[str, str, int], Outcome] = {}
    # Not forked: a fork of a process with threads may hang.
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(min(len(jobs), os.cpu_count() or 1), mp_context=context) as pool:
        waiting = {
            pool.submit(play, data_dir / motion, MOTIONS[motion], physics): (motion, condition, seed)
            for (motion, condition, seed), physics in jobs.items()
        }
        try:
            for done in as_completed(waiting):
                found[waiting[done]] = done.result()
                progress(" ".join(map(str, waiting[done])), len(found), len(jobs))
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
    rows = [_robustness_row(motion, condition, found) for motion in motions for condition in conditions]
    return {
        "passed": all(row["successes_mean"] >= _NEEDED for row in rows),
        "seeds": list(SEEDS),
        "rows": rows,
        "runs": [{"motion": m, "condition": c, "seed": s, **asdict(found[m, c, s])} for m, c, s in jobs],
    }


def _with_offsets(physics: Physics, seed: int) -> Physics:
    return Physics(physics.friction, physics.mass_scale, offsets(seed))


def _robustness_row(motion: str, condition: str, found: dict[tuple[str, str, int], Outcome]) -> dict[str, Any]:
    outcomes = [found[motion, condition, seed] for seed in SEEDS]
    return {
        "motion": motion,
        "condition": condition,
        "successes_mean": float(sum(outcome.success(motion) for outcome in outcomes)),
        "least_forward_m_mean": min(outcome.forward_m for outcome in outcomes),
        "most_yaw_deg_mean": max(abs(outcome.yaw_deg) for outcome in outcomes),
        "least_height_m_mean": min(outcome.height_m for outcome in outcomes),
    }


STUDIES = (
    Study(
        name="factory-motions",
        summary="HOAP-2 walks and stands up in simulation by the motions of its factory",
        data=tuple(MOTIONS),
        target="walks 1.8 m or more, turned by less than 5 degrees, without touching itself; stands up and keeps "
        "its base above 0.27 m for 2 s",
        run=_factory_motions,
        layout=Layout(measure="forward_m", percent=False),
    ),
    Study(
        name="factory-robustness",
        summary="the same with other friction and masses, every joint off by up to a degree",
        data=tuple(MOTIONS),
        target=f"succeeds for at least {_NEEDED} of {len(SEEDS)} seeds in every condition",
        run=_factory_robustness,
        layout=Layout(measure="successes", percent=False),
        axes={"motion": tuple(MOTIONS), "condition": tuple(CONDITIONS)},
        quick={"motion": ("walk.csv",), "condition": ("as built",)},
    ),
)
