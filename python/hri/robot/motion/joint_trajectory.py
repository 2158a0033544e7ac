# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Motions as trajectory_msgs/JointTrajectory of ROS 2: as a message, in JSON as rosbridge has it, and in MCAP.

Angles are in radians, times in seconds (REP 103); joints turn as in the robot's URDF (`urdf_text`).
"""

from __future__ import annotations

import json
from os import PathLike, fspath
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import FormatError, InvalidArgument
from hri.core.files import parse_json, read_bytes, read_text, write_bytes, write_text
from hri.robot.motion.joint_trajectory_mcap import mcap_of_message, message_of_mcap
from hri.robot.motion.trajectory import Trajectory

SUFFIXES = (".json", ".mcap")
MAX_BYTES = 1 << 26
"""Of a file: ten minutes of 25 joints, 100 times a second, in JSON."""
MAX_POINTS = 500_000

_PERIOD_S = 0.01  # of points at uneven times, once interpolated
_MAX_NUMBERS = 25_000_000  # of positions, as they stand and as interpolation makes them
_MAX_S = float((1 << 31) - 1)
_NS = 1_000_000_000
_EVEN_NS = 1000.0
_FIELDS = {"header", "joint_names", "points"}
_POINT_FIELDS = {"positions", "velocities", "accelerations", "effort", "time_from_start"}


def joint_trajectory_message(trajectory: Trajectory) -> dict[str, Any]:
    """The message, as values that JSON holds.

    Velocities are central differences, and 0 in the first and the last point, where the robot stands still. The stamp
    of the header is 0: the motion begins when it is received.

    Raises
    ------
    InvalidArgument
        For a position that is not known, or more than 2**31 - 1 seconds.
    """
    positions, period_s = trajectory.positions_rad, trajectory.period_s
    if not np.isfinite(positions).all():
        row = int(np.flatnonzero(~np.isfinite(positions).all(axis=1))[0]) + 1
        raise InvalidArgument(f"row {row}: a position is not known; a JointTrajectory holds numbers only")
    if trajectory.duration_s > _MAX_S:
        raise InvalidArgument(f"the motion lasts {trajectory.duration_s:g} s, must be at most {_MAX_S:g}")
    velocities = np.zeros_like(positions)
    velocities[1:-1] = (positions[2:] - positions[:-2]) / (2.0 * period_s)
    points = []
    for row, (position, velocity) in enumerate(zip(positions.tolist(), velocities.tolist(), strict=True)):
        sec, nanosec = divmod(round(row * period_s * _NS), _NS)
        time = {"sec": sec, "nanosec": nanosec}
        rates: dict[str, Any] = {"velocities": velocity, "accelerations": [], "effort": []}
        points.append({"positions": position, **rates, "time_from_start": time})
    header = {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": ""}
    return {"header": header, "joint_names": list(trajectory.joint_names), "points": points}


def trajectory_of_message(message: Any, name: str = "message") -> Trajectory:
    """A message's motion, from its first point on.

    Points at even times are rows as they are. Others are interpolated as controllers of ROS do, in steps of 10 ms or
    slightly less: along cubics where all points have velocities, else along straight lines. Accelerations and efforts
    are not heeded. A single point becomes a single row.

    Parameters
    ----------
    message : dict
        As of `joint_trajectory_message`; header, velocities, accelerations and effort may be missing.
    name : str
        Of the file, for errors.

    Raises
    ------
    FormatError
        Names the file, the point (from 1) and the field: missing, unknown, of another kind, of another length than
        joint_names, not finite; times that do not rise; joints without or with repeated names; no or more than 500 000
        points.
    """
    fields = _dict(message, _FIELDS, name)
    names, points = _list(fields, "joint_names", name), _list(fields, "points", name)
    if not 1 <= len(points) <= MAX_POINTS:
        raise FormatError(f"{name}: points: {len(points)}, must be 1 to {MAX_POINTS}")
    if len(points) * len(names) > _MAX_NUMBERS:
        raise FormatError(
            f"{name}: {len(points)} points of {len(names)} joints: must be {_MAX_NUMBERS} positions or fewer"
        )
    times_ns = np.empty(len(points), np.int64)
    positions = np.empty((len(points), len(names)))
    velocities: NDArray[np.float64] | None = np.zeros_like(positions)
    for row, entry in enumerate(points):
        where = f"{name}: point {row + 1}"
        point = _dict(entry, _POINT_FIELDS, where)
        positions[row] = _numbers(point.get("positions"), len(names), f"{where}: positions")
        times_ns[row] = _time_ns(point.get("time_from_start"), f"{where}: time_from_start")
        if row > 0 and times_ns[row] <= times_ns[row - 1]:
            raise FormatError(f"{where}: time_from_start: is not after that of the point before")
        if not point.get("velocities"):
            velocities = None
        elif velocities is not None:
            velocities[row] = _numbers(point["velocities"], len(names), f"{where}: velocities")
    try:
        return _sampled(names, times_ns - times_ns[0], positions, velocities)
    except InvalidArgument as error:
        raise FormatError(f"{name}: {error}") from error


def write_joint_trajectory(path: str | PathLike[str], trajectory: Trajectory) -> None:
    """Write a motion as JSON (.json), or as the one message of an MCAP file (.mcap) that ROS 2 and Foxglove play.

    What another controller is to carry out should have been checked (`require_safe`).

    Raises
    ------
    InvalidArgument
        For another suffix; as `joint_trajectory_message` does.
    ImportError
        For .mcap without the extra mcap.
    IoError
        For a place that cannot be written.
    """
    message = joint_trajectory_message(trajectory)
    if _suffix(path) == ".mcap":
        write_bytes(path, mcap_of_message(message))
    else:
        write_text(path, json.dumps(message) + "\n")


def read_joint_trajectory(path: str | PathLike[str]) -> Trajectory:
    """Read a motion from JSON (.json), or from an MCAP file (.mcap) that holds one JointTrajectory of ROS 2.

    Raises
    ------
    InvalidArgument
        For another suffix.
    ImportError
        For .mcap without the extra mcap.
    IoError
        When the file cannot be read.
    FormatError
        For more than 64 MiB, also once decompressed; for another file or a damaged one; as `trajectory_of_message`.
    """
    if _suffix(path) == ".mcap":
        message = message_of_mcap(read_bytes(path, MAX_BYTES), fspath(path), MAX_BYTES, MAX_POINTS)
    else:
        message = parse_json(read_text(path, MAX_BYTES), fspath(path))
    return trajectory_of_message(message, fspath(path))


def _suffix(path: str | PathLike[str]) -> str:
    suffix = Path(path).suffix.lower()
    if suffix not in SUFFIXES:
        raise InvalidArgument(f"{fspath(path)}: suffix must be {' or '.join(SUFFIXES)}")
    return suffix


def _sampled(
    names: list[Any],
    times_ns: NDArray[np.int64],
    positions: NDArray[np.float64],
    velocities: NDArray[np.float64] | None,
) -> Trajectory:
    """Rows at even times."""
    if len(times_ns) == 1:
        return Trajectory(names, _PERIOD_S, positions)
    period_ns = float(times_ns[-1]) / (len(times_ns) - 1)
    uneven_ns = np.abs(times_ns - period_ns * np.arange(len(times_ns))).max()
    if uneven_ns <= min(_EVEN_NS, 1.0 + 0.001 * period_ns):
        return Trajectory(names, period_ns / _NS, positions)
    seconds = times_ns / _NS
    num_steps = int(np.ceil(seconds[-1] / _PERIOD_S))
    if (num_steps + 1) * len(names) > _MAX_NUMBERS:
        raise InvalidArgument(f"{seconds[-1]:g} s of points at uneven times are too many to interpolate")
    sampled_s = np.linspace(0.0, seconds[-1], num_steps + 1)
    with np.errstate(over="ignore", invalid="ignore"):  # a check finds what is beyond reason
        rows = _interpolated(seconds, positions, velocities, sampled_s)
    return Trajectory(names, float(seconds[-1]) / num_steps, rows)


def _interpolated(
    times_s: NDArray[np.float64],
    positions: NDArray[np.float64],
    velocities: NDArray[np.float64] | None,
    at_s: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Cubic Hermite splines, or straight lines without velocities; shape (times, joints)."""
    first = np.clip(np.searchsorted(times_s, at_s, "right") - 1, 0, len(times_s) - 2)
    length = (times_s[first + 1] - times_s[first])[:, np.newaxis]
    part = (at_s - times_s[first])[:, np.newaxis] / length
    begin, way = positions[first], positions[first + 1] - positions[first]
    if velocities is None:
        return begin + part * way
    bent = velocities[first] * (1.0 - part) - velocities[first + 1] * part
    return begin + part**2 * (3.0 - 2.0 * part) * way + length * part * (1.0 - part) * bent


def _dict(value: Any, known: set[str], where: str) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise FormatError(f"{where}: must be an object with {', '.join(sorted(known))}")
    unknown = sorted(str(field)[:40] for field in set(value) - known)
    if unknown:
        raise FormatError(f"{where}: no field {', '.join(unknown[:5])}")
    return value


def _list(fields: dict[str, Any], field: str, name: str) -> list[Any]:
    value = fields.get(field)
    if not isinstance(value, list):
        raise FormatError(f"{name}: {field}: must be a list")
    return value


def _numbers(value: Any, length: int, where: str) -> list[float]:
    if not isinstance(value, list) or not all(type(number) in (int, float) for number in value):
        raise FormatError(f"{where}: must be a list of numbers")
    if len(value) != length:
        raise FormatError(f"{where}: has {len(value)} numbers, joint_names has {length}")
    if not all(-1e300 < number < 1e300 for number in value):  # an int of any size is compared, not converted
        raise FormatError(f"{where}: has a number that is not finite")
    return value


def _time_ns(value: Any, where: str) -> int:
    fields = _dict(value, {"sec", "nanosec"}, where)
    sec, nanosec = fields.get("sec"), fields.get("nanosec")
    if type(sec) is not int or type(nanosec) is not int or not (0 <= sec <= _MAX_S and 0 <= nanosec < _NS):
        raise FormatError(f"{where}: must be sec, 0 to 2**31 - 1, and nanosec, 0 to 999999999")
    return sec * _NS + nanosec
