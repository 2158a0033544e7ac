# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The errors hri raises; InvalidArgument and FormatError are also ValueErrors, IoError an OSError."""

from hri._native import Error, FormatError, Interrupted, InvalidArgument, IoError

__all__ = ["Error", "FormatError", "Interrupted", "InvalidArgument", "IoError", "NotFittedError"]


class NotFittedError(InvalidArgument, AttributeError):
    """A model is asked before `fit` or `load`; also scikit-learn's NotFittedError where scikit-learn is loaded."""


for _error in (Error, FormatError, Interrupted, InvalidArgument, IoError, NotFittedError):
    _error.__module__ = "hri"  # where users find them, and what tracebacks say
