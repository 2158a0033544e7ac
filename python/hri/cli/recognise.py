# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri recognise``."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from hri.cli.answers import alternatives, confidence_text
from hri.cli.faces import faces_option, look_for_faces
from hri.cli.groups import CheckedCommand, refuse_given
from hri.cli.messages import note
from hri.cli.output import OutputFile, json_option, say, write_json
from hri.cli.progress import progress_bars
from hri.cli.recognizers import embedding_option, kept_model, load_embedding
from hri.core.display import count
from hri.core.errors import Error, FormatError, InvalidArgument
from hri.core.phrases import phrase
from hri.core.suggest import did_you_mean
from hri.fusion import RULES, FusedDecision, FusionOptions, LearnedFusion, fuse
from hri.media import IMAGE_SUFFIXES, VIDEO_SUFFIXES, kind_of_file, write_image
from hri.media.order import natural_key
from hri.recognition import Decision, GestureRecognizer, load
from hri.recognition.decision import RECOGNISED

if TYPE_CHECKING:
    from hri.session import LabelMotions

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
@click.option(
    "--motions",
    "motions_path",
    type=_file,
    metavar="TOML",
    help='What the robot does for labels that are no gestures: a line each, as in pinch = "small".',
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
    motions_path: str | None,
    gui: bool,
    top: int,
    json_path: str | None,
) -> None:
    """Recognise a spoken word, a sign, or both fused; print label, confidence and the rule that fired.

    FILE is a recording of a word, or a picture, video or folder of pictures of a sign; --speech and --gesture say which
    is which. A word and a sign are fused. Several words, several signs, or a folder of sounds or of videos give a line
    each: the file, its label and the confidence. "unknown", "no_input" and "ask" (an unsure STOP) are answers too: the
    robot then does not move.

    \b
    Examples:
      hri recognise seven.wav
      hri recognise seven.wav seven.jpg
      hri recognise spoken/*.wav --json decisions.json
      hri recognise --speech seven.wav --gesture seven.jpg --robot robot.webm
      hri recognise --gesture clip.mp4 --gui
      hri recognise clip.mp4 --motions examples/motions/webcam_gestures.toml --robot robot.webm
      hri recognise --speech seven.wav --gesture seven.jpg --rule product --json -
    """
    said, shown, in_folder = _by_mode(files)
    said, shown = [*([speech] if speech else []), *said], [*([gesture] if gesture else []), *shown]
    if not (said or shown):
        raise click.UsageError("give a recording: --speech FILE, --gesture FILE, or both")
    several = in_folder or max(len(said), len(shown)) > 1
    if several and said and shown:
        raise click.UsageError(
            "a word and a sign are fused; several recordings must be of words only, or of signs only"
        )
    if several and (robot_path is not None or gui):
        raise click.UsageError("--robot and --gui show one decision: give one recording, or a word and a sign")
    if not said:
        refuse_given(("speech_model", "embedding_path"), "is of speech, and no recording of a word is given")
    if not shown:
        refuse_given(("gesture_model",), "is of signs, and no recording of one is given")
    if not (said and shown):
        refuse_given(("rule", "fusion_path"), "is for a word and a sign together")
    if fusion_path is not None:
        refuse_given(("rule",), "and --fusion exclude each other")
    if robot_path is None and not gui:
        refuse_given(("backend", "motions_path"), "goes with --robot or --gui")
    if faces is not None and not shown:
        raise click.UsageError("--faces is for signs: --gesture FILE")
    if gui and backend != "pybullet":
        raise click.UsageError("--gui needs --backend pybullet")
    motions = _motions(motions_path)
    learned = None if fusion_path is None else LearnedFusion.load(fusion_path)
    words = signs = None
    if said:
        words = load(speech_model or kept_model("speech"), "speech", embedding=load_embedding(embedding_path))
    if shown:
        signs = GestureRecognizer.load(gesture_model or kept_model("gesture"))
        look_for_faces(signs, faces)
    if several:
        _recognise_each(words or signs, said or shown, top, json_path)
        return
    heard = None if words is None else _described(words, said[0], top)
    seen = None if signs is None else _described(signs, shown[0], top)
    decision = fuse(heard, seen, rule=learned or rule)
    say(f"{decision.label}\t{confidence_text(decision)}\t{decision.rule}", json_path)
    answer = None
    try:
        if robot_path is not None or gui:
            answer = _answer(decision, None if robot_path is None else Path(robot_path), backend, gui, motions)
    except (Error, ImportError, OSError) as error:
        answer = {"moved": False, "reason": str(error)}
        raise
    finally:
        write_json(json_path, {**decision.to_dict(), "robot": answer})


def _by_mode(files: tuple[str, ...]) -> tuple[list[str], list[str], bool]:
    """Recordings of words, and of signs, and whether some are those in a folder."""
    said: list[str] = []
    shown: list[str] = []
    in_folder = False
    for file in files:
        kind = kind_of_file(Path(file))
        inside = _recordings_in(file) if kind == "a folder" else []
        if kind == "a model":
            raise click.UsageError(f"{file} is a model, not a recording: give it as --speech-model or --gesture-model")
        if not kind:
            raise click.UsageError(
                f"{file} is neither sound, picture nor video by its suffix: say --speech or --gesture"
            )
        in_folder = in_folder or bool(inside)
        of_words = kind_of_file(Path(inside[0] if inside else file)) == "a sound file"
        (said if of_words else shown).extend(inside or [file])
    return said, shown, in_folder


def _recordings_in(folder: str) -> list[str]:
    """Its sound files, or else its videos, in the order of their names; none where pictures make it one sign."""
    kinds: dict[str, list[str]] = {}
    for path in sorted(Path(folder).iterdir(), key=lambda path: natural_key(path.name)):
        kinds.setdefault(kind_of_file(path), []).append(str(path))
    if "a sound file" in kinds:
        return kinds["a sound file"]
    return [] if "a picture" in kinds else kinds.get("a video", [])


def _recognise_each(recognizer: Any, files: list[str], top: int, json_path: str | None) -> None:
    """A line for each recording; one that cannot be read is reported, and the others are recognised all the same."""
    rows: list[dict[str, Any]] = []
    failures: list[str] = []
    for file in files:
        try:
            found = _described(recognizer, file, top)
            decision = fuse(found, None) if found.mode == "speech" else fuse(None, found)
        except (Error, OSError) as error:
            failures.append(str(error) if file in str(error) else f"{file}: {error}")
            note(f"not recognised: {failures[-1]}")
            rows.append({"file": file, "error": str(error)})
            continue
        say(f"{file}\t{decision.label}\t{confidence_text(decision)}", json_path)
        rows.append({"file": file, **decision.to_dict()})
    write_json(json_path, rows)
    if failures:
        raise FormatError(f"{len(failures)} of {count(len(files), 'recording')} not recognised, first {failures[0]}")


def _described(recognizer: Any, path: str, top: int) -> Decision:
    """What one mode finds in a recording; its alternatives go to standard error."""
    decision: Decision = recognizer.recognise(path)
    note(f"{decision.mode}: {decision.label} ({alternatives(decision, top)}) {path}")
    for text in decision.notes:
        note(f"{decision.mode}: note: {text}")
        if "utterances" in text:
            note(f"{decision.mode}: 'hri listen {path}' recognises each of them")
    return decision


def _motions(path: str | None) -> LabelMotions:
    """What the robot does for labels beside its gestures; it is held by the torso, so that its legs stay."""
    from hri.robot import needs_feet
    from hri.session import LabelMotions, read_motions

    motions = LabelMotions() if path is None else read_motions(path)
    for label, motion in motions.items():
        if needs_feet(motion):
            raise InvalidArgument(f"{path}: {label}: {phrase('torso_held')}")
    return motions


def _answer(
    decision: FusedDecision, path: Path | None, backend: str, gui: bool, motions: LabelMotions
) -> dict[str, Any]:
    """Let the robot answer the label, on film, in a window, or both; what it did."""
    from hri.robot import gesture_trajectory, load_gestures, open_robot, render_video, stopped_by_signals

    if decision.status != RECOGNISED:
        note(f"robot: not moved, because the answer is {decision.label}")
        return {"moved": False, "reason": decision.label}
    if decision.label in FusionOptions().stop_labels:
        note("robot: not moved, because the answer is to stop")
        return {"moved": False, "reason": "stop"}
    if decision.label not in motions and decision.label not in load_gestures():
        raise InvalidArgument(
            f"the robot has no gesture named {decision.label!r}; "
            f"{did_you_mean(decision.label, load_gestures())} ('hri robot gestures' lists all); "
            "--motions FILE says what it does instead"
        )
    trajectory = motions[decision.label] if decision.label in motions else gesture_trajectory(decision.label)
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
