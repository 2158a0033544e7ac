# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri options``."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import click

from hri.cli.output import json_option, say, write_json
from hri.cli.recognizers import CLASSES, mode_argument


@click.command()
@mode_argument
@json_option
def options(mode: str, json_path: str | None) -> None:
    """Print what --option takes for MODE: every name with its default, the values it may have, and what it does.

    \b
    Examples:
      hri options speech
      hri options gesture --json -
    """
    fields = list(option_table(type(CLASSES[mode]().options)))
    for field in fields:
        values = f"{field['values']}\t" if field["values"] else "\t"
        say(f"{field['name']}={field['default']}\t{values}{field['description']}", json_path)
    write_json(json_path, {"mode": mode, "options": fields})


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
