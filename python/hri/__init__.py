# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Command a humanoid robot with words and signs.

The names below are loaded on first use, so that ``import hri`` pulls in neither OpenCV nor PyBullet.
"""

from __future__ import annotations

import logging
from importlib import import_module
from typing import TYPE_CHECKING, Any

from hri._native import __version__

if TYPE_CHECKING:
    from hri._native import (
        CepstraOptions,
        GestureRecognizerOptions,
        HandFeatureOptions,
        WordRecognizerOptions,
    )
    from hri.datasets import Dataset
    from hri.evaluation import cross_validate
    from hri.evaluation.training import train
    from hri.fusion import FusedDecision, fuse
    from hri.media import read_audio, read_frames
    from hri.recognition import Decision, GestureRecognizer, NBest, SpeakerAdapter, WordRecognizer
    from hri.robot import gesture_trajectory, open_robot, render_video
    from hri.signal.noise_reduction import denoise

_HOMES = {
    "CepstraOptions": "hri._native",
    "Dataset": "hri.datasets",
    "Decision": "hri.recognition",
    "FusedDecision": "hri.fusion",
    "GestureRecognizer": "hri.recognition",
    "GestureRecognizerOptions": "hri._native",
    "HandFeatureOptions": "hri._native",
    "NBest": "hri.recognition",
    "SpeakerAdapter": "hri.recognition",
    "WordRecognizer": "hri.recognition",
    "WordRecognizerOptions": "hri._native",
    "cross_validate": "hri.evaluation",
    "denoise": "hri.signal.noise_reduction",
    "fuse": "hri.fusion",
    "gesture_trajectory": "hri.robot",
    "open_robot": "hri.robot",
    "read_audio": "hri.media",
    "read_frames": "hri.media",
    "render_video": "hri.robot",
    "train": "hri.evaluation.training",
}

__all__ = [
    "CepstraOptions",
    "Dataset",
    "Decision",
    "FusedDecision",
    "GestureRecognizer",
    "GestureRecognizerOptions",
    "HandFeatureOptions",
    "NBest",
    "SpeakerAdapter",
    "WordRecognizer",
    "WordRecognizerOptions",
    "__version__",
    "cross_validate",
    "denoise",
    "fuse",
    "gesture_trajectory",
    "open_robot",
    "read_audio",
    "read_frames",
    "render_video",
    "train",
]


logging.getLogger(__name__).addHandler(logging.NullHandler())


def __getattr__(name: str) -> Any:
    if name in _HOMES:
        return getattr(import_module(_HOMES[name]), name)
    from hri.core.suggest import nearest

    alike = nearest(name, __all__)
    hint = f"; did you mean {' or '.join(repr(entry) for entry in alike)}?" if alike else ""
    raise AttributeError(f"module 'hri' has no attribute {name!r}{hint}")


def __dir__() -> list[str]:
    return __all__
