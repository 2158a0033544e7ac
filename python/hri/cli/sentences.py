# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri train-sentences`` and ``hri read-sentences``."""

from __future__ import annotations

import sys
from pathlib import Path

import click
import numpy as np
from numpy.typing import NDArray

from hri.cli.groups import CheckedCommand, FiniteRange, refuse_given
from hri.cli.messages import note, report_fault
from hri.cli.output import OutputFile, json_option, say, write_json
from hri.cli.progress import progress_bars
from hri.cli.recognizers import (
    default_model,
    model_to_write,
    naming_options,
    options_option,
    parse_options,
    refuse_chosen,
    warn_of_stored,
)
from hri.cli.voice import SpokenText, spoken
from hri.core.display import count
from hri.core.errors import Error, FormatError, InvalidArgument
from hri.datasets.asl_sentences import read_asl_sentences
from hri.evaluation.sentences import fit_sentences
from hri.io import write_wav_pcm16
from hri.language import KnowledgeBase, StoredMatch
from hri.language.knowledge import MAX_DISTANCE
from hri.recognition import SentenceRecognizer
from hri.robot.imitation import read_hand_tracks

EXIT_BAD_DATA = 3
MODE = "sentences"
"""Under which name the model is kept per user."""


@click.command("train-sentences", cls=CheckedCommand)
@click.option(
    "--data",
    required=True,
    type=click.Path(exists=True, file_okay=False),
    help="Folder of the files hands.csv, words.csv, signers.csv: tracks and their words.",
)
@click.option("--out", type=OutputFile(), metavar="MODEL", help="Model file; the default is kept per user.")
@options_option("sentences", "frames_per_state=4")
@click.option("--seed", type=click.IntRange(0), default=0, show_default=True, help="Of everything random in training.")
@json_option
def train_sentences(data: str, out: str | None, options: tuple[str, ...], seed: int, json_path: str | None) -> None:
    """Train a recogniser of signed sentences on tracks of both hands with their words.

    Where there are two signers or more, weights are chosen on signers held out.

    \b
    Examples:
      hri train-sentences --data signed/
      hri train-sentences --data signed/ --option language_order=1 --out signs.hri
    """
    fields = parse_options((f"seed={seed}", *options))
    refuse_chosen(fields, "choose_weights")
    with naming_options():
        recognizer = SentenceRecognizer(**fields)
    path = model_to_write(MODE, out)
    sentences = read_asl_sentences(Path(data))
    path.parent.mkdir(parents=True, exist_ok=True)
    words = sorted({word.label for sentence in sentences for word in sentence.words})
    note(f"{count(len(sentences), 'sentence')}, {count(len(words), 'word')}: {' '.join(words)}")
    with progress_bars() as progress:
        fit_sentences(recognizer, sentences, lambda done, total: progress("training", done, total))
    recognizer.save(path)
    labels = [str(label) for label in recognizer.classes_]
    say(str(path), json_path)
    write_json(json_path, {"model": str(path), "labels": labels, "options": recognizer.trained_options.as_dict()})


@click.command("read-sentences", cls=CheckedCommand)
@click.argument("files", nargs=-1, required=True, type=click.Path(exists=True, dir_okay=False), metavar="TRACKS...")
@click.option(
    "--model",
    type=click.Path(exists=True, dir_okay=False),
    metavar="MODEL",
    help="A model from 'hri train-sentences'; the default is the one kept per user.",
)
@click.option(
    "--frames", is_flag=True, help="Print a line a word: its first frame, the frame after its last, the word."
)
@click.option(
    "--knowledge",
    type=click.Path(exists=True, dir_okay=False),
    metavar="CSV",
    help="Stored sentences: a column 'signs' with their words, and columns 'en', 'hi', ... with what they say. The "
    "nearest is printed in place of the words.",
)
@click.option(
    "--max-distance",
    type=FiniteRange(0, 1),
    default=MAX_DISTANCE,
    show_default=True,
    help="Words farther from every stored sentence are none of them.",
)
@click.option(
    "--alternatives",
    type=click.IntRange(0, 1000),
    default=0,
    metavar="N",
    help="Print the N best sentences with their scores; with --knowledge, the stored sentence nearest to any of them.",
)
@click.option("--language", default="en", show_default=True, help="Of the text and of the voice.")
@click.option(
    "--speak",
    type=click.Path(file_okay=False),
    metavar="FOLDER",
    help="Write each sentence as speech, 001.wav and so on (by espeak-ng).",
)
@click.option("--play", is_flag=True, help="Say each sentence through the loudspeaker (by espeak-ng).")
@json_option
def read_sentences(
    files: tuple[str, ...],
    model: str | None,
    frames: bool,
    knowledge: str | None,
    max_distance: float,
    alternatives: int,
    language: str,
    speak: str | None,
    play: bool,
    json_path: str | None,
) -> None:
    """Recognise signed sentences in CSV files of tracks; print a line for each sentence: its name and its words.

    A file has the columns left-x, left-y, right-x, right-y, nose-x, nose-y, in pixels, and may have video and frame;
    an empty cell is a position that was not seen. What cannot be recognised is said on standard error, the others are
    read, and the exit code is 3.

    \b
    Examples:
      hri read-sentences hands.csv
      hri read-sentences monday.csv tuesday.csv --frames --json -
      hri read-sentences hands.csv --knowledge sentences.csv --language hi --speak voice/
      hri read-sentences hands.csv --knowledge sentences.csv --play
      hri read-sentences hands.csv --alternatives 5
    """
    if knowledge is None:
        refuse_given(("max_distance",), "goes with --knowledge")
    if frames and alternatives:
        raise click.UsageError("--frames and --alternatives exclude each other")
    path = Path(model) if model is not None else default_model(MODE)
    if not path.is_file():
        raise InvalidArgument("there is no model of signed sentences yet: run 'hri train-sentences --data DIR'")
    recognizer = SentenceRecognizer.load(path)
    stored = None
    if knowledge is not None:
        stored = KnowledgeBase.read(knowledge, max_distance)
        warn_of_stored(stored, [recognizer], knowledge)
    if stored is not None and language != "en" and not any(language in s.texts for s in stored.sentences):
        raise InvalidArgument(f"{knowledge}: no stored sentence has a text in '{language}'")
    found: dict[str, dict[str, object]] = {}
    num_spoken = num_faults = 0
    voice = SpokenText(language) if play else None
    for file in files:
        found[file] = {}
        try:
            tracks = _read_tracks(file)
        except Error as error:
            report_fault(error)
            found[file]["error"] = str(error)
            num_faults += 1
            continue
        for name, track in tracks.items():
            try:
                best = (
                    recognizer.recognise_n_best(track, alternatives) if alternatives else [recognizer.recognise(track)]
                )
            except InvalidArgument as error:
                report_fault(f"{file}: {name}: {error}")
                found[file][name] = {"error": str(error)}
                num_faults += 1
                continue
            sentence, *others = best
            match = None if stored is None else stored.match(sentence.labels, [other.labels for other in others])
            text = sentence.text if match is None else match.sentence.text(language)
            entry = sentence.to_dict()
            if alternatives:
                entry["alternatives"] = [one.to_dict() for one in best]
            if stored is not None:
                entry["stored"] = None if match is None else _as_dict(match, text)
            found[file][name] = entry
            if frames:
                for word in sentence.words:
                    say(f"{name}\t{word.first_frame}\t{word.last_frame}\t{word.label}", json_path)
            elif alternatives and stored is None:
                for one in best:
                    say(f"{name}\t{one.log_score:.1f}\t{one.text}", json_path)
            else:
                say(f"{name}\t{text}", json_path)
            if stored is not None and match is None:
                note(f"{file}: {name}: none of the stored sentences")
            if speak is not None and text:
                num_spoken += 1
                _write_speech(text, language, Path(speak) / f"{num_spoken:03}.wav")
            if voice is not None and text:
                voice.say(text)
    write_json(json_path, found)
    if num_faults:
        sys.exit(EXIT_BAD_DATA)


def _read_tracks(file: str) -> dict[str, NDArray[np.float64]]:
    """Tracks of a file by name, shape (frames, 6) each."""
    tracks: dict[str, NDArray[np.float64]] = {}
    for name, track in read_hand_tracks(file).items():
        if track.nose is None:
            raise FormatError(f"{file}: row 1: no column nose-x, nose-y")
        tracks[name] = np.hstack([track.left, track.right, track.nose])
    return tracks


def _as_dict(match: StoredMatch, text: str) -> dict[str, object]:
    return {"words": list(match.sentence.words), "text": text, "distance": match.distance}


def _write_speech(text: str, language: str, path: Path) -> None:
    audio = spoken(text, language)
    path.parent.mkdir(parents=True, exist_ok=True)
    write_wav_pcm16(path, audio.samples, audio.sample_rate_hz)
    note(f"{path}: {text}")
