# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri record``."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from pathlib import Path

import click

from hri.cli.groups import SuggestingGroup, refuse_given
from hri.cli.live_screen import (
    camera,
    camera_option,
    describe_stream,
    device_option,
    events_json_option,
    microphone,
    recording,
    report,
    stall_option,
)
from hri.cli.messages import note
from hri.cli.result_screen import ResultScreen
from hri.core.display import count
from hri.core.errors import FormatError
from hri.live import AudioSource, Event, FrameSource, GestureRecorder, VideoSource, WordRecorder


@click.group(cls=SuggestingGroup)
def record() -> None:
    """Make a data set of your own.

    \b
    Example:
      hri record word go stop left right --person asha --out commands/
      hri record gesture wave circle push --person asha --out signs/
    """


@record.command()
@click.argument("labels", nargs=-1, required=True, metavar="WORD...")
@click.option("--out", required=True, type=click.Path(file_okay=False), metavar="DIR", help="Folder to add to.")
@click.option("--person", required=True, help="The speaker.")
@click.option("--takes", default=5, show_default=True, type=click.IntRange(1, 10000), help="Recordings of every word.")
@click.option(
    "--from",
    "files",
    multiple=True,
    type=click.Path(exists=True, dir_okay=False),
    metavar="FILE",
    help="Take this recording of the words, in the order of the prompts, instead of a microphone.",
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

    Prompts for one word after the other and endpoints each. Recordings in the folder are kept and not prompted for:
    after Ctrl-C the same command resumes. To record a take anew, delete its file.

    \b
    Examples:
      hri record word go stop left right --person asha --out commands/
      hri record word go stop --person ben --takes 10 --device 2 --out commands/
      hri record word go stop --person cem --takes 1 --from cem.wav --out commands/
    """
    if files:
        refuse_given(("device", "stall_s"), "is of a microphone, and --from takes its place")
    recorder = WordRecorder(out, labels, person, takes)
    sources: Iterable[AudioSource] = (recording(file) for file in files)
    if not files and recorder.missing():
        sources = (microphone(device, stall_s) for _ in range(1))
    for source in sources:
        report(recorder.record(source), as_json, describe)
    _summarise(recorder, person, out, files)


@record.command()
@click.argument("labels", nargs=-1, required=True, metavar="GESTURE...")
@click.option("--out", required=True, type=click.Path(file_okay=False), metavar="DIR", help="Folder to add to.")
@click.option("--person", required=True, help="Who is seen.")
@click.option(
    "--takes", default=5, show_default=True, type=click.IntRange(1, 10000), help="Recordings of each gesture."
)
@click.option("--hands", type=click.Choice(["one", "both"]), default="one", show_default=True, help="Hands that sign.")
@click.option("--held", is_flag=True, help="Signs that are held: the hand comes into view with them.")
@click.option(
    "--pause", "pause_s", default=2.5, show_default=True, type=float, help="Seconds to go back before the next prompt."
)
@click.option(
    "--from",
    "files",
    multiple=True,
    type=click.Path(exists=True, dir_okay=False),
    metavar="FILE",
    help="Watch this video of the gestures, in the order they are asked for, instead of a camera.",
)
@camera_option
@click.option("--show", is_flag=True, help="Show the picture and the hand in a window.")
@stall_option
@events_json_option
def gesture(
    labels: tuple[str, ...],
    out: str,
    person: str,
    takes: int,
    hands: str,
    held: bool,
    pause_s: float,
    files: tuple[str, ...],
    device: str,
    show: bool,
    stall_s: float,
    as_json: bool,
) -> None:
    """Record gestures from the camera, label by label, into a folder that 'hri train gesture' reads.

    Asks for one gesture after the other and finds where it begins and ends. Dynamic gestures begin and end with the
    hand at rest in view; signs (--held) come into view and are held. What is in the folder already stays and is not
    asked for again: after Ctrl-C the same command goes on. To record a take anew, delete its file.

    \b
    Examples:
      hri record gesture wave circle push --person asha --out signs/
      hri record gesture one two five --held --person ben --device 1 --out digits/
      hri record gesture wave circle --person cem --takes 1 --from cem.mp4 --out signs/
      hri record gesture clap part --hands both --person asha --out pairs/
    """
    if files:
        refuse_given(("device", "stall_s"), "is of a camera, and --from takes its place")
    recorder = GestureRecorder(
        out, labels, person, takes, held=held, num_hands=1 if hands == "one" else 2, pause_s=pause_s
    )
    sources: Iterable[FrameSource] = (VideoSource(file) for file in files)
    if not files and recorder.missing():
        sources = (camera(device, stall_s) for _ in range(1))
    for source in sources:
        with ResultScreen(None, source.fps, show, 1) as screen:
            report(recorder.record(source, partial(screen.draw, decision=None)), as_json, describe)
    _summarise(recorder, person, out, files)


def _summarise(recorder: WordRecorder | GestureRecorder, person: str, out: str, files: tuple[str, ...]) -> None:
    missing = recorder.missing()
    done = f"{recorder.num_takes - len(missing)} of {count(recorder.num_takes, 'recording')} by {person} are in {out}"
    note(done)
    if missing:
        raise FormatError(f"{', '.join(files)}: ended before '{missing[0][0]}', take {missing[0][1]}")


def describe(event: Event) -> str:
    """One line of text; "" for events that are not shown."""
    fields = event.fields
    if event.event == "prompt":
        what = "show" if event.mode == "gesture" else "say"
        return f"{fields['done'] + 1:4d} of {fields['total']}: {what}  {fields['label']}"
    if event.event == "recorded":
        how = f"{fields['peak_db']:.0f} dB" if "peak_db" in fields else f"quality {fields['quality']:.2f}"
        return f"             {fields['duration_s']:.1f} s, {how}: {Path(fields['path']).name}"
    if event.event == "refused":
        return f"             not kept: {fields['reason']}"
    return describe_stream(event)
