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
CHOSEN_BY_TRAIN = {
    "speech": {
        "front_end": "both where the extra embedding is installed",
        "use_network": "true from three speakers on by cepstra, from ten on with the embedding",
    },
    "gesture": {"source": "landmarks where the extra mediapipe finds the hands"},
}
"""What ``hri train`` and ``hri evaluate`` take in place of the default where it is not given (`choose_options`)."""


@click.command(cls=CheckedCommand)
@click.argument("kind", type=click.Choice(list(KINDS)))
@json_option
def options(kind: str, json_path: str | None) -> None:
    """Print what --option takes: every name with its default, the values it may have, and what it does.

    KIND is speech or gesture for 'hri train', and connected, units or sentences for 'hri train-' of this name. What
    'hri train' decides by the recordings and the extras, in place of the default, stands at the end of the line.

    \b
    Examples:
      hri options speech
      hri options connected
      hri options gesture --json -
    """
    chosen = CHOSEN_BY_TRAIN.get(kind, {})
    fields = [{**field, "train": chosen.get(field["name"], "")} for field in option_table(type(KINDS[kind]().options))]
    for field in fields:
        values = f"{field['values']}\t" if field["values"] else "\t"
        train = f"\t'hri train' takes {field['train']}" if field["train"] else ""
        say(f"{field['name']}={field['default']}\t{values}{field['description']}{train}", json_path)
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
