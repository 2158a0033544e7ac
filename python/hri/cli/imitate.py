# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri robot imitate``."""

from __future__ import annotations

from pathlib import Path

import click

from hri.cli.groups import CheckedCommand, FiniteRange
from hri.cli.messages import note
from hri.cli.output import OutputFile, json_option, say, write_json
from hri.core.errors import InvalidArgument
from hri.media import VIDEO_SUFFIXES
from hri.robot.imitation.imitate import FORMS, Imitation, ImitationOptions
from hri.robot.imitation.imitate import imitate as make_imitation
from hri.robot.imitation.tracks import HandTrack, read_hand_tracks
from hri.robot.imitation.video import film_imitation
from hri.robot.motion.pulse_csv import write_pulse_csv


@click.command(cls=CheckedCommand, short_help="Turn a person's hand track into a motion of the arms.")
@click.argument("file", type=click.Path(exists=True, dir_okay=False, path_type=Path))
@click.option(
    "--out", type=OutputFile((".csv",), path_type=Path), required=True, help="The motion as a pulse CSV file."
)
@click.option("--track", "name", help="Which track, in a file with several (column video).")
@click.option("--fps", type=FiniteRange(0, 1000, min_open=True), default=30.0, show_default=True)
@click.option("--height-px", type=float, help="The person's height in pixels; guessed if not given.")
@click.option(
    "--form", type=click.Choice(FORMS), default="search", show_default=True, help="Best poses, or plain angles."
)
@click.option("--mirrored", is_flag=True, help="The picture was mirrored, as programs show webcams.")
@click.option(
    "--video", type=OutputFile(VIDEO_SUFFIXES, path_type=Path), help="Film the track and the robot side by side."
)
@json_option
def imitate(
    file: Path,
    out: Path,
    name: str | None,
    fps: float,
    height_px: float | None,
    mirrored: bool,
    form: str,
    video: Path | None,
    json_path: str | None,
) -> None:
    """Turn a track of a person's hands, the CSV file FILE, into a motion of the robot's arms.

    FILE has a header with left-x, left-y, right-x, right-y and nose-x, nose-y or left-shoulder-x to right-shoulder-y,
    in pixels; empty cells are frames in which something was not seen. What was bridged, and how much of the track is
    within the robot's reach, goes to stderr.

    \b
    Examples:
      hri robot imitate hands.csv --out motion.csv
      hri robot imitate sentences.csv --track 98 --out motion.csv --video both.mp4
    """
    if out.suffix.lower() != ".csv":
        raise InvalidArgument(f"{out}: suffix must be .csv")
    track = _chosen(read_hand_tracks(file, fps), file, name)
    if mirrored:
        track = track.unmirrored()
    made = make_imitation(track, ImitationOptions(form=form, height_px=height_px))
    write_pulse_csv(out, made.trajectory)
    _tell(made, height_px is None)
    write_json(json_path, made.report())
    if video is not None:
        film_imitation(track, made, video)
    say(str(out), json_path)


def _chosen(tracks: dict[str, HandTrack], file: Path, name: str | None) -> HandTrack:
    if name is None and len(tracks) == 1:
        return next(iter(tracks.values()))
    names = ", ".join(list(tracks)[:10]) + (f" and {len(tracks) - 10} more" if len(tracks) > 10 else "")
    if name is None:
        raise InvalidArgument(f"{file} has several tracks, --track chooses one: {names}")
    if name not in tracks:
        raise InvalidArgument(f"{file} has no track {name!r}; there are {names}")
    return tracks[name]


def _tell(made: Imitation, guessed: bool) -> None:
    how = "guessed from the track" if guessed else "as given"
    note(f"the person's height: {made.targets.height_px:.0f} px, {how}")
    for gap in made.gaps:
        note(f"{gap.what} not seen in frames {gap.first} to {gap.last}: bridged")
    report = made.report()
    for side, share in report["reached"].items():
        note(f"{side} hand: {100 * share:.1f} % of the frames it is seen in are within reach")
    rms = "nothing is within reach" if report["rms_m"] is None else f"{1000 * report['rms_m']:.1f} mm"
    note(f"distance from the scaled track there, root mean square: {rms}")
    note(f"{report['slower']:.2f} times as long as the track; {made.trajectory.duration_s:.1f} s in all")
