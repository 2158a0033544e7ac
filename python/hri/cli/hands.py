# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri hands``."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from hri.cli.faces import faces_option
from hri.cli.groups import CheckedCommand, FiniteRange
from hri.cli.messages import note
from hri.cli.output import OutputFile, write_json, write_text
from hri.cli.progress import progress_bars
from hri.cli.recognizers import naming_options, parse_options
from hri.core.display import count
from hri.features.hand import HAND_KINDS, hand_column_names
from hri.media import DEFAULT_FPS, VIDEO_SUFFIXES, Clip, read_frames, read_image, read_pictures
from hri.vision.film import film_hands
from hri.vision.hands import background_of
from hri.vision.report import SOURCES, HandReport, inspect_hands

METHODS = ("chroma_otsu", "hsv_narrow", "hsv_wide", "grey_otsu")


@click.command(cls=CheckedCommand)
@click.argument("clip", type=click.Path(exists=True))
@click.option(
    "--source",
    type=click.Choice(SOURCES),
    default="silhouettes",
    show_default=True,
    help="What is looked for; landmarks need the extra mediapipe.",
)
@click.option(
    "--kind",
    type=click.Choice(list(HAND_KINDS)),
    help="Features of silhouettes, as 'hri features' gives them.  [default: track]",
)
@click.option(
    "--option",
    "options",
    multiple=True,
    metavar="NAME=VALUE",
    help="A field of the kind's options, such as delta_orders=0; may be given several times.",
)
@click.option(
    "--max-hands",
    type=click.IntRange(1, 2),
    default=1,
    show_default=True,
    help="2 looks for the left and the right hand of the picture.",
)
@click.option(
    "--method",
    type=click.Choice(METHODS),
    help="Find the hand in every picture by itself: Otsu's threshold on chroma or grey, or fixed HSV bounds.  "
    "[default: by colours learned from the clip]",
)
@click.option(
    "--background",
    metavar="FILE",
    help="A picture of the place without a person; what looks like skin there as well is no hand.  'clip': what most "
    "frames of the clip show.",
)
@faces_option("never: an open palm may look like a face")
@click.option("--as-found", is_flag=True, help="Leave masks that jump for a frame or two as they are.")
@click.option(
    "--fps",
    type=FiniteRange(min=0, min_open=True),
    help=f"At which the pictures of a folder were taken.  [default: {DEFAULT_FPS:g}]",
)
@click.option(
    "--video",
    "video_path",
    type=OutputFile(VIDEO_SUFFIXES),
    metavar="FILE",
    help="Film what is found: frame, mask, outline, track, features and quality.",
)
@click.option(
    "-o",
    "--out",
    type=OutputFile((".csv", ".json")),
    metavar="FILE",
    help="Where to write the table, .csv or .json; without it, and without --video, to standard output.",
)
def hands(
    clip: str,
    source: Any,
    kind: Any,
    options: tuple[str, ...],
    max_hands: int,
    method: str | None,
    background: str | None,
    faces: str | None,
    as_found: bool,
    fps: float | None,
    video_path: str | None,
    out: str | None,
) -> None:
    """Show what is found of the hand in CLIP: a video, a picture, or a folder of pictures in the order of their names.

    No trained model is needed. The table has a row for every frame: time, quality (0 no hand .. 1), whether the mask
    was repaired by those around it, the hand's middle and area in shares of the picture, and features; cells are empty
    where there is no hand.

    \b
    Examples:
      hri hands swipe.mp4 --video seen.mp4 -o seen.csv
      hri hands pictures/ --fps 15 --kind fourier --video seen.webm
      hri hands swipe.mp4 --source landmarks -o joints.json
      hri hands clap.mp4 --max-hands 2 --video seen.mp4
      hri hands room.mp4 --faces auto --video seen.mp4
      hri hands swipe.mp4 --method hsv_wide --background empty_room.jpg --video seen.mp4
    """
    if (kind is not None or options) and source != "silhouettes":
        raise click.UsageError("--kind and --option are for silhouettes: landmarks have but one kind of features")
    if max_hands > 1 and source != "silhouettes":
        raise click.UsageError("--max-hands 2 is for silhouettes")
    if (method is not None or background is not None) and source != "silhouettes":
        raise click.UsageError("--method and --background are for silhouettes")
    if faces is not None and source != "silhouettes":
        raise click.UsageError("--faces is for silhouettes")
    if faces not in (None, "never") and (method is not None or background is not None):
        raise click.UsageError("--faces cannot go with --method or --background")
    if fps is not None and not Path(clip).is_dir():
        raise click.UsageError(f"--fps is for folders of pictures: {clip} is a file")
    chosen: Any = kind or "track"
    fields = parse_options(options)
    with naming_options():
        hand_column_names(chosen, **fields)
    read = _read(clip, fps)
    with progress_bars() as progress:
        report = inspect_hands(
            read,
            source,
            chosen,
            progress=lambda done, total: progress("finding hands", done, total),
            max_hands=max_hands,
            smooth=not as_found,
            silhouette=_options(method),
            background=_background(background, read),
            faces=faces or "never",
            **fields,
        )
        if video_path is not None:
            film_hands(report, video_path, lambda done, total: progress("filming", done, total))
    _write_table(report, out, video_path)
    written = ", ".join(path for path in (video_path, out) if path is not None)
    for side, found in report.hands.items():
        which = "a hand" if side == "hand" else f"a {side} hand"
        num_found = sum(hand.found for hand in found)
        note(f"{written or clip}: {which} in {num_found} of {count(len(found), 'frame')}")


def _options(method: Any) -> Any:
    from hri.vision import SilhouetteOptions

    return None if method is None else SilhouetteOptions(method=method)


def _background(background: str | None, clip: Clip) -> Any:
    if background is None:
        return None
    return background_of(clip.frames) if background == "clip" else read_image(background)


def _read(clip: str, fps: float | None) -> Clip:
    return read_pictures(clip, fps or DEFAULT_FPS) if Path(clip).is_dir() else read_frames(clip)


def _write_table(report: HandReport, out: str | None, video_path: str | None) -> None:
    if out is None:
        if video_path is None:
            click.echo(report.table("\t"), nl=False)
    elif Path(out).suffix.lower() == ".json":
        write_json(out, report.as_dict())
    else:
        write_text(Path(out), report.table())
