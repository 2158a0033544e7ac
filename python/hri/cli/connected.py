# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri train-connected`` and ``hri transcribe``."""

from __future__ import annotations

from pathlib import Path

import click

from hri.cli.messages import note
from hri.cli.output import OutputFile, json_option, say, write_json
from hri.cli.progress import progress_bars
from hri.cli.recognizers import (
    default_model,
    load_dataset,
    naming_options,
    options_option,
    parse_options,
    pattern_option,
)
from hri.core.errors import InvalidArgument
from hri.language import NGramModel
from hri.media import read_audio
from hri.recognition import ConnectedWordRecognizer

MODE = "connected"
"""Under which name the model is kept per user."""


@click.command("train-connected")
@click.option(
    "--data",
    required=True,
    type=click.Path(exists=True, file_okay=False),
    help="Folder of recordings of one word each.",
)
@pattern_option
@click.option("--out", type=OutputFile(), metavar="MODEL", help="Model file; the default is kept per user.")
@options_option
@click.option(
    "--language",
    type=click.Path(exists=True, dir_okay=False),
    metavar="ARPA",
    help="A language model of order 1 or 2, which is kept with the model.",
)
@click.option("--seed", type=click.IntRange(0), default=0, show_default=True, help="Of everything random in training.")
@json_option
def train_connected(
    data: str,
    pattern: str | None,
    out: str | None,
    options: tuple[str, ...],
    language: str | None,
    seed: int,
    json_path: str | None,
) -> None:
    """Train a recogniser of connected words on a folder of isolated ones.

    \b
    Examples:
      hri train-connected --data spoken/
      hri train-connected --data spoken/ --language commands.arpa --out commands.hri
      hri train-connected --data spoken/ --option words.num_states=6 --option max_pause_ms=500
    """
    fields = parse_options((f"words.seed={seed}", *options))
    with naming_options():
        recognizer = ConnectedWordRecognizer(**fields)
    model = None if language is None else NGramModel.load(language)
    dataset = load_dataset(data, "speech", pattern)
    path = default_model(MODE) if out is None else Path(out)
    path.parent.mkdir(parents=True, exist_ok=True)
    clips = [read_audio(sample.path) for sample in dataset.samples]
    with progress_bars() as progress:
        recognizer.fit(
            clips,
            [sample.label for sample in dataset.samples],
            groups=[sample.person for sample in dataset.samples],
            progress=lambda done, total: progress("training", done, total),
        )
    if model is not None:
        recognizer.set_language(model)
    recognizer.save(path)
    say(str(path), json_path)
    note(f"{len(dataset)} recordings, {len(dataset.labels)} labels: {' '.join(dataset.labels)}")
    note(f"insertion penalty: {recognizer.insertion_penalty:g}")
    write_json(
        json_path,
        {"model": str(path), "labels": dataset.labels, "insertion_penalty": recognizer.insertion_penalty},
    )


@click.command()
@click.argument("files", nargs=-1, required=True, type=click.Path(exists=True, dir_okay=False), metavar="FILE...")
@click.option(
    "--model",
    type=click.Path(exists=True, dir_okay=False),
    metavar="MODEL",
    help="A model from 'hri train-connected'; the default is the one kept per user.",
)
@click.option("--words", type=click.IntRange(1, 1000), metavar="N", help="How many words there are, where it is known.")
@click.option("--times", is_flag=True, help="Print a line a word: its beginning and end in seconds, and the word.")
@json_option
def transcribe(
    files: tuple[str, ...], model: str | None, words: int | None, times: bool, json_path: str | None
) -> None:
    """Recognise several words in one recording; print them in a line for each file.

    \b
    Examples:
      hri transcribe number.wav
      hri transcribe number.wav --words 4
      hri transcribe monday.wav tuesday.wav --times --json -
    """
    path = Path(model) if model is not None else default_model(MODE)
    if not path.is_file():
        raise InvalidArgument("there is no model of connected words yet: run 'hri train-connected --data DIR'")
    recognizer = ConnectedWordRecognizer.load(path)
    found = {}
    for file in files:
        transcript = recognizer.recognise(file, num_words=words)
        found[file] = transcript.to_dict()
        if times:
            for word in transcript.words:
                say(f"{word.first_s:.3f}\t{word.last_s:.3f}\t{word.label}", json_path)
        else:
            say(transcript.text, json_path)
        if not transcript.complete:
            note(f"{file}: too short for {words} words")
        for text in transcript.notes:
            note(f"{file}: {text}")
    write_json(json_path, found)
