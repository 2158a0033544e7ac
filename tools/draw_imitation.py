# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Draw docs/images/imitation.jpg: a made-up person turns a wheel, and the robot does the same."""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np

from hri.media import read_frames, write_image
from hri.robot.imitation import HandTrack, film_imitation, imitate

OUT = Path(__file__).resolve().parents[1] / "docs" / "images" / "imitation.jpg"
FRAMES, FPS, FILM_FPS = 75, 30.0, 15.0
SHOWN = (9, 26, 45)


def main() -> None:
    angle = np.linspace(0.0, 4.0 * np.pi, FRAMES)
    lifted = np.minimum(1.0, np.arange(FRAMES) / 15.0)  # from where they rest
    places = []
    for side in (1.0, -1.0):
        x = 160.0 + side * (20.0 + 22.0 * lifted) + 10.0 * lifted * np.sin(angle / 2.0)
        places.append(np.stack((x, 195.0 - lifted * (95.0 + side * 28.0 * np.sin(angle))), axis=1))
    track = HandTrack("wheel", FPS, *places, nose=np.tile([160.0, 67.0], (FRAMES, 1)))
    made = imitate(track)
    with tempfile.TemporaryDirectory() as folder:
        film_imitation(track, made, Path(folder) / "wheel.avi", fps=FILM_FPS, size=(200, 200))
        film = read_frames(Path(folder) / "wheel.avi").frames
    moments = np.interp(SHOWN, np.arange(FRAMES), made.frame_times_s)
    write_image(OUT, np.hstack([film[int(FILM_FPS * moment)] for moment in moments]))


if __name__ == "__main__":
    main()
