# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""HOAP-2's arms move as a person's hands did."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.display import short_repr
from hri.core.errors import InvalidArgument
from hri.robot.imitation.body import Targets, scale_to_robot
from hri.robot.imitation.both import Arms, find_both, least_clearance_m
from hri.robot.imitation.pacing import pace
from hri.robot.imitation.plain import plain_path
from hri.robot.imitation.search import Path, find_path
from hri.robot.imitation.tracks import Gap, HandTrack
from hri.robot.model.arm import MIRROR, arm_of, arm_points
from hri.robot.model.joints import HOAP2, JointTable
from hri.robot.motion.checks import require_safe
from hri.robot.motion.gestures import minimum_jerk, rest_positions
from hri.robot.motion.trajectory import Trajectory

Floats = NDArray[np.float64]
FORMS = ("search", "atan2")
_SPEED_SHARE = 0.95  # the rest is for rounding to pulses


@dataclass(frozen=True)
class ImitationOptions:
    """How a track becomes a motion.

    Attributes
    ----------
    form : "search" or "atan2"
        Search among all poses that bring the hand to its place, or the plain angles of the line from shoulder to hand.
    height_px : float, optional
        The person's height in pixels; guessed from the track if not given.
    smoothing_s : float
        Hand positions are averaged over about this time.
    rest_s : float
        From arms down to the first pose and back after the last; 0 begins and ends in the track's own poses.
    period_s : float
        Of the motion's rows.
    max_acceleration_rad_s2 : float
        Of every joint. Its speed stays below 95 % of the motors'.
    """

    form: str = "search"
    height_px: float | None = None
    smoothing_s: float = 0.07
    rest_s: float = 1.0
    period_s: float = 0.01
    max_acceleration_rad_s2: float = 50.0

    def __post_init__(self) -> None:
        if self.form not in FORMS:
            raise InvalidArgument(f"form is {self.form!r}, must be one of {', '.join(FORMS)}")
        bounds = {
            "smoothing_s": (0.0, 1.0),
            "rest_s": (0.0, 10.0),
            "period_s": (0.001, 0.05),
            "max_acceleration_rad_s2": (1.0, 1000.0),
        }
        for field, (low, high) in bounds.items():
            if not low <= getattr(self, field) <= high:
                raise InvalidArgument(f"{field} is {getattr(self, field)}, must be {low:g} to {high:g}")


@dataclass(frozen=True)
@short_repr
class Imitation:
    """A motion made from a track, and how near it comes.

    Attributes
    ----------
    name : str
    trajectory : Trajectory
        Of the eight joints of both arms.
    targets : Targets
        The scaled track.
    frame_times_s : ndarray of float64, shape (frames,)
        When the motion passes the track's frames.
    hands_m : ndarray of float64, shape (2, frames, 3)
        The robot's left and right hand then: forward, outwards and up from that shoulder.
    reached : ndarray of bool, shape (2, frames)
        Frames in which the hand was seen and its scaled place is within the arm's reach.
    clearance_m : float
        The least distance of a forearm from the body or the other forearm; below 0 they touch.
    track_s : float
        Duration of the track.
    """

    name: str
    trajectory: Trajectory
    targets: Targets
    frame_times_s: Floats
    hands_m: Floats
    reached: NDArray[np.bool_]
    clearance_m: float
    track_s: float

    @property
    def gaps(self) -> list[Gap]:
        """Frames that were bridged."""
        return self.targets.gaps

    @property
    def errors_m(self) -> Floats:
        """Distance of the robot's hand from the scaled track as seen from the front; NaN where not seen."""
        return np.linalg.norm(self.hands_m[..., 1:] - self.targets.hands_m, axis=-1)

    @property
    def rms_m(self) -> float:
        """Root mean square of the errors over the reached frames of both hands; NaN when there are none."""
        errors = self.errors_m[self.reached]
        return float(np.sqrt(np.mean(errors**2))) if len(errors) else float("nan")

    def report(self) -> dict[str, Any]:
        """What can be written as JSON about it."""
        seen = self.targets.seen
        rms = self.rms_m
        return {
            "track": self.name,
            "frames": int(self.reached.shape[1]),
            "track_s": round(self.track_s, 4),
            "motion_s": round(self.trajectory.duration_s, 4),
            "slower": round(float(self.frame_times_s[-1] - self.frame_times_s[0]) / max(self.track_s, 1e-9), 4),
            "height_px": round(self.targets.height_px, 2),
            "metres_per_px": self.targets.metres_per_px,
            "seen": {side: round(float(seen[i].mean()), 4) for i, side in enumerate(("left", "right"))},
            "reached": {
                side: round(float(self.reached[i].sum() / max(seen[i].sum(), 1)), 4)
                for i, side in enumerate(("left", "right"))
            },
            "rms_m": None if np.isnan(rms) else round(rms, 6),
            "clearance_m": round(self.clearance_m, 5),
            "bridged": [{"what": gap.what, "first": gap.first, "last": gap.last} for gap in self.gaps],
        }


def imitate(track: HandTrack, options: ImitationOptions | None = None, table: JointTable = HOAP2) -> Imitation:
    """Move the robot's arms as the person's hands moved, as seen from the front.

    A track in a picture has no depth: the robot's hands keep about 0.12 m before its shoulders, nearer or farther where
    an arm must. A hand that is never seen rests. The motion is inside all limits; where the joints would be too fast
    it is slower than the track.

    Raises
    ------
    InvalidArgument
        When nothing is seen, or the person's size cannot be known.
    """
    chosen = options or ImitationOptions()
    arms = (arm_of("left", table), arm_of("right", table))
    targets = scale_to_robot(track, arms, chosen.height_px)
    paths = _paths(arms, targets, track.fps, chosen, table)
    angles = np.concatenate([path.angles_rad for path in paths], axis=1)
    rest = _rest(arms)
    lead = round(chosen.rest_s * track.fps)
    if lead:
        angles = np.concatenate((_joined(rest, angles[0], lead), angles, _joined(angles[-1], rest, lead)))
    speed = _SPEED_SHARE * table.max_speed_rad_s
    paced = pace(angles, track.fps, chosen.period_s, speed, chosen.max_acceleration_rad_s2)
    signs = np.concatenate((np.ones(4), MIRROR))
    trajectory = Trajectory((*arms[0].names, *arms[1].names), chosen.period_s, paced.positions_rad * signs)
    require_safe(trajectory, table)
    times = paced.frame_times_s[lead : lead + len(track)]
    rows_s = np.arange(len(paced.positions_rad)) * chosen.period_s
    at = np.stack([np.interp(times, rows_s, column) for column in paced.positions_rad.T], axis=1)
    hands = np.stack([arm_points(arm, at[:, 4 * i : 4 * i + 4])[1] for i, arm in enumerate(arms)])
    seen = targets.seen
    return Imitation(
        name=track.name,
        trajectory=trajectory,
        targets=targets,
        frame_times_s=times,
        hands_m=hands,
        reached=np.stack([path.reached for path in paths]) & seen,
        clearance_m=least_clearance_m(arms, table, paced.positions_rad),
        track_s=(len(track) - 1) / track.fps,
    )


def _paths(arms: Arms, targets: Targets, fps: float, options: ImitationOptions, table: JointTable) -> list[Path]:
    wanted = targets.filled_m
    smooth = np.stack([_smoothed(points, options.smoothing_s * fps) for points in wanted])
    seen = [not np.isnan(points).any() for points in wanted]
    if all(seen) and options.form == "search":
        return find_both(arms, table, wanted, smooth)
    rest = _rest(arms)
    paths = []
    for i, arm in enumerate(arms):
        if not seen[i]:
            angles = np.broadcast_to(rest[4 * i : 4 * i + 4], (wanted.shape[1], 4))
            paths.append(Path(angles, arm_points(arm, angles)[1], np.zeros(len(angles), dtype=bool)))
        elif options.form == "search":
            paths.append(find_path(arm, table, wanted[i], smooth[i]))
        else:
            paths.append(plain_path(arm, wanted[i], smooth[i]))
    return paths


def _rest(arms: Arms) -> Floats:
    """Arms down, as for two left arms."""
    rest = rest_positions()
    left, right = (np.array([rest[name] for name in arm.names]) for arm in arms)
    return np.concatenate((left, right * MIRROR))


def _joined(begin: Floats, end: Floats, frames: int) -> Floats:
    times = np.arange(frames, dtype=np.float64)
    return minimum_jerk(np.array([0.0, max(frames - 1.0, 1.0)]), np.stack((begin, end)), times)


def _smoothed(points: Floats, width: float) -> Floats:
    """Averaged by a Gaussian of this full width at half height, in frames; the ends count as held."""
    if width <= 0.0:
        return points
    deviation = width / 2.355
    reach = int(np.ceil(3.0 * deviation))
    weights = np.exp(-0.5 * (np.arange(-reach, reach + 1) / deviation) ** 2)
    padded = np.pad(points, ((reach, reach), (0, 0)), mode="edge")
    return np.stack([np.convolve(column, weights / weights.sum(), mode="valid") for column in padded.T], axis=1)
