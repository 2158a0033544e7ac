# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The robot: reading and checking a long motion, simulating one on its feet, filming a gesture."""

from __future__ import annotations

import io
import os
import tempfile
import time
from pathlib import Path

import numpy as np

from hri.robot import (
    HOAP2,
    Trajectory,
    check_pulse_csv,
    gesture_trajectory,
    open_robot,
    read_pulse_csv,
    render_video,
    write_pulse_csv,
)
from timing import Bench, Timed, medians

ROWS = 26_000
VIDEO_BUDGET_S = 10.0


def _motion(rows: int) -> Trajectory:
    """Every counted joint sways about rest within its limits; legs so little that the robot stays upright."""
    joints = HOAP2.counted
    times = 0.001 * np.arange(rows)[:, np.newaxis]
    arms = np.array(["arm" in joint.name for joint in joints])
    limits = np.array([(joint.lower_rad, joint.upper_rad) for joint in joints])
    rest = np.array([joint.rest_rad for joint in joints])
    middle = np.clip(rest, limits[:, 0] + 0.3 * arms, limits[:, 1] - 0.3 * arms)
    phase = np.arange(len(joints)) / 3.0
    positions = middle + np.where(arms, 0.2, 0.005) * np.sin(2.0 * np.pi * 0.5 * times + phase)
    return Trajectory([joint.name for joint in joints], 0.001, positions)


def robot_csv() -> Timed:
    """Reading a motion of 26000 rows, to radians and checking all of it; the peer only reads the numbers."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "motion.csv"
        write_pulse_csv(path, _motion(ROWS))
        text = path.read_text()
        assert [f for f in check_pulse_csv(path) if f.severity == "error"] == []

        def peer() -> np.ndarray:
            return np.loadtxt(io.StringIO(text), delimiter=",", usecols=range(2, 23), dtype=np.int64)

        pulses = np.array([joint.pulses_per_degree for joint in HOAP2.counted])
        found = read_pulse_csv(path)
        assert found.joint_names == tuple(joint.name for joint in HOAP2.counted)
        np.testing.assert_array_equal(np.rint(np.degrees(found.positions_rad) * pulses), peer())
        ours, theirs = medians(lambda: check_pulse_csv(path), peer, repeats=7)
        begin_cpu = time.process_time()
        check_pulse_csv(path)
        return ours, theirs, {"processor_time_s": time.process_time() - begin_cpu}


def robot_walk() -> Timed:
    """Simulating a motion of the robot on its feet: walk.csv in HRI_DATA, else a made one; the peer is real time.

    On a machine that does other things too, the time of this process alone says more than the wall clock.
    """
    path = Path(os.environ.get("HRI_DATA", ".")) / "walk.csv"
    motion = read_pulse_csv(path) if path.is_file() else _motion(5_000)
    idle = [name for name in HOAP2.names if name not in motion.joint_names]
    with open_robot("pybullet", fixed_base=False, locked=idle) as robot:
        robot.reset(dict(zip(motion.joint_names, motion.positions_rad[0].tolist(), strict=True)), "standing")
        begin, begin_cpu = time.perf_counter(), time.process_time()
        done = robot.perform(motion)
        ours, ours_cpu = time.perf_counter() - begin, time.process_time() - begin_cpu
        assert done and robot.events == []
        factors = {
            "real_time_factor": motion.duration_s / ours,
            "real_time_factor_of_processor_time": motion.duration_s / ours_cpu,
        }
        return ours, motion.duration_s, {"forward_m": robot.state().base_position_m[0], **factors}


def robot_video() -> Timed:
    """Filming five seconds of gestures with physics, at the pictures' default size and rate; the peer is 10 s."""
    gesture = gesture_trajectory("namaste")
    times = np.linspace(0.0, gesture.duration_s, 501)
    five = Trajectory(gesture.joint_names, 0.01, gesture.at(times))
    with tempfile.TemporaryDirectory() as folder:
        begin, begin_cpu = time.perf_counter(), time.process_time()
        frames = render_video(five, Path(folder) / "gesture.mp4")
        ours, ours_cpu = time.perf_counter() - begin, time.process_time() - begin_cpu
        assert frames == 61
    return ours, VIDEO_BUDGET_S, {"processor_time_s": ours_cpu}


BENCHES = (
    Bench("robot_csv", robot_csv, "numpy.loadtxt"),
    Bench("robot_walk", robot_walk, "real time"),
    Bench("robot_video", robot_video, "budget of 10 s"),
)
