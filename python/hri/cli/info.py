# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri info``."""

from __future__ import annotations

from importlib.util import find_spec
from typing import Any

import click

from hri import __version__
from hri.cli.output import json_option, say, write_json
from hri.cli.recognizers import CLASSES, default_model
from hri.errors import FormatError

EXTRAS = {
    "audio": ("soundfile",),
    "cli": ("click", "rich", "platformdirs"),
    "plots": ("matplotlib",),
    "robot": ("pybullet",),
    "video": ("cv2",),
}


@click.command()
@click.argument("model", required=False, type=click.Path(exists=True, dir_okay=False))
@json_option
def info(model: str | None, json_path: str | None) -> None:
    """Tell what is installed; with MODEL, what that model file holds.

    \b
    Examples:
      hri info
      hri info digits.hri
    """
    found = _installation() if model is None else _model(model)
    for line in _lines(found):
        say(line, json_path)
    write_json(json_path, found)


def _installation() -> dict[str, Any]:
    return {
        "version": __version__,
        "vision": find_spec("hri._native_vision") is not None,
        "extras": {name: all(map(find_spec, modules)) for name, modules in EXTRAS.items()},
        "models": {mode: str(default_model(mode)) for mode in CLASSES if default_model(mode).is_file()},
    }


def _model(path: str) -> dict[str, Any]:
    errors = []
    for mode, recognizer_class in CLASSES.items():
        try:
            recognizer = recognizer_class.load(path)
        except FormatError as error:
            errors.append(str(error))
            continue
        labels = [str(label) for label in recognizer.classes_]
        return {"mode": mode, "labels": labels, "options": recognizer.get_params()}
    raise FormatError(f"{path} is no model of this version: {'; '.join(errors)}")


def _lines(value: dict[str, Any], prefix: str = "") -> list[str]:
    lines = []
    for key, entry in value.items():
        if hasattr(entry, "as_dict"):
            entry = entry.as_dict()
        if isinstance(entry, dict):
            lines += _lines(entry, f"{prefix}{key}.")
        else:
            text = " ".join(map(str, entry)) if isinstance(entry, list) else str(entry)
            lines.append(f"{prefix}{key}\t{text}")
    return lines
