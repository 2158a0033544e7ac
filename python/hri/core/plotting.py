# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Figures for plots: Matplotlib's own objects, without pyplot, so that nothing is shown or kept open by drawing.

Functions that plot return what they drew on, and leave showing and saving to the caller unless a path is given.
"""

from __future__ import annotations

import io
import logging
import os
import re
import warnings
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from hri.core.errors import IoError
from hri.core.files import write_bytes
from hri.core.optional import import_optional

_log = logging.getLogger(__name__)

_DEVANAGARI = re.compile("[\u0900-\u097f]")
_FAMILIES = (
    "Noto Sans Devanagari",
    "Lohit Devanagari",
    "Nirmala UI",
    "Mangal",
    "Kohinoor Devanagari",
    "Noto Serif Devanagari",
    "Gargi",
    "Nakula",
    "Sahadeva",
    "FreeSans",
    "FreeSerif",
)


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

    Text in Devanagari is set in a font that has it, where one is installed; a warning is logged where none is.

    Raises
    ------
    IoError
        For a suffix that Matplotlib does not write, or a place that cannot be written.
    """
    drawn = io.BytesIO()
    _choose_fonts(figure)
    try:
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", r"Glyph .* missing from")  # said in a line of our own
            figure.savefig(drawn, dpi=dpi, format=Path(path).suffix[1:].lower() or "png")
    except ValueError as error:
        raise IoError(f"{fspath(path)}: {error}") from error
    write_bytes(path, drawn.getvalue())


def _choose_fonts(figure: Any) -> None:
    """A font for Hindi, and characters in place of bytes that are no text, as in names of files."""
    from matplotlib.font_manager import fontManager
    from matplotlib.text import Text

    hindi = []
    for text in figure.findobj(Text):
        said = text.get_text()
        if any("\udc80" <= character <= "\udcff" for character in said):
            text.set_text(os.fsencode(said).decode("utf-8", "replace"))
        if _DEVANAGARI.search(said):
            hindi.append(text)
    if not hindi:
        return
    installed = {font.name for font in fontManager.ttflist}
    found = [family for family in _FAMILIES if family in installed]
    if not found:
        _log.warning("no font for Devanagari is installed, such as Debian's fonts-lohit-deva: plots show boxes")
    for text in hindi:
        text.set_fontfamily([*text.get_fontfamily(), *found[:1]])
