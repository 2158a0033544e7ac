# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""From a person's hands in pictures to a motion of HOAP-2's arms."""

from hri.robot.imitation.imitate import FORMS, Imitation, ImitationOptions, imitate
from hri.robot.imitation.live import LiveImitation, SeenPerson
from hri.robot.imitation.tracks import Gap, HandTrack, read_hand_tracks
from hri.robot.imitation.video import film_imitation

__all__ = [
    "FORMS",
    "Gap",
    "HandTrack",
    "Imitation",
    "ImitationOptions",
    "LiveImitation",
    "SeenPerson",
    "film_imitation",
    "imitate",
    "read_hand_tracks",
]
