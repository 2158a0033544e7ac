# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The errors hri raises; InvalidArgument and FormatError are also ValueErrors, IoError an OSError."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from os import PathLike, fsdecode

from hri._native import Error, FormatError, Interrupted, InvalidArgument, IoError

__all__ = ["Error", "FormatError", "Interrupted", "InvalidArgument", "IoError", "NotFittedError", "naming_model_file"]


class NotFittedError(InvalidArgument, AttributeError):
    """A model is asked before `fit` or `load`; also scikit-learn's NotFittedError where scikit-learn is loaded."""


@contextmanager
def naming_model_file(path: str | PathLike[str]) -> Iterator[None]:
    """Within the block, a FormatError that names a field names this file before it, unless it has named it already."""
    name = fsdecode(path)
    try:
        yield
    except FormatError as error:
        raise FormatError(str(error) if str(error).startswith(name) else f"{name}: {error}") from None


for _error in (Error, FormatError, Interrupted, InvalidArgument, IoError, NotFittedError):
    _error.__module__ = "hri"  # where users find them, and what tracebacks say
