# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Command a humanoid robot with words and signs.

The names below are loaded on first use, so that ``import hri`` pulls in neither OpenCV nor PyBullet. The rooms are
`hri.signal`, `hri.features`, `hri.models`, `hri.language`, `hri.htk`, `hri.vision`, `hri.recognition`, `hri.io` (as in
C++), and `hri.media`, `hri.datasets`, `hri.synthetic`, `hri.training`, `hri.evaluation`, `hri.fusion`, `hri.live`,
`hri.robot`, `hri.session`.
"""

import logging
from typing import TYPE_CHECKING

from hri._native import __version__, num_threads, set_num_threads
from hri.core.errors import Error, FormatError, Interrupted, InvalidArgument, IoError, NotFittedError

if TYPE_CHECKING:
    from hri import (
        datasets,
        evaluation,
        features,
        fusion,
        htk,
        io,
        language,
        live,
        media,
        models,
        recognition,
        robot,
        session,
        signal,
        synthetic,
        training,
        vision,
    )
    from hri.datasets import Dataset
    from hri.evaluation import cross_validate
    from hri.features import CepstraOptions, HandFeatureOptions
    from hri.fusion import FusedDecision
    from hri.fusion.fuse import fuse
    from hri.media import Audio, Clip, read_audio, read_frames
    from hri.recognition import (
        CommandRecognizer,
        ConnectedWordRecognizer,
        Decision,
        GestureRecognizer,
        GestureRecognizerOptions,
        NBest,
        SentenceRecognizer,
        SpeakerAdapter,
        SubwordRecognizer,
        Transcript,
        WordRecognizer,
        WordRecognizerOptions,
        load,
    )
    from hri.robot import gesture_trajectory, open_robot, render_video
    from hri.session import Session
    from hri.signal import denoise
    from hri.training.train import train
else:
    from hri.core.lazy import loader

    _ROOMS = (
        "datasets",
        "evaluation",
        "features",
        "fusion",
        "htk",
        "io",
        "language",
        "live",
        "media",
        "models",
        "recognition",
        "robot",
        "session",
        "signal",
        "synthetic",
        "training",
        "vision",
    )
    __getattr__ = loader(
        __name__,
        {
            "hri.datasets": ("Dataset",),
            "hri.evaluation": ("cross_validate",),
            "hri.features": ("CepstraOptions", "HandFeatureOptions"),
            "hri.fusion": ("FusedDecision", "fuse"),
            "hri.media": ("Audio", "Clip", "read_audio", "read_frames"),
            "hri.recognition": (
                "CommandRecognizer",
                "ConnectedWordRecognizer",
                "Decision",
                "GestureRecognizer",
                "GestureRecognizerOptions",
                "NBest",
                "SentenceRecognizer",
                "SpeakerAdapter",
                "SubwordRecognizer",
                "Transcript",
                "WordRecognizer",
                "WordRecognizerOptions",
                "load",
            ),
            "hri.robot": ("gesture_trajectory", "open_robot", "render_video"),
            "hri.session": ("Session",),
            "hri.signal": ("denoise",),
            "hri.training": ("train",),
        },
        _ROOMS,
    )

    def __dir__() -> list[str]:
        return __all__


logging.getLogger(__name__).addHandler(logging.NullHandler())

__all__ = [
    "Audio",
    "CepstraOptions",
    "Clip",
    "CommandRecognizer",
    "ConnectedWordRecognizer",
    "Dataset",
    "Decision",
    "Error",
    "FormatError",
    "FusedDecision",
    "GestureRecognizer",
    "GestureRecognizerOptions",
    "HandFeatureOptions",
    "Interrupted",
    "InvalidArgument",
    "IoError",
    "NBest",
    "NotFittedError",
    "SentenceRecognizer",
    "Session",
    "SpeakerAdapter",
    "SubwordRecognizer",
    "Transcript",
    "WordRecognizer",
    "WordRecognizerOptions",
    "__version__",
    "cross_validate",
    "datasets",
    "denoise",
    "evaluation",
    "features",
    "fuse",
    "fusion",
    "gesture_trajectory",
    "htk",
    "io",
    "language",
    "live",
    "load",
    "media",
    "models",
    "num_threads",
    "open_robot",
    "read_audio",
    "read_frames",
    "recognition",
    "render_video",
    "robot",
    "session",
    "set_num_threads",
    "signal",
    "synthetic",
    "train",
    "training",
    "vision",
]
