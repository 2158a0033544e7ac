# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What commands that listen or watch have in common: devices by name, the meter, one line of JSON an event."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from os import PathLike

import click

from hri.cli.answers import alternatives
from hri.cli.messages import note
from hri.core.errors import IoError
from hri.live import CameraSource, Event, FileSource, MicrophoneSource
from hri.live.visibility import missing_text

device_option = click.option("--device", help="Number or part of the name of the microphone.")
events_json_option = click.option("--json-lines", "as_json", is_flag=True, help="Write JSON lines also on a terminal.")
stall_option = click.option(
    "--stall",
    "stall_s",
    type=float,
    default=2.0,
    show_default=True,
    help="Seconds without sound or picture after which a microphone or camera counts as gone.",
)
camera_option = click.option("--device", default="0", show_default=True, help="Number or address of the camera.")


def microphone(device: str | None, stall_s: float, buffer_s: float = 5.0) -> MicrophoneSource:
    """The microphone of that number or name, the default one for None; errors as of `MicrophoneSource`."""
    chosen = int(device) if device is not None and device.isdigit() else device
    return MicrophoneSource(chosen, stall_s=stall_s, buffer_s=buffer_s)


def camera(device: str, stall_s: float, option: str = "--device") -> CameraSource:
    """The camera of that number or address; an IoError says which option names another."""
    try:
        return CameraSource(int(device) if device.isdigit() else device, stall_s=stall_s)
    except IoError as error:
        raise IoError(f"{error}; {option} names another") from error


def recording(path: str | PathLike[str], paced: bool = False) -> FileSource:
    """The recording as a stream; what is wrong with the file is said."""
    source = FileSource(path, paced)
    for text in source.notes:
        note(f"{path}: {text}")
    return source


def report(events: Iterable[Event], as_json: bool, describe: Callable[[Event], str], plain: bool = False) -> None:
    """Every event as a line of JSON; on a terminal, unless --json-lines is given, the level and what `describe` makes
    of the others, which with `plain` is written in place of JSON where there is no terminal, too."""
    if as_json or not sys.stdout.isatty():
        for event in events:
            line = describe(event) if plain and not as_json else event.to_json()
            if line:
                click.echo(line)
                sys.stdout.flush()
        return
    from rich.live import Live
    from rich.text import Text

    with Live(refresh_per_second=20) as screen:
        for event in events:
            line = describe(event)
            if event.event in ("level", "hand", "partial", "signing"):
                screen.update(Text(meter(event) if event.event == "level" else hand_line(event)))
            elif line:
                screen.console.print(Text(line))


def meter(event: Event, width: int = 40) -> str:
    """The level as a bar from -80 to 0 dB."""
    level_db = float(event.fields["level_db"])
    filled = max(0, min(width, round(width * (level_db + 80) / 80)))
    state = "speech" if event.fields["in_speech"] else "       "
    return f"{'█' * filled}{'·' * (width - filled)} {level_db:6.1f} dB  {state}  {event.time:7.1f} s"


def hand_line(event: Event) -> str:
    """Where the hand is, what is missing for it to be seen, or what a gesture looks like so far."""
    if event.event == "signing":
        return f"so far  {' '.join(event.fields['words'])}  {event.time:7.1f} s"
    if event.decision is not None:
        return f"so far  {alternatives(event.decision, 3)}  {event.time:7.1f} s"
    fields = event.fields
    if missing := missing_text(fields.get("missing", "")):
        return f"{missing}  {event.time:7.1f} s"
    if fields["x"] is None:
        return f"no hand  {event.time:7.1f} s"
    state = "gesture" if fields["in_gesture"] else "       "
    return (
        f"hand at {fields['x']:.2f}, {fields['y']:.2f}  quality {fields['quality']:.2f}  {state}  {event.time:7.1f} s"
    )


def describe_stream(event: Event) -> str:
    """One line for people about the stream itself; "" for what they need not read."""
    if event.event == "listening":
        return f"listening to {event.fields['source']} at {event.fields['sample_rate_hz']} Hz; Ctrl-C ends"
    if event.event == "watching":
        return f"watching {event.fields['source']}; Ctrl-C ends"
    if event.event == "reconnected":
        return f"{event.time:8.2f} s  the {'microphone' if event.mode == 'speech' else 'camera'} is back"
    if event.event == "overflow":
        lost = next(f"{count} {name.removeprefix('lost_')}" for name, count in event.fields.items())
        return f"{event.time:8.2f} s  {lost} lost: this computer is too busy"
    if event.event == "stall":
        return f"{event.time:8.2f} s  {event.fields['message']}"
    return ""
