# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri options``."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import click

from hri.cli.groups import CheckedCommand
from hri.cli.output import json_option, say, write_json
from hri.recognition import (
    ConnectedWordRecognizer,
    GestureRecognizer,
    SentenceRecognizer,
    SubwordRecognizer,
    WordRecognizer,
)

KINDS: dict[str, type[Any]] = {
    "speech": WordRecognizer,
    "gesture": GestureRecognizer,
    "connected": ConnectedWordRecognizer,
    "units": SubwordRecognizer,
    "sentences": SentenceRecognizer,
}
"""What trains a recogniser: ``hri train`` the first two, ``hri train-connected`` and so on the others."""


@click.command(cls=CheckedCommand)
@click.argument("kind", type=click.Choice(list(KINDS)))
@json_option
def options(kind: str, json_path: str | None) -> None:
    """Print what --option takes: every name with its default, the values it may have, and what it does.

    KIND is speech or gesture for 'hri train', and connected, units or sentences for 'hri train-' of this name.

    \b
    Examples:
      hri options speech
      hri options connected
      hri options gesture --json -
    """
    fields = list(option_table(type(KINDS[kind]().options)))
    for field in fields:
        values = f"{field['values']}\t" if field["values"] else "\t"
        say(f"{field['name']}={field['default']}\t{values}{field['description']}", json_path)
    write_json(json_path, {"kind": kind, "options": fields})


def option_table(options_class: Any, prefix: str = "") -> Iterator[dict[str, str]]:
    """Name, default, values and description of every field, those of nested classes by dotted names."""
    yield from _rows(options_class, options_class().as_dict(), prefix)


def _rows(options_class: Any, defaults: dict[str, Any], prefix: str) -> Iterator[dict[str, str]]:
    for field in options_class.fields():
        default = defaults[field.name]
        if field.options is not None:
            yield from _rows(field.options, default, f"{prefix}{field.name}.")
            continue
        values = ", ".join(field.choices) or f"{field.range} {field.unit}".strip() * bool(field.range)
        yield {
            "name": f"{prefix}{field.name}",
            "default": str(default).lower() if isinstance(default, bool) else str(default),
            "values": values or {"bool": "true, false"}.get(field.type, ""),
            "description": field.description,
        }
