# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri htk results``."""

from __future__ import annotations

import time
from collections.abc import Iterator

import click

from hri.cli.groups import CheckedCommand
from hri.cli.htk.options import (
    INPUT,
    References,
    all_arguments,
    label_folder_option,
    label_suffix_option,
    labels_option,
    script_option,
)
from hri.core.errors import FormatError
from hri.core.files import read_text
from hri.htk import MasterLabelFile, Results, Transcription, compare, read_list
from hri.htk.results import HTK_COSTS, WIDTH, aligned_lines
from hri.language.word_errors import NIST_COSTS

MASTER = "#!MLF!#"
NULL_CLASS = "???"


@click.command(cls=CheckedCommand)
@labels_option
@label_folder_option
@label_suffix_option
@script_option
@click.option("-e", "equal", nargs=2, multiple=True, metavar="S T", help="Label T counts as S; as ???: not at all.")
@click.option("-f", "by_file", is_flag=True, help="A line for each file, too.")
@click.option("-t", "aligned", is_flag=True, help="Sentences with errors, aligned.")
@click.option("-n", "nist", is_flag=True, help="Align at NIST's costs.")
@click.argument("label_list", type=INPUT)
@click.argument("found", nargs=-1)
def results(
    masters: tuple[str, ...],
    label_folder: str | None,
    suffix: str,
    scripts: tuple[str, ...],
    equal: tuple[tuple[str, str], ...],
    by_file: bool,
    aligned: bool,
    nist: bool,
    label_list: str,
    found: tuple[str, ...],
) -> None:
    """Count errors of recognised label files or MLFs, as HResults; LABEL_LIST names all labels.

    \b
    Example:
      hri htk results -I said.mlf list found.mlf
    """
    names = all_arguments(found, scripts)
    if not names:
        raise click.UsageError("there is no file of recognised labels")
    known = set(read_list(label_list)) | {name for pair in equal for name in pair}
    references = References(masters, label_folder, suffix)
    classes = {member: name for name, member in equal}
    costs = NIST_COSTS if nist else HTK_COSTS
    total = Results()
    lines = []
    for name, transcription in _recognised(names):
        said = _words(references.find(name), classes)
        for word in said:
            if word not in known:
                raise FormatError(f"{label_list}: does not have {word!r}, a label of the reference of {name}")
        errors, pairs = compare(said, _words(transcription, classes), costs)
        total.add(errors)
        if aligned and errors.total:
            lines += [f"Aligned transcription: {name}", *aligned_lines(pairs)]
        if by_file:
            one = Results()
            one.add(errors)
            lines.append(one.file_line(name))
    click.echo(" HTK Results Analysis ".center(WIDTH, "="))
    click.echo(f"  Date: {time.asctime()}")
    for mark, paths in (("Ref", masters or (label_folder or ".",)), ("Rec", names)):
        for row, path in enumerate(paths):
            click.echo(f"  {mark if row == 0 else '   '} : {path}")
    for line in lines:
        click.echo(line)
    click.echo(" Overall Results ".center(WIDTH, "-"))
    for line in total.lines():
        click.echo(line)
    click.echo("=" * WIDTH)


def _recognised(names: list[str]) -> Iterator[tuple[str, Transcription]]:
    """Pairs of the name of a recording's labels and these, of label files and of what MLFs hold."""
    for name in names:
        text = read_text(name)
        if text.startswith(MASTER):
            yield from MasterLabelFile.parse(text, name).entries
        else:
            yield name, Transcription.parse(text, name)


def _words(transcription: Transcription, classes: dict[str, str]) -> list[str]:
    words = (classes.get(label.name, label.name) for label in transcription.labels)
    return [word for word in words if word != NULL_CLASS]
