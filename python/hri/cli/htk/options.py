# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Options that HTK's tools share, and the files that they name."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import click

from hri.cli.messages import note
from hri.core.errors import FormatError
from hri.core.files import make_folder
from hri.htk import Configuration, MasterLabelFile, ModelSet, Transcription, read_script

INPUT = click.Path(exists=True, dir_okay=False)
config_option = click.option("-C", "configs", multiple=True, type=INPUT, metavar="CONFIG", help="A configuration file.")
script_option = click.option("-S", "scripts", multiple=True, type=INPUT, metavar="SCRIPT", help="A file of arguments.")
trace_option = click.option("-T", "trace", type=click.IntRange(0), default=0, metavar="N", help="1: say what is done.")
models_option = click.option("-H", "macros", multiple=True, type=INPUT, metavar="MMF", help="A file of models.")
labels_option = click.option("-I", "masters", multiple=True, type=INPUT, metavar="MLF", help="A master label file.")
label_folder_option = click.option("-L", "label_folder", metavar="DIR", help="The folder of label files.")
label_suffix_option = click.option("-X", "suffix", default="lab", show_default=True, help="Suffix of label files.")


def load_configuration(paths: Iterable[str]) -> Configuration:
    """What all configuration files set, the last one last; keys that set nothing are named."""
    configuration = Configuration()
    for path in paths:
        configuration.read(path)
    if configuration.ignored:
        note(f"set nothing here: {' '.join(sorted(set(configuration.ignored)))}")
    return configuration


def load_models(paths: Iterable[str]) -> ModelSet:
    """All definitions of the files."""
    models = ModelSet()
    for path in paths:
        models.read(path)
    return models


class ModelFiles:
    """Definitions of several files, each of which is written again with what it defines.

    Parameters
    ----------
    paths : iterable of path

    Attributes
    ----------
    models : ModelSet
        Of all files.
    """

    def __init__(self, paths: Iterable[str]) -> None:
        self.models = ModelSet()
        self._parts: list[tuple[str, int, int]] = []
        for path in paths:
            self.read(path)

    @property
    def paths(self) -> list[str]:
        """Of the files, in their order."""
        return [path for path, _, _ in self._parts]

    def read(self, path: str) -> None:
        """Add what a file defines."""
        first = self.models.num_definitions
        self.models.read(path)
        self._parts.append((path, first, self.models.num_definitions))

    def write(self, models: ModelSet, folder: str | None, renamed: Mapping[str, str] | None = None) -> list[Path]:
        """Write `models`, which have the same definitions, to files of the same names; gives these.

        Parameters
        ----------
        models : ModelSet
        folder : path or None
            Where the files go; None: where they were read.
        renamed : mapping or None
            Other names of files.

        Raises
        ------
        FormatError
            For files that would have the same name; nothing is written then.
        """
        targets = []
        for path, _, _ in self._parts:
            name = (renamed or {}).get(path, path)
            targets.append(Path(name) if folder is None else Path(folder, Path(name).name))
        for number, target in enumerate(targets):
            if target in targets[:number]:
                raise FormatError(f"{target}: two files of models would be written here")
        for target, (_, first, last) in zip(targets, self._parts, strict=True):
            make_folder(target.parent)
            models.write_part(target, first, last)
        return targets


def all_arguments(given: Sequence[str], scripts: Iterable[str]) -> list[str]:
    """The arguments of the command line, then those of the script files."""
    return [*given, *(argument for script in scripts for argument in read_script(script))]


class References:
    """Transcriptions by the names of recordings: of master label files, else of label files.

    Parameters
    ----------
    masters : iterable of path
    folder : path or None
        Of label files; None: where the recording is.
    suffix : str
        Of label files.
    """

    def __init__(self, masters: Iterable[str], folder: str | None, suffix: str) -> None:
        self._masters = {path: MasterLabelFile.read(path) for path in masters}
        self._folder = folder
        self._suffix = suffix

    def find(self, recording: str) -> Transcription:
        """Raises FormatError where there is none."""
        return self.locate(recording)[0]

    def locate(self, recording: str) -> tuple[Transcription, str]:
        """The same with the name of the file that it stands in."""
        path = Path(recording).with_suffix(f".{self._suffix}")
        if self._folder is not None:
            path = Path(self._folder, path.name)
        # A pattern such as */a.lab also means a file in the current folder.
        name = str(path) if path.parent != Path() else f"./{path}"
        for source, master in self._masters.items():
            found = master.find(name)
            if found is not None:
                return found, source
        if self._masters and not path.is_file():
            raise FormatError(f"{recording}: no master label file has a transcription for {str(path)!r}")
        return Transcription.read(path), str(path)
