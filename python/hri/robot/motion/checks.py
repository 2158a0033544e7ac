# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Whether a motion is safe to carry out: known positions, inside the limits, not too fast, clear of itself."""

from __future__ import annotations

from os import PathLike

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument
from hri.robot.model.joints import HOAP2, Joint, JointTable
from hri.robot.motion.pulse_csv import parse_pulse_csv, trajectory_from_counts
from hri.robot.motion.self_collision import self_collisions
from hri.robot.motion.trajectory import Finding, Trajectory, TrajectoryError

SPEED_WINDOW_S = 0.05
LIMIT_TOLERANCE_RAD = np.radians(1.5 / 209.0)  # limits are written in whole pulses, or rounded


def check_trajectory(trajectory: Trajectory, table: JointTable = HOAP2) -> list[Finding]:
    """Look over a whole motion before any of it is carried out.

    Errors are an unknown joint, a position that is not finite or outside its joint's limits, a mean
    speed over 50 ms above the motor's, a change of it within 50 ms above the most acceleration, and
    links that overlap (`self_collisions`). A step from one row to the next that is too fast, while
    the 50 ms about it are not, is a warning: a dropped sample. Rows in succession with the same
    fault of one joint make one finding, at the first of them. Nothing is clamped.

    Returns
    -------
    list of Finding
        By row; empty when nothing is amiss.
    """
    findings: list[Finding] = []
    for name, positions in zip(trajectory.joint_names, trajectory.positions_rad.T, strict=True):
        if name not in table.names:
            findings.append(Finding(1, "", name, name, f"{table.name} has no such joint"))
            continue
        findings += _check_joint(table[name], positions, trajectory.period_s, table)
    if all(name in table.names for name in trajectory.joint_names):
        findings += _touches(trajectory, table)
    return sorted(findings, key=lambda finding: (finding.row, finding.severity))


def check_pulse_csv(path: str | PathLike[str], table: JointTable = HOAP2) -> list[Finding]:
    """Look over a pulse CSV file, first its cells, then, if they can be read, its motion.

    Raises
    ------
    IoError
        When the file cannot be read.
    """
    period_s, counts, findings = parse_pulse_csv(path, table)
    if findings:
        return findings
    return check_trajectory(trajectory_from_counts(period_s, counts, table), table)


def require_safe(trajectory: Trajectory, table: JointTable = HOAP2, source: str = "") -> list[Finding]:
    """Raise TrajectoryError, which names the source, when a motion has errors; return its warnings."""
    findings = check_trajectory(trajectory, table)
    errors = [finding for finding in findings if finding.severity == "error"]
    if errors:
        raise TrajectoryError(errors, source)
    return findings


def require_within(joint: Joint, position_rad: float) -> None:
    """Raise InvalidArgument for a position that is not finite or not within the joint's limits."""
    if not joint.lower_rad - LIMIT_TOLERANCE_RAD <= position_rad <= joint.upper_rad + LIMIT_TOLERANCE_RAD:
        low, high, degrees = np.degrees((joint.lower_rad, joint.upper_rad, position_rad))
        raise InvalidArgument(f"{joint.name}: {degrees:.1f} deg is outside {low:.1f} to {high:.1f} deg")


def _touches(trajectory: Trajectory, table: JointTable) -> list[Finding]:
    carriers = {joint.child: joint for joint in table.joints}
    findings = []
    for touch in self_collisions(trajectory, table):
        joint = carriers[touch.link]
        value = f"{1000.0 * touch.depth_m:.1f} mm"
        message = f"{touch.link} and {touch.other} overlap by {value}"
        findings.append(Finding(touch.row + 1, joint.column, joint.name, value, message))
    return findings


def _check_joint(joint: Joint, positions: NDArray[np.float64], period_s: float, table: JointTable) -> list[Finding]:
    findings: list[Finding] = []
    max_speed, max_acceleration = table.max_speed_rad_s, table.max_acceleration_rad_s2

    def report(rows: NDArray[np.bool_], values: NDArray[np.float64], unit: str, text: str) -> None:
        for first, last in _runs(rows):
            worst = first + int(np.argmax(np.abs(values[first : last + 1])))
            value = f"{values[worst]:.1f} {unit}" if unit else "nan"
            message = text.format(value=value) + (f", to row {last + 1}" if last > first else "")
            findings.append(Finding(first + 1, joint.column, joint.name, value, message))

    finite = np.isfinite(positions)
    report(~finite, np.where(finite, 0.0, 1.0), "", "the position is not known")
    low, high = np.degrees((joint.lower_rad, joint.upper_rad))
    beyond = (positions < joint.lower_rad - LIMIT_TOLERANCE_RAD) | (positions > joint.upper_rad + LIMIT_TOLERANCE_RAD)
    report(beyond, np.degrees(positions), "deg", f"{{value}} is outside {low:.1f} to {high:.1f} deg")

    window = max(1, round(SPEED_WINDOW_S / period_s))
    window = min(window, max(1, len(positions) - 1))
    mean_speed = (positions[window:] - positions[:-window]) / (window * period_s)
    fast = np.abs(mean_speed) > max_speed
    limit = f"above {max_speed:g} rad/s"
    report(fast, mean_speed, "rad/s", f"a speed of {{value}} over 50 ms is {limit}")
    change = (mean_speed[window:] - mean_speed[:-window]) / (window * period_s)
    limit = f"above {max_acceleration:g} rad/s2"
    report(np.abs(change) > max_acceleration, change, "rad/s2", f"an acceleration of {{value}} over 50 ms is {limit}")
    limit = f"above {max_speed:g} rad/s"
    if window > 1:
        jumps = np.diff(positions) / period_s
        in_fast = np.zeros(len(positions), dtype=bool)
        for first, last in _runs(fast):
            in_fast[first : last + window] = True
        for row in np.flatnonzero((np.abs(jumps) > max_speed) & ~in_fast[: len(jumps)]):
            value = f"{jumps[row]:.1f} rad/s"
            message = f"a jump of {value} to this row alone is {limit}"
            findings.append(Finding(int(row) + 2, joint.column, joint.name, value, message, "warning"))
    return findings


def _runs(flags: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """First and last index of each run of True."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], flags, [False])).astype(np.int8)))
    return [(int(a), int(b) - 1) for a, b in zip(edges[0::2], edges[1::2], strict=True)]
