# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""From a person's hands in pixels to places for the robot's hands: one scale, so that a sign keeps its shape.

Shares of a person's height are those of adults (Drillis and Contini, 1966): shoulders 0.259 apart and 0.818 above the
ground, upper arm 0.186, forearm 0.146, from there to the middle of the hand 0.055; the nose is at 0.918.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hri.core.display import short_repr
from hri.core.errors import InvalidArgument
from hri.robot.imitation.tracks import Gap, HandTrack, bridge
from hri.robot.model.arm import SIDES, Arm

Floats = NDArray[np.float64]

SHOULDER_WIDTH = 0.259
NOSE_ABOVE_SHOULDERS = 0.10
REACH = 0.186 + 0.146 + 0.055
RESTING_HANDS_BELOW_NOSE = 0.40
"""Of hands that rest in the lap or hang folded; from this a person's size is guessed when no shoulders are seen."""
MIN_HEIGHT_PX = 20.0


@dataclass(frozen=True)
@short_repr
class Targets:
    """Where the robot's hands should go, seen from the front.

    Attributes
    ----------
    hands_m : ndarray of float64, shape (2, frames, 2)
        Left and right arm: outwards and up from that arm's own shoulder. Unfilled frames are NaN.
    filled_m : ndarray of float64, shape (2, frames, 2)
        The same with gaps bridged; NaN throughout for a hand that was never seen.
    gaps : list of Gap
    height_px : float
        The person's height that was given or guessed.
    metres_per_px : float
    """

    hands_m: Floats
    filled_m: Floats
    gaps: list[Gap]
    height_px: float
    metres_per_px: float

    @property
    def seen(self) -> NDArray[np.bool_]:
        """Shape (2, frames)."""
        return np.asarray(np.isfinite(self.hands_m).all(axis=-1))


def person_height_px(track: HandTrack) -> float:
    """Guess a person's height: from the shoulders' distance, else from where the hands rest below the nose."""
    if track.shoulders is not None:
        apart = np.linalg.norm(track.shoulders[:, 0] - track.shoulders[:, 1], axis=1)
        apart = apart[np.isfinite(apart)]
        if len(apart):
            return float(np.median(apart)) / SHOULDER_WIDTH
    if track.nose is None:
        raise InvalidArgument(f"track {track.name!r}: the shoulders are not seen in any frame")
    below = np.fmax(track.left[:, 1], track.right[:, 1]) - track.nose[:, 1]
    below = below[np.isfinite(below)]
    if not len(below):
        raise InvalidArgument(f"track {track.name!r}: no frame has both a hand and the nose")
    return float(np.quantile(below, 0.95)) / RESTING_HANDS_BELOW_NOSE


def scale_to_robot(track: HandTrack, arms: tuple[Arm, Arm], height_px: float | None = None) -> Targets:
    """Scale a track by the ratio of the arms' lengths, each hand about its own shoulder.

    So a sign keeps its shape and every arm its directions. HOAP-2's shoulders are wider for the length of its arms than
    a person's: hands that meet are 4 cm apart on the robot, where its hands have room.

    Parameters
    ----------
    track : HandTrack
    arms : left and right Arm
    height_px : float, optional
        The person's height in pixels; see `person_height_px` for the default.

    Raises
    ------
    InvalidArgument
        When the height is below 20 pixels, or cannot be guessed; when no hand or no person is seen at all.
    """
    height = person_height_px(track) if height_px is None else float(height_px)
    if not MIN_HEIGHT_PX <= height < np.inf:
        raise InvalidArgument(f"height_px is {height:g}, must be at least {MIN_HEIGHT_PX:g}; give it, or the shoulders")
    metres_per_px = arms[0].reach_m / (REACH * height)
    shoulder_m = 0.5 * SHOULDER_WIDTH * height * metres_per_px
    centre, gaps = _body_centre(track, height)
    hands, filled = [], []
    for side in SIDES:
        outwards = 1.0 if side == "left" else -1.0  # the camera sees the person's left on its right
        pixels = getattr(track, side)

        def scaled(points: Floats, outwards: float = outwards) -> Floats:
            offset = metres_per_px * (points - centre)
            return np.stack((outwards * offset[:, 0] - shoulder_m, -offset[:, 1]), axis=1)

        hands.append(scaled(pixels))
        if np.isfinite(pixels).all(axis=1).any():
            bridged, more = bridge(pixels, f"{side} hand")
            filled.append(scaled(bridged))
            gaps += more
        else:
            gaps.append(Gap(f"{side} hand", 0, len(track) - 1))
            filled.append(np.full((len(track), 2), np.nan))
    if np.isnan(filled).all():
        raise InvalidArgument(f"track {track.name!r}: no hand is seen in any frame")
    return Targets(np.array(hands), np.array(filled), gaps, height, metres_per_px)


def _body_centre(track: HandTrack, height_px: float) -> tuple[Floats, list[Gap]]:
    """The middle between the shoulders in every frame."""
    if track.shoulders is not None and np.isfinite(track.shoulders).all(axis=(1, 2)).any():
        shoulders, gaps = bridge(track.shoulders, "shoulders")
        return shoulders.mean(axis=1), gaps
    if track.nose is None:
        raise InvalidArgument(f"track {track.name!r}: the shoulders are not seen in any frame")
    nose, gaps = bridge(track.nose, "nose")
    return nose + np.array((0.0, NOSE_ABOVE_SHOULDERS * height_px)), gaps
