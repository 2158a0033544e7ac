# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The order of names that hold numbers."""

from __future__ import annotations

import re
import unicodedata


def natural_key(text: str) -> list[tuple[int, int, str, str]]:
    """Sort key that counts numbers as numbers: 2 before 10."""
    return [
        _number_key(piece) if piece.isdecimal() else (1, 0, piece, "") for piece in re.split(r"(\d+)", text) if piece
    ]


def _number_key(piece: str) -> tuple[int, int, str, str]:
    # Python makes no integer of more than 4300 digits; of those without zeros before them the longer is the larger.
    digits = "".join(str(unicodedata.decimal(digit)) for digit in piece).lstrip("0")
    return 0, len(digits), digits, piece
