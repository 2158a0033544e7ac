# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri transcribe``."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from hri.cli.connected import (
    LANGUAGE_SCALE,
    connected_model,
    connected_model_option,
    language_scale_option,
    load_language,
)
from hri.cli.groups import CheckedCommand, refuse_given
from hri.cli.live_screen import device_option, microphone, recording, stall_option
from hri.cli.messages import note
from hri.cli.output import OutputFile, json_option, say, write_json, write_text
from hri.cli.recognizers import embedding_option, load_embedding
from hri.cli.transcripts import EXIT_BAD_DATA, labels_of, lines_of_words, noting_faults, require_names_apart
from hri.core.errors import InvalidArgument
from hri.core.files import make_folder
from hri.htk import MasterLabelFile, Transcription, WordLattice
from hri.language import Grammar
from hri.live import AudioSource
from hri.live.events import json_line
from hri.media import VIDEO_SUFFIXES
from hri.recognition import ConnectedWordRecognizer, ConnectedWordStream, Transcript, UtteranceResult
from hri.recognition.sentence.transcript import UNKNOWN

SILENCE = "<sil>"
"""The word of silence in lattices."""
NO_WORD = "-"
"""What stands for none where words are printed with their probabilities."""
_SEARCH = ("grammar", "language", "no_grammar", "no_language")
"""Parameters that say which sentences there are: one of them at most."""


@click.command(cls=CheckedCommand)
@click.argument("files", nargs=-1, type=click.Path(exists=True, dir_okay=False), metavar="FILE...")
@connected_model_option
@embedding_option
@click.option(
    "--words",
    type=click.IntRange(1, 1000),
    metavar="N",
    help="How many words there are, where it is known; then in any order, whatever language model or grammar the model "
    "holds.",
)
@click.option(
    "--grammar",
    type=click.Path(exists=True, dir_okay=False),
    metavar="JSGF",
    help="Commands with slots: only its sentences are recognised.",
)
@click.option(
    "--language",
    type=click.Path(exists=True, dir_okay=False),
    metavar="ARPA",
    help="A language model of order 1 or 2, in place of what the model holds.",
)
@language_scale_option
@click.option("--no-grammar", is_flag=True, help="Without the grammar that the model holds: words in any order.")
@click.option("--no-language", is_flag=True, help="Without the language model that the model holds.")
@click.option(
    "--alternatives", type=click.IntRange(0, 1000), default=0, metavar="N", help="Print the N best sentences."
)
@click.option(
    "--confusions",
    is_flag=True,
    help="Print a line for each place where a word may have been said: its beginning and end in seconds, then the "
    "words with their probabilities, '-' for none.",
)
@click.option(
    "--lattices", type=click.Path(file_okay=False, path_type=Path), metavar="DIR", help="Write lattices (.slf)."
)
@click.option(
    "--mlf",
    type=OutputFile(path_type=Path),
    metavar="FILE",
    help="Write the words with their times as a master label file, which 'hri htk results' counts errors of.",
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
    embedding_path: str | None,
    words: int | None,
    grammar: str | None,
    language: str | None,
    language_scale: float | None,
    no_grammar: bool,
    no_language: bool,
    alternatives: int,
    confusions: bool,
    lattices: Path | None,
    mlf: Path | None,
    film: Path | None,
    stream: bool,
    wake: str,
    device: str | None,
    stall_s: float,
    times: bool,
    json_path: str | None,
) -> None:
    """Recognise several words in one recording; print them in a line for each file.

    Of several files every line begins with the name of its file. A file that is no recording is said on standard
    error, the others are recognised, and the exit code is 3.

    \b
    Examples:
      hri transcribe number.wav
      hri transcribe number.wav --words 4
      hri transcribe number.wav --confusions
      hri transcribe command.wav --grammar robot.jsgf --alternatives 3
      hri transcribe command.wav --grammar robot.jsgf --robot robot.webm
      hri transcribe number.wav --language digits.arpa --language-scale 15
      hri transcribe --stream --wake robot
      hri transcribe monday.wav tuesday.wav --times --json -
    """
    if not files and not stream:
        raise click.UsageError("name a recording, or add --stream for the microphone")
    if film is not None and (grammar is None or len(files) != 1 or stream):
        raise click.UsageError("--robot goes with --grammar and one recording")
    if stream:
        refuse_given(
            ("words", "alternatives", "confusions", "lattices", "mlf"), "is for whole recordings, without --stream"
        )
        refuse_given(("json_path",), "goes without --stream, which writes its lines as JSON")
    else:
        refuse_given(("wake", "device", "stall_s"), "goes with --stream")
    printed = [name for name in ("times", "alternatives", "confusions") if click.get_current_context().params[name]]
    if len(printed) > 1:
        raise click.UsageError(f"--{printed[0]} and --{printed[1]} exclude each other")
    if words is not None:
        refuse_given((*_SEARCH, "language_scale"), "and --words exclude each other: so many words come in any order")
    for name in _SEARCH:
        if click.get_current_context().params[name]:
            others = tuple(other for other in _SEARCH if other != name)
            refuse_given(others, f"and --{name.replace('_', '-')} exclude each other")
    if lattices is not None:
        require_names_apart([_lattice_path(file, lattices) for file in files], files, "--lattices")
    if mlf is not None:
        require_names_apart([_label_path(file) for file in files], files, "--mlf")
    embedding = load_embedding(embedding_path)
    recognizer = ConnectedWordRecognizer.load(connected_model() if model is None else model, embedding=embedding)
    _choose_sentences(recognizer, grammar, language, language_scale, no_grammar, no_language)
    if stream:
        sources: list[AudioSource] = [recording(file) for file in files] or [microphone(device, stall_s)]
        for source in sources:
            _follow(recognizer, source, wake, times, f"{source.name}\t" if len(sources) > 1 else "")
        return
    if words is not None and (held := _held(recognizer)):
        note(f"with --words the {held} of the model has no say")
    found: dict[str, dict[str, Any]] = {}
    labels: list[tuple[str, Transcription]] = []
    for file in files:
        found[file] = {}
        with noting_faults(found[file]):
            transcript = _checked(
                recognizer.recognise(file, num_words=words, num_alternatives=alternatives), recognizer, words
            )
            found[file] |= transcript.to_dict()
            if confusions:
                found[file]["confusions"] = _confusions(recognizer, file, words)
        if "error" in found[file]:
            continue
        labels.append((str(_label_path(file)), labels_of(transcript)))
        lines = (
            _lines_of_places(found[file]["confusions"]) if confusions else _lines(transcript, times, alternatives > 0)
        )
        for line in lines:
            say(f"{file}\t{line}" if len(files) > 1 else line, json_path)
        for text in transcript.notes:
            note(f"{file}: {text}")
        with noting_faults(found[file]):
            if lattices is not None:
                _write_lattice(recognizer, file, words, _lattice_path(file, lattices))
            if film is not None:
                _film(transcript, film)
    write_json(json_path, found)
    if mlf is not None:
        write_text(mlf, MasterLabelFile(labels).to_text())
    if any("error" in entry for entry in found.values()):
        sys.exit(EXIT_BAD_DATA)


def _lattice_path(file: str, folder: Path) -> Path:
    return folder / Path(file).with_suffix(".slf").name


def _label_path(file: str) -> Path:
    """As HTK names what was recognised."""
    return Path(file).with_suffix(".rec")


def _held(recognizer: ConnectedWordRecognizer) -> str:
    """What weighs or bounds the sentences of a recogniser; "" where words come in any order."""
    return "grammar" if recognizer.grammar is not None else "language model" if recognizer.language is not None else ""


def _choose_sentences(
    recognizer: ConnectedWordRecognizer,
    grammar: str | None,
    language: str | None,
    scale: float | None,
    no_grammar: bool,
    no_language: bool,
) -> None:
    """Set or drop what weighs or bounds the sentences."""
    held = _held(recognizer)
    for dropped, kind in ((no_grammar, "grammar"), (no_language, "language model")):
        if dropped and held != kind:
            raise InvalidArgument(f"--no-{kind.split()[0]}: the model holds no {kind}")
    if no_grammar:
        recognizer.set_grammar(None)
    if no_language:
        recognizer.set_language(None)
    if grammar is not None:
        sentences = Grammar.load(grammar)
        try:
            recognizer.set_grammar(sentences)
        except InvalidArgument as error:
            raise InvalidArgument(f"{grammar}: {error}") from error
    if language is not None:
        recognizer.set_language(load_language(language, [str(label) for label in recognizer.classes_]))
        if scale is None and held != "language model" and recognizer.language_scale == 1:
            scale = LANGUAGE_SCALE
    if scale is not None:
        if not _held(recognizer):
            raise InvalidArgument("--language-scale: there is no language model and no grammar whose weights it scales")
        recognizer.set_decoder(language_scale=scale)


def _checked(transcript: Transcript, recognizer: ConnectedWordRecognizer, num_words: int | None) -> Transcript:
    """With a note where it is no whole sentence; words that begin a sentence of a grammar, and end none, are none."""
    if transcript.complete:
        return transcript
    if num_words is None and recognizer.grammar is not None:
        notes = (*transcript.notes, "no sentence of the grammar fits")
        return replace(transcript, words=(), log_score=0.0, notes=notes)
    short = f"too short for {num_words} words" if num_words is not None else "too short for a whole sentence"
    return replace(transcript, notes=(*transcript.notes, short))


def _lines(transcript: Transcript, times: bool, alternatives: bool) -> list[str]:
    """What is printed of a recording."""
    if times:
        return lines_of_words(transcript)
    if alternatives:
        return [f"{other.log_score:.1f}\t{other.text}" for other in transcript.alternatives]
    return [transcript.text + "".join(f"\t{slot}={value}" for slot, value in transcript.slots.items())]


def _confusions(recognizer: ConnectedWordRecognizer, file: str, num_words: int | None) -> list[dict[str, Any]]:
    """The confusion network, with seconds and labels in place of frames and models; None: no word."""
    lattice, first_s, frame_s = recognizer.lattice(file, num_words=num_words)
    labels = [*map(str, recognizer.classes_), SILENCE, UNKNOWN]
    return [
        {
            # The first frame may begin before the recording.
            "first_s": max(0.0, first_s + slot.first_frame * frame_s),
            "last_s": max(0.0, first_s + slot.last_frame * frame_s),
            "words": [{"label": labels[model] if model >= 0 else None, "probability": p} for model, p in slot.entries],
        }
        for slot in lattice.confusion_network(recognizer.trained_options.confidence_scale)
    ]


def _lines_of_places(confusions: list[dict[str, Any]]) -> list[str]:
    """What is printed of a confusion network: without what is rounded to 0."""
    lines = []
    for place in confusions:
        shares = [(f"{word['probability']:.3f}", word["label"] or NO_WORD) for word in place["words"]]
        words = [f"{label} {share}" for share, label in shares if float(share) > 0]
        lines.append("\t".join([f"{place['first_s']:.3f}", f"{place['last_s']:.3f}", *words]))
    return lines


def _follow(recognizer: ConnectedWordRecognizer, source: AudioSource, wake: str, times: bool, prefix: str) -> None:
    """A line of JSON for every result until the source ends; with `times` a line for every word of the final ones."""
    stream = ConnectedWordStream(recognizer, source.sample_rate_hz, wake_word=wake)

    def show(results: list[UtteranceResult]) -> None:
        for result in results:
            transcript = _checked(result.transcript, recognizer, None) if result.is_final else result.transcript
            if times:
                for line in _lines(transcript, True, False) if result.is_final else ():
                    click.echo(prefix + line)
                continue
            fields: dict[str, Any] = {"event": "final" if result.is_final else "partial", "source": source.name}
            fields |= {"first_s": round(result.first_s, 3), "last_s": round(result.last_s, 3)}
            fields |= {"num_stable": result.num_stable, **transcript.to_dict()}
            click.echo(json_line(fields))

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


def _write_lattice(recognizer: ConnectedWordRecognizer, file: str, num_words: int | None, path: Path) -> None:
    lattice, first_s, frame_s = recognizer.lattice(file, num_words=num_words)
    if lattice.empty:
        note(f"{file}: no sentence, no lattice")
        return
    labels = [*recognizer.classes_, SILENCE, UNKNOWN]
    weighed = (recognizer.language_scale, recognizer.insertion_penalty)
    make_folder(path.parent)
    WordLattice.of_lattice(lattice, labels, first_s, frame_s, *weighed).write(path)
