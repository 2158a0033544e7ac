# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Model files as text: a C++ header, for programs without a file system, and JSON, for other programs."""

from __future__ import annotations

import json
import re
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri._native import ModelFile
from hri.core.errors import InvalidArgument
from hri.core.files import parse_json

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_DTYPES: dict[str, np.dtype[Any]] = {"F32": np.dtype("<f4"), "F64": np.dtype("<f8")}
_BYTES_A_LINE = 32


def model_as_cpp(model: ModelFile, name: str) -> str:
    """A C++17 header that holds the bytes of a model file.

    Parameters
    ----------
    model : ModelFile
    name : str
        Of the function that gives the bytes, as `hri::Span<const std::uint8_t>`; an identifier.

    Returns
    -------
    str
        Includes of libhri only ``hri/core/types.hpp``; `ModelFile::parse` takes what the function gives.

    Raises
    ------
    InvalidArgument
        For a name that is no identifier of letters, digits and underscores.
    """
    if not _NAME.fullmatch(name):
        raise InvalidArgument(f"{name!r} is no name for C++: letters, digits and underscores, a letter first")
    data = model.to_bytes()
    rows = [data[at : at + _BYTES_A_LINE] for at in range(0, len(data), _BYTES_A_LINE)]
    values = ",\n".join(",".join(map(str, row)) for row in rows)
    return f"""// {model.kind} for libhri, {len(data)} bytes, written by `hri export`. Load it with
//   hri::ModelFile::parse({name}(), "{name}")
#pragma once

#include <cstdint>
#include <hri/core/types.hpp>

inline hri::Span<const std::uint8_t> {name}() {{
  alignas(8) static constexpr std::uint8_t bytes[] = {{
{values}}};
  return {{bytes, sizeof bytes}};
}}
"""


def model_as_json(model: ModelFile) -> str:
    """The fields and tensors of a model file as JSON.

    Returns
    -------
    str
        An object with "kind", "metadata" (an object of text) and "tensors": of each "dtype" (float32 or float64),
        "shape" and "values", a list of rows. Numbers read back to the same bits.
    """
    data = model.to_bytes()
    begin = 8 + int.from_bytes(data[:8], "little")
    header = parse_json(data[8:begin].decode(), "the model")
    tensors = {}
    for name, entry in header.items():
        if name == "__metadata__":
            continue
        first, last = entry["data_offsets"]
        dtype = _DTYPES[entry["dtype"]]
        values = np.frombuffer(data[begin + first : begin + last], dtype).reshape(entry["shape"])
        tensors[name] = {"dtype": dtype.name, "shape": list(values.shape), "values": _shortest(values)}
    return json.dumps(
        {"kind": model.kind, "metadata": dict(model.metadata()), "tensors": tensors},
        ensure_ascii=False,
        allow_nan=False,
    )


def _shortest(values: NDArray[Any]) -> list[list[float]]:
    """Rows of the numbers with the fewest digits that give these values in their own precision."""
    if values.dtype.itemsize == 8:
        return [[float(value) for value in row] for row in values]
    return [[float(str(value)) for value in row] for row in values]
