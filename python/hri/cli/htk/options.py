# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Options that HTK's tools share, and the files that they name."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

import click

from hri.cli.messages import note
from hri.core.errors import FormatError
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
        self._masters = [MasterLabelFile.read(path) for path in masters]
        self._folder = folder
        self._suffix = suffix

    def find(self, recording: str) -> Transcription:
        """Raises FormatError where there is none."""
        path = Path(recording).with_suffix(f".{self._suffix}")
        if self._folder is not None:
            path = Path(self._folder, path.name)
        # A pattern such as */a.lab also means a file in the current folder.
        name = str(path) if path.parent != Path() else f"./{path}"
        for master in self._masters:
            found = master.find(name)
            if found is not None:
                return found
        if self._masters and not path.is_file():
            raise FormatError(f"{recording}: no master label file has a transcription for {str(path)!r}")
        return Transcription.read(path)
