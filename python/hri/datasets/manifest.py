# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""dataset.toml: what a folder of recordings holds. docs/datasets.md describes every key."""

from __future__ import annotations

import difflib
import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from hri.core.display import short_repr, shown
from hri.core.errors import FormatError, InvalidArgument
from hri.core.files import read_toml, write_text
from hri.datasets.pattern import Pattern

MANIFEST_NAME = "dataset.toml"
FORMAT_VERSION = 1
KINDS = ("speech", "gesture")

_TOP_KEYS: dict[str, type] = {
    "format_version": int,
    "kind": str,
    "name": str,
    "description": str,
    "licence": str,
    "synthetic": bool,
    "pattern": str,
    "labels": list,
    "made_by": dict,
    "samples": list,
}
_SAMPLE_KEYS = ("path", "label", "person", "take")


@dataclass(frozen=True)
class SampleRow:
    """One ``[[samples]]`` table, as written."""

    path: str
    label: str
    person: str = ""
    take: str = ""


@dataclass(frozen=True)
@short_repr
class Manifest:
    """The checked content of a dataset.toml.

    Attributes
    ----------
    kind : "speech" or "gesture"
    name, description, licence : str
    synthetic : bool
        Synthetic: a program made it.
    pattern : str or None
        Exactly one of `pattern` and `rows` is there.
    labels : list of str
        The labels that may occur; empty allows all.
    made_by : dict
        Program and settings that made a synthetic data set; free keys.
    rows : list of SampleRow
    """

    kind: str
    name: str = ""
    description: str = ""
    licence: str = ""
    synthetic: bool = False
    pattern: str | None = None
    labels: list[str] = field(default_factory=list)
    made_by: dict[str, Any] = field(default_factory=dict)
    rows: list[SampleRow] = field(default_factory=list)


def read_manifest(path: Path) -> Manifest:
    """Read and check a manifest.

    Raises
    ------
    FormatError
        Names the file, the table and row, and the key.
    IoError
        When the file cannot be read.
    """
    data = read_toml(path)
    _require_known(data, tuple(_TOP_KEYS), f"{path}")
    for key, value in data.items():
        _require_type(value, _TOP_KEYS[key], f"{path}: {key}")
    version = data.get("format_version", FORMAT_VERSION)
    if not 1 <= version <= FORMAT_VERSION:
        raise FormatError(f"{path}: format_version is {shown(version)}, this program reads up to {FORMAT_VERSION}")
    if data.get("kind") not in KINDS:
        raise FormatError(f"{path}: kind is {shown(data.get('kind'))}, must be one of {KINDS}")
    for index, label in enumerate(data.get("labels", []), start=1):
        _require_text(label, f"{path}: labels, entry {index}")
    if ("pattern" in data) == ("samples" in data):
        raise FormatError(f"{path}: needs either pattern or [[samples]] tables, and not both")
    if "pattern" in data:
        try:
            Pattern(data["pattern"])
        except InvalidArgument as error:
            raise FormatError(f"{path}: pattern: {error}") from error
    return Manifest(
        kind=data["kind"],
        name=data.get("name", ""),
        description=data.get("description", ""),
        licence=data.get("licence", ""),
        synthetic=data.get("synthetic", False),
        pattern=data.get("pattern"),
        labels=data.get("labels", []),
        made_by=data.get("made_by", {}),
        rows=_sample_rows(data.get("samples", []), path),
    )


def _sample_rows(tables: list[Any], path: Path) -> list[SampleRow]:
    rows: list[SampleRow] = []
    first_use: dict[str, int] = {}
    for number, table in enumerate(tables, start=1):
        where = f"{path}: [[samples]] row {number}"
        _require_type(table, dict, where)
        _require_known(table, _SAMPLE_KEYS, where)
        for key in ("path", "label"):
            if key not in table:
                raise FormatError(f"{where}: {key} is missing")
        for key, value in table.items():
            _require_text(value, f"{where}: {key}")
        row = SampleRow(**table)
        if row.path in first_use:
            raise FormatError(f"{where}: path {row.path!r} is already in row {first_use[row.path]}")
        first_use[row.path] = number
        rows.append(row)
    return rows


def _require_known(table: dict[str, Any], known: tuple[str, ...], where: str) -> None:
    for key in table:
        if key not in known:
            close = difflib.get_close_matches(key, known, n=1)
            hint = f"did you mean {close[0]}?" if close else f"known are {', '.join(known)}"
            raise FormatError(f"{where}: unknown key {key}; {hint}")


def _require_type(value: Any, wanted: type, where: str) -> None:
    if not isinstance(value, wanted) or (wanted is int and isinstance(value, bool)):
        names = {int: "a whole number", str: "text", bool: "true or false", list: "a list"}
        raise FormatError(f"{where} is {shown(value)}, must be {names.get(wanted, 'a table')}")


def _require_text(value: Any, where: str) -> None:
    _require_type(value, str, where)
    if not value.strip():
        raise FormatError(f"{where} is empty")


def write_manifest(path: Path, manifest: Manifest) -> None:
    """Write a manifest that `read_manifest` reads back equal; the file appears whole or not at all.

    Raises
    ------
    IoError
        When the file cannot be written.
    """
    write_text(path, manifest_text(manifest))


def manifest_text(manifest: Manifest) -> str:
    """What `write_manifest` writes."""
    lines = [f"format_version = {FORMAT_VERSION}", f"kind = {_toml(manifest.kind)}"]
    for key in ("name", "description", "licence", "pattern", "labels"):
        value = getattr(manifest, key)
        if value:
            lines.append(f"{key} = {_toml(value)}")
    lines.append(f"synthetic = {_toml(manifest.synthetic)}")
    if manifest.made_by:
        lines += ["", "[made_by]"]
        lines += [f"{_toml(key)} = {_toml(value)}" for key, value in manifest.made_by.items()]
    for row in manifest.rows:
        lines += ["", "[[samples]]"]
        lines += [f"{key} = {_toml(getattr(row, key))}" for key in _SAMPLE_KEYS if getattr(row, key)]
    return "\n".join(lines) + "\n"


def _toml(value: Any) -> str:
    """A string, number, truth value or list of these; TOML's strings are JSON's but for DEL."""
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
