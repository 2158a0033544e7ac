# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri split``."""

from __future__ import annotations

from typing import Any

import click
import numpy as np
from numpy.typing import NDArray

from hri.cli.faces import faces_option
from hri.cli.groups import CheckedCommand, FiniteRange
from hri.cli.messages import note
from hri.cli.output import json_option, say, write_json
from hri.cli.progress import progress_bars
from hri.core.display import count
from hri.media import read_frames
from hri.vision.hands import find_silhouettes
from hri.vision.splitting import KEY_FRAMES, direction_changes, key_frames, split_at_pauses, subsample

CHANGES = ("pixels", "mean")


@click.command(cls=CheckedCommand)
@click.argument("clip", type=click.Path(exists=True, dir_okay=False), metavar="VIDEO")
@click.option(
    "--change",
    type=click.Choice(CHANGES),
    default="pixels",
    show_default=True,
    help="Between pictures: the mean over all pixels of how much the direction of the gradient turns, or how much the "
    "mean direction turns, as the thesis writes it.",
)
@click.option(
    "--share",
    type=FiniteRange(0, 1),
    default=0.1,
    show_default=True,
    help="A picture that changes by at most this share of the 90th percentile belongs to a pause.",
)
@click.option(
    "--min-pause", type=click.IntRange(1, 100000), default=4, show_default=True, help="Frames of a pause, at least."
)
@click.option(
    "--min-part",
    type=click.IntRange(1, 100000),
    default=KEY_FRAMES,
    show_default=True,
    help="Frames of a part, at least.",
)
@faces_option("never: an open palm may look like a face")
@json_option
def split(
    clip: str, change: str, share: float, min_pause: int, min_part: int, faces: str | None, json_path: str | None
) -> None:
    """Split VIDEO, a signed sentence, into gestures where the hand stands still, as the thesis does; a line for each.

    A line has the first frame and the frame after the last, the same of the middle frames (15 at most), and the times
    of the first and the last frame in seconds. 'hri read-sentences' and 'hri watch' find words and what lies between
    them at once, without pauses; 'hri study sentence-splitting' has what splitting loses beside that.

    \b
    Examples:
      hri split sentence.mp4
      hri split sentence.mp4 --min-pause 8 --json parts.json
    """
    video = read_frames(clip)
    with progress_bars() as progress:
        hands = find_silhouettes(
            video.frames, None, lambda done, total: progress("finding the hand", done, total), faces=faces or "never"
        )
    pictures = np.stack([_hand_alone(*pair) for pair in zip(video.frames, hands, strict=True)])
    changes = direction_changes(pictures, per_pixel=change == "pixels")
    parts = []
    for first, last in split_at_pauses(changes, share, min_pause, min_part):
        middle = key_frames((first, last))
        times = (video.times_s[first], video.times_s[last - 1])
        parts.append({"frames": [first, last], "key_frames": list(middle), "seconds": list(times)})
        say(f"{first}\t{last}\t{middle[0]}\t{middle[1]}\t{times[0]:.2f}\t{times[1]:.2f}", json_path)
    note(f"{clip}: {count(len(parts), 'part')} in {count(len(video.frames), 'frame')}")
    write_json(json_path, {"file": clip, "num_frames": len(video.frames), "parts": parts})


def _hand_alone(frame: NDArray[np.uint8], hand: Any) -> NDArray[np.float32]:
    """Grey levels of the hand, 0 around it, in the size of the thesis."""
    grey = subsample(frame.mean(axis=2, dtype=np.float32))
    return np.where(subsample(np.asarray(hand.mask) > 0) > 0.5, grey, np.float32(0))
