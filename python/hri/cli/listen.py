# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri listen``."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from dataclasses import asdict
from functools import partial
from pathlib import Path

import click

from hri.cli.answers import alternatives
from hri.cli.groups import CheckedCommand, is_given, refuse_given
from hri.cli.live_screen import (
    describe_stream,
    device_option,
    events_json_option,
    microphone,
    recording,
    report,
    stall_option,
)
from hri.cli.messages import note
from hri.cli.recognizers import embedding_option, kept_model, load_embedding
from hri.core.errors import InvalidArgument
from hri.core.files import MAX_MODEL_BYTES, read_bytes
from hri.live import Attention, AudioSource, Event, Listener, list_microphones
from hri.live.events import json_line
from hri.recognition import WordRecognizer


@click.command(cls=CheckedCommand)
@click.argument("files", nargs=-1, type=click.Path(exists=True, dir_okay=False))
@click.option(
    "--model",
    "model_path",
    type=click.Path(exists=True, dir_okay=False),
    help="A model from 'hri train speech'; the default is the one kept per user.",
)
@embedding_option
@device_option
@click.option("--list-devices", is_flag=True, help="List the microphones and end.")
@events_json_option
@click.option("--paced", is_flag=True, help="Play recordings as fast as they were spoken.")
@stall_option
@click.option("--wake", default="", metavar="WORD", help="Take commands only after this word of the vocabulary.")
@click.option(
    "--within", "within_s", type=float, default=3.0, show_default=True, help="Seconds from wake word to command."
)
@click.option(
    "--always",
    multiple=True,
    default=("stop",),
    show_default=True,
    metavar="WORD",
    help="A word that is a command at any moment, without the wake word.",
)
@click.option(
    "--min-score", type=float, metavar="E", help="Score a command needs; by default the model's own threshold."
)
@click.option("--locale", default="", help="Language of the words, passed on with decisions.")
@click.option("--top", type=click.IntRange(1), default=3, show_default=True, help="Alternatives to show.")
def listen(
    files: tuple[str, ...],
    model_path: str | None,
    embedding_path: str | None,
    device: str | None,
    list_devices: bool,
    as_json: bool,
    paced: bool,
    stall_s: float,
    wake: str,
    within_s: float,
    always: tuple[str, ...],
    min_score: float | None,
    locale: str,
    top: int,
) -> None:
    """Recognise words as they are spoken, from a microphone or from recordings played as a stream.

    On a terminal: level, start and end of speech, and every decision. Otherwise, or with --json-lines, one JSON
    object a line.

    \b
    Examples:
      hri listen
      hri listen --model words.hri --json-lines session.wav
      hri listen --wake robot --min-score 0.5
      hri listen --list-devices
    """
    if list_devices:
        _list_devices(as_json)
        return
    if not wake:
        refuse_given(("within_s", "always"), "goes with --wake")
    if files:
        refuse_given(("device", "stall_s"), "is of a microphone, and FILES take its place")
    else:
        refuse_given(("paced",), "is of recordings: name FILES")
    path = Path(model_path) if model_path else kept_model("speech")
    words = WordRecognizer.load(path, embedding=load_embedding(embedding_path))
    model_id = f"{path.name}:{hashlib.sha256(read_bytes(path, MAX_MODEL_BYTES)).hexdigest()[:12]}"
    if wake:
        _check_always(always, [str(label) for label in words.classes_])
    attention = Attention(wake, within_s, always, min_score)
    listener = Listener(words, attention=attention, locale=locale, model_id=model_id)
    if files:
        sources: Iterable[AudioSource] = (recording(file, paced) for file in files)
    else:
        sources = (microphone(device, stall_s) for _ in range(1))
    for source in sources:
        report(listener.listen(source), as_json, partial(describe, top=top))


def _check_always(always: tuple[str, ...], labels: list[str]) -> None:
    """Refuse words of --always that nothing can say, and warn where the default is none."""
    unknown = [word for word in always if word not in labels]
    if unknown and is_given("always"):
        raise InvalidArgument(f"--always '{unknown[0]}' is not in the vocabulary: {', '.join(labels)}")
    if unknown:
        named, there_are = " or ".join(unknown), f"there are {', '.join(labels)}"
        note(f"WARNING: no word is a command without the wake word: none is {named}; choose by --always, {there_are}")


def _list_devices(as_json: bool) -> None:
    microphones = list_microphones()
    for one in microphones:
        if as_json:
            click.echo(json_line(asdict(one)))
        else:
            mark = "*" if one.is_default else " "
            click.echo(f"{mark} {one.index}\t{one.name}\t{one.sample_rate_hz} Hz")
    if not microphones:
        click.echo("no microphone found", err=True)


def describe(event: Event, top: int) -> str:
    """One line of text; "" for events that are not shown."""
    if event.event == "wake":
        return f"{event.time:8.2f} s  listening for a command"
    if event.decision is None:
        return describe_stream(event)
    place = f"{event.fields['first_s']:8.2f} - {event.fields['last_s']:.2f} s"
    return f"{place}  {event.decision.label}  ({alternatives(event.decision, top)})"
