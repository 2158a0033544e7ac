# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri adapt``."""

from __future__ import annotations

from pathlib import Path

import click

from hri.cli.output import json_option, say, write_json
from hri.cli.progress import progress_bars
from hri.cli.recognizers import default_model
from hri.media import read_audio
from hri.recognition import SpeakerAdapter, WordRecognizer

_file = click.Path(exists=True, dir_okay=False)


@click.command()
@click.argument("files", type=_file, nargs=-1, required=True)
@click.option("--model", type=_file, help="A model from 'hri train speech'; the default is the one kept per user.")
@click.option("-o", "--output", required=True, type=click.Path(dir_okay=False), help="Where the adapted model goes.")
@click.option("--label", help="What is said in every FILE; without it, FILES are learned as what they are heard as.")
@json_option
def adapt(files: tuple[str, ...], model: str | None, output: str, label: str | None, json_path: str | None) -> None:
    """Let a model get used to a speaker, a microphone or a room, from recordings of single words.

    Prints what each recording was heard as before it was learned from. Five words already help; from five a label on,
    every word's own model is adapted too. The model given stays as it is.

    \b
    Examples:
      hri adapt --model words.hri -o asha.hri asha/*.wav
      hri adapt --model words.hri -o asha.hri --label seven asha/seven_*.wav
    """
    adapter = SpeakerAdapter(WordRecognizer.load(model or default_model("speech")))
    heard = []
    with progress_bars() as progress:
        for done, path in enumerate(files):
            audio = read_audio(path)
            if label is None:
                heard.append(adapter.recognise(audio.samples, audio.sample_rate_hz).label)
            else:
                adapter.learn(audio.samples, audio.sample_rate_hz, label)
                heard.append(label)
            progress("listening", done + 1, len(files))
    adapter.update()
    Path(output).parent.mkdir(parents=True, exist_ok=True)
    adapter.recognizer.save(output)
    for path, word in zip(files, heard, strict=True):
        say(f"{word}\t{path}", json_path)
    counts = {"num_words": adapter.num_words, "num_learned": adapter.num_learned}
    click.echo(f"learned from {adapter.num_learned} of {adapter.num_words} words: {output}", err=True)
    write_json(json_path, {"model": output, **counts, "heard": dict(zip(files, heard, strict=True))})
