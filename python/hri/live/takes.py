# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Recordings of one person that a data set is to hold: which are missing, and how one is added."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from pathlib import Path

from hri.core.errors import InvalidArgument, IoError
from hri.core.text import is_printable
from hri.datasets import Pattern
from hri.datasets.detection import SUFFIXES, is_noise, media_files
from hri.datasets.manifest import MANIFEST_NAME, Manifest, read_manifest, write_manifest
from hri.live import events
from hri.live.events import Event
from hri.recognition.decision import NO_INPUT, UNKNOWN

_BAD_IN_NAMES = set('/\\:*?"<>|')


class Takes:
    """The recordings of some labels by one person in a folder.

    Parameters
    ----------
    folder : path-like
        Made with the first recording. A manifest in it must have the pattern; without one, all recordings in it must
        fit the pattern: the manifest that is written then would hide the others.
    labels : sequence of str
        In the order of the prompts.
    person : str
        No "_" in it, which ends the person in a file's name.
    takes : int
        Recordings of every label.
    kind : "speech" or "gesture"
    pattern : str
        Of paths, with label, person and take.

    Raises
    ------
    InvalidArgument
        For labels or a person that cannot be names of files, labels that are there twice or reserved ("unknown",
        "no_input"), takes below 1, or a folder that holds another kind of data set.
    """

    def __init__(
        self, folder: str | os.PathLike[str], labels: Sequence[str], person: str, takes: int, kind: str, pattern: str
    ) -> None:
        if takes < 1:
            raise InvalidArgument(f"takes must be at least 1, got {takes}")
        if not labels:
            raise InvalidArgument("labels: there is none to record")
        for label in labels:
            _require_name("label", label)
            if label in (UNKNOWN, NO_INPUT):
                raise InvalidArgument(f"label '{label}' is reserved for decisions")
            if list(labels).count(label) > 1:
                raise InvalidArgument(f"label '{label}' is there twice")
        _require_name("person", person)
        if "_" in person:
            raise InvalidArgument(f"person '{person}' has a '_', which ends the person in the name of a file")
        self.folder = Path(folder)
        self._labels = list(labels)
        self._person = person
        self._takes = takes
        self._kind = kind
        self._pattern = pattern
        self._require_fitting_manifest()

    def __len__(self) -> int:
        return self._takes * len(self._labels)

    def missing(self) -> list[tuple[str, int]]:
        """Label and take of every missing recording: every label once, then every label again."""
        wanted = [(label, take) for take in range(1, self._takes + 1) for label in self._labels]
        return [place for place in wanted if not self.path(*place).exists()]

    def path(self, label: str, take: int) -> Path:
        """The path of a recording."""
        return self.folder / self._pattern.format(label=label, person=self._person, take=take)

    def prompt(self, time_s: float, missing: Sequence[tuple[str, int]]) -> Event:
        """The prompt for the first of the missing ones."""
        label, take = missing[0]
        done = len(self) - len(missing)
        fields = {"label": label, "take": take, "done": done, "total": len(self)}
        return Event(time_s, events.PROMPT, fields, mode=self._kind)

    def begin(self) -> None:
        """Make folder and manifest if they are not there. Raises IoError."""
        manifest = self.folder / MANIFEST_NAME
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise IoError(f"{self.folder}: {error.strerror or error}") from error
        if not manifest.exists():
            name = self.folder.absolute().name
            write_manifest(manifest, Manifest(self._kind, name=name, pattern=self._pattern))

    def keep(self, label: str, take: int, write: Callable[[Path], None]) -> Path:
        """Add a recording whole or not at all, and never over another one; `write` makes the file. Raises IoError."""
        path = self.path(label, take)
        part = path.with_name(f".{path.name}")
        try:
            path.parent.mkdir(exist_ok=True)
            write(part)
            os.link(part, path)  # which, other than renaming, replaces nothing
        except IoError:
            raise
        except OSError as error:
            raise IoError(f"{path}: {error.strerror or error}") from error
        finally:
            part.unlink(missing_ok=True)
        return path

    def _require_fitting_manifest(self) -> None:
        manifest = self.folder / MANIFEST_NAME
        if not manifest.exists():
            self._require_fitting_files()
            return
        found = read_manifest(manifest)
        if found.synthetic:
            raise InvalidArgument(f"{self.folder} holds synthetic recordings: record people into another folder")
        if (found.kind, found.pattern) != (self._kind, self._pattern):
            raise InvalidArgument(
                f"{self.folder} holds another data set: {manifest} has not pattern '{self._pattern}' for {self._kind}"
            )
        for label in self._labels if found.labels else ():
            if label not in found.labels:
                raise InvalidArgument(f"label '{label}' is not among the labels of {manifest}")

    def _require_fitting_files(self) -> None:
        """Without a manifest."""
        pattern = Pattern(self._pattern)
        for kind in SUFFIXES:
            for path in media_files(self.folder, kind):
                name = path.relative_to(self.folder).as_posix()
                fits = kind == self._kind and pattern.match(name) is not None
                if not fits and not is_noise(self.folder, path):
                    raise InvalidArgument(
                        f"{self.folder} holds recordings that are not '{self._pattern}' for {self._kind}, such as "
                        f"{name}: record into another folder"
                    )


def _require_name(what: str, text: str) -> None:
    """A name that files may have on every system, and that is read back as it was written."""
    if not text or text != text.strip() or text.startswith(".") or text.endswith("."):
        raise InvalidArgument(f"{what} '{text}' cannot be the name of a file")
    for character in text:
        if character in _BAD_IN_NAMES or not (character.isprintable() or is_printable(text)):
            raise InvalidArgument(f"{what} '{text}' cannot be the name of a file: {character!r} is in it")
