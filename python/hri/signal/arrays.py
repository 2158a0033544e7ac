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

_MODES: dict[str, Any] = dict(_native.Border.__members__)


def as_mode(name: str) -> Any:
    """What the C++ library takes for a mode of that name."""
    try:
        return _MODES[name]
    except (KeyError, TypeError):
        raise InvalidArgument(f"no mode {name!r}; there are: {', '.join(_MODES)}") from None


def as_real(values: ArrayLike) -> Array:
    """As an array of float32 or float64; complex numbers and text are refused."""
    array = np.asarray(values)
    return array if array.dtype.char in "fd" else array.astype(np.float64, casting="safe")


def as_contiguous(values: ArrayLike) -> Array:
    """The same, its values one beside the other."""
    return np.ascontiguousarray(as_real(values))
