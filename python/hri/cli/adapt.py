# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri adapt``."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import click

from hri.cli.groups import CheckedCommand
from hri.cli.messages import note
from hri.cli.output import OutputFile, json_option, say, write_json
from hri.cli.progress import progress_bars
from hri.cli.recognizers import embedding_option, kept_model, load_dataset, load_embedding, pattern_option
from hri.core.display import count
from hri.core.errors import InvalidArgument
from hri.media import read_audio
from hri.recognition import SpeakerAdapter, WordRecognizer

_file = click.Path(exists=True, dir_okay=False)


@click.command(cls=CheckedCommand)
@click.argument("files", type=_file, nargs=-1, metavar="[FILE]...")
@click.option("--model", type=_file, help="A model from 'hri train speech'; the default is the one kept per user.")
@embedding_option
@click.option("-o", "--out", required=True, type=OutputFile(), help="File of the adapted model.")
@click.option(
    "--label",
    help="The word in every FILE (supervised); without it, it is unsupervised, by what FILES are recognised as.",
)
@click.option("--data", type=click.Path(exists=True, file_okay=False), help="A folder of recordings with their labels.")
@click.option("--person", help="Adapt only to this person of the folder.")
@pattern_option
@json_option
def adapt(
    files: tuple[str, ...],
    model: str | None,
    embedding_path: str | None,
    out: str,
    label: str | None,
    data: str | None,
    person: str | None,
    pattern: str | None,
    json_path: str | None,
) -> None:
    """Adapt a model to a speaker, a microphone or a room, from recordings of single words.

    Prints the label of each recording, or what it was recognised as in its turn; learned from is only what is accepted
    once all have been heard. Five words already help, more so with labels; from five a label on, every word's own model
    is adapted too. The model given stays as it is.

    \b
    Examples:
      hri adapt --model words.hri -o asha.hri asha/*.wav
      hri adapt --model words.hri -o asha.hri --label seven asha/seven_*.wav
      hri adapt --model words.hri -o asha.hri --data spoken/ --person asha
    """
    if data is None and (person is not None or pattern is not None):
        raise click.UsageError("--person and --pattern go with --data")
    if data is not None and label is not None:
        raise click.UsageError("--label is for FILES; in a folder every recording has its own")
    if not files and data is None:
        raise click.UsageError("give recordings, or --data DIR")
    source = kept_model("speech") if model is None else Path(model)
    if Path(out).exists() and source.samefile(out):
        raise click.UsageError(f"--out: {out} is the model that is adapted, which stays as it is: name another file")
    words = [(Path(file), label) for file in files]
    if data is not None:
        dataset = load_dataset(data, "speech", pattern).select(persons=None if person is None else [person])
        words += [(sample.path, sample.label) for sample in dataset]
    recognizer = WordRecognizer.load(source, embedding=load_embedding(embedding_path))
    adapter = SpeakerAdapter(recognizer)
    with progress_bars() as progress:
        heard = []
        for done, (path, word) in enumerate(_heard(adapter, words)):
            heard.append((path, word))
            progress("recognising", done + 1, len(words))
    adapter.update()
    if adapter.num_learned == 0:
        raise InvalidArgument(
            "no recording has a word to learn from"
            if len(words) > 1
            else f"{words[0][0]}: there is no word to learn from"
        )
    Path(out).parent.mkdir(parents=True, exist_ok=True)
    adapter.recognizer.save(out)
    for path, word in heard:
        say(f"{word}\t{path}", json_path)
    counts = {"num_words": adapter.num_words, "num_learned": adapter.num_learned}
    note(f"learned from {adapter.num_learned} of {count(len(words), 'recording')}: {out}")
    write_json(json_path, {"model": out, **counts, "labels": {str(path): word for path, word in heard}})


def _heard(adapter: SpeakerAdapter, words: list[tuple[Path, str | None]]) -> Iterator[tuple[Path, str]]:
    """Every recording with its label, or else what it is recognised as."""
    for path, label in words:
        audio = read_audio(path)
        if label is not None:
            adapter.learn(audio, label)
            yield path, label
        else:
            yield path, adapter.recognise(audio).label
