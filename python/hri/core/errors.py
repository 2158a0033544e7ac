# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The errors hri raises; InvalidArgument and FormatError are also ValueErrors, IoError an OSError."""

from hri._native import Error, FormatError, Interrupted, InvalidArgument, IoError

__all__ = ["Error", "FormatError", "Interrupted", "InvalidArgument", "IoError"]
