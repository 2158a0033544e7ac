# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri recognise``."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import click

from hri.cli.answers import alternatives, confidence_text
from hri.cli.faces import faces_option, look_for_faces
from hri.cli.groups import CheckedCommand, refuse_given
from hri.cli.messages import note
from hri.cli.output import OutputFile, json_option, say, write_json
from hri.cli.progress import progress_bars
from hri.cli.recognizers import embedding_option, kept_model, load_embedding
from hri.core.errors import Error, InvalidArgument
from hri.core.suggest import did_you_mean
from hri.fusion import RULES, FusedDecision, FusionOptions, LearnedFusion, fuse
from hri.media import IMAGE_SUFFIXES, VIDEO_SUFFIXES, kind_of_file, write_image
from hri.recognition import Decision, GestureRecognizer, load
from hri.recognition.decision import RECOGNISED

_file = click.Path(exists=True, dir_okay=False)


@click.command(cls=CheckedCommand)
@click.argument("files", nargs=-1, type=click.Path(exists=True), metavar="[FILE]...")
@click.option("--speech", type=_file, help="A recording of one spoken word.")
@click.option("--gesture", type=click.Path(exists=True), help="A picture, video or folder of pictures of one sign.")
@click.option(
    "--speech-model",
    type=_file,
    help="A model from 'hri train speech' or 'hri train-units'; the default is the one kept per user by the first.",
)
@embedding_option
@click.option("--gesture-model", type=_file, help="The same for gestures.")
@faces_option("as the model was trained")
@click.option("--rule", type=click.Choice(RULES), default=RULES[0], show_default=True, help="How both are fused.")
@click.option("--fusion", "fusion_path", type=_file, metavar="FILE", help="A learned fusion, in place of --rule.")
@click.option(
    "--robot",
    "robot_path",
    type=OutputFile((*VIDEO_SUFFIXES, *IMAGE_SUFFIXES)),
    metavar="FILE",
    help="Film the robot's answer (.mp4, .webm, ...), or picture its end (.png, .jpg).",
)
@click.option(
    "--backend",
    type=click.Choice(["pybullet", "kinematic"]),
    default="pybullet",
    show_default=True,
    help="The robot with physics, or without.",
)
@click.option("--gui", is_flag=True, help="Show the robot in a window (pybullet).")
@click.option("--top", type=click.IntRange(1), default=3, show_default=True, help="Alternatives to list of each mode.")
@json_option
def recognise(
    files: tuple[str, ...],
    speech: str | None,
    gesture: str | None,
    speech_model: str | None,
    embedding_path: str | None,
    gesture_model: str | None,
    faces: str | None,
    rule: str,
    fusion_path: str | None,
    robot_path: str | None,
    backend: str,
    gui: bool,
    top: int,
    json_path: str | None,
) -> None:
    """Recognise a spoken word, a sign, or both fused; print label, confidence and the rule that fired.

    FILE is a recording of a word, or a picture, video or folder of pictures of a sign: one of each at most; --speech
    and --gesture say which is which. "unknown", "no_input" and "ask" (an unsure STOP) are answers too: the robot then
    does not move.

    \b
    Examples:
      hri recognise seven.wav
      hri recognise seven.wav seven.jpg
      hri recognise --speech seven.wav --gesture seven.jpg --robot robot.webm
      hri recognise --gesture clip.mp4 --gui
      hri recognise --speech seven.wav --gesture seven.jpg --rule product --json -
    """
    for file in files:
        if _is_sound(file):
            speech = _only_one(speech, file, "words")
        else:
            gesture = _only_one(gesture, file, "signs")
    if speech is None and gesture is None:
        raise click.UsageError("give a recording: --speech FILE, --gesture FILE, or both")
    if speech is None:
        refuse_given(("speech_model", "embedding_path"), "is of speech, and no recording of a word is given")
    if gesture is None:
        refuse_given(("gesture_model",), "is of signs, and no recording of one is given")
    if speech is None or gesture is None:
        refuse_given(("rule", "fusion_path"), "is for a word and a sign together")
    if fusion_path is not None:
        refuse_given(("rule",), "and --fusion exclude each other")
    if robot_path is None and not gui:
        refuse_given(("backend",), "goes with --robot or --gui")
    if faces is not None and gesture is None:
        raise click.UsageError("--faces is for signs: --gesture FILE")
    if gui and backend != "pybullet":
        raise click.UsageError("--gui needs --backend pybullet")
    learned = None if fusion_path is None else LearnedFusion.load(fusion_path)
    heard = seen = None
    if speech is not None:
        words = load(speech_model or kept_model("speech"), "speech", embedding=load_embedding(embedding_path))
        heard = words.recognise(speech)
        _describe(heard, speech, top)
    if gesture is not None:
        signs = GestureRecognizer.load(gesture_model or kept_model("gesture"))
        look_for_faces(signs, faces)
        seen = signs.recognise(gesture)
        _describe(seen, gesture, top)
    decision = fuse(heard, seen, rule=learned or rule)
    say(f"{decision.label}\t{confidence_text(decision)}\t{decision.rule}", json_path)
    answer = None
    try:
        if robot_path is not None or gui:
            answer = _answer(decision, None if robot_path is None else Path(robot_path), backend, gui)
    except (Error, ImportError, OSError) as error:
        answer = {"moved": False, "reason": str(error)}
        raise
    finally:
        write_json(json_path, {**decision.to_dict(), "robot": answer})


def _is_sound(file: str) -> bool:
    kind = kind_of_file(Path(file))
    if kind == "a model":
        raise click.UsageError(f"{file} is a model, not a recording: give it as --speech-model or --gesture-model")
    if kind == "a folder" and any(kind_of_file(inside) == "a sound file" for inside in Path(file).iterdir()):
        raise click.UsageError(
            f"{file} is a folder of sounds: give one of them, or 'hri evaluate speech --data {file}'"
        )
    if not kind:
        raise click.UsageError(f"{file} is neither sound, picture nor video by its suffix: say --speech or --gesture")
    return kind == "a sound file"


def _only_one(before: str | None, file: str, what: str) -> str:
    if before is not None:
        raise click.UsageError(f"{before} and {file} are both {what}: one at a time")
    return file


def _describe(decision: Decision, path: str, top: int) -> None:
    """What one mode found, on standard error."""
    note(f"{decision.mode}: {decision.label} ({alternatives(decision, top)}) {path}")
    for text in decision.notes:
        note(f"{decision.mode}: note: {text}")
        if "utterances" in text:
            note(f"{decision.mode}: 'hri listen {path}' recognises each of them")


def _answer(decision: FusedDecision, path: Path | None, backend: str, gui: bool) -> dict[str, Any]:
    """Let the robot show the label, on film, in a window, or both; what it did."""
    from hri.robot import gesture_trajectory, load_gestures, open_robot, render_video, stopped_by_signals

    if decision.status != RECOGNISED:
        note(f"robot: not moved, because the answer is {decision.label}")
        return {"moved": False, "reason": decision.label}
    if decision.label in FusionOptions().stop_labels:
        note("robot: not moved, because the answer is to stop")
        return {"moved": False, "reason": "stop"}
    if decision.label not in load_gestures():
        raise InvalidArgument(
            f"the robot has no gesture named {decision.label!r}; "
            f"{did_you_mean(decision.label, load_gestures())} ('hri robot gestures' lists all)"
        )
    trajectory = gesture_trajectory(decision.label)
    if gui:
        with open_robot(backend, gui=True) as robot, stopped_by_signals(robot) as signals:
            robot.perform(trajectory)
        if signals:
            note("robot: stopped")
            sys.exit(128 + signals[0])
    if path is not None:
        path.parent.mkdir(parents=True, exist_ok=True)
    if path is not None and path.suffix.lower() in IMAGE_SUFFIXES:
        with open_robot(backend) as robot:
            robot.perform(trajectory)
            write_image(path, robot.render(640, 480)[:, :, ::-1])
    elif path is not None:
        with progress_bars() as progress:
            render_video(trajectory, path, backend, progress=lambda done, total: progress("filming", done, total))
    if path is not None:
        note(f"robot: {path}")
    return {"moved": True, "gesture": decision.label, "film": None if path is None else str(path)}
