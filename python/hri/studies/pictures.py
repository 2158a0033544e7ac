# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Results of studies as pictures."""

from __future__ import annotations

from os import PathLike
from typing import Any

import numpy as np

from hri.core.plotting import new_axes, new_figure, save_figure
from hri.studies.registry import Layout
from hri.studies.rendering import result_rows
from hri.studies.tables import Row, axes_of


def draw(result: Row, layout: Layout, path: str | PathLike[str] | None = None) -> Any:
    """Draw a result: lines over `Layout.x`, or bars; bars of error are the spread over the persons held out.

    A result with ``"curves"``, shares or rates over shares by name, gets those drawn; one with ``"points"``, planes of
    points by feature and class, gets them and the distances in its rows. A `path` also writes the picture (PNG, SVG or
    PDF by suffix).

    Returns
    -------
    ndarray of matplotlib.axes.Axes

    Raises
    ------
    ImportError
        Without matplotlib; says how to install it.
    """
    if "curves" in result:
        drawn = np.asarray([new_axes((5.0, 4.6), "to draw studies")])
        _curves(drawn[0], result["curves"])
    elif "points" in result:
        drawn = _points(new_figure((3.2 * len(result["points"]), 9.0), "to draw studies"), result)
    else:
        drawn = _panels(result, layout)
    figure = drawn.flat[0].figure
    figure.suptitle(str(result["study"]))
    if path is not None:
        save_figure(figure, path, dpi=90 if "points" in result else 110)
    return drawn


def _panels(result: Row, layout: Layout) -> Any:
    rows = [row for row in result_rows(result, layout) if row.get(f"{layout.measure}_mean") is not None]
    panels = list(dict.fromkeys(row.get(layout.panel, "") for row in rows)) or [""]
    wide = 4.6 if layout.x else 2.5 + 0.28 * max(1, len(rows) // len(panels))
    figure = new_figure((max(4.6, min(wide, 14.0)) * len(panels), 4.2), "to draw studies")
    every = figure.subplots(1, len(panels), squeeze=False, sharey=True)[0]
    for axes, panel in zip(every, panels, strict=True):
        members = [row for row in rows if row.get(layout.panel, "") == panel]
        (_lines if layout.x else _bars)(axes, members, layout)
        axes.set_title(str(panel))
        axes.grid(alpha=0.3)
    every[0].set_ylabel(f"{layout.measure}{', %' if layout.percent else ''}")
    return every


def _curves(axes: Any, curves: Row) -> None:
    rates = bool(curves.get("rates"))  # of the vertical axis: from none to thousands
    for name, line in curves["lines"].items():
        marker = "" if rates else "o"
        axes.plot([100 * v for v in line["x"]], [v if rates else 100 * v for v in line["y"]], marker=marker, label=name)
    axes.set_xlabel(f"{curves['x']}, %")
    axes.set_ylabel(curves["y"] if rates else f"{curves['y']}, %")
    axes.set_xlim(left=0)
    if rates:
        axes.set_yscale("symlog", linthresh=1.0)
    axes.set_ylim(bottom=0)
    axes.grid(alpha=0.3)
    axes.legend(fontsize="small")


def _points(figure: Any, result: Row) -> Any:
    """A column for each feature: its planes, and below them the distances within and between classes."""
    num_planes = max(len(planes) for planes in result["points"].values())
    every = figure.subplots(num_planes + 1, len(result["points"]), squeeze=False)
    for column, (name, planes) in enumerate(result["points"].items()):
        for axes, (plane, classes) in zip(every[:, column], planes.items(), strict=False):
            for label, points in classes.items():
                axes.plot(*zip(*points, strict=True), ".", markersize=3, alpha=0.6, label=label)
            axes.set(title=f"{name}: {plane}", xlim=(-3.5, 3.5), ylim=(-3.5, 3.5))
        for axes in every[len(planes) : -1, column]:
            axes.set_axis_off()
        rows = [row for row in result["rows"] if row["features"] == name]
        for shift, measure in ((-0.2, "within"), (0.2, "between")):
            means = [row[f"{measure}_mean"] for row in rows]
            spreads = [row[f"{measure}_std"] for row in rows]
            places = np.arange(len(rows)) + shift
            every[-1, column].bar(places, means, 0.4, yerr=spreads, capsize=2, label=measure)
        every[-1, column].set_xticks(range(len(rows)), [row["sign"] for row in rows])
        every[-1, column].set(xlabel="sign", ylim=(0, None))
    every[0, 0].legend(fontsize="x-small", ncols=2)
    every[-1, 0].set_ylabel("distance")
    every[-1, 0].legend(fontsize="x-small")
    return every


def _values(rows: list[Row], layout: Layout) -> tuple[list[float], list[float]]:
    scale = 100.0 if layout.percent else 1.0
    means = [scale * row[f"{layout.measure}_mean"] for row in rows]
    return means, [scale * (row.get(f"{layout.measure}_std") or 0.0) for row in rows]


def _name(row: Row, keys: list[str]) -> str:
    return ", ".join(str(row[key]) for key in keys if row.get(key, "") != "")


def _lines(axes: Any, rows: list[Row], layout: Layout) -> None:
    keys = [axis for axis in axes_of(rows) if axis not in (layout.x, layout.panel)]
    places = list(dict.fromkeys(row[layout.x] for row in rows))
    numbers = all(isinstance(place, int | float) for place in places)
    series: dict[str, list[Row]] = {}
    for row in rows:
        series.setdefault(_name(row, keys), []).append(row)
    for name, members in series.items():
        means, spreads = _values(members, layout)
        x = [row[layout.x] if numbers else places.index(row[layout.x]) for row in members]
        axes.errorbar(x, means, spreads, label=name, marker="o", capsize=2, linewidth=1.2, alpha=0.85)
    if not numbers:
        axes.set_xticks(range(len(places)), [str(place) for place in places], rotation=20)
    axes.set_xlabel(layout.x.replace("_", " "))
    if any(series):
        axes.legend(fontsize="x-small")


def _bars(axes: Any, rows: list[Row], layout: Layout) -> None:
    keys = [axis for axis in axes_of(rows) if axis != layout.panel]
    means, spreads = _values(rows, layout)
    axes.bar(range(len(rows)), means, yerr=spreads, capsize=2, color="steelblue")
    axes.set_xticks(range(len(rows)), [_name(row, keys) for row in rows], rotation=75, ha="right", fontsize="x-small")
