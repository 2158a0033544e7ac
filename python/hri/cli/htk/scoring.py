# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri htk results``."""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import click

from hri.cli.groups import FiniteRange
from hri.cli.htk.formatting import strip_contexts
from hri.cli.htk.options import (
    References,
    files_to_read,
    label_folder_option,
    label_suffix_option,
    labelled_entries,
    labels_option,
    load_configuration,
)
from hri.cli.htk.standard import INPUT, HtkCommand, label_format_option, refused_options, standard_options
from hri.core.errors import FormatError
from hri.core.files import read_text
from hri.htk import Label, MasterLabelFile, Results, Transcription, WordSpotting, compare, read_list
from hri.htk.results import HTK_COSTS, WIDTH, Confusions, aligned_lines, bar, nist_table, speaker_of
from hri.language.word_errors import NIST_COSTS

MASTER = "#!MLF!#"


@dataclass(frozen=True)
class _Labels:
    """How labels are compared: equal ones, those left out, and whether case and contexts count."""

    classes: dict[str, str]
    null: str
    ignore_case: bool
    strip: bool

    def one(self, name: str) -> str:
        plain = strip_contexts(name) if self.strip else name
        plain = plain.upper() if self.ignore_case else plain
        return self.classes.get(plain, plain)

    def words(self, labels: Iterable[Label]) -> list[str]:
        words = (self.one(label.name) for label in labels)
        return [word for word in words if word != self.null]


@click.command(cls=HtkCommand)
@standard_options("ACDSTV")
@labels_option
@label_folder_option
@label_suffix_option
@label_format_option
@click.option(
    "-a", "sentence_name", default="SENT", show_default=True, metavar="NAME", help="What sentences are called."
)
@click.option("-b", "word_name", default="WORD", show_default=True, metavar="NAME", help="What labels are called.")
@click.option("-c", "ignore_case", is_flag=True, help="Capital and small letters are the same.")
@click.option("-d", "best_of", type=click.IntRange(1), default=1, metavar="N", help="Count the best of N alternatives.")
@click.option("-e", "equal", nargs=2, multiple=True, metavar="S T", help="Label T counts as S; as ???: not at all.")
@click.option("-f", "by_file", is_flag=True, help="A line for each file, too.")
@click.option("-h", "nist_format", is_flag=True, help="A table as NIST's, in percent of words.")
@click.option("-k", "mask", metavar="MASK", help="By speakers: what % stand for in the name of a file; * any, ? one.")
@click.option("-m", "most_files", type=click.IntRange(1), metavar="N", help="The first N files alone.")
@click.option("-n", "nist", is_flag=True, help="Align at NIST's costs.")
@click.option("-p", "confusions", is_flag=True, help="A table of labels said and found.")
@click.option("-s", "strip", is_flag=True, help="Labels without their contexts: a-b+c is b.")
@click.option("-t", "aligned", is_flag=True, help="Sentences with errors, aligned.")
@click.option(
    "-u",
    "unit_hours",
    type=FiniteRange(0, min_open=True),
    default=1.0,
    show_default=True,
    metavar="HOURS",
    help="With -w: false alarms are counted in a unit of so many hours.",
)
@click.option("-w", "spotting", is_flag=True, help="Hits, false alarms and figures of merit of keywords, by times.")
@click.option("-z", "null", default="???", show_default=True, metavar="NAME", help="The label that is not counted.")
@refused_options(g=("labels found are in HTK's format", 1))
@click.argument("label_list", type=INPUT)
@click.argument("found", nargs=-1)
def results(
    configs: tuple[str, ...],
    masters: tuple[str, ...],
    label_folder: str | None,
    suffix: str,
    scripts: tuple[str, ...],
    trace: int,
    sentence_name: str,
    word_name: str,
    ignore_case: bool,
    best_of: int,
    equal: tuple[tuple[str, str], ...],
    by_file: bool,
    nist_format: bool,
    mask: str | None,
    most_files: int | None,
    nist: bool,
    confusions: bool,
    strip: bool,
    aligned: bool,
    unit_hours: float,
    spotting: bool,
    null: str,
    label_list: str,
    found: tuple[str, ...],
) -> None:
    """Count errors of recognised label files or MLFs, as HResults.

    LABEL_LIST names the labels of the table of -p, and the keywords of -w; a list of models does else.

    \b
    Example:
      hri htk results -I said.mlf list found.mlf
    """
    load_configuration(configs)
    names: list[str] = list(files_to_read(found, scripts))
    if not names:
        raise click.UsageError("there is no file of recognised labels")
    case = str.upper if ignore_case else str
    classes = {case(member): case(name) for name, member in equal}
    labels = _Labels(classes, case(null), ignore_case, strip)
    listed = list(read_list(label_list))
    known = {labels.one(name) for name in listed} | set(classes.values()) if confusions else None
    references = References(masters, label_folder, suffix)
    if spotting:
        _spot(_recognised(names), references, listed, unit_hours)
        return
    costs = NIST_COSTS if nist or nist_format else HTK_COSTS
    total, matrix = Results(), Confusions()
    of_speakers: dict[str, Results] = {}
    num_of_none = 0
    lines: list[str] = []
    for number, (name, source, transcription) in enumerate(_recognised(names)):
        if number == most_files:
            break
        reference, where = references.locate(name)
        _require_known([reference.labels], labels, known, where, label_list)
        alternatives = transcription.alternatives[:best_of]
        _require_known(alternatives, labels, known, source, label_list)
        said = labels.words(reference.labels)
        scored = [compare(said, labels.words(one), costs) for one in alternatives]
        errors, pairs = min(scored, key=lambda pair: pair[0].total)
        total.add(errors)
        matrix.add(pairs)
        if mask is not None:
            speaker = speaker_of(mask, name)
            num_of_none += speaker is None
            if speaker is not None:
                of_speakers.setdefault(speaker, Results()).add(errors)
        if by_file:
            one = Results()
            one.add(errors)
            lines.append(one.file_line(Path(name).name))
        if aligned and errors.total:
            lines += [f"Aligned transcription: {references.name_of(name)} vs {name}", *aligned_lines(pairs)]
    if by_file:
        lines.insert(0, bar("File Results"))
    if nist_format:
        lines += nist_table(of_speakers, total)
    else:
        if mask is not None:
            lines.append(bar("Speaker Results"))
            lines += [one.speaker_line(name) for name, one in of_speakers.items()]
        if by_file:
            click.echo(bar("Sentence Scores"))
        click.echo(bar("HTK Results Analysis", "="))
        click.echo(f"  Date: {time.asctime()}")
        for mark, paths in (("Ref", masters or (label_folder or ".",)), ("Rec", names)):
            for row, path in enumerate(paths):
                click.echo(f"  {mark if row == 0 else '   '} : {path}")
        lines += [bar("Overall Results"), *total.lines(word_name, sentence_name)]
    if confusions:
        lines += [bar("Confusion Matrix"), *matrix.lines()]
    lines += [] if nist_format else ["=" * WIDTH]
    if num_of_none:
        lines.append(f"** Speaker Pattern '{mask}' Failed {num_of_none} Times **")
    for line in lines:
        click.echo(line)


def _spot(
    recognised: Iterator[tuple[str, str, Transcription]],
    references: References,
    keywords: list[str],
    unit_hours: float,
) -> None:
    """Count keywords by their times; other labels are not looked at."""
    counted = WordSpotting(keywords)
    for name, source, transcription in recognised:
        reference, where = references.locate(name)
        for file, labels in ((where, reference.labels), (source, transcription.labels)):
            for label in labels:
                if label.first is None or label.last is None:
                    raise FormatError(f"{file}: line {label.line}: the label {label.name!r} has no times")
        for label in transcription.labels:
            if label.name in keywords and label.score is None:
                raise FormatError(f"{source}: line {label.line}: the keyword {label.name!r} has no score")
        counted.add(reference.labels, transcription.labels)
    for line in counted.lines(unit_hours):
        click.echo(line)


def _require_known(
    alternatives: Iterable[Iterable[Label]], labels: _Labels, known: set[str] | None, source: str, label_list: str
) -> None:
    """Of the labels of a table; None: any are."""
    if known is None:
        return
    for one in alternatives:
        for label in one:
            name = labels.one(label.name)
            if name not in known and name != labels.null:
                raise FormatError(f"{source}: line {label.line}: the list {label_list} does not have {label.name!r}")


def _recognised(names: list[str]) -> Iterator[tuple[str, str, Transcription]]:
    """The name of a recording's labels, the file that these stand in, and these, of label files and of MLFs."""
    for name in names:
        text = read_text(name)
        if text.startswith(MASTER):
            for pattern, transcription in labelled_entries(MasterLabelFile.parse(text, name), name):
                yield pattern, name, transcription
        else:
            yield name, name, Transcription.parse(text, name)
