# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What is said beside the results, on standard error: messages of commands, and the library's log."""

from __future__ import annotations

import logging
import warnings
from collections.abc import Iterable

import click

from hri.cli.in_commands import of_models

_COMMANDS = logging.getLogger("hri.cli")
_LIBRARY = logging.getLogger("hri")


class _StandardError(logging.Handler):
    """Writes to what standard error is at that moment; the library's records carry their logger's name."""

    def emit(self, record: logging.LogRecord) -> None:
        text = record.getMessage()
        click.echo(text if record.name == _COMMANDS.name else f"{record.name}: {text}", err=True)


def _show_warning(message: Warning | str, *_: object, **__: object) -> None:
    """A warning as a line for people, without the place in the source."""
    note(f"warning: {message}")


def note(text: str) -> None:
    """A message for people, on standard error unless ``hri --quiet``."""
    _COMMANDS.info(text)


def listed(labels: Iterable[str]) -> str:
    """Labels with spaces between; those in which there is a space stand in quotation marks."""
    return " ".join(repr(label) if label.split() != [label] else label for label in labels)


def report_fault(error: Exception | str) -> None:
    """What is wrong with one of several items, on standard error even with ``hri --quiet``; the others go on."""
    _COMMANDS.error("hri: error: %s", " ".join(of_models(str(error)).split()))


def set_verbosity(verbosity: int) -> None:
    """How much is said.

    Parameters
    ----------
    verbosity : int
        -1: errors only. 0: what commands have to say, and the library's warnings. 1: also what the library does.
        2: every detail.
    """
    for handler in _LIBRARY.handlers[:]:
        if isinstance(handler, _StandardError):
            _LIBRARY.removeHandler(handler)
    _LIBRARY.addHandler(_StandardError())
    _LIBRARY.propagate = False
    level = {-1: logging.ERROR, 0: logging.WARNING, 1: logging.INFO}.get(verbosity, logging.DEBUG)
    _LIBRARY.setLevel(level)
    warnings.showwarning = _show_warning
    _COMMANDS.setLevel(logging.ERROR if verbosity < 0 else min(level, logging.INFO))
