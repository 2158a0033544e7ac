# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri record``."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import click

from hri.cli.live_screen import describe_stream, device_option, events_json_option, microphone, stall_option, tell
from hri.errors import FormatError
from hri.live import AudioSource, Event, FileSource, WordRecorder


@click.group()
def record() -> None:
    """Make a data set of your own.

    \b
    Example:
      hri record word go stop left right --person asha --out commands/
    """


@record.command()
@click.argument("labels", nargs=-1, required=True, metavar="WORD...")
@click.option("--out", required=True, type=click.Path(file_okay=False), metavar="DIR", help="Folder to add to.")
@click.option("--person", required=True, help="Who speaks.")
@click.option("--takes", default=5, show_default=True, type=click.IntRange(1, 10000), help="Recordings of every word.")
@click.option(
    "--from",
    "files",
    multiple=True,
    type=click.Path(exists=True, dir_okay=False),
    metavar="FILE",
    help="Listen to this recording of the words, in the order they are asked for, instead of a microphone.",
)
@device_option
@stall_option
@events_json_option
def word(
    labels: tuple[str, ...],
    out: str,
    person: str,
    takes: int,
    files: tuple[str, ...],
    device: str | None,
    stall_s: float,
    as_json: bool,
) -> None:
    """Record words from the microphone, label by label, into a folder that 'hri train speech' reads.

    Asks for one word after the other and finds where it begins and ends. What is in the folder already stays and is
    not asked for again: after Ctrl-C the same command goes on. To record a take anew, delete its file.

    \b
    Examples:
      hri record word go stop left right --person asha --out commands/
      hri record word go stop --person ben --takes 10 --device 2 --out commands/
      hri record word go stop --person cem --takes 1 --from cem.wav --out commands/
    """
    recorder = WordRecorder(out, labels, person, takes)
    sources: Iterable[AudioSource] = (FileSource(file) for file in files)
    if not files and recorder.missing():
        sources = (microphone(device, stall_s) for _ in range(1))
    for source in sources:
        tell(recorder.record(source), as_json, describe)
    missing = recorder.missing()
    done = f"{recorder.num_takes - len(missing)} of {recorder.num_takes} recordings by {person} are in {out}"
    click.echo(done, err=True)
    if missing:
        raise FormatError(f"{', '.join(files)}: ended before '{missing[0][0]}', take {missing[0][1]}")


def describe(event: Event) -> str:
    """One line for people; "" for what they need not read."""
    fields = event.fields
    if event.event == "prompt":
        return f"{fields['done'] + 1:4d} of {fields['total']}: say  {fields['label']}"
    if event.event == "recorded":
        return f"             {fields['duration_s']:.1f} s, {fields['peak_db']:.0f} dB: {Path(fields['path']).name}"
    if event.event == "refused":
        return f"             not kept: {fields['reason']}"
    return describe_stream(event)
