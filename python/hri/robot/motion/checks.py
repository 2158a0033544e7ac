# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Whether a motion is safe to carry out: known positions, inside the limits, not too fast, clear of itself."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import chain
from os import PathLike

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument
from hri.robot.model.joints import HOAP2, Joint, JointTable
from hri.robot.motion.jumps import find_jumps, without_jumps
from hri.robot.motion.pulse_csv import parse_pulse_csv, trajectory_from_counts
from hri.robot.motion.rates import SHORT_S, SMOOTHING_S, calm_joints, short_measures, smoothed_measures
from hri.robot.motion.self_collision import self_collisions
from hri.robot.motion.trajectory import Finding, Trajectory, TrajectoryError

LIMIT_TOLERANCE_RAD = float(np.radians(1.5 / 209.0))  # limits are written in whole pulses, or rounded
# A leg moves its foot by 4 mm when its hip is off by a degree, and balancing turns hips and ankles.
_LEGS_NEARER_THAN_M = 0.005
_BEYOND_REASON_RAD = 1e6  # an error anyway; squares of what is measured stay finite


def check_trajectory(
    trajectory: Trajectory, table: JointTable = HOAP2, others_rad: Mapping[str, float] | None = None
) -> list[Finding]:
    """Look over a whole motion before any of it is carried out.

    Errors are an unknown joint, a position that is not finite or outside its joint's limits, a speed, acceleration or
    jerk above the motors' (`rates`), jumps to single rows that are no isolated glitch (`jumps`), and links that overlap
    (`self_collisions`). A step to one row that is too fast, while the 10 ms about it are not, is a warning: a dropped
    sample. So are legs that come within 5 mm of one another, once for every pair of links: on a robot that balances
    they may graze. The motion counts as held before its first row and after its last. Rows in succession with the same
    fault of one joint make one finding, at the first of them; of several faults there of speed and what follows from it
    only the first is reported. Nothing is clamped.

    Parameters
    ----------
    trajectory : Trajectory
    table : JointTable
    others_rad : mapping of joint name to float, optional
        Where joints are that the motion does not name; the others rest. A robot says where its own are.

    Returns
    -------
    list of Finding
        By row; empty when nothing is amiss.
    """
    findings: list[Finding] = []
    measured: list[tuple[Joint, NDArray[np.float64]]] = []
    for name, positions in zip(trajectory.joint_names, trajectory.positions_rad.T, strict=True):
        if name not in table.names:
            findings.append(Finding(1, "", name, name, f"{table.name} has no such joint"))
            continue
        found = _check_positions(table[name], positions)
        findings += found
        if np.isfinite(positions).all():
            measured.append((table[name], np.clip(positions, -_BEYOND_REASON_RAD, _BEYOND_REASON_RAD)))
    if measured:
        rows = np.stack([positions for _, positions in measured])
        moved = np.flatnonzero(~calm_joints(rows, trajectory.period_s, table))
        findings += _check_rates([measured[place][0] for place in moved], rows[moved], trajectory, table)
    if all(name in table.names for name in trajectory.joint_names):
        findings += _touches(trajectory, table, others_rad)
    return sorted(findings, key=lambda finding: (finding.row, finding.severity))


def check_pulse_csv(path: str | PathLike[str], table: JointTable = HOAP2) -> list[Finding]:
    """Look over a pulse CSV file, first its cells, then, if they can be read, its motion.

    Raises
    ------
    IoError
        When the file cannot be read.
    """
    period_s, counts, findings = parse_pulse_csv(path, table)
    if not findings and np.isnan(counts).all():
        findings = [Finding(1, "", "", "", "the file commands no joint")]
    if findings:
        return findings
    return check_trajectory(trajectory_from_counts(period_s, counts, table), table)


def require_safe(
    trajectory: Trajectory,
    table: JointTable = HOAP2,
    source: str = "",
    others_rad: Mapping[str, float] | None = None,
) -> list[Finding]:
    """Raise TrajectoryError, which names the source, when a motion has errors; return its warnings."""
    findings = check_trajectory(trajectory, table, others_rad)
    errors = [finding for finding in findings if finding.severity == "error"]
    if errors:
        raise TrajectoryError(errors, source)
    return findings


def require_safe_approach(approach: Trajectory, table: JointTable, others_rad: Mapping[str, float]) -> None:
    """Raise TrajectoryError when the way to a motion's first row has errors.

    Links that overlap where the motion begins, put there by hand, may move apart.
    """
    findings = [
        Finding(1, finding.column, finding.joint, finding.value, f"on the way to this row, {finding.message}")
        for finding in check_trajectory(approach, table, others_rad)
        if finding.severity == "error" and finding.row > 1
    ]
    if findings:
        raise TrajectoryError(findings)


def require_within(joint: Joint, position_rad: float) -> None:
    """Raise InvalidArgument for a position that is no number, not finite or not within the joint's limits."""
    if not isinstance(position_rad, int | float | np.integer | np.floating):
        raise InvalidArgument(f"{joint.name}: {position_rad!r} is no number")
    if not joint.lower_rad - LIMIT_TOLERANCE_RAD <= position_rad <= joint.upper_rad + LIMIT_TOLERANCE_RAD:
        low, high = np.degrees((joint.lower_rad, joint.upper_rad))
        limits = f"{joint.lower_rad:.4f} to {joint.upper_rad:.4f} rad ({low:.1f} to {high:.1f} deg)"
        raise InvalidArgument(f"{joint.name}: {str(position_rad)[:20]} rad is outside {limits}")


def _touches(trajectory: Trajectory, table: JointTable, others_rad: Mapping[str, float] | None) -> list[Finding]:
    carriers = {joint.child: joint for joint in table.joints}
    findings = []
    touches = self_collisions(trajectory, table, others_rad, _LEGS_NEARER_THAN_M)
    near = sorted((touch for touch in touches if not touch.overlaps), key=lambda touch: touch.depth_m)
    nearest = {(touch.link, touch.other): touch for touch in near}
    for touch in chain((touch for touch in touches if touch.overlaps), nearest.values()):
        joint = carriers[touch.link]
        value = f"{1000.0 * (touch.depth_m if touch.overlaps else max(-touch.depth_m, 0.0)):.1f} mm"
        message = f"{touch.link} and {touch.other} {'overlap by' if touch.overlaps else 'come within'} {value}"
        severity = "error" if touch.overlaps else "warning"
        findings.append(Finding(touch.row + 1, joint.column, joint.name, value, message, severity))
    return findings


def _check_positions(joint: Joint, positions: NDArray[np.float64]) -> list[Finding]:
    findings: list[Finding] = []
    finite = np.isfinite(positions)
    for first, last in _runs(~finite):
        findings.append(_finding(joint, first, last, "nan", "the position is not known"))
    low, high = np.degrees((joint.lower_rad, joint.upper_rad))
    outside = (positions < joint.lower_rad - LIMIT_TOLERANCE_RAD) | (positions > joint.upper_rad + LIMIT_TOLERANCE_RAD)
    for first, last in _runs(finite & outside):
        run = positions[first : last + 1]
        worst = np.degrees(run[np.argmax(np.maximum(joint.lower_rad - run, run - joint.upper_rad))])
        value = f"{worst:.1f} deg"
        findings.append(_finding(joint, first, last, value, f"{value} is outside {low:.1f} to {high:.1f} deg"))
    return findings


def _check_rates(
    joints: list[Joint], positions: NDArray[np.float64], trajectory: Trajectory, table: JointTable
) -> list[Finding]:
    period_s, rows = trajectory.period_s, len(trajectory)
    reach = round(2.0 * SMOOTHING_S / period_s)
    jumps = find_jumps(positions, period_s, table)
    findings: list[Finding] = []
    faulty = np.zeros((len(joints), rows), dtype=bool)
    for jump in jumps:
        if jump.why_not:
            value = f"{jump.size_rad / period_s:.1f} rad/s"
            message = f"a jump of {value} to a single row, {jump.why_not}"
            findings.append(_finding(joints[jump.joint], jump.first + 1, jump.last + 1, value, message))
            faulty[jump.joint, max(0, jump.first - reach) : jump.last + reach + 2] = True
    even = without_jumps(positions, period_s, jumps)
    for measure in chain(smoothed_measures(positions, period_s, table), short_measures(even, period_s, table)):
        beyond = np.abs(measure.values) > measure.limit * (1.0 + 1e-9)
        for place in np.flatnonzero(beyond.any(axis=1)).tolist():
            for first, last in _runs(beyond[place]):
                begin, end = (min(max(row + measure.first_row, 0), rows - 1) for row in (first, last))
                if faulty[place, begin : end + 1].any():
                    continue
                faulty[place, max(0, begin - reach) : end + reach + 1] = True
                run = measure.values[place, first : last + 1]
                value = f"{run[np.argmax(np.abs(run))]:.1f} {measure.unit}"
                message = f"{measure.text.format(value)} is above {measure.limit:g} {measure.unit}"
                findings.append(_finding(joints[place], begin, end, value, message))
    if period_s < SHORT_S:
        speeds = np.diff(positions) / period_s
        single = (np.abs(speeds) > table.max_speed_rad_s) & ~faulty[:, 1:]
        for place, row in zip(*np.nonzero(single), strict=True):
            value = f"{speeds[place, row]:.1f} rad/s"
            message = f"a jump of {value} to this row alone is above {table.max_speed_rad_s:g} rad/s"
            joint = joints[place]
            findings.append(Finding(int(row) + 2, joint.column, joint.name, value, message, "warning"))
    return findings


def _finding(joint: Joint, first: int, last: int, value: str, message: str) -> Finding:
    """For rows counted from 0."""
    rows = f", to row {last + 1}" if last > first else ""
    return Finding(first + 1, joint.column, joint.name, value, message + rows)


def _runs(flags: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """First and last index of each run of True."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], flags, [False])).astype(np.int8)))
    return [(int(a), int(b) - 1) for a, b in zip(edges[0::2], edges[1::2], strict=True)]
