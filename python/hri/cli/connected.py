# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri train-connected`` and ``hri transcribe``."""

from __future__ import annotations

import json
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

import click

from hri.cli.groups import CheckedCommand, refuse_given
from hri.cli.live_screen import device_option, microphone, recording, stall_option
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
from hri.core.files import make_folder
from hri.htk import WordLattice
from hri.io import SpokenWords
from hri.language import Grammar, NGramModel
from hri.live import AudioSource
from hri.media import VIDEO_SUFFIXES, read_audio
from hri.recognition import ConnectedWordRecognizer, ConnectedWordStream, Transcript, UtteranceResult
from hri.recognition.sentence.recognizer import UNKNOWN
from hri.synthetic.speech import speak_words

MODE = "connected"
"""Under which name the model is kept per user."""
SILENCE = "<sil>"
"""The word of silence in lattices."""


@click.command("train-connected", cls=CheckedCommand)
@click.option(
    "--data",
    required=True,
    type=click.Path(exists=True, file_okay=False),
    help="Folder of recordings of one word each.",
)
@pattern_option
@click.option("--out", type=OutputFile(), metavar="MODEL", help="Model file; the default is kept per user.")
@options_option("connected", "words.num_states=8")
@click.option(
    "--language",
    type=click.Path(exists=True, dir_okay=False),
    metavar="ARPA",
    help="A language model of order 1 or 2, which is kept with the model.",
)
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
    options: tuple[str, ...],
    language: str | None,
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
      hri train-connected --data spoken/ --add sideways --add "ulta=उल्टा" --voice hi
      hri train-connected --data spoken/ --option words.num_states=6 --option max_pause_ms=500
    """
    fields = parse_options((f"words.seed={seed}", *options))
    with naming_options():
        recognizer = ConnectedWordRecognizer(**fields)
    model = None if language is None else NGramModel.load(language)
    dataset = load_dataset(data, "speech", pattern)
    path = default_model(MODE) if out is None else Path(out)
    path.parent.mkdir(parents=True, exist_ok=True)
    spellings = _spellings(added, dataset.labels)
    spoken = SpokenWords(voice, spellings, num_voices, seed) if spellings else None  # refuses what is wrong now
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
            progress=lambda done, total: progress("training", done, total),
        )
    if model is not None:
        recognizer.set_language(model)
    recognizer.save(path)
    if spoken is not None:
        note(f"how these words were said: {spoken.write_beside(path)}")
    else:
        SpokenWords.remove_beside(path)
    say(str(path), json_path)
    note(f"{len(dataset)} recordings, {len(dataset.labels)} labels: {' '.join(dataset.labels)}")
    if spellings:
        note(f"not recorded, said by {num_voices} synthetic voices: {' '.join(spellings)}")
    note(f"insertion penalty: {recognizer.insertion_penalty:g}")
    write_json(
        json_path,
        {
            "model": str(path),
            "labels": [str(label) for label in recognizer.classes_],
            "synthetic_labels": list(spellings),
            "insertion_penalty": recognizer.insertion_penalty,
        },
    )


def _spellings(added: Sequence[str], recorded: Sequence[str]) -> dict[str, str]:
    """How words without recordings are written, by label."""
    found: dict[str, str] = {}
    for one in added:
        label, _, text = (part.strip() for part in one.partition("="))
        if not label or label in found:
            raise click.UsageError(f"--add {one!r}: it has no label, or one that was given before")
        if label in recorded:
            raise click.UsageError(f"--add {one!r}: there are recordings of this word")
        found[label] = text or label
    return found


@click.command(cls=CheckedCommand)
@click.argument("files", nargs=-1, type=click.Path(exists=True, dir_okay=False), metavar="FILE...")
@click.option(
    "--model",
    type=click.Path(exists=True, dir_okay=False),
    metavar="MODEL",
    help="A model from 'hri train-connected'; the default is the one kept per user.",
)
@click.option("--words", type=click.IntRange(1, 1000), metavar="N", help="How many words there are, where it is known.")
@click.option(
    "--grammar",
    type=click.Path(exists=True, dir_okay=False),
    metavar="JSGF",
    help="Commands with slots: only its sentences are recognised.",
)
@click.option(
    "--alternatives", type=click.IntRange(0, 1000), default=0, metavar="N", help="Print the N best sentences."
)
@click.option(
    "--lattices", type=click.Path(file_okay=False, path_type=Path), metavar="DIR", help="Write lattices (.slf)."
)
@click.option(
    "--robot",
    "film",
    type=OutputFile(VIDEO_SUFFIXES, path_type=Path),
    metavar="FILE",
    help="Film HOAP-2 as it performs the command: slots 'gesture', 'side', 'times', or 'walk' and 'steps'.",
)
@click.option(
    "--stream",
    is_flag=True,
    help="Recognise utterance by utterance, from the microphone where no file is named; a line each, as JSON.",
)
@click.option("--wake", default="", metavar="WORD", help="With --stream: take what is said behind this word.")
@device_option
@stall_option
@click.option("--times", is_flag=True, help="Print a line a word: its beginning and end in seconds, and the word.")
@json_option
def transcribe(
    files: tuple[str, ...],
    model: str | None,
    words: int | None,
    grammar: str | None,
    alternatives: int,
    lattices: Path | None,
    film: Path | None,
    stream: bool,
    wake: str,
    device: str | None,
    stall_s: float,
    times: bool,
    json_path: str | None,
) -> None:
    """Recognise several words in one recording; print them in a line for each file.

    \b
    Examples:
      hri transcribe number.wav
      hri transcribe number.wav --words 4
      hri transcribe command.wav --grammar robot.jsgf --alternatives 3
      hri transcribe command.wav --grammar robot.jsgf --robot robot.webm
      hri transcribe --stream --wake robot
      hri transcribe monday.wav tuesday.wav --times --json -
    """
    if not files and not stream:
        raise click.UsageError("name a recording, or add --stream for the microphone")
    if not stream:
        refuse_given(("wake", "device", "stall_s"), "goes with --stream")
    if times and alternatives:
        raise click.UsageError("--times and --alternatives exclude each other")
    if film is not None and (grammar is None or len(files) != 1 or stream):
        raise click.UsageError("--robot goes with --grammar and one recording")
    recognizer = ConnectedWordRecognizer.load(connected_model() if model is None else model)
    if grammar is not None:
        recognizer.set_grammar(Grammar.load(grammar))
    if stream:
        sources: list[AudioSource] = [recording(file) for file in files] or [microphone(device, stall_s)]
        for source in sources:
            _follow(recognizer, source, wake)
        return
    found = {}
    for file in files:
        transcript = recognizer.recognise(file, num_words=words, num_alternatives=alternatives)
        found[file] = transcript.to_dict()
        if times:
            for word in transcript.words:
                say(f"{word.first_s:.3f}\t{word.last_s:.3f}\t{word.label}", json_path)
        elif alternatives:
            for other in transcript.alternatives:
                say(f"{other.log_score:.1f}\t{other.text}", json_path)
        else:
            slots = "".join(f"\t{slot}={value}" for slot, value in transcript.slots.items())
            say(transcript.text + slots, json_path)
        if lattices is not None:
            _write_lattice(recognizer, file, lattices)
        if film is not None:
            _film(transcript, film)
        if not transcript.complete:
            note(f"{file}: too short for {words} words")
        for text in transcript.notes:
            note(f"{file}: {text}")
    write_json(json_path, found)


def connected_model() -> Path:
    """The model kept per user. Raises InvalidArgument that says how to make it when there is none."""
    path = default_model(MODE)
    if not path.is_file():
        raise InvalidArgument("there is no model of connected words yet: run 'hri train-connected --data DIR'")
    return path


def _follow(recognizer: ConnectedWordRecognizer, source: AudioSource, wake: str) -> None:
    """A line of JSON for every result until the source ends."""
    stream = ConnectedWordStream(recognizer, source.sample_rate_hz, wake_word=wake)

    def show(results: list[UtteranceResult]) -> None:
        for result in results:
            fields: dict[str, Any] = {"event": "final" if result.is_final else "partial", "source": source.name}
            fields |= {"first_s": round(result.first_s, 3), "last_s": round(result.last_s, 3)}
            fields |= {"num_stable": result.num_stable, **result.transcript.to_dict()}
            click.echo(json.dumps(fields, ensure_ascii=False))

    try:
        while (block := source.read()) is not None:
            show(stream.process(block))
        show(stream.finish())
    finally:
        source.close()


def _film(transcript: Transcript, path: Path) -> None:
    from hri.robot import command_trajectory, needs_feet, render_video

    if not transcript.slots or any(word.unknown for word in transcript.words):
        note("robot: not moved, no command with slots was understood")
        return
    motion = command_trajectory(transcript.slots)
    make_folder(path.parent)
    render_video(motion, path, fixed_base=not needs_feet(motion))
    note(f"robot: {path}")


def _write_lattice(recognizer: ConnectedWordRecognizer, file: str, folder: Path) -> None:
    lattice, first_s, frame_s = recognizer.lattice(file)
    if lattice.empty:
        note(f"{file}: no speech, no lattice")
        return
    labels = [*recognizer.classes_, SILENCE, UNKNOWN]
    make_folder(folder)
    WordLattice.of_lattice(lattice, labels, first_s, frame_s).write(folder / Path(file).with_suffix(".slf").name)
