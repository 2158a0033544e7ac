# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Where the cascade of classifiers that finds faces is on this machine."""

from __future__ import annotations

import os
from functools import lru_cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any, Literal

CASCADE = "haarcascade_frontalface_alt2.xml"
VARIABLE = "HRI_FACE_CASCADE"
Faces = Literal["auto", "never"]

_FOLDERS = (
    "/usr/share/opencv4/haarcascades",
    "/usr/share/opencv/haarcascades",
    "/usr/local/share/opencv4/haarcascades",
)


def find_cascade() -> str | None:
    """The path of the cascade that finds faces; None where there is none.

    It is what the environment variable ``HRI_FACE_CASCADE`` names, that of Debian's package opencv-data, or that of
    OpenCV's package for Python before version 5.
    """
    if named := os.environ.get(VARIABLE):
        return named
    folders = [Path(folder) for folder in _FOLDERS]
    if (package := find_spec("cv2")) is not None and package.origin is not None:
        folders.append(Path(package.origin).parent / "data")
    return next((str(folder / CASCADE) for folder in folders if (folder / CASCADE).is_file()), None)


def face_finder(faces: Any = "auto") -> Any:
    """A FaceFinder, or None.

    Parameters
    ----------
    faces : "auto", "never", a path of a cascade, or FaceFinder
        "auto": by the cascade that `find_cascade` gives, where there is one.

    Raises
    ------
    IoError, FormatError
        For a cascade that cannot be read.
    """
    from hri import _native_vision

    if isinstance(faces, _native_vision.FaceFinder):
        return faces
    if faces == "never":
        return None
    path = find_cascade() if faces == "auto" else os.fspath(faces)
    return None if path is None else _read_cascade(path)


@lru_cache(maxsize=4)
def _read_cascade(path: str) -> Any:
    from hri import _native_vision

    return _native_vision.FaceFinder(path)
