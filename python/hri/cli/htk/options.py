# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Options that HTK's tools share, and the files that they name."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar

import click

from hri.cli.htk.standard import (
    INPUT,
    given_format,
    label_format_option,
    settings_are_shown,
    source_format_option,
    standard_options,
)
from hri.cli.messages import note
from hri.core.errors import FormatError
from hri.core.files import make_folder
from hri.htk import Configuration, MasterLabelFile, ModelSet, Transcription
from hri.htk.lists import script_rows

F = TypeVar("F", bound=Callable[..., Any])
_MASTER = "#!MLF!#"
models_option = click.option("-H", "macros", multiple=True, type=INPUT, metavar="MMF", help="A file of models.")
labels_option = click.option("-I", "masters", multiple=True, type=INPUT, metavar="MLF", help="A master label file.")
label_folder_option = click.option("-L", "label_folder", metavar="DIR", help="The folder of label files.")
label_suffix_option = click.option("-X", "suffix", default="lab", show_default=True, help="Suffix of label files.")


def stacked(*options: Callable[[Any], Any]) -> Callable[[F], F]:
    """One decorator of several options, in this order in the help."""

    def add(command: F) -> F:
        for option in reversed(options):
            command = option(command)
        return command

    return add


recording_options = stacked(
    standard_options("ACDSTV"),
    labels_option,
    label_folder_option,
    label_suffix_option,
    source_format_option,
    label_format_option,
)
"""Of tools that read recordings and their labels: configs, scripts, trace, masters, label_folder and suffix."""
listed_models_options = stacked(
    click.option("-d", "model_folder", metavar="DIR", help="Folder of models that no -H defines, a file for each."),
    click.option("-x", "model_suffix", metavar="EXT", help="Suffix of these files."),
)
"""Of tools that take a list of models."""
folder_option = click.option("-M", "folder", metavar="DIR", help="Where models go; over those that were read else.")
new_suffix_option = click.option(
    "-o", "new_suffix", metavar="EXT", help="Suffix of the files that models of -d are written to."
)
name_option = click.option(
    "-o", "name", metavar="NAME", help="Name of the model and its file; that of the prototype else."
)


def load_configuration(paths: Iterable[str], live: bool = False) -> Configuration:
    """What all configuration files set, the last one last, then ``-F``; keys that set nothing are named.

    With ``-D`` all settings are printed. With `live` it is of live sound.
    """
    configuration = Configuration(live)
    for path in paths:
        configuration.read(path)
    chosen = given_format()
    if chosen is not None:
        configuration.parse(f"SOURCEFORMAT = {chosen}", "-F")
    if settings_are_shown():
        click.echo("Configuration Parameters")
        for key, value in configuration.settings:
            click.echo(f"  {key:<16} {value}")
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
        self._names: set[str] = set()
        for path in paths:
            self.read(path)

    @property
    def paths(self) -> list[str]:
        """Of the files, in their order."""
        return [path for path, _, _ in self._parts]

    def add_prototype(self, given: str) -> tuple[str, str | None]:
        """The model of this name, which these files define or a file of this name does, and the path of that file.

        Raises
        ------
        FormatError
            Where neither defines it, and for a file that defines several models.
        """
        name = Path(given).name
        if self.has(name):
            return name, None
        if not Path(given).is_file():
            raise FormatError(f"{given}: there is no such file, and no -H defines the model {name!r}")
        above = set(self.models.hmm_names)
        self.read(given)
        defined = [model for model in self.models.hmm_names if model not in above]
        if len(defined) != 1:
            raise FormatError(f"{given}: defines {len(defined)} models, not one")
        return defined[0], given

    def add_listed(self, names: Iterable[str], folder: str | None, suffix: str | None = None) -> list[str]:
        """Read a file of `folder` for every model that is not defined yet; gives the paths.

        Raises
        ------
        FormatError
            For a model that is defined nowhere.
        """
        read = []
        for model in dict.fromkeys(names):
            if self.has(model):
                continue
            path = Path(folder or ".", model if suffix is None else f"{model}.{suffix}")
            if not path.is_file():
                raise FormatError(f"{path}: there is no such file, and no -H defines the model {model!r}")
            self.read(str(path))
            if not self.has(model):
                raise FormatError(f"{path}: does not define the model {model!r}")
            read.append(str(path))
        return read

    def follow(self, models: ModelSet) -> ModelSet:
        """`models`, which have macros that these files had not, in their order of files; writes go by it from now on.

        New macros come to the first file that defines a model, and stand before its models.

        Raises
        ------
        FormatError
            For definitions that would use what stands in a file behind theirs.
        """
        places = {}
        for number, (_, first, last) in enumerate(self._parts):
            places.update(dict.fromkeys(self.models.definitions[first:last], number))
        of_models = [number for (kind, _), number in places.items() if kind == "h"]
        new_place = min(of_models, default=0)
        numbers = [places.get(definition, new_place) for definition in models.definitions]
        order = sorted(range(len(numbers)), key=lambda i: numbers[i])
        models.reorder(order)
        counts = [numbers.count(number) for number in range(len(self._parts))]
        ends = [sum(counts[: number + 1]) for number in range(len(counts))]
        self._parts = [
            (path, end - count, end) for (path, _, _), count, end in zip(self._parts, counts, ends, strict=True)
        ]
        try:
            models.to_text()
        except FormatError as error:
            raise FormatError(
                f"the models cannot go to the files that they came from; name one with -w ({error})"
            ) from error
        self.models = models
        return models

    def read(self, path: str) -> None:
        """Add what a file defines."""
        first = self.models.num_definitions
        self.models.read(path)
        self._parts.append((path, first, self.models.num_definitions))
        self._names.update(self.models.hmm_names)

    def has(self, model: str) -> bool:
        """Whether the files define this model."""
        return model in self._names

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


class Argument(str):
    """An argument, and where it stands: "" on the command line, else script and line.

    Attributes
    ----------
    place : str
    """

    place: str = ""

    @classmethod
    def of_script(cls, text: str, script: str, line: int) -> Argument:
        """One of a script."""
        argument = cls(text)
        argument.place = f"{script}: line {line}: "
        return argument

    def require_file(self, path: str | None = None) -> None:
        """Raise FormatError where a script names a file, its own text or `path`, that is not there.

        One of the command line is not looked at: who reads it names it.
        """
        if self.place and not Path(path or self).exists():
            raise FormatError(f"{self.place}{path or self}: there is no such file")


def all_arguments(given: Sequence[str], scripts: Iterable[str]) -> list[Argument]:
    """The arguments of the command line, then those of the script files.

    Raises
    ------
    FormatError
        Also for a master label file in place of a script.
    """
    found = [Argument(text) for text in given]
    for script in scripts:
        for line, row in enumerate(script_rows(script), 1):
            if line == 1 and row[:1] == [_MASTER]:
                raise FormatError(f"{script}: is a master label file, which -I takes; -S takes a file of arguments")
            found += [Argument.of_script(text, script, line) for text in row]
    return found


def files_to_read(given: Sequence[str], scripts: Iterable[str]) -> list[Argument]:
    """`all_arguments` that are names of files to read; also raises FormatError where one in a script is not there."""
    found = all_arguments(given, scripts)
    for argument in found:
        argument.require_file()
    return found


def labelled_entries(master: MasterLabelFile, path: str) -> list[tuple[str, Transcription]]:
    """Patterns and transcriptions of a file, none of which may name a folder in place of labels.

    Raises
    ------
    FormatError
    """
    if master.folder_patterns:
        raise FormatError(f"{path}: {master.folder_patterns[0]!r} names a folder; labels have to stand here")
    return master.entries


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
        name = self.name_of(recording)
        path = Path(name)
        # Patterns are compared with the name as it is given; */a.lab also means a file in the current folder.
        names = dict.fromkeys((name, str(path), f"./{path}" if path.parent == Path() else str(path)))
        tried = []
        for source, master in self._masters.items():
            for found in next(filter(None, map(master.search, names)), []):
                if isinstance(found, Transcription):
                    return found, source
                places = _places(path, *found)
                for place in places:
                    if place.is_file():
                        return Transcription.read(place), str(place)
                tried.append(places[0])
        if tried and not path.is_file():
            raise FormatError(f"{tried[0]}: there is no such label file, where a master label file says that it is")
        if self._masters and not path.is_file():
            raise FormatError(f"{recording}: no master label file has a transcription for {str(path)!r}")
        return Transcription.read(path), str(path)

    def name_of(self, recording: str) -> str:
        """Of the label file of a recording, which need not exist."""
        head, separator, last = recording.rpartition("/")
        stem, dot, _ = last.rpartition(".")
        named = f"{stem if dot and stem else last}.{self._suffix}"
        return str(Path(self._folder, named)) if self._folder is not None else f"{head}{separator}{named}"


def _places(path: Path, folder: str, is_searched: bool) -> list[Path]:
    """Where a label file may be in a folder that a master label file names: perhaps below the last of its folders."""
    parts = [part for part in path.parts if part != path.anchor]
    depths = range(1, len(parts) + 1) if is_searched else range(1, 2)
    return [Path(folder, *parts[len(parts) - depth :]) for depth in depths]
