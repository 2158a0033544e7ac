# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri align``: when words that are known were spoken."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import click

from hri.cli.connected import connected_model, connected_model_option
from hri.cli.groups import CheckedCommand
from hri.cli.messages import listed, note
from hri.cli.output import OutputFile, json_option, say, write_json, write_text
from hri.cli.recognizers import embedding_option, load_embedding
from hri.cli.transcript_tables import Recording, Said, recordings_among, recordings_below
from hri.cli.transcripts import EXIT_BAD_DATA, labels_of, lines_of_words, noting_faults, require_names_apart
from hri.core.errors import FormatError, InvalidArgument
from hri.htk import MasterLabelFile, Transcription
from hri.media import Audio, read_audio
from hri.recognition import ConnectedWordRecognizer, Transcript
from hri.recognition.sentence.transcript import UNKNOWN


@click.command(cls=CheckedCommand)
@click.argument("files", nargs=-1, type=click.Path(exists=True, dir_okay=False), metavar="[FILE...]")
@connected_model_option
@embedding_option
@click.option(
    "--words", metavar="TEXT", help='What was said in every FILE, in its order: labels of the model, as "3 1 2".'
)
@click.option(
    "--transcripts",
    type=click.Path(exists=True, dir_okay=False),
    metavar="TABLE",
    help="What was said in each recording: an MLF of HTK, or lines of words with the name of the recording behind them "
    "in brackets (trn). Without FILE all of its recordings, which lie below its folder.",
)
@click.option(
    "--mlf",
    type=OutputFile(path_type=Path),
    metavar="FILE",
    help="Write the words with their times as a master label file, from which HTK's programs train.",
)
@click.option(
    "--textgrids",
    type=click.Path(file_okay=False, path_type=Path),
    metavar="DIR",
    help="Write a TextGrid of each recording, which Praat shows beside its sound.",
)
@json_option
def align(
    files: tuple[str, ...],
    model: str | None,
    embedding_path: str | None,
    words: str | None,
    transcripts: str | None,
    mlf: Path | None,
    textgrids: Path | None,
    json_path: str | None,
) -> None:
    """Find when each word was spoken, where it is known what was said.

    Prints a line a word: its beginning and end in seconds, and the word; of several recordings every line begins with
    the name of its file. Pauses may lie between the words. A grammar or language model of the model has no say. A
    recording that cannot be read, is too short for its words, or does not stand in the table once is named on standard
    error; the others are aligned, and the exit code is 3.

    \b
    Examples:
      hri align number.wav --words "3 1 2"
      hri align --transcripts numbers/said.trn --mlf times.mlf
      hri align monday.wav tuesday.wav --transcripts said.mlf --textgrids grids/ --json -
    """
    if (words is None) == (transcripts is None):
        raise click.UsageError("say what was said, either by --words or by --transcripts")
    if words is not None and not files:
        raise click.UsageError("name the recordings in which --words were said")
    if words is not None and not words.split():
        raise click.UsageError("--words: there is no word")
    embedding = load_embedding(embedding_path)
    recognizer = ConnectedWordRecognizer.load(connected_model() if model is None else model, embedding=embedding)
    if words is not None:
        said = Said("", words.split(), ["--words"] * len(words.split()), "--words")
        _require_words(said, recognizer)
        tasks = [Recording(file, said) for file in files]
    else:
        assert transcripts is not None
        tasks = recordings_among(files, transcripts) if files else recordings_below(transcripts)
    names = [task.name for task in tasks if task.said is not None]
    if mlf is not None:
        require_names_apart([_label_path(name) for name in names], names, "--mlf")
    if textgrids is not None:
        require_names_apart([_grid_path(name, textgrids) for name in names], names, "--textgrids")
    found: dict[str, dict[str, Any]] = {}
    labels: list[tuple[str, Transcription]] = []
    for task in tasks:
        found[task.name] = {}
        with noting_faults(found[task.name]):
            audio, transcript = _aligned(task, recognizer)
            if textgrids is not None:
                write_text(_grid_path(task.name, textgrids), _grid_of(transcript, audio))
            found[task.name] |= transcript.to_dict()
        if "error" in found[task.name]:
            continue
        labels.append((str(_label_path(task.name)), labels_of(transcript)))
        for line in lines_of_words(transcript):
            say(f"{task.name}\t{line}" if len(tasks) > 1 else line, json_path)
        for text in transcript.notes:
            note(f"{task.name}: {text}")
    write_json(json_path, found)
    if mlf is not None:
        write_text(mlf, MasterLabelFile(labels).to_text())
    if any("error" in entry for entry in found.values()):
        sys.exit(EXIT_BAD_DATA)


def _require_words(said: Said, recognizer: ConnectedWordRecognizer) -> None:
    known = [str(label) for label in recognizer.classes_] + [UNKNOWN] * recognizer.options.unknown_words
    spaced = not said.in_master and any(label.split() != [label] for label in known)
    hint = "; those with a space can be given in a master label file alone" if spaced else ""
    for word, place in zip(said.words, said.places, strict=True):
        if word not in known:
            raise InvalidArgument(f"{place}: {word!r} is no word of the model, whose words are {listed(known)}{hint}")
    if not said.words:
        raise InvalidArgument(f"{said.place}: {said.name!r} has no word")


def _aligned(task: Recording, recognizer: ConnectedWordRecognizer) -> tuple[Audio, Transcript]:
    if task.said is None:
        raise FormatError(task.fault)
    _require_words(task.said, recognizer)
    audio = read_audio(task.name)
    transcript = recognizer.align(audio, words=task.said.words)
    if not transcript.complete:
        raise FormatError(f"{task.name}: is too short for its {len(task.said.words)} words, or has no speech")
    return audio, transcript


def _label_path(file: str) -> Path:
    """As HTK names what was said."""
    return Path(file).with_suffix(".lab")


def _grid_path(file: str, folder: Path) -> Path:
    return folder / Path(file).with_suffix(".TextGrid").name


def _grid_of(transcript: Transcript, audio: Audio) -> str:
    """A tier of words in Praat's short form: intervals that follow each other, empty ones where nothing is said."""
    length_s = len(audio.samples) / audio.sample_rate_hz
    intervals: list[tuple[float, float, str]] = []
    now = 0.0
    for first_s, last_s, label in [
        *((word.first_s, min(word.last_s, length_s), word.label) for word in transcript.words),
        (length_s, length_s, ""),
    ]:
        if first_s > now:
            intervals.append((now, first_s, ""))
        if last_s > first_s:
            intervals.append((first_s, last_s, label.replace('"', '""')))
        now = last_s
    head = ['File type = "ooTextFile"', 'Object class = "TextGrid"', "", "0", f"{length_s:.6f}", "<exists>", "1"]
    head += ['"IntervalTier"', '"words"', "0", f"{length_s:.6f}", str(len(intervals))]
    body = [f'{first_s:.6f}\n{last_s:.6f}\n"{label}"' for first_s, last_s, label in intervals]
    return "\n".join([*head, *body]) + "\n"
