# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Arguments of the transforms: real arrays, and names of modes."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hri import _native
from hri.core.errors import InvalidArgument

Array = NDArray[Any]

MODES: tuple[str, ...] = tuple(
    next(field.choices for field in _native.ShrinkageOptions.fields() if field.name == "border")
)
"""What stands beyond the ends of a signal, by PyWavelets' names."""


def as_mode(name: str) -> Any:
    """The name, if there is a mode of that name."""
    if name not in MODES:
        raise InvalidArgument(f"no mode {name!r}; there are: {', '.join(MODES)}")
    return name


def as_real(values: ArrayLike) -> Array:
    """As an array of float32 or float64; complex numbers and text are refused."""
    array = np.asarray(values)
    return array if array.dtype.char in "fd" else array.astype(np.float64, casting="safe")


def as_contiguous(values: ArrayLike) -> Array:
    """The same, its values one beside the other."""
    return np.ascontiguousarray(as_real(values))
