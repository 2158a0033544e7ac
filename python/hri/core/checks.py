# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Numbers among arguments, refused before anything is done with them."""

from __future__ import annotations

import numpy as np

from hri.core.display import shown
from hri.core.errors import InvalidArgument


def check_integer(value: object, name: str, least: int | None = None) -> None:
    """Refuse what is not an integer of `least` or more. Raises InvalidArgument, which names the argument."""
    if isinstance(value, bool) or not isinstance(value, int | np.integer):
        raise InvalidArgument(f"{name} must be an integer, got {shown(value)}")
    if least is not None and value < least:
        raise InvalidArgument(f"{name} is {shown(value)}, must be {least} or more")


def check_number(value: object, name: str, least: float, most: float) -> None:
    """Refuse what is not a number of `least` to `most`. Raises InvalidArgument, which names the argument."""
    if isinstance(value, bool) or not isinstance(value, int | float | np.integer | np.floating):
        raise InvalidArgument(f"{name} must be a number, got {shown(value)}")
    if not least <= value <= most:
        raise InvalidArgument(f"{name} must lie in {least}..{most}, got {value}")
