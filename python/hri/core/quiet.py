# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Libraries that print on standard error what means nothing to the user."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def silent_stderr() -> Iterator[None]:
    """Standard error of the whole process, also of libraries in C, goes nowhere meanwhile: a moment at most."""
    if sys.stderr is not None:
        sys.stderr.flush()
    try:
        kept = os.dup(2)
    except OSError:  # it is closed
        yield
        return
    sink = os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(sink, 2)
        yield
        if sys.stderr is not None:
            sys.stderr.flush()
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(sink)
