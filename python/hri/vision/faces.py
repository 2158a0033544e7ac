# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Where the cascade of classifiers that finds faces is on this machine."""

from __future__ import annotations

import os
import warnings
from functools import lru_cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from hri.core.errors import InvalidArgument

CASCADE = "haarcascade_frontalface_alt2.xml"
VARIABLE = "HRI_FACE_CASCADE"
REMEDY = (
    "install Debian's package opencv-data, or opencv-python-headless below version 5, or name OpenCV's "
    f"{CASCADE} in the environment variable {VARIABLE}"
)
"""What gives this machine something that finds faces."""

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


def face_finder(faces: Any = "auto", *, required: bool = False) -> Any:
    """A FaceFinder, or None.

    Parameters
    ----------
    faces : "auto", "never", a path of a cascade, or FaceFinder
        "auto": by the cascade that `find_cascade` gives. Where there is none, a warning says what hands are then
        found without, once a process.
    required : bool
        Nothing works without: no cascade is an error.

    Raises
    ------
    IoError, FormatError
        For a cascade that cannot be read.
    InvalidArgument
        With `required`, for "never", and where there is no cascade.
    """
    from hri import _native_vision

    if isinstance(faces, _native_vision.FaceFinder):
        return faces
    if faces == "never":
        if required:
            raise InvalidArgument('faces is "never", where the face of a person is needed')
        return None
    path = find_cascade() if faces == "auto" else os.fspath(faces)
    if path is not None:
        return _read_cascade(path)
    if required:
        raise InvalidArgument(f"nothing here finds faces: {REMEDY}")
    warnings.warn(
        f"nothing here finds faces, so hands are found without; of persons in rooms most hands are missed: {REMEDY}",
        stacklevel=1,  # one place, so that it is said once
    )
    return None


@lru_cache(maxsize=4)
def _read_cascade(path: str) -> Any:
    from hri import _native_vision

    return _native_vision.FaceFinder(path)
