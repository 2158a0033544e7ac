# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri add-word``, ``hri remove-word`` and ``hri add-gesture``."""

from __future__ import annotations

from pathlib import Path

import click

from hri.cli.groups import CheckedCommand, refuse_given
from hri.cli.messages import note
from hri.cli.output import OutputFile, json_option, say, why_not_writable, write_json
from hri.cli.recognizers import embedding_option, fault_of_label, kept_model, load_embedding
from hri.core.display import count
from hri.core.errors import InvalidArgument
from hri.media import read_audio
from hri.recognition import GestureRecognizer, SubwordRecognizer, WordRecognizer, load

_model_option = click.option(
    "--model",
    "model_path",
    type=click.Path(exists=True, dir_okay=False),
    metavar="MODEL",
    help="A model from 'hri train speech' or 'hri train-units'; the default is the one kept per user by the first.",
)
_out_option = click.option(
    "--out",
    "-o",
    type=OutputFile(replaces=("model_path",)),
    metavar="MODEL",
    help="The new model file; the default replaces the old one.",
)


def _printable(context: click.Context, param: click.Parameter, label: str) -> str:
    fault = fault_of_label(label)
    if fault is not None:
        raise click.BadParameter(fault, context, param)
    return label


@click.command("add-word", cls=CheckedCommand)
@_model_option
@click.option("--label", required=True, callback=_printable, help="The new word.")
@click.option(
    "--spelling", metavar="TEXT", help="How the word is written; for models from 'hri train-units', without recordings."
)
@click.option(
    "--language",
    default="en",
    show_default=True,
    help="Of the spelling, or of the label without one, as espeak-ng calls it; for models from 'hri train-units'.",
)
@click.argument("files", nargs=-1, type=click.Path(exists=True, dir_okay=False), metavar="[FILE]...")
@embedding_option
@_out_option
@json_option
def add_word(
    model_path: str | None,
    label: str,
    spelling: str | None,
    language: str,
    files: tuple[str, ...],
    embedding_path: str | None,
    out: str | None,
    json_path: str | None,
) -> None:
    """Add a word to a trained recogniser, from few recordings of it or by its spelling.

    Three recordings suffice. A model from 'hri train-units' takes a spelling, and recordings beside it if there are
    any. The models of the other words stay as they are; nothing is trained again.

    \b
    Examples:
      hri add-word --label dance dance1.wav dance2.wav dance3.wav
      hri add-word --model digits.hri --label dance dance*.wav -o more.hri
      hri add-word --model units.hri --label dance --spelling dance
    """
    if spelling is not None and not spelling.strip():
        raise click.UsageError("--spelling is empty")
    if not files and spelling is None:
        raise click.UsageError("give recordings of the word, or --spelling")
    words, target = _open(model_path, embedding_path, out)
    clips = [read_audio(path) for path in files]
    if isinstance(words, SubwordRecognizer):
        for phone, other in words.add_word(label, spelling, language=language, clips=clips).items():
            note(f"no recording had the phone {phone}: {other} stands for it")
    elif spelling is not None:
        raise InvalidArgument("a word is added by its spelling to a model from 'hri train-units', not to one of words")
    else:
        refuse_given(("language",), "is for models from 'hri train-units'")
        words.add_word(label, clips)
    _keep(words, target, json_path)


@click.command("remove-word", cls=CheckedCommand)
@_model_option
@click.option("--label", required=True, help="The word to remove.")
@embedding_option
@_out_option
@json_option
def remove_word(
    model_path: str | None, label: str, embedding_path: str | None, out: str | None, json_path: str | None
) -> None:
    """Remove a word from a trained recogniser.

    \b
    Examples:
      hri remove-word --label dance
      hri remove-word --model more.hri --label dance -o fewer.hri
    """
    words, target = _open(model_path, embedding_path, out)
    words.remove_word(label)
    _keep(words, target, json_path)


@click.command("add-gesture", cls=CheckedCommand)
@click.option(
    "--model",
    "model_path",
    type=click.Path(exists=True, dir_okay=False),
    metavar="MODEL",
    help="A model from 'hri train gesture'; the default is the one kept per user.",
)
@click.option("--label", required=True, callback=_printable, help="The new gesture.")
@click.argument("clips", nargs=-1, required=True, type=click.Path(exists=True), metavar="CLIP...")
@_out_option
@json_option
def add_gesture(
    model_path: str | None, label: str, clips: tuple[str, ...], out: str | None, json_path: str | None
) -> None:
    """Add a gesture to a trained recogniser, from few clips of it.

    Three clips suffice: pictures or videos, or folders of pictures. The models svm and bayes keep too little of what
    they were trained on, and are trained again instead.

    \b
    Examples:
      hri add-gesture --label wave wave1.avi wave2.avi wave3.avi
      hri add-gesture --model signs.hri --label eight eight*.jpg -o more.hri
    """
    source = kept_model("gesture") if model_path is None else Path(model_path)
    target = _target(source, out)
    signs = load(source, "gesture")
    if label in signs.classes_:  # which is said before clips are read
        raise InvalidArgument(f"label '{label}' is in the vocabulary already")
    rows = [signs.features(clip) for clip in clips]
    for clip, found in zip(clips, rows, strict=True):
        if len(found) == 0:
            raise InvalidArgument(f"{clip}: no picture shows a hand")
    signs.add_gesture_features(label, rows)
    _keep(signs, target, json_path)


def _open(
    model_path: str | None, embedding_path: str | None, out: str | None
) -> tuple[WordRecognizer | SubwordRecognizer, Path]:
    source = kept_model("speech") if model_path is None else Path(model_path)
    target = _target(source, out)
    return load(source, "speech", embedding=load_embedding(embedding_path)), target


def _target(source: Path, out: str | None) -> Path:
    """Where the new model goes; click.UsageError where the old one, which it replaces, cannot be."""
    if out is not None:
        return Path(out)
    fault = why_not_writable(source)
    if fault is not None:
        raise click.UsageError(f"'{source}' cannot be replaced: {fault}; name a file with --out")
    return source


def _keep(
    recognizer: WordRecognizer | SubwordRecognizer | GestureRecognizer, target: Path, json_path: str | None
) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    recognizer.save(target)
    labels = [str(label) for label in recognizer.classes_]
    say(str(target), json_path)
    note(f"{count(len(labels), 'label')}: {' '.join(labels)}")
    write_json(json_path, {"model": str(target), "labels": labels})
