# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri htk copy`` and ``hri htk list``."""

from __future__ import annotations

import os
from pathlib import Path

import click

from hri.cli.groups import FiniteRange
from hri.cli.htk.options import (
    Argument,
    References,
    all_arguments,
    files_to_read,
    load_configuration,
    recording_options,
)
from hri.cli.htk.standard import (
    HtkCommand,
    NumbersOption,
    only_format,
    refused_options,
    source_format_option,
    standard_options,
)
from hri.cli.output import OutputFile
from hri.core.display import count
from hri.core.errors import FormatError
from hri.core.files import make_folder
from hri.htk import (
    Label,
    MasterLabelFile,
    Source,
    Transcription,
    blocks_of,
    code_sources,
    header_of,
    list_parameters,
    observation_names,
)
from hri.media import kind_of_file


def _label_numbers(ctx: click.Context, param: click.Parameter, value: str | None) -> tuple[int, int] | None:
    """Of ``-n i [j]``."""
    if value is None:
        return None
    try:
        first, *rest = map(int, value.split())
    except ValueError:
        raise click.BadParameter("takes one whole number, or two") from None
    if len(rest) > 1 or first == 0:
        raise click.BadParameter("takes one whole number, or two; labels count from 1, from the end below 0")
    return first, rest[0] if rest else first


def _named_label(ctx: click.Context, param: click.Parameter, value: str | None) -> tuple[str, int] | None:
    """Of ``-x s [n]``."""
    if value is None:
        return None
    name, *rest = value.split()
    if not all(part.isdecimal() and int(part) > 0 for part in rest):
        raise click.BadParameter("takes a label, and perhaps which of its occurrences, from 1")
    return name, int(rest[0]) if rest else 1


@click.command(cls=HtkCommand)
@recording_options
@only_format("-O", "parameter files")
@only_format("-P", "label files")
@click.option("-s", "start", type=FiniteRange(0), default=0.0, metavar="T", help="Begin here, in 100 ns.")
@click.option(
    "-e",
    "end",
    type=FiniteRange(),
    default=0.0,
    metavar="T",
    help="End here, in 100 ns; 0 or below: so far before the end.",
)
@click.option(
    "-n",
    "numbers",
    cls=NumbersOption,
    most=2,
    callback=_label_numbers,
    metavar="I [J]",
    help="What label I, or I to J, spans.",
)
@click.option(
    "-x",
    "named",
    cls=NumbersOption,
    most=2,
    callback=_named_label,
    metavar="NAME [N]",
    help="What the Nth label of this name spans.",
)
@click.option("-m", "margin", type=FiniteRange(0), default=0.0, metavar="T", help="With -n and -x: so much around it.")
@click.option("-a", "level", type=click.IntRange(1), default=1, help="Which alternative of labels counts.")
@click.option(
    "-i", "master", type=OutputFile(), metavar="MLF", help="Write the labels of what was copied to this file."
)
@click.option(
    "-l",
    "label_target",
    metavar="DIR",
    help="Write them to label files in this folder; with -i: what stands before their names in FILE.",
)
@refused_options(t=("what is traced has no width", 1))
@click.argument("files", nargs=-1)
def copy(
    configs: tuple[str, ...],
    scripts: tuple[str, ...],
    masters: tuple[str, ...],
    label_folder: str | None,
    suffix: str,
    trace: int,
    start: float,
    end: float,
    numbers: tuple[int, int] | None,
    named: tuple[str, int] | None,
    margin: float,
    level: int,
    master: str | None,
    label_target: str | None,
    files: tuple[str, ...],
) -> None:
    """Convert recordings to parameter files, as HCopy; FILES are sources and targets: `a.wav a.mfc`.

    Several sources become one target: `a.wav + b.wav both.mfc`. With -s, -e, -n or -x a part is copied, and its labels
    with it where -i or -l asks for them. Where a configuration sets VQTABLE, SAVEASVQ and _V in TARGETKIND, codewords
    of the table are written.

    \b
    Example:
      hri htk copy -C config -S copy.scp
      hri htk copy -C config -x seven 2 -L labels all.wav seven.mfc
    """
    configuration = load_configuration(configs)
    pairs = _pairs(all_arguments(files, scripts))
    _require_targets_apart(pairs)
    if numbers is not None and named is not None:
        raise click.UsageError("either -n or -x")
    wants_labels = master is not None or label_target is not None
    references = References(masters, label_folder, suffix)
    entries = []
    for sources, target in pairs:
        parts, labels = [], []
        length = 0
        for source in sources:
            spans = numbers is not None or named is not None
            found: list[Label] = []
            where = source
            if spans or wants_labels:
                transcription, where = references.locate(source)
                num_found = count(len(transcription.alternatives), "alternative")
                if level > len(transcription.alternatives):
                    raise FormatError(f"{where}: has {num_found}, no number {level}")
                found = list(transcription.alternatives[level - 1])
            first, last = (start, end) if not spans else _span(found, where, numbers, named, margin)
            part = Source(source, first, last)
            parts.append(part)
            if wants_labels:
                duration = part.duration(configuration)
                labels += _moved(found, first, first + duration, length)
                length += duration
        file = code_sources(parts, configuration)
        make_folder(Path(target).parent)
        file.write(target)
        name = Path(target).with_suffix(f".{suffix}").name
        if label_target is not None and master is None:
            make_folder(Path(label_target))
            Transcription(labels).write(Path(label_target, name))
        entries.append((f"{label_target or '*'}/{name}", Transcription(labels)))
        if trace:
            click.echo(f"{' + '.join(sources)} -> {target}")
    if master is not None:
        make_folder(Path(master).parent)
        MasterLabelFile(entries).write(master)


def _pairs(names: list[Argument]) -> list[tuple[list[str], str]]:
    """Sources, which + joins, and the target of each."""
    pairs: list[tuple[list[str], str]] = []
    at = 0
    while at < len(names):
        sources: list[str] = [names[at]]
        names[at].require_file()
        while at + 2 < len(names) and names[at + 1] == "+":
            at += 2
            sources.append(names[at])
            names[at].require_file()
        if at + 1 >= len(names) or names[at + 1] == "+":
            raise click.UsageError(
                f"{names[at].place}{names[at]} has no target: files come in pairs of a source, or several with + "
                "between them, and a target"
            )
        pairs.append((sources, names[at + 1]))
        at += 2
    if not pairs:
        raise click.UsageError("files come in pairs of a source, or several with + between them, and a target")
    return pairs


def _require_targets_apart(pairs: list[tuple[list[str], str]]) -> None:
    """No target is a source, a recording that is there, or the target of another pair, as where one was forgotten."""
    read = {os.path.realpath(source) for sources, _ in pairs for source in sources}
    written = set()
    for _, target in pairs:
        place = os.path.realpath(target)
        if place in read:
            raise click.UsageError(f"{target} is a source, and would be written over")
        if place in written:
            raise click.UsageError(f"{target} is the target of two pairs")
        if kind_of_file(Path(target)) == "a sound file" and Path(target).exists():
            raise click.UsageError(
                f"{target} is a recording that is there, and would be written over; files come in pairs of a source "
                "and a target"
            )
        written.add(place)


def _span(
    labels: list[Label], where: str, numbers: tuple[int, int] | None, named: tuple[str, int] | None, margin: float
) -> tuple[float, float]:
    """The time that the labels of -n or -x take, with a margin, in 100 ns."""
    if named is not None:
        name, number = named
        wanted = [label for label in labels if label.name == name][number - 1 : number]
        if not wanted:
            raise FormatError(f"{where}: has no label {name!r} number {number}")
    else:
        assert numbers is not None
        first, last = (n - 1 if n > 0 else len(labels) + n for n in numbers)
        wanted = labels[first : last + 1] if 0 <= first <= last < len(labels) else []
        if not wanted:
            raise FormatError(
                f"{where}: has {count(len(labels), 'label')}, and not those from {numbers[0]} to {numbers[1]}"
            )
    begin, end = wanted[0].first, wanted[-1].last
    if begin is None or end is None:
        raise FormatError(f"{where}: line {wanted[0].line}: the label {wanted[0].name!r} has no times")
    if end + margin <= 0.0:  # which would mean the end of the recording
        raise FormatError(f"{where}: line {wanted[-1].line}: the label {wanted[-1].name!r} ends where it begins, at 0")
    return max(0.0, begin - margin), end + margin


def _moved(labels: list[Label], start: float, end: float, offset: int) -> list[Label]:
    """Labels that lie in a part, with times from its beginning on, and `offset`."""
    kept = []
    for label in labels:
        if label.first is None or label.last is None:
            kept.append(label)
        elif label.first < end and label.last > start:
            first, last = max(label.first - round(start), 0), round(min(label.last, end) - start)
            kept.append(Label(label.name, first + offset, last + offset, label.score, label.others))
    return kept


@click.command("list", cls=HtkCommand)
@standard_options("ACDSTV")
@source_format_option
@click.option("-h", "header", is_flag=True, help="Also what the header says.")
@click.option("-t", "target", is_flag=True, help="Also what that of the target of the configuration would say.")
@click.option("-o", "structure", is_flag=True, help="Also the names of the values of a frame.")
@click.option("-r", "raw", is_flag=True, help="Values alone, a frame a line.")
@click.option("-z", "no_values", is_flag=True, help="No frames.")
@click.option("-s", "first", type=click.IntRange(0), default=0, metavar="N", help="The first frame.")
@click.option("-e", "last", type=click.IntRange(-1), default=-1, metavar="N", help="The last frame.")
@click.option("-i", "items", type=click.IntRange(1), default=10, metavar="N", help="Values in a line.")
@click.option("-n", "streams", type=click.IntRange(1), default=1, help="1: frames have one stream.")
@refused_options(d=("there are no codebooks of HQuant", 0), p=("nothing is played", 0))
@click.argument("files", nargs=-1)
def list_files(
    configs: tuple[str, ...],
    scripts: tuple[str, ...],
    trace: int,
    header: bool,
    target: bool,
    structure: bool,
    raw: bool,
    no_values: bool,
    first: int,
    last: int,
    items: int,
    streams: int,
    files: tuple[str, ...],
) -> None:
    """Print parameter files, as HList; with a configuration, what they become by it.

    \b
    Example:
      hri htk list -h -e 9 seven.mfc
      hri htk list -C config -t -o -z seven.wav
    """
    if streams != 1:
        raise click.UsageError(f"-n {streams} is not supported: frames have one stream")
    configuration = load_configuration(configs)
    is_coded = configuration.source_format == "WAV" or configuration.target != "ANON"
    if target and not is_coded:
        raise click.UsageError("-t shows what a configuration makes of a file: name one with TARGETKIND with -C")
    if -1 < last < first:
        raise click.UsageError(f"-e {last} lies before -s {first}")
    names = files_to_read(files, scripts)
    if not names:
        raise click.UsageError("no files: name those to print, or with -S a file of their names")
    for name in names:
        # A file as it is is shown piece by piece.
        file = code_sources([Source(name)], configuration) if is_coded else name
        shown = file if configuration.source_format == "WAV" else name
        seen = header_of(file)
        if first >= seen.num_frames > 0:
            raise FormatError(f"{name}: has {count(seen.num_frames, 'frame')}, from 0 on, and none from {first} on")
        if header:
            for line in list_parameters(shown, name, header=True, values=False):
                click.echo(line)
        if target:
            for line in list_parameters(file, name, header=True, values=False, title="Target"):
                click.echo(line)
        if structure:
            click.echo(" ".join(observation_names(seen.kind, seen.num_columns)))
        if raw:
            for block in blocks_of(file, first, last):
                for row in block:
                    click.echo(" ".join(f"{value:e}" for value in row))
        elif not no_values:
            for line in list_parameters(file, name, first, last, header, items, header_lines=False):
                click.echo(line)
