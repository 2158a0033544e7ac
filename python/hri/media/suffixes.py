# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Kinds of files by their suffix."""

from __future__ import annotations

import os
from pathlib import Path

AUDIO_SUFFIXES = (".wav", ".flac", ".ogg", ".opus", ".mp3", ".aiff", ".aif")
IMAGE_SUFFIXES = (".jpg", ".jpeg", ".png", ".bmp")
VIDEO_SUFFIXES = (".mp4", ".m4v", ".mov", ".avi", ".mkv", ".webm")
MODEL_SUFFIX = ".hri"

_KINDS = {
    "a sound file": AUDIO_SUFFIXES,
    "a picture": IMAGE_SUFFIXES,
    "a video": VIDEO_SUFFIXES,
    "a model": (MODEL_SUFFIX,),
}


def kind_of_file(path: Path) -> str:
    """ "a sound file", "a picture", "a video", "a model" or "a folder"; "" where the suffix says nothing."""
    if os.path.isdir(path):  # noqa: PTH112 - which, unlike Path.is_dir, is False where the path cannot be looked at
        return "a folder"
    return next((kind for kind, suffixes in _KINDS.items() if path.suffix.lower() in suffixes), "")
