# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The console script: ends at Ctrl-C as commands do while what they need is still being loaded.

Nothing is imported here that takes time: what comes before the handler is in place would end with a traceback.
"""

from __future__ import annotations

import os
import signal
import sys
from types import FrameType

_INTERRUPTED = 130


def run() -> None:
    """Load the command line, and do what the arguments say."""
    # Who has started this in the background may have the signal ignored, which stays so.
    takes_over = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if takes_over:
        signal.signal(signal.SIGINT, _end_at_once)
    try:
        from hri.cli.main import run as run_command
    finally:
        if takes_over:
            signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        run_command()
    except KeyboardInterrupt:  # between the commands' own handlers
        _end_at_once(signal.SIGINT, None)


def _end_at_once(number: int, frame: FrameType | None) -> None:
    """An exception would come out of the midst of an import, which may make another one of it."""
    if sys.stderr is not None:
        os.write(2, b"\nhri: interrupted\n")  # below the ^C of a terminal
    os._exit(_INTERRUPTED)
