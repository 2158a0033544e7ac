# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The compiled core."""

from __future__ import annotations

from pathlib import Path

from hri import _native


def library_file() -> Path:
    """Where the compiled core lies."""
    return Path(str(_native.__file__))
