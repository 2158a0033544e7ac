# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Results of studies as tables: Markdown for people, CSV for programs."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from hri.core.errors import InvalidArgument
from hri.studies.registry import Layout
from hri.studies.tables import PER_FOLD, Row, axes_of, measures_of


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


def show(row: Row, layout: Layout, measure: str = "", shown: Pivot | None = None) -> str:
    """A measurement as "84.0 ± 9.2", of a single fold as "84.0"; "" where the row has none."""
    name, digits = measure or layout.measure, 1 if shown is None else shown.digits
    mean = row.get(f"{name}_mean")
    if mean is None:
        return ""
    scale = 100.0 if layout.percent else 1.0
    one_fold = len(row.get(PER_FOLD, ())) == 1
    std = row.get(f"{name}_std") if not one_fold and (shown is None or shown.spread) else None
    text = f"{scale * mean:.{digits}f}"
    return text if std is None else f"{text} ± {scale * std:.{digits}f}"


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
    return "\n".join(lines) + "\n" + markdown_table([header, *rows])


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


@dataclass(frozen=True)
class Pivot:
    """How a table of the documentation shows rows of a result.

    Attributes
    ----------
    rows : tuple of str
        Axes along the rows of the table; empty for all that vary.
    columns : str
        The axis along the columns; "measures" for one column a measure.
    measures : tuple of str
        What was measured, for one column a measure; empty for all. Of other columns one; empty for the layout's.
    where : mapping of str to sequence of str
        Only the rows of the result with these values.
    names : mapping of str to str
        What axes, values and measures are called.
    spread : bool
        Whether to show the spread behind the mean.
    digits : int
        Decimals.
    """

    rows: tuple[str, ...] = ()
    columns: str = "measures"
    measures: tuple[str, ...] = ()
    where: Mapping[str, Sequence[str]] = field(default_factory=dict)
    names: Mapping[str, str] = field(default_factory=dict)
    spread: bool = True
    digits: int = 1


def pivot(rows: Sequence[Row], layout: Layout, shown: Pivot) -> list[list[str]]:
    """Header and cells.

    Raises
    ------
    InvalidArgument
        For an axis that the rows have not, no row left, or two rows or measures for one cell.
    """
    axes = axes_of(rows)
    if shown.columns != "measures" and len(shown.measures) > 1:
        raise InvalidArgument(f"several measures for one cell: {', '.join(shown.measures)}")
    unknown = {*shown.rows, *shown.where, shown.columns} - {*axes, "measures"}
    if unknown:
        raise InvalidArgument(f"no axis {', '.join(sorted(unknown))}; there are: {', '.join(axes)}")
    kept = [row for row in rows if all(str(row.get(axis)) in values for axis, values in shown.where.items())]
    if not kept:
        raise InvalidArgument(f"no row has {dict(shown.where)}")
    varied = [axis for axis in axes if len({str(row.get(axis)) for row in kept}) > 1]
    down = [axis for axis in (shown.rows or varied) if axis != shown.columns]
    by_measure = shown.columns == "measures"
    lines: dict[tuple[str, ...], dict[str, str]] = {}
    for row in kept:
        cells = lines.setdefault(tuple(_named(row.get(axis, ""), shown) for axis in down), {})
        found = (
            {name: show(row, layout, name, shown) for name in shown.measures or measures_of(kept)}
            if by_measure
            else {_named(row[shown.columns], shown): show(row, layout, "".join(shown.measures), shown)}
        )
        if cells.keys() & found.keys():
            raise InvalidArgument(f"several rows for one cell: {row}")
        cells |= found
    across = list(dict.fromkeys(name for cells in lines.values() for name in cells))
    header = [_named(name, shown) for name in (*down, *across)]
    return [header, *([*key, *(cells.get(name, "") for name in across)] for key, cells in lines.items())]


def _named(value: Any, shown: Pivot) -> str:
    return shown.names.get(str(value), str(value))


def markdown_table(lines: Sequence[Sequence[str]]) -> str:
    """Header and cells as Markdown."""
    header, *rows = lines
    return "".join("| " + " | ".join(cells) + " |\n" for cells in (header, ["---"] * len(header), *rows))
