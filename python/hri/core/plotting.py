# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Figures for plots: Matplotlib's own objects, without pyplot, so that nothing is shown or kept open by drawing.

Functions that plot return what they drew on, and leave showing and saving to the caller unless a path is given.
"""

from __future__ import annotations

import io
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from hri.core.errors import IoError
from hri.core.files import write_bytes
from hri.core.optional import import_optional


def new_figure(size: tuple[float, float], purpose: str = "to draw plots") -> Any:
    """A `matplotlib.figure.Figure` of `size` inches (width, height).

    Raises
    ------
    ImportError
        Without Matplotlib; says how to install it.
    """
    figures = import_optional("matplotlib.figure", "plots", purpose)
    return figures.Figure(figsize=size, layout="constrained")


def new_axes(size: tuple[float, float], purpose: str = "to draw plots") -> Any:
    """The only `matplotlib.axes.Axes` of a new figure; errors as for `new_figure`."""
    return new_figure(size, purpose).subplots()


def save_figure(figure: Any, path: str | PathLike[str], dpi: int = 110) -> None:
    """Write `figure` in the format of the suffix; the file appears whole or not at all.

    Raises
    ------
    IoError
        For a suffix that Matplotlib does not write, or a place that cannot be written.
    """
    drawn = io.BytesIO()
    try:
        figure.savefig(drawn, dpi=dpi, format=Path(path).suffix[1:].lower() or "png")
    except ValueError as error:
        raise IoError(f"{fspath(path)}: {error}") from error
    write_bytes(path, drawn.getvalue())
