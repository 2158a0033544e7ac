# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri session``."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import click

from hri.cli.groups import CheckedCommand, is_given, refuse_given
from hri.cli.live_screen import events_json_option, stall_option
from hri.cli.messages import note
from hri.cli.output import OutputFile, in_a_folder
from hri.cli.robot import nao_url_option
from hri.cli.session_devices import open_camera, open_microphone, open_voice, require_nao
from hri.cli.session_options import ChosenSession, model_file, refuse_unused, session_options
from hri.cli.session_screen import show_session
from hri.core.display import count
from hri.core.errors import InvalidArgument
from hri.live import FileSource, VideoSource
from hri.media import kind_of_file
from hri.robot import stopped_by_signals
from hri.session import McapRecorder, Session, is_repeated, read_recording, replay

EXIT_DIFFERENT = 1
_OF_REPLAY = (
    *("replay_path", "as_json", "speech_model", "embedding_path", "grammar_path", "min_confidence", "gesture_model"),
    *("faces", "knowledge_path", "max_distance", "fusion_path"),
)
"""Parameters that --replay heeds: what is in no recording."""
_AS_RECORDED = "has no effect: --replay takes what was recorded"
EXIT_SIGNAL = 128


@click.command(cls=CheckedCommand)
@click.argument("files", nargs=-1, type=click.Path(exists=True, dir_okay=False, path_type=Path))
@session_options
@click.option("--microphone", "microphone_name", metavar="NAME", help="Number or part of the name of the microphone.")
@click.option(
    "--camera", "camera_name", default="0", show_default=True, help="Number or address; nao: NAO's, at --url."
)
@stall_option
@click.option(
    "--speak", is_flag=True, help="Say what the robot says through the loudspeaker, in --language (by espeak-ng)."
)
@click.option("--gui", is_flag=True, help="Show the robot in a window (pybullet).")
@nao_url_option
@click.option("--record", "record_path", type=OutputFile((".mcap",)), metavar="FILE", help="Keep everything (.mcap).")
@click.option(
    "--replay", "replay_path", type=model_file, metavar="FILE", help="Decide once more on what --record kept."
)
@events_json_option
def session(
    files: tuple[Path, ...],
    chosen: ChosenSession,
    microphone_name: str | None,
    camera_name: str,
    stall_s: float,
    speak: bool,
    gui: bool,
    url: str | None,
    record_path: str | None,
    replay_path: Path | None,
    as_json: bool,
) -> None:
    """Command a robot by words and signs, together or alone, live or from a recording and a video.

    FILE is a sound file, a video, or one of each that began at the same time; without any, microphone and camera are
    used. STOP is heeded at any moment; Ctrl-C stops the robot and ends the session. On a terminal: the state, the
    level, decisions and why; otherwise, or with --json-lines, one JSON object a line.

    \b
    Examples:
      hri session
      hri session --wake robot --resume start --record class.mcap
      hri session --speak
      hri session --imitate follow --gui
      hri session --sentence-begin start --sentence-end end --knowledge sentences.csv
      hri session --gesture-model sentences.hri --no-speech --knowledge sentences.csv
      hri session --motions examples/motions/commands.toml
      hri session --grammar robot.jsgf --stand --gui --no-gesture
      hri session --backend kinematic --json-lines words.wav signs.mp4
      hri session --replay class.mcap
      hri session --robot nao --url tcp://nao.local --camera nao --microphone nao
    """
    if replay_path is not None:
        params = (param.name or "" for param in click.get_current_context().command.params)
        refuse_given(tuple(name for name in params if name not in _OF_REPLAY), _AS_RECORDED)
        if files:
            raise click.UsageError(f"FILE {_AS_RECORDED}")
        _replay(replay_path, chosen, as_json)
        return
    require_nao(chosen, url, camera_name, microphone_name)
    if url is not None and (gui or speak):
        raise click.UsageError("--gui is of a simulated robot, and a real NAO speaks by itself, without --speak")
    sound, video = _files(files)
    live = not files
    if files and is_given("microphone_name", "camera_name", "stall_s", "speak"):
        raise click.UsageError("--microphone, --camera, --stall and --speak are of devices; FILE takes their place")
    if (chosen.no_speech and sound is not None) or (chosen.no_gesture and video is not None):
        raise click.UsageError("--no-speech and --no-gesture leave out what FILE brings")
    with_speech = not chosen.no_speech and (live or sound is not None)
    with_gesture = not chosen.no_gesture and (live or video is not None)
    if not (with_speech or with_gesture):
        raise click.UsageError("--no-speech and --no-gesture leave nothing")
    refuse_unused(with_speech, with_gesture)
    options = chosen.session_options()
    words = chosen.load_words() if with_speech else None
    signs = chosen.load_signs() if with_gesture else None
    chosen.warn_of_stop(words, signs)
    learned, stored, faces = chosen.load_fusion(), chosen.load_knowledge(words, signs), chosen.person_finder()
    chosen.require_sentences(signs)
    motions = chosen.load_motions()
    with ExitStack() as stack:
        robot = chosen.open_robot(gui, url)
        if robot is not None:
            stack.enter_context(robot)
        voice = open_voice(stack, robot, chosen.language if speak else "")
        note("preparing the robot's motions")
        ids = chosen.model_ids
        made = Session(
            words,
            signs,
            robot,
            options,
            motions=motions,
            voice=voice,
            model_ids=ids,
            fusion=learned,
            faces=faces,
            knowledge=stored,
        )
        chosen.note_motions(made, motions)
        hear: Any = None
        see: Any = None
        if with_speech:
            hear = (lambda: open_microphone(microphone_name, stall_s, url)) if live else FileSource(sound or "")
        if with_gesture:
            see = (lambda: open_camera(camera_name, stall_s, url)) if live else VideoSource(video or "")
        recorder = None if record_path is None else McapRecorder(in_a_folder(record_path))
        signals = stack.enter_context(stopped_by_signals(made))
        failed = show_session(made.run(hear, see, live=live, recorder=recorder), as_json, lambda: bool(signals))
    if recorder is not None and recorder.failure:
        note(f"not recorded: {recorder.failure}")
    if signals:
        sys.exit(EXIT_SIGNAL + signals[0])
    if failed:
        raise InvalidArgument(failed)


def _replay(path: Path, chosen: ChosenSession, as_json: bool) -> None:
    """Decide once more; exit code 1 where a decision differs."""
    recording = read_recording(path)
    words = chosen.load_words() if any(True for _ in recording.sound()) else None
    signs = chosen.load_signs() if any(True for _ in recording.pictures()) else None
    learned, stored = chosen.load_fusion(), chosen.load_knowledge(words, signs)
    for mode, name in chosen.model_ids.items():
        if name != recording.models.get(mode):
            note(f"{mode}: recorded with {recording.models.get(mode) or 'another model'}, replayed with {name}")
    compared = _Compared(recording.events())

    def kept() -> Any:
        models = chosen.model_ids
        for event in replay(recording, words, signs, learned, stored, faces=chosen.person_finder(), model_ids=models):
            compared.see(event.to_dict())
            yield event

    show_session(kept(), as_json, lambda: False)
    place = compared.difference()
    if place is None:
        note(f"{path}: {count(compared.num_same, 'event')} of the session, all as recorded")
        return
    note(f"{path}: differs from what was recorded at {place['time']:g} s, {place['event']}")
    sys.exit(EXIT_DIFFERENT)


class _Compared:
    """Events of the session as they are repeated beside those that were recorded, one by one."""

    def __init__(self, recorded: Iterator[dict[str, Any]]) -> None:
        self._recorded = (event for event in recorded if is_repeated(event))
        self._place: dict[str, Any] | None = None
        self.num_same = 0

    def see(self, event: dict[str, Any]) -> None:
        """What was repeated."""
        if self._place is None and is_repeated(event):
            before = next(self._recorded, None)
            if before == event:
                self.num_same += 1
            else:
                self._place = before or event

    def difference(self) -> dict[str, Any] | None:
        """Where both differ, once all is repeated."""
        return self._place or next(self._recorded, None)


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
