# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Results as JSON."""

from __future__ import annotations

import json
import os
import tempfile
from pathlib import Path
from typing import Any

import click

json_option = click.option(
    "--json",
    "json_path",
    type=click.Path(dir_okay=False, allow_dash=True),
    help="Also write everything as JSON to this file; - is standard output, and then nothing else goes there.",
)


def write_json(path: str | None, value: Any) -> None:
    """Write `value` to `path`; an old file stays whole if this fails. None writes nothing."""
    if path is None:
        return
    text = json.dumps(value, indent=2, ensure_ascii=False, default=str) + "\n"
    if path == "-":
        click.echo(text, nl=False)
        return
    target = Path(path)
    target.parent.mkdir(parents=True, exist_ok=True)
    handle, temporary = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}.")
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(text)
        Path(temporary).chmod(0o644)
        Path(temporary).replace(target)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise


def say(text: str, json_path: str | None) -> None:
    """Print `text` for people, unless standard output is taken by JSON."""
    if json_path != "-":
        click.echo(text)
