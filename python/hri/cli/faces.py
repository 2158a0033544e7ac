# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The option ``--faces`` of the commands that look for hands."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import click

from hri.recognition import GestureRecognizer, SentenceRecognizer
from hri.vision.faces import face_finder


def faces_option(default: str) -> Callable[[Any], Any]:
    """The option; `default` says what holds without it."""
    return click.option(
        "--faces",
        metavar="auto|never|FILE",
        help="Whether hands are those of the person whose face is seen, where one is; FILE is a cascade of OpenCV's "
        f"that finds faces.  [default: {default}]",
    )


def require_faces(faces: str | None) -> None:
    """Refuse ``--faces`` where nothing here finds faces: now, not after all recordings."""
    if faces not in (None, "never"):
        face_finder(faces, required=True)


def look_for_faces(signs: GestureRecognizer | SentenceRecognizer, faces: str | None) -> None:
    """Let a recogniser find hands as ``--faces`` says. Raises UsageError where that would have no effect."""
    if faces is None:
        return
    if isinstance(signs, SentenceRecognizer):
        if faces == "never":
            raise click.UsageError("--faces never: signed sentences need the head beside the hands")
        return
    if signs.options.source == "landmarks":
        raise click.UsageError("--faces: the model finds hands by their joints, without faces")
    signs.faces = faces
