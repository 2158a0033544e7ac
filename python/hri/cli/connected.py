# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri train-connected``, and the models that ``hri transcribe`` uses."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

import click

from hri.cli.choices import names
from hri.cli.groups import CheckedCommand, FiniteRange, refuse_given
from hri.cli.messages import listed, note
from hri.cli.output import OutputFile, json_option, say, write_json
from hri.cli.progress import progress_bars
from hri.cli.recognizers import (
    default_model,
    embedding_option,
    fault_of_label,
    load_dataset,
    model_to_write,
    naming_options,
    options_option,
    parse_options,
    pattern_option,
    refuse_chosen,
)
from hri.cli.train_checks import summary_of
from hri.core.display import count
from hri.core.errors import InvalidArgument
from hri.io import SpokenWords
from hri.language import NGramModel
from hri.media import read_audio
from hri.recognition import ConnectedWordRecognizer, SpeechEmbedding
from hri.recognition.sentence.transcript import UNKNOWN
from hri.synthetic.speech import speak_words
from hri.training import has_embedding

MODE = "connected"
"""Under which name the model is kept per user."""
LANGUAGE_SCALE = 10.0
"""On log probabilities of a language model: scores count every frame as if it were independent of its neighbours."""

language_scale_option = click.option(
    "--language-scale",
    type=FiniteRange(0, 1e6),
    metavar="X",
    help="Factor on the log probabilities of the language model, 5 to 20 as a rule; the default is "
    f"{LANGUAGE_SCALE:g}, unless the model or --option decoder.language_scale says another.",
)


connected_model_option = click.option(
    "--model",
    type=click.Path(exists=True, dir_okay=False),
    metavar="MODEL",
    help="A model from 'hri train-connected'; the default is the one kept per user.",
)
front_end_option = click.option(
    "--front-end",
    type=click.Choice(["cepstra", "both"]),
    help="cepstra alone, or both: words that these find are named anew by a pretrained speech embedding, which the "
    "extra embedding installs. The default is both where the extra is. The same as --option words.front_end=...",
)


@click.command("train-connected", cls=CheckedCommand)
@click.option(
    "--data",
    required=True,
    type=click.Path(exists=True, file_okay=False),
    help="Folder of recordings of one word each.",
)
@pattern_option
@click.option("--out", type=OutputFile(), metavar="MODEL", help="Model file; the default is kept per user.")
@front_end_option
@embedding_option
@options_option("connected", "words.num_states=8")
@click.option(
    "--language",
    type=click.Path(exists=True, dir_okay=False),
    metavar="ARPA",
    help="A language model of order 1 or 2, which is kept with the model.",
)
@language_scale_option
@click.option(
    "--add",
    "added",
    multiple=True,
    metavar="LABEL[=TEXT]",
    help="A word without recordings, as it is written: synthetic voices of espeak-ng say it. May be repeated.",
)
@click.option("--voice", default="en", show_default=True, help="Language of these words, as espeak-ng calls it.")
@click.option(
    "--voices", "num_voices", type=click.IntRange(1), default=24, show_default=True, help="How many voices say them."
)
@click.option("--seed", type=click.IntRange(0), default=0, show_default=True, help="Of everything random in training.")
@json_option
def train_connected(
    data: str,
    pattern: str | None,
    out: str | None,
    front_end: str | None,
    embedding_path: str | None,
    options: tuple[str, ...],
    language: str | None,
    language_scale: float | None,
    added: tuple[str, ...],
    voice: str,
    num_voices: int,
    seed: int,
    json_path: str | None,
) -> None:
    """Train a recogniser of connected words on a folder of isolated ones.

    A word without recordings is learned from synthetic voices (--add): it is recognised less well than one that
    people said, and better where a grammar leaves few words to choose from.

    \b
    Examples:
      hri train-connected --data spoken/
      hri train-connected --data spoken/ --language commands.arpa --out commands.hri
      hri train-connected --data spoken/ --language commands.arpa --language-scale 15
      hri train-connected --data spoken/ --add sideways --add "ulta=उल्टा" --voice hi
      hri train-connected --data spoken/ --front-end cepstra
      hri train-connected --data spoken/ --option words.num_states=6 --option max_pause_ms=500
    """
    scaled = any(option.startswith("decoder.language_scale=") for option in options)
    if language is None:
        refuse_given(("language_scale",), "goes with --language")
    elif scaled:
        refuse_given(("language_scale",), "and --option decoder.language_scale=... exclude each other")
    fields = connected_options(options, front_end, embedding_path, seed)
    with naming_options():
        recognizer = ConnectedWordRecognizer(**fields)
    embedding = connected_embedding(recognizer, embedding_path)
    path = model_to_write(MODE, out)
    dataset = load_dataset(data, "speech", pattern)
    spellings = _spellings(added, dataset.labels)
    model = None if language is None else load_language(language, [*dataset.labels, *spellings])
    path.parent.mkdir(parents=True, exist_ok=True)
    spoken = SpokenWords(voice, spellings, num_voices, seed) if spellings else None  # refuses what is wrong now
    # Said before training, which may take hours and shows nothing where there is no terminal.
    note(summary_of(dataset))
    if spellings:
        note(f"not recorded, said by {count(num_voices, 'synthetic voice')}: {listed(spellings)}")
    note(_what_words_are_of(recognizer))
    clips = [read_audio(sample.path) for sample in dataset.samples]
    labels = [sample.label for sample in dataset.samples]
    persons = [sample.person for sample in dataset.samples]
    with progress_bars() as progress:
        if spellings:
            said = speak_words({voice: spellings}, num_voices, 1, seed, partial(progress, "speaking"))
            clips, labels, persons = clips + said[0], labels + said[1], persons + said[2]
        recognizer.fit(
            clips,
            labels,
            groups=persons,
            embedding=embedding,
            progress=lambda done, total: progress("training", done, total),
        )
    if model is not None:
        recognizer.set_language(model)
        if not scaled:
            recognizer.set_decoder(language_scale=LANGUAGE_SCALE if language_scale is None else language_scale)
    recognizer.save(path)
    if spoken is not None:
        note(f"how these words were said: {spoken.write_beside(path)}")
    else:
        SpokenWords.remove_beside(path)
    say(str(path), json_path)
    note(f"insertion penalty: {recognizer.insertion_penalty:g}")
    if model is not None:
        note(f"language model of order {model.order}, scale {recognizer.language_scale:g}")
    write_json(
        json_path,
        {
            "model": str(path),
            "labels": [str(label) for label in recognizer.classes_],
            "synthetic_labels": list(spellings),
            "insertion_penalty": recognizer.insertion_penalty,
        },
    )


def connected_options(
    options: tuple[str, ...], front_end: str | None, embedding_path: str | None, seed: int
) -> dict[str, Any]:
    """What ``--option`` and the flags of the front end say, and the front end that is taken without.

    Raises
    ------
    click.UsageError
        For flags and an option that do not go together, and options that training chooses.
    """
    named = names(options, "words.front_end")
    for flag, given in (("--front-end", front_end), ("--embedding", embedding_path)):
        if given is not None and named and (flag == "--front-end" or "words.front_end=cepstra" in options):
            raise click.UsageError(f"{flag} and --option words.front_end=... exclude each other")
    if front_end == "cepstra" and embedding_path is not None:
        raise click.UsageError("--embedding is for --front-end both")
    if not named:
        chosen = front_end or ("both" if embedding_path is not None or has_embedding() else "cepstra")
        options = (*options, f"words.front_end={chosen}")
    fields = parse_options((f"words.seed={seed}", *options))
    refuse_chosen(fields, "choose_penalty")
    return fields


def connected_embedding(recognizer: ConnectedWordRecognizer, path: str | None) -> SpeechEmbedding | None:
    """What training takes; ImportError, before recordings are read, where neither the extra nor a file gives it."""
    return None if recognizer.options.words.front_end == "cepstra" else SpeechEmbedding(path)


def _what_words_are_of(recognizer: ConnectedWordRecognizer) -> str:
    if recognizer.options.words.front_end == "cepstra":
        return "front end: cepstra; --front-end both names words more surely (extra embedding)"
    return (
        "front end: both, cepstra and a speech embedding (extra embedding); wherever the model is used it needs the "
        "extra too, or the weights (--embedding), or --front-end cepstra here"
    )


def _spellings(added: Sequence[str], recorded: Sequence[str]) -> dict[str, str]:
    """How words without recordings are written, by label."""
    found: dict[str, str] = {}
    for one in added:
        label, _, text = (part.strip() for part in one.partition("="))
        if not label or label in found:
            raise click.UsageError(f"--add {one!r}: it has no label, or one that was given before")
        if fault_of_label(label) is not None:
            raise click.UsageError(f"--add: {fault_of_label(label)}")
        if label in recorded:
            raise click.UsageError(f"--add {one!r}: there are recordings of this word")
        found[label] = text or label
    return found


def load_language(path: str, labels: Sequence[str]) -> NGramModel:
    """A language model for words of these labels; says for which of them its ``<unk>`` stands.

    Raises
    ------
    FormatError, IoError
        For a file that is none.
    InvalidArgument
        For an order above 2, and labels that it does not know where it has no ``<unk>``; names the file.
    """
    model = NGramModel.load(path)
    if model.order > 2:
        raise InvalidArgument(f"{path}: has order {model.order}; connected words take language models of order 1 or 2")
    known = set(model.words)
    missing = listed(label for label in labels if label not in known)
    if missing and UNKNOWN not in known:
        raise InvalidArgument(f"{path}: does not have these labels, and no {UNKNOWN}: {missing}")
    if missing:
        note(f"{path}: does not have these labels, {UNKNOWN} stands for each: {missing}")
    return model


def connected_model() -> Path:
    """The model kept per user. Raises InvalidArgument that says how to make it when there is none."""
    path = default_model(MODE)
    if not path.is_file():
        raise InvalidArgument("there is no model of connected words yet: run 'hri train-connected --data DIR'")
    return path
