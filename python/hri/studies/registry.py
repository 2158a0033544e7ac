# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Named studies: every measured claim of the project is one of them, and anyone can repeat it."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from hri.errors import InvalidArgument

Progress = Callable[[str, int, int], None]
"""Called with (what is being done, steps done, steps in all)."""


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
        target was met.
    """

    name: str
    summary: str
    data: tuple[str, ...]
    target: str
    run: Callable[[Path, Progress], dict[str, Any]]


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


def run_study(study: Study, directory: str | os.PathLike[str] | None, progress: Progress) -> dict[str, Any]:
    """Run `study` on the recordings in `directory`; the result also names the study, its target and its seed."""
    data_dir = find_data(directory)
    missing = [name for name in study.data if not (data_dir / name).exists()]
    if missing:
        raise InvalidArgument(f"study {study.name}: {data_dir} has no folder {', '.join(missing)}")
    return {"study": study.name, "target": study.target, **study.run(data_dir, progress)}
