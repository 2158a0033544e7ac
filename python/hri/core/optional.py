# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Libraries that are imported only when something needs them."""

from __future__ import annotations

import os
import sys
from contextlib import nullcontext
from importlib import import_module
from typing import Any

from hri.core.quiet import silent_stderr


def import_optional(module: str, extra: str, purpose: str) -> Any:
    """Import `module`, or raise an ImportError that says which extra brings it.

    Parameters
    ----------
    module : str
        Name as in an import statement.
    extra : str
        The extra of libhri that depends on it.
    purpose : str
        What it is needed for, as in "to read video".
    """
    try:
        return import_module(module)
    except ImportError as error:
        raise ImportError(f"{module} is needed {purpose}: pip install libhri[{extra}] ({error})") from error


def import_pybullet() -> Any:
    """Import PyBullet without the time of its build, which it prints on stderr the first time."""
    with nullcontext() if "pybullet" in sys.modules else silent_stderr():
        return import_optional("pybullet", "robot", "to simulate the robot")


def import_opencv(purpose: str) -> Any:
    """Import OpenCV; it then reports through our errors and not on stderr, and refuses vast pictures."""
    os.environ.setdefault("OPENCV_FFMPEG_LOGLEVEL", "-8")
    os.environ.setdefault("OPENCV_LOG_LEVEL", "OFF")
    os.environ.setdefault("OPENCV_IO_MAX_IMAGE_PIXELS", "100000000")  # for formats whose header hri does not read
    return import_optional("cv2", "video", purpose)
