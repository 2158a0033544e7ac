# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri watch``."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from functools import partial
from pathlib import Path

import click

from hri.cli.answers import alternatives
from hri.cli.faces import faces_option, look_for_faces
from hri.cli.groups import CheckedCommand, refuse_given
from hri.cli.live_screen import camera, camera_option, describe_stream, events_json_option, report, stall_option
from hri.cli.messages import note
from hri.cli.output import OutputFile
from hri.cli.recognizers import kept_model, load_signs
from hri.cli.result_screen import ResultScreen
from hri.core.errors import InvalidArgument
from hri.core.files import MAX_MODEL_BYTES, read_bytes
from hri.live import Event, FrameSource, PersonTracks, SignWatcher, VideoSource, Watcher
from hri.media import VIDEO_SUFFIXES, kind_of_file
from hri.recognition import SentenceRecognizer
from hri.vision.faces import face_finder


@click.command(cls=CheckedCommand)
@click.argument("files", nargs=-1, type=click.Path(exists=True, dir_okay=False))
@click.option(
    "--model",
    "model_path",
    type=click.Path(exists=True, dir_okay=False),
    help="A model from 'hri train gesture' or 'hri train-sentences'; the default is the one kept per user.",
)
@camera_option
@events_json_option
@click.option("--paced", is_flag=True, help="Play videos as fast as they were filmed.")
@stall_option
@click.option(
    "--reconnect",
    "reconnect_s",
    type=float,
    default=30.0,
    show_default=True,
    help="Seconds for which a camera that stalled is opened again; 0 ends at once.",
)
@click.option(
    "--video",
    "video_path",
    type=OutputFile(VIDEO_SUFFIXES),
    metavar="FILE",
    help="Film what is seen: picture, mask, outline, track and n-best.",
)
@click.option("--show", is_flag=True, help="Show the same in a window.")
@faces_option("as the model was trained")
@click.option("--top", type=click.IntRange(1), default=3, show_default=True, help="Alternatives to show.")
def watch(
    files: tuple[str, ...],
    model_path: str | None,
    device: str,
    as_json: bool,
    paced: bool,
    stall_s: float,
    reconnect_s: float,
    video_path: str | None,
    show: bool,
    faces: str | None,
    top: int,
) -> None:
    """Recognise gestures as they are shown, from a camera or from videos played as a stream.

    With a model from 'hri train-sentences' signs follow on one another in sentences, which end as the hands rest.

    On a terminal: where the hand is, gesture segments, and decisions. Otherwise, or with --json-lines, one JSON object
    a line.

    \b
    Examples:
      hri watch
      hri watch --model signs.hri --json-lines session.mp4
      hri watch --device 1 --video seen.mp4
    """
    if video_path is not None and len(files) > 1:
        raise InvalidArgument("--video films one stream: give one file, or a camera")
    if files:
        refuse_given(("device", "stall_s", "reconnect_s"), "is of a camera, and FILES take its place")
    else:
        refuse_given(("paced",), "is of videos: name FILES")
    for file in files:
        if kind_of_file(Path(file)) == "a picture":
            raise InvalidArgument(f"{file} is a picture, and a video is needed here; 'hri recognise' takes pictures")
    path = Path(model_path) if model_path else kept_model("gesture")
    signs = load_signs(path)
    look_for_faces(signs, faces)
    if not isinstance(signs, SentenceRecognizer) and signs.options.source == "landmarks":
        note("hands: by their joints, as MediaPipe finds them")
    model_id = f"{path.name}:{hashlib.sha256(read_bytes(path, MAX_MODEL_BYTES)).hexdigest()[:12]}"
    sources: Iterable[FrameSource] = (VideoSource(file, paced) for file in files)
    if not files:
        sources = (camera(device, stall_s) for _ in range(1))
    for source in sources:
        with ResultScreen(video_path, source.fps, show, top) as screen:
            watcher: Watcher | SignWatcher
            if isinstance(signs, SentenceRecognizer):
                hands = PersonTracks(face_finder(faces or "auto", required=True))
                watcher = SignWatcher(
                    signs, hands=hands, reconnect_s=reconnect_s, model_id=model_id, on_result=screen.draw
                )
            else:
                watcher = Watcher(signs, reconnect_s=reconnect_s, model_id=model_id, on_result=screen.draw)
            report(watcher.watch(source), as_json, partial(describe, top=top))


def describe(event: Event, top: int) -> str:
    """One line for people; "" for what they need not read."""
    if event.event == "signed":
        return f"{event.fields['first_s']:8.2f} - {event.fields['last_s']:.2f} s  {' '.join(event.fields['words'])}"
    if event.event != "decision" or event.decision is None:
        return describe_stream(event)
    place = f"{event.fields['first_s']:8.2f} - {event.fields['last_s']:.2f} s"
    return f"{place}  {event.decision.label}  ({alternatives(event.decision, top)})"
