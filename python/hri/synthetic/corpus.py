# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What the makers of synthetic data sets share: a folder per label, a manifest written last."""

from __future__ import annotations

from collections.abc import Iterable
from os import PathLike
from pathlib import Path
from typing import Any

from hri.core.errors import InvalidArgument, IoError
from hri.datasets.dataset import Dataset
from hri.datasets.manifest import MANIFEST_NAME, Manifest, SampleRow, write_manifest


def start_corpus(directory: str | PathLike[str], labels: Iterable[str]) -> Path:
    """Make the folders; a manifest of an earlier run is removed first, so that none ever lies.

    Raises
    ------
    InvalidArgument
        For a label that cannot be the name of a folder.
    IoError
        When a folder cannot be made.
    """
    root = Path(directory)
    names = list(labels)
    for label in names:
        if not label.strip() or label.startswith(".") or any(c in label for c in '/\\:*?"<>|\0'):
            raise InvalidArgument(f"label {label!r} cannot be the name of a folder")
    try:
        root.mkdir(parents=True, exist_ok=True)
        (root / MANIFEST_NAME).unlink(missing_ok=True)
        for label in names:
            (root / label).mkdir(exist_ok=True)
    except OSError as error:
        raise IoError(f"{error.filename}: {error.strerror}") from error
    return root


def finish_corpus(
    root: Path,
    kind: str,
    name: str,
    description: str,
    made_by: dict[str, Any],
    rows: list[SampleRow],
) -> Dataset:
    """Write the manifest, marked synthetic, and load the data set."""
    manifest = Manifest(
        kind=kind,
        name=name,
        description=description,
        synthetic=True,
        made_by=made_by,
        rows=rows,
    )
    write_manifest(root / MANIFEST_NAME, manifest)
    return Dataset.load(root)
