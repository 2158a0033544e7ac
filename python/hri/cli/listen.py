# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri listen``."""

from __future__ import annotations

import hashlib
import json
import sys
from collections.abc import Iterable
from dataclasses import asdict
from pathlib import Path

import click

from hri.cli.recognizers import kept_model
from hri.live import AudioSource, Event, FileSource, Listener, MicrophoneSource, list_microphones
from hri.recognition import WordRecognizer


@click.command()
@click.argument("files", nargs=-1, type=click.Path(exists=True, dir_okay=False))
@click.option(
    "--model",
    "model_path",
    type=click.Path(exists=True, dir_okay=False),
    help="A model from 'hri train speech'; the default is the one kept per user.",
)
@click.option("--device", help="Number or part of the name of the microphone.")
@click.option("--list-devices", is_flag=True, help="List the microphones and end.")
@click.option("--json", "as_json", is_flag=True, help="Write JSON lines also on a terminal.")
@click.option("--paced", is_flag=True, help="Play recordings as fast as they were spoken.")
@click.option("--stall", "stall_s", type=float, default=2.0, show_default=True, help="Seconds without sound to end at.")
@click.option("--locale", default="", help="Language of the words, passed on with decisions.")
@click.option("--top", type=click.IntRange(1), default=3, show_default=True, help="Alternatives to show.")
def listen(
    files: tuple[str, ...],
    model_path: str | None,
    device: str | None,
    list_devices: bool,
    as_json: bool,
    paced: bool,
    stall_s: float,
    locale: str,
    top: int,
) -> None:
    """Recognise words as they are spoken, from a microphone or from recordings played as a stream.

    On a terminal: level, start and end of speech, and what was understood. Otherwise, or with --json, one JSON
    object a line.

    \b
    Examples:
      hri listen
      hri listen --model words.hri --json session.wav
      hri listen --list-devices
    """
    if list_devices:
        _list_devices(as_json)
        return
    path = Path(model_path) if model_path else kept_model("speech")
    words = WordRecognizer.load(path)
    model_id = f"{path.name}:{hashlib.sha256(path.read_bytes()).hexdigest()[:12]}"
    listener = Listener(words, locale=locale, model_id=model_id)
    if files:
        sources: Iterable[AudioSource] = (FileSource(file, paced) for file in files)
    else:
        number = int(device) if device is not None and device.isdigit() else device
        sources = (MicrophoneSource(number, stall_s=stall_s) for _ in range(1))
    for source in sources:
        if as_json or not sys.stdout.isatty():
            for event in listener.listen(source):
                click.echo(event.to_json())
                sys.stdout.flush()
        else:
            _show(listener.listen(source), top)


def _list_devices(as_json: bool) -> None:
    microphones = list_microphones()
    for microphone in microphones:
        if as_json:
            click.echo(json.dumps(asdict(microphone), ensure_ascii=False))
        else:
            mark = "*" if microphone.is_default else " "
            click.echo(f"{mark} {microphone.index}\t{microphone.name}\t{microphone.sample_rate_hz} Hz")
    if not microphones:
        click.echo("there is no microphone", err=True)


def _show(events: Iterable[Event], top: int) -> None:
    """A line that follows the level; above it, what was understood."""
    from rich.live import Live
    from rich.text import Text

    with Live(refresh_per_second=20) as screen:
        for event in events:
            line = describe(event, top)
            if event.event == "level":
                screen.update(Text(meter(event)))
            elif line:
                screen.console.print(Text(line))


def meter(event: Event, width: int = 40) -> str:
    """The level as a bar from -80 to 0 dB."""
    level_db = float(event.fields["level_db"])
    filled = max(0, min(width, round(width * (level_db + 80) / 80)))
    state = "speech" if event.fields["in_speech"] else "      "
    return f"{'█' * filled}{'·' * (width - filled)} {level_db:6.1f} dB  {state}  {event.time:7.1f} s"


def describe(event: Event, top: int) -> str:
    """One line for people; "" for what they need not read."""
    if event.event == "listening":
        return f"listening to {event.fields['source']} at {event.fields['sample_rate_hz']} Hz; Ctrl-C ends"
    if event.event == "overflow":
        return f"{event.time:8.2f} s  {event.fields['lost_samples']} samples lost: this computer is too busy"
    if event.event == "stall":
        return f"{event.time:8.2f} s  {event.fields['message']}"
    if event.decision is None:
        return ""
    best = ", ".join(f"{entry.label} {entry.probability:.3f}" for entry in event.decision.nbest[:top])
    place = f"{event.fields['first_s']:8.2f} - {event.fields['last_s']:.2f} s"
    return f"{place}  {event.decision.label}  ({best or event.decision.status})"
