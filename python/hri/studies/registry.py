# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Named studies: every measured claim of the project is one of them, and anyone can repeat it."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from hri.core.errors import InvalidArgument

Progress = Callable[[str, int, int], None]
"""Called with (what is being done, steps done, steps in all)."""


WORD_SOURCES = (
    "cpp/signal",
    "cpp/features/speech",
    "cpp/models/...",
    "cpp/recognition",
    "cpp/recognition/word",
)
"""The rooms that the recognition of words depends on; see `Study.sources`."""
GESTURE_SOURCES = (
    "cpp/signal",
    "cpp/features/hand",
    "cpp/models/...",
    "cpp/recognition",
    "cpp/recognition/gesture",
    "cpp/vision",
)
"""Those that the recognition of gestures depends on."""


def within(progress: Progress, name: str) -> Progress:
    """Progress of a part of a study, reported with its name."""
    return lambda what, done, total: progress(f"{name}: {what}", done, total)


@dataclass(frozen=True)
class Layout:
    """How the rows of a result are shown.

    A result's ``"rows"`` are dicts: what was varied, and what was measured as ``{measure}_mean``, ``{measure}_std``.

    Attributes
    ----------
    columns : str
        What is varied along the columns of the table; "" puts every row of the result into a row of the table.
    x : str
        What is varied along the picture's horizontal axis, such as an SNR; "" draws bars.
    panel : str
        What is varied from panel to panel; "" draws one panel.
    measure : str
        What was measured.
    percent : bool
        Whether that is a share, shown in percent.
    """

    columns: str = ""
    x: str = ""
    panel: str = ""
    measure: str = "accuracy"
    percent: bool = True


@dataclass(frozen=True)
class Study:
    """One measured claim.

    Attributes
    ----------
    name : str
        As typed after ``hri study``.
    summary : str
        What is measured, in one line.
    data : tuple of str
        Sub-folders of the data directory that it reads.
    target : str
        What it should show, in words.
    run : callable
        ``run(data_dir, progress)`` gives a dict that can be written as JSON; its ``"passed"`` says whether the
        target was met, None where there is none to meet. With `axes`, also ``run(data_dir, progress, **chosen)``.
    layout : Layout
        How tables and pictures show it.
    axes : mapping of str to sequence of str
        What of it can be run alone: ``chosen`` gives some of the values of some axes.
    thins : bool
        Whether ``run(..., takes=N)`` takes the first N recordings of every word by every person, to be done sooner.
    sources : tuple of str
        Rooms of the source tree that the result depends on, see `hri.studies.provenance`; the study's own file is one
        without being named.
    folds : bool
        Whether ``run(..., folds=N)`` runs the first N folds only.
    quick : mapping of str to sequence of str
        Values of `axes` that suffice to check that a kept result still holds.
    """

    name: str
    summary: str
    data: tuple[str, ...]
    target: str
    run: Callable[..., dict[str, Any]]
    layout: Layout = Layout()
    axes: Mapping[str, Sequence[str]] = field(default_factory=dict)
    thins: bool = False
    sources: tuple[str, ...] = ()
    folds: bool = False
    quick: Mapping[str, Sequence[str]] = field(default_factory=dict)


def find_data(directory: str | os.PathLike[str] | None = None) -> Path:
    """The folder with the recordings: `directory`, or what the environment variable ``HRI_DATA`` names.

    Raises
    ------
    InvalidArgument
        When neither is given, or it is not a folder.
    """
    given = directory if directory is not None else os.environ.get("HRI_DATA")
    if not given:
        raise InvalidArgument("no data folder: give --data DIR or set HRI_DATA")
    path = Path(given)
    if not path.is_dir():
        raise InvalidArgument(f"data folder {path} does not exist")
    return path


def run_study(
    study: Study,
    directory: str | os.PathLike[str] | None,
    progress: Progress,
    only: Mapping[str, Sequence[str]] | None = None,
    takes: int | None = None,
    folds: int | None = None,
) -> dict[str, Any]:
    """Run `study` on the recordings in `directory`; the result also names the study and its target.

    Parameters
    ----------
    study : Study
    directory : path-like, optional
        See `find_data`.
    progress : callable
        Called with (what, done, total).
    only : mapping of str to sequence of str, optional
        Run only these values of these axes of the study.
    takes : int, optional
        Only the first recordings of every word by every person; the result says so.
    folds : int, optional
        Only the first folds.

    Raises
    ------
    InvalidArgument
        For missing data, an axis or value that the study does not have (lists those it has), `takes` for a study that
        needs all recordings, or `folds` for a study without folds.
    """
    chosen: dict[str, Any] = {axis: _chosen(study, axis, values) for axis, values in (only or {}).items()}
    if takes is not None:
        if not study.thins:
            raise InvalidArgument(f"study {study.name} needs all recordings: it takes no takes")
        if takes < 1:
            raise InvalidArgument(f"takes is {takes}, must be at least 1")
        chosen["takes"] = takes
    if folds is not None:
        if not study.folds:
            raise InvalidArgument(f"study {study.name} has no folds to choose from")
        if folds < 1:
            raise InvalidArgument(f"folds is {folds}, must be at least 1")
        chosen["folds"] = folds
    data_dir = find_data(directory)
    missing = [name for name in study.data if not (data_dir / name).exists()]
    if missing:
        raise InvalidArgument(f"study {study.name}: {data_dir} has no folder {', '.join(missing)}")
    found = study.run(data_dir, progress, **chosen)
    thinned = {} if takes is None else {"takes": takes}
    return {"study": study.name, "target": study.target, **thinned, **found}


def _chosen(study: Study, axis: str, values: Sequence[str]) -> tuple[str, ...]:
    if axis not in study.axes:
        there = ", ".join(study.axes) or "none"
        raise InvalidArgument(f"study {study.name} has no axis '{axis}'; there are: {there}")
    for value in values:
        if value not in study.axes[axis]:
            raise InvalidArgument(f"axis {axis} has no '{value}'; there are: {', '.join(study.axes[axis])}")
    return tuple(values)
