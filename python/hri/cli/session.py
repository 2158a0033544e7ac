# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri session``."""

from __future__ import annotations

import hashlib
import sys
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import click

from hri.cli.connected import connected_model
from hri.cli.live_screen import camera, events_json_option, microphone, stall_option
from hri.cli.messages import note
from hri.cli.output import OutputFile
from hri.cli.recognizers import kept_model
from hri.cli.robot import nao_url_option
from hri.cli.session_screen import show_session
from hri.core.errors import InvalidArgument
from hri.core.files import MAX_MODEL_BYTES, read_bytes
from hri.fusion import RULES, FusionOptions, LearnedFusion
from hri.language import Grammar, KnowledgeBase
from hri.language.knowledge import MAX_DISTANCE
from hri.live import CameraSource, FileSource, MicrophoneSource, VideoSource
from hri.media import kind_of_file
from hri.recognition import CommandRecognizer, ConnectedWordRecognizer, GestureRecognizer, WordRecognizer
from hri.robot import BACKENDS, NAO, ROBOTS, JointTable, NaoqiRobot, Robot, open_robot, stopped_by_signals
from hri.session import (
    McapRecorder,
    NaoCamera,
    NaoMicrophone,
    Session,
    SessionOptions,
    decisions,
    read_recording,
    replay,
)

EXIT_DIFFERENT = 1
EXIT_SIGNAL = 128
_MODEL = click.Path(exists=True, dir_okay=False, path_type=Path)
_NO_ROBOT = "none"
_NAO = "nao"


@click.command()
@click.argument("files", nargs=-1, type=click.Path(exists=True, dir_okay=False, path_type=Path))
@click.option("--speech-model", type=_MODEL, help="From 'hri train speech'; the default is the one kept per user.")
@click.option(
    "--grammar",
    "grammar_path",
    type=_MODEL,
    metavar="JSGF",
    help="Commands of several words with slots; --speech-model is then from 'hri train-connected'.",
)
@click.option("--gesture-model", type=_MODEL, help="The same for gestures.")
@click.option("--no-speech", is_flag=True, help="Signs only: use no microphone.")
@click.option("--no-gesture", is_flag=True, help="Words only: use no camera.")
@click.option("--microphone", "microphone_name", metavar="NAME", help="Number or part of the name of the microphone.")
@click.option(
    "--camera", "camera_name", default="0", show_default=True, help="Number or address; nao: NAO's, at --url."
)
@stall_option
@click.option("--wake", multiple=True, metavar="LABEL", help="Take commands only after this word or sign.")
@click.option("--stop", "stops", multiple=True, default=("stop",), show_default=True, help="A label that stops.")
@click.option("--stop-threshold", type=float, metavar="P", help="Confidence from which STOP is sure; else the model's.")
@click.option("--resume", multiple=True, metavar="LABEL", help="A word or sign that ends STOP.")
@click.option(
    "--imitate",
    multiple=True,
    metavar="LABEL",
    help="From this word or sign on the arms move as yours do, until no or STOP.",
)
@click.option("--sentence-begin", multiple=True, metavar="LABEL", help="From this word or sign on comes a sentence.")
@click.option("--sentence-end", multiple=True, metavar="LABEL", help="It ends with this one, and is said.")
@click.option(
    "--knowledge",
    "knowledge_path",
    type=_MODEL,
    metavar="CSV",
    help="Stored sentences, of which the nearest is said: columns signs, en, hi, ..., and answer: gestures in return.",
)
@click.option(
    "--max-distance",
    type=click.FloatRange(0, 1),
    default=MAX_DISTANCE,
    show_default=True,
    help="Words farther from every stored sentence are none of them.",
)
@click.option("--language", default="en", show_default=True, help="Of what stored sentences say.")
@click.option(
    "--confirm-below", type=float, default=0.5, show_default=True, help="Ask for what is less sure; 1: always."
)
@click.option("--window", "window_s", type=float, default=1.0, show_default=True, help="Seconds between word and sign.")
@click.option("--rule", type=click.Choice(RULES), default=RULES[0], show_default=True, help="How both are fused.")
@click.option("--fusion", "fusion_path", type=_MODEL, metavar="FILE", help="A learned fusion, in place of --rule.")
@click.option(
    "--backend",
    type=click.Choice((*BACKENDS, _NO_ROBOT)),
    default="pybullet",
    show_default=True,
    help="The robot with physics, without, or no robot.",
)
@click.option("--gui", is_flag=True, help="Show the robot in a window (pybullet).")
@click.option("--stand", is_flag=True, help="The robot stands on its feet and can walk (pybullet).")
@click.option(
    "--robot",
    "table",
    type=click.Choice(tuple(ROBOTS)),
    default="hoap2",
    show_default=True,
    callback=lambda context, option, name: ROBOTS[name],
)
@nao_url_option
@click.option("--record", "record_path", type=OutputFile((".mcap",)), metavar="FILE", help="Keep everything (.mcap).")
@click.option("--replay", "replay_path", type=_MODEL, metavar="FILE", help="Decide once more on what --record kept.")
@events_json_option
def session(
    files: tuple[Path, ...],
    speech_model: Path | None,
    grammar_path: Path | None,
    gesture_model: Path | None,
    no_speech: bool,
    no_gesture: bool,
    microphone_name: str | None,
    camera_name: str,
    stall_s: float,
    wake: tuple[str, ...],
    stops: tuple[str, ...],
    stop_threshold: float | None,
    resume: tuple[str, ...],
    imitate: tuple[str, ...],
    sentence_begin: tuple[str, ...],
    sentence_end: tuple[str, ...],
    knowledge_path: Path | None,
    max_distance: float,
    language: str,
    confirm_below: float,
    window_s: float,
    rule: str,
    fusion_path: Path | None,
    backend: str,
    gui: bool,
    stand: bool,
    table: JointTable,
    url: str | None,
    record_path: str | None,
    replay_path: Path | None,
    as_json: bool,
) -> None:
    """Command a robot by words and signs, together or alone, live or from a recording and a video.

    FILE is a sound file, a video, or one of each that began at the same time; without any, microphone and camera are
    used. STOP is heeded at any moment; Ctrl-C stops the robot and ends the session. On a terminal: the state, the
    level, decisions and why; otherwise, or with --json, one JSON object a line.

    \b
    Examples:
      hri session
      hri session --wake robot --resume start --record class.mcap
      hri session --imitate follow --gui
      hri session --sentence-begin start --sentence-end end --knowledge sentences.csv
      hri session --grammar robot.jsgf --stand --gui --no-gesture
      hri session --backend kinematic --json words.wav signs.mp4
      hri session --replay class.mcap
      hri session --robot nao --url tcp://nao.local --camera nao --microphone nao
    """
    if replay_path is not None:
        known = (knowledge_path, max_distance)
        _replay(replay_path, speech_model, grammar_path, gesture_model, fusion_path, known, as_json)
        return
    if url is not None and table is not NAO:
        raise click.UsageError("--url is of a real NAO: add --robot nao")
    if url is None and _NAO in (camera_name, microphone_name):
        raise click.UsageError("--camera nao and --microphone nao are of a real NAO: name its --url")
    sound, video = _files(files)
    live = not files
    with_speech, with_gesture = (not no_speech, not no_gesture) if live else (sound is not None, video is not None)
    if not (with_speech or with_gesture):
        raise click.UsageError("--no-speech and --no-gesture leave nothing")
    fusion = FusionOptions(stop_labels=stops, stop_threshold=stop_threshold)
    options = SessionOptions(
        window_s,
        rule=rule,
        fusion=fusion,
        wake_labels=wake,
        resume_labels=resume,
        imitate_labels=imitate,
        sentence_begin_labels=sentence_begin,
        sentence_end_labels=sentence_end,
        language=language,
        confirm_below=confirm_below,
    )
    ids: dict[str, str] = {}
    words = load_words(speech_model, grammar_path, ids) if with_speech else None
    signs = load_model(GestureRecognizer, "gesture", gesture_model, ids) if with_gesture else None
    learned = None if fusion_path is None else load_model(LearnedFusion, "fusion", fusion_path, ids)
    stored = _stored(knowledge_path, max_distance, ids)
    with ExitStack() as stack:
        robot: Robot | None = None
        if url is not None:
            robot = stack.enter_context(NaoqiRobot(url))
        elif backend != _NO_ROBOT:
            robot = stack.enter_context(open_robot(backend, gui=gui, fixed_base=not stand, table=table))
        note("preparing the robot's motions")
        # NAO hears itself: a question that names a word would be answered by it.
        say = robot.say_later if isinstance(robot, NaoqiRobot) and microphone_name != _NAO else None
        made = Session(words, signs, robot, options, on_say=say, model_ids=ids, fusion=learned, knowledge=stored)
        for label, why in made.refused.items():
            note(f"no motion for {label}: {why}")
        hear: Any = None
        see: Any = None
        if with_speech:
            hear = (lambda: _microphone(microphone_name, stall_s, url)) if live else FileSource(sound or "")
        if with_gesture:
            see = (lambda: _camera(camera_name, stall_s, url)) if live else VideoSource(video or "")
        recorder = None if record_path is None else McapRecorder(record_path)
        signals = stack.enter_context(stopped_by_signals(made))
        failed = show_session(made.run(hear, see, live=live, recorder=recorder), as_json, lambda: bool(signals))
    if recorder is not None and recorder.failure:
        note(f"not recorded: {recorder.failure}")
    if signals:
        sys.exit(EXIT_SIGNAL + signals[0])
    if failed:
        raise InvalidArgument(failed)


def _camera(name: str, stall_s: float, url: str | None) -> CameraSource | NaoCamera:
    """A camera of this computer, or NAO's."""
    return NaoCamera(url, stall_s=stall_s) if url is not None and name == _NAO else camera(name, stall_s)


def _microphone(name: str | None, stall_s: float, url: str | None) -> MicrophoneSource | NaoMicrophone:
    """A microphone of this computer, or NAO's."""
    return NaoMicrophone(url, stall_s=stall_s) if url is not None and name == _NAO else microphone(name, stall_s)


def _replay(
    path: Path,
    speech_model: Path | None,
    grammar_path: Path | None,
    gesture_model: Path | None,
    fusion_path: Path | None,
    known: tuple[Path | None, float],
    as_json: bool,
) -> None:
    """Decide once more; exit code 1 where a decision differs."""
    recording = read_recording(path)
    ids: dict[str, str] = {}
    words = load_words(speech_model, grammar_path, ids) if recording.sound else None
    signs = load_model(GestureRecognizer, "gesture", gesture_model, ids) if recording.pictures else None
    learned = None if fusion_path is None else load_model(LearnedFusion, "fusion", fusion_path, ids)
    stored = _stored(*known, ids)
    for mode, name in ids.items():
        if name != recording.models.get(mode):
            note(f"{mode}: recorded with {recording.models.get(mode) or 'another model'}, replayed with {name}")
    again: list[dict[str, Any]] = []

    def kept() -> Any:
        for event in replay(recording, words, signs, learned, stored):
            again.append(event.to_dict())
            yield event

    show_session(kept(), as_json, lambda: False)
    before, after = decisions(recording.events), decisions(again)
    if before == after:
        note(f"{path}: {len(after)} events of the session, all as recorded")
        return
    first = next((i for i, pair in enumerate(zip(before, after, strict=False)) if pair[0] != pair[1]), None)
    place = before[first] if first is not None else (before + after)[min(len(before), len(after))]
    note(f"{path}: differs from what was recorded at {place['time']:g} s, {place['event']}")
    sys.exit(EXIT_DIFFERENT)


def _files(files: tuple[Path, ...]) -> tuple[Path | None, Path | None]:
    """The sound file and the video among `files`."""
    found: dict[str, Path] = {}
    for file in files:
        kind = kind_of_file(file)
        if kind not in ("a sound file", "a video"):
            raise click.UsageError(f"{file} is neither a sound file nor a video by its suffix")
        if kind in found:
            raise click.UsageError(f"{found[kind]} and {file} are both {kind.removeprefix('a ')}s: one at a time")
        found[kind] = file
    return found.get("a sound file"), found.get("a video")


def _stored(path: Path | None, max_distance: float, ids: dict[str, str]) -> KnowledgeBase | None:
    """Stored sentences; the name and hash of their file and how near words must be to them go into `ids`."""
    if path is None:
        return None
    ids["knowledge"] = f"{_name_and_hash(path)} within {max_distance:g}"
    return KnowledgeBase.read(path, max_distance)


def load_words(path: Path | None, grammar_path: Path | None, ids: dict[str, str]) -> WordRecognizer | CommandRecognizer:
    """What recognises words, or commands of several words by a grammar, whose name and hash are part of the id."""
    if grammar_path is None:
        recognizer: WordRecognizer = load_model(WordRecognizer, "speech", path, ids)
        return recognizer
    commands = CommandRecognizer(
        load_model(ConnectedWordRecognizer, "speech", path or connected_model(), ids), Grammar.load(grammar_path)
    )
    ids["speech"] += f" {_name_and_hash(grammar_path)}"
    return commands


def load_model(kind: type[Any], mode: str, path: Path | None, ids: dict[str, str]) -> Any:
    """The recogniser or fusion in a model file; its name and hash go into `ids`."""
    chosen = path or kept_model(mode)
    ids[mode] = _name_and_hash(chosen)
    return kind.load(chosen)


def _name_and_hash(path: Path) -> str:
    return f"{path.name}:{hashlib.sha256(read_bytes(path, MAX_MODEL_BYTES)).hexdigest()[:12]}"
