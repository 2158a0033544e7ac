# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What the makers of synthetic data sets share: a folder per label, a manifest, and nothing lost that was there."""

from __future__ import annotations

import re
import shutil
import tempfile
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from os import PathLike
from pathlib import Path

from hri.core.errors import InvalidArgument, IoError
from hri.core.files import make_folder, read_text
from hri.datasets.dataset import Dataset
from hri.datasets.manifest import MANIFEST_NAME, Manifest, manifest_text, read_manifest, write_manifest

MADE_UP_PERSON = re.compile(r"(voice|signer)[0-9]+")
"""Names of the persons of synthetic data sets; any other is that of a real one."""


def make_corpus(
    directory: str | PathLike[str], manifest: Manifest, replace: bool, writers: Iterable[Callable[[Path], None]]
) -> Dataset:
    """Make every recording of a manifest that is marked synthetic, and the manifest; all of it or nothing.

    Parameters
    ----------
    directory : path-like
        Made if needed. It is empty, holds the data set of an equal manifest, which is made anew, or, with `replace`, a
        synthetic one by the same program, which gives way.
    manifest : Manifest
        With rows, and the name of the program in ``made_by``.
    replace : bool
    writers : iterable of callable
        For each row one that writes the recording to the path that it gets.

    Raises
    ------
    InvalidArgument
        For a label that cannot be the name of a folder, and a folder that holds anything else.
    IoError
        When a folder or a file cannot be written.
    """
    labels = dict.fromkeys(row.label for row in manifest.rows)
    for label in labels:
        if not label.strip() or label.startswith(".") or any(c in label for c in '/\\:*?"<>|\0'):
            raise InvalidArgument(f"label {label!r} cannot be the name of a folder")
    root = Path(directory)
    old = _giving_way(root, manifest, replace)
    with new_content(root, old) as folder:
        for label in labels:
            make_folder(folder / label)
        for row, write in zip(manifest.rows, writers, strict=True):
            write(folder / row.path)
        write_manifest(folder / MANIFEST_NAME, manifest)
    return Dataset.load(root)


def _giving_way(root: Path, manifest: Manifest, replace: bool) -> list[Path]:
    """The files in `root` in whose place new ones come; InvalidArgument where that would lose anything."""
    there = files_in(root)
    if not there:
        return []
    path = root / MANIFEST_NAME
    if not path.is_file():
        raise InvalidArgument(f"{root} is not empty, there is {there[0]}: choose another folder")
    old = read_manifest(path)
    made_by = manifest.made_by["program"]
    if not old.synthetic or old.made_by.get("program") != made_by:
        raise InvalidArgument(f"{root} holds a data set that {made_by} did not make: choose another folder")
    listed = {Path(MANIFEST_NAME), *(Path(row.path) for row in old.rows)}
    require_made_up(root, [row.person for row in old.rows], [one for one in there if one not in listed])
    if not replace and read_text(path) != manifest_text(manifest):
        raise InvalidArgument(to_replace(root))
    return there


def files_in(root: Path) -> list[Path]:
    """Files below a folder, relative to it; names that begin with "." are none of a data set."""
    found = (path.relative_to(root) for path in sorted(root.rglob("*")) if path.is_symlink() or not path.is_dir())
    return [path for path in found if not any(part.startswith(".") for part in path.parts)]


def require_made_up(root: Path, persons: Iterable[str], others: list[Path]) -> None:
    """InvalidArgument where a synthetic data set has recordings of people, or other files in its folder."""
    people = sorted({person for person in persons if not MADE_UP_PERSON.fullmatch(person)})
    if people or others:
        found = f"recordings by {people[0]!r}" if people else str(others[0])
        raise InvalidArgument(f"{root} holds more than synthetic data, {found}: choose another folder")


def to_replace(root: Path) -> str:
    """Why a synthetic data set stays, and what to do."""
    return (
        f"{root} holds synthetic data made with other options: choose another folder, or replace them by --replace, "
        "replace=True in Python"
    )


@contextmanager
def new_content(root: Path, old: Iterable[Path]) -> Iterator[Path]:
    """A folder to write into, whose files go to `root` in place of `old` ones once all are written."""
    is_new = not root.exists()
    make_folder(root)
    try:
        folder = Path(tempfile.mkdtemp(prefix=".hri_corpus_", dir=root))
    except OSError as error:
        raise IoError(f"{root}: {error.strerror}") from error
    try:
        yield folder
        try:
            _move(folder, root, list(old))
        except OSError as error:
            raise IoError(f"{error.filename}: {error.strerror}") from error
    finally:
        shutil.rmtree(folder, ignore_errors=True)
        if is_new and not any(root.iterdir()):
            root.rmdir()


def _move(folder: Path, root: Path, old: list[Path]) -> None:
    for path in old:
        (root / path).unlink()
    for path in {root / one.parent for one in old} - {root}:
        if not any(path.iterdir()):
            path.rmdir()
    # A manifest comes last, so that it lists nothing that is not there yet.
    for path in sorted(files_in(folder), key=lambda one: (one.suffix == ".toml", one)):
        (root / path).parent.mkdir(exist_ok=True)
        (folder / path).replace(root / path)
