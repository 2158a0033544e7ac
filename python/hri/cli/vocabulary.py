# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri add-word`` and ``hri remove-word``."""

from __future__ import annotations

from pathlib import Path

import click

from hri.cli.messages import note
from hri.cli.output import OutputFile, json_option, say, write_json
from hri.cli.recognizers import kept_model
from hri.media import read_audio
from hri.recognition import WordRecognizer

_model_option = click.option(
    "--model",
    "model_path",
    type=click.Path(exists=True, dir_okay=False),
    metavar="MODEL",
    help="A model from 'hri train speech'; the default is the one kept per user.",
)
_out_option = click.option(
    "--out", "-o", type=OutputFile(), metavar="MODEL", help="The new model file; the default replaces the old one."
)


@click.command("add-word")
@_model_option
@click.option("--label", required=True, help="The new word.")
@click.argument("files", nargs=-1, required=True, type=click.Path(exists=True, dir_okay=False), metavar="FILE...")
@_out_option
@json_option
def add_word(
    model_path: str | None, label: str, files: tuple[str, ...], out: str | None, json_path: str | None
) -> None:
    """Add a word to a trained recogniser, from few recordings of it: three suffice.

    The models of the other words stay as they are; nothing is trained again.

    \b
    Examples:
      hri add-word --label dance dance1.wav dance2.wav dance3.wav
      hri add-word --model digits.hri --label dance dance*.wav -o more.hri
    """
    words, target = _open(model_path, out)
    clips = [read_audio(path) for path in files]
    words.add_word(label, [clip.samples for clip in clips], [clip.sample_rate_hz for clip in clips])
    _keep(words, target, json_path)


@click.command("remove-word")
@_model_option
@click.option("--label", required=True, help="The word to remove.")
@_out_option
@json_option
def remove_word(model_path: str | None, label: str, out: str | None, json_path: str | None) -> None:
    """Remove a word from a trained recogniser.

    \b
    Examples:
      hri remove-word --label dance
      hri remove-word --model more.hri --label dance -o fewer.hri
    """
    words, target = _open(model_path, out)
    words.remove_word(label)
    _keep(words, target, json_path)


def _open(model_path: str | None, out: str | None) -> tuple[WordRecognizer, Path]:
    source = kept_model("speech") if model_path is None else Path(model_path)
    return WordRecognizer.load(source), source if out is None else Path(out)


def _keep(words: WordRecognizer, target: Path, json_path: str | None) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    words.save(target)
    labels = [str(label) for label in words.classes_]
    say(str(target), json_path)
    note(f"{len(labels)} labels: {' '.join(labels)}")
    write_json(json_path, {"model": str(target), "labels": labels})
