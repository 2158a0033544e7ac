# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Whether gestures are learned from silhouettes or from landmarks, where the command does not say."""

from __future__ import annotations

from importlib.util import find_spec
from typing import Literal

from hri.datasets import Dataset
from hri.media import read_frames
from hri.vision.landmarks import LandmarkTracker

Source = Literal["silhouettes", "landmarks"]

NUM_LOOKED_AT = 12
MIN_FOUND = 0.9
"""Share of the recordings looked at in which MediaPipe must find a hand: drawn hands, for one, it does not find."""


def choose_source(dataset: Dataset) -> tuple[Source, str]:
    """What to take, and why, in a line for the reader.

    Landmarks, where the extra `mediapipe` is installed and finds a hand in the middle of nearly all of a few recordings
    that are looked at.
    """
    if find_spec("mediapipe") is None:
        return "silhouettes", "source: silhouettes; landmarks need the extra mediapipe"
    count = min(NUM_LOOKED_AT, len(dataset.samples))
    looked_at = [dataset.samples[len(dataset.samples) * i // count] for i in range(count)]
    found = 0
    with LandmarkTracker(each_alone=True) as tracker:
        for sample in looked_at:
            frames = read_frames(sample.path).frames
            found += tracker.find(frames[len(frames) // 2]) is not None
    share = f"MediaPipe finds a hand in {found} of {len(looked_at)} recordings looked at"
    if found >= MIN_FOUND * len(looked_at):
        return "landmarks", f"source: landmarks, as {share}; --source silhouettes needs no extra"
    return "silhouettes", f"source: silhouettes, as {share}"
