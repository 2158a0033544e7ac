# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Results of studies as tables: Markdown for people, CSV for programs."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from typing import Any

from hri.studies.registry import Layout

Row = dict[str, Any]


def statistics(per_fold: dict[str, float], measure: str = "accuracy") -> Row:
    """Mean and spread (population standard deviation) over folds, as rows hold them."""
    values = list(per_fold.values())
    mean = sum(values) / len(values)
    spread = (sum((value - mean) ** 2 for value in values) / len(values)) ** 0.5
    return {f"{measure}_mean": mean, f"{measure}_std": spread, "per_fold": per_fold}


def result_rows(result: Row, layout: Layout) -> list[Row]:
    """The rows of a result; of one without rows, every part that holds what the layout shows, by its place."""
    if "rows" in result:
        return list(result["rows"])
    return list(_parts(result, layout, ()))


def _parts(part: Row, layout: Layout, place: tuple[str, ...]) -> Iterable[Row]:
    if f"{layout.measure}_mean" in part:
        kept = (f"{layout.measure}_mean", f"{layout.measure}_std")
        yield {"part": " / ".join(place) or "all", **{key: part[key] for key in kept if key in part}}
    for name, inner in part.items():
        if isinstance(inner, dict):
            yield from _parts(inner, layout, (*place, name))


def axes_of(rows: Sequence[Row]) -> list[str]:
    """What is varied: the keys that no measurement takes, in the order of their first use."""
    keys = dict.fromkeys(key for row in rows for key in row)
    return [k for k in keys if not k.endswith(("_mean", "_std")) and not any(isinstance(r.get(k), dict) for r in rows)]


def measures_of(rows: Sequence[Row]) -> list[str]:
    """What was measured, in the order of first use."""
    return list(dict.fromkeys(key[: -len("_mean")] for row in rows for key in row if key.endswith("_mean")))


def show(row: Row, layout: Layout, measure: str = "") -> str:
    """A measurement as "84.0 ± 9.2"; "" where the row has none."""
    name = measure or layout.measure
    mean = row.get(f"{name}_mean")
    if mean is None:
        return ""
    scale = 100.0 if layout.percent else 1.0
    std = row.get(f"{name}_std")
    return f"{scale * mean:.1f}" if std is None else f"{scale * mean:.1f} ± {scale * std:.1f}"


def table(result: Row, layout: Layout) -> list[list[str]]:
    """Header and cells: a column for each axis and measurement, or one axis spread over the columns."""
    rows = result_rows(result, layout)
    axes, unit = axes_of(rows), " %" if layout.percent else ""
    if not layout.columns:
        measures = measures_of(rows)
        header = [*axes, *(f"{measure}{unit}" for measure in measures)]
        cells = [[str(r.get(a, "")) for a in axes] + [show(r, layout, m) for m in measures] for r in rows]
        return [header, *cells]
    down = [axis for axis in axes if axis != layout.columns]
    across = list(dict.fromkeys(row[layout.columns] for row in rows))
    if all(isinstance(value, int | float) for value in across):
        across.sort()
    lines: dict[tuple[str, ...], dict[Any, str]] = {}
    for row in rows:
        lines.setdefault(tuple(str(row.get(a, "")) for a in down), {})[row[layout.columns]] = show(row, layout)
    header = [*down, *(f"{layout.columns} {value}" if isinstance(value, int | float) else value for value in across)]
    return [header, *([*key, *(found.get(value, "") for value in across)] for key, found in lines.items())]


def markdown(result: Row, layout: Layout) -> str:
    """The table with what the study is for."""
    header, *rows = table(result, layout)
    lines = [f"# {result['study']}", "", f"target: {result['target']}", ""]
    if isinstance(result.get("passed"), bool):
        lines[2:3] = [f"target: {result['target']} ({'met' if result['passed'] else 'missed'})"]
    if "takes" in result:
        lines += [f"the first {result['takes']} recordings of every word by every person", ""]
    if layout.columns:
        lines += [f"{layout.measure}{', %' if layout.percent else ''}, mean ± spread over persons held out", ""]
    lines += ["| " + " | ".join(cells) + " |" for cells in (header, ["---"] * len(header), *rows)]
    return "\n".join(lines) + "\n"


def csv_text(result: Row, layout: Layout) -> str:
    """Every row with all its measurements in full, folds included."""
    rows = result_rows(result, layout)
    flat = []
    for row in rows:
        inner = {
            f"{key}: {name}": value
            for key, part in row.items()
            if isinstance(part, dict)
            for name, value in part.items()
        }
        flat.append({key: value for key, value in row.items() if not isinstance(value, dict)} | inner)
    text = io.StringIO()
    writer = csv.DictWriter(text, list(dict.fromkeys(key for row in flat for key in row)), lineterminator="\n")
    writer.writeheader()
    writer.writerows(flat)
    return text.getvalue()
