# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri train-units``."""

from __future__ import annotations

from collections.abc import Sequence

import click

from hri.cli.groups import CheckedCommand
from hri.cli.messages import note
from hri.cli.output import OutputFile, json_option, say, write_json
from hri.cli.progress import progress_bars
from hri.cli.recognizers import (
    load_dataset,
    model_to_write,
    naming_options,
    options_option,
    parse_options,
    pattern_option,
)
from hri.cli.train_checks import summary_of
from hri.core.display import count
from hri.core.errors import InvalidArgument
from hri.core.files import read_text
from hri.htk import Dictionary
from hri.media import read_audio
from hri.recognition import SubwordRecognizer
from hri.recognition.subword.recognizer import labels_without_entry

MODE = "units"
"""Under which name the model is kept per user."""


@click.command("train-units", cls=CheckedCommand)
@click.option(
    "--data",
    required=True,
    type=click.Path(exists=True, file_okay=False),
    help="Folder of recordings of one word each.",
)
@pattern_option
@click.option("--out", type=OutputFile(), metavar="MODEL", help="Model file; the default is kept per user.")
@click.option(
    "--language", default="en", show_default=True, help="Which language the words are of, as espeak-ng calls it."
)
@click.option(
    "--spelling",
    "spellings",
    multiple=True,
    metavar="LABEL=TEXT",
    help="How a word is written whose label is not; may be given several times.",
)
@click.option(
    "--dictionary",
    type=click.Path(exists=True, dir_okay=False),
    metavar="FILE",
    help="Pronunciations, a line a word, as HTK's dictionaries; lines that begin with ;;; are comments, as in that of "
    "CMU. Words that it has not are pronounced by espeak-ng.",
)
@options_option("units", "words.num_states=3")
@click.option("--seed", type=click.IntRange(0), default=0, show_default=True, help="Of everything random in training.")
@json_option
def train_units(
    data: str,
    pattern: str | None,
    out: str | None,
    language: str,
    spellings: tuple[str, ...],
    dictionary: str | None,
    options: tuple[str, ...],
    seed: int,
    json_path: str | None,
) -> None:
    """Train models of phones on recordings of words, to which words are added by their spelling.

    \b
    Examples:
      hri train-units --data spoken/ --out units.hri
      hri train-units --data spoken/ --language hi --spelling ghar=घर --out units.hri
      hri add-word --model units.hri --label dance --spelling dance
      hri recognise --speech-model units.hri dance.wav
    """
    fields = parse_options((f"words.seed={seed}", *options))
    with naming_options():
        recognizer = SubwordRecognizer(**fields)
    written = dict(_split(spelling) for spelling in spellings)
    lexicon = None if dictionary is None else _read_dictionary(dictionary)
    path = model_to_write(MODE, out)
    dataset = load_dataset(data, "speech", pattern)
    by_rule = [] if dictionary is None or lexicon is None else _not_in(lexicon, dictionary, dataset.labels)
    for label in written:
        if label not in dataset.labels:
            raise InvalidArgument(f"--spelling {label}: no recording has this label")
    path.parent.mkdir(parents=True, exist_ok=True)
    note(summary_of(dataset))
    clips = [read_audio(sample.path) for sample in dataset.samples]
    with progress_bars() as progress:
        recognizer.fit(
            clips,
            [sample.label for sample in dataset.samples],
            language=language,
            spellings=written,
            dictionary=lexicon,
            groups=[sample.person for sample in dataset.samples],
            progress=lambda done, total: progress("training", done, total),
        )
    recognizer.save(path)
    say(str(path), json_path)
    note(f"{count(len(recognizer.units), 'unit')}: {' '.join(recognizer.units)}")
    if by_rule:
        note(f"not in {dictionary}, pronounced by espeak-ng: {' '.join(by_rule)}")
    write_json(json_path, {"model": str(path), "labels": dataset.labels, "units": list(recognizer.units)})


def _read_dictionary(path: str) -> Dictionary:
    """HTK's dictionaries have no comments: lines of these become empty ones, so that errors name the right line."""
    lines = read_text(path).split("\n")
    return Dictionary.parse("\n".join("" if line.startswith(";;;") else line for line in lines), path)


def _not_in(lexicon: Dictionary, path: str, labels: Sequence[str]) -> list[str]:
    try:
        return labels_without_entry(labels, lexicon)
    except InvalidArgument as error:
        raise InvalidArgument(f"{path}: {error}") from error


def _split(spelling: str) -> tuple[str, str]:
    label, equals, text = spelling.partition("=")
    if not (label and equals and text):
        raise InvalidArgument(f"--spelling {spelling!r} is not LABEL=TEXT")
    return label, text
