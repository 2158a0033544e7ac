# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri serve``."""

from __future__ import annotations

import webbrowser
from collections.abc import Iterator
from contextlib import ExitStack
from functools import partial
from itertools import count
from pathlib import Path

import click

from hri.cli.connected import connected_model
from hri.cli.groups import CheckedCommand
from hri.cli.messages import note
from hri.cli.output import OutputFile, in_a_folder
from hri.cli.recognizers import load_dataset
from hri.cli.robot import nao_url_option
from hri.cli.session_devices import NAO_NAME, open_camera, open_microphone, open_voice, require_nao
from hri.cli.session_options import ChosenSession, refuse_unused, session_options
from hri.core.optional import import_optional
from hri.io import SpokenWords
from hri.media import Audio
from hri.robot.control.stopping import broken_pipes_as_errors
from hri.session import McapRecorder
from hri.synthetic.speech import speak_words

PORT = 8019
STALL_S = 2.0


@click.command(cls=CheckedCommand)
@session_options
@click.option(
    "--port", type=click.IntRange(0, 65535), default=PORT, show_default=True, help="0 takes any that is free."
)
@click.option(
    "--speech-data",
    multiple=True,
    type=click.Path(exists=True, file_okay=False),
    metavar="DIR",
    help="With --grammar: what the model was trained on, so that words can be added on the page. May be repeated.",
)
@click.option(
    "--voice",
    metavar="LANGUAGE",
    help="With --speech-data: synthetic voices of this language (espeak-ng's name) say added words, too.",
)
@click.option(
    "--microphone", "microphone_name", type=click.Choice((NAO_NAME,)), help="NAO's, in place of the browser's."
)
@click.option("--camera", "camera_name", type=click.Choice((NAO_NAME,)), help="NAO's, in place of the browser's.")
@nao_url_option
@click.option("--record", "record_path", type=OutputFile((".mcap",)), metavar="FILE", help="Keep everything (.mcap).")
@click.option("--open", "open_browser", is_flag=True, help="Open the page in the browser.")
def serve(
    chosen: ChosenSession,
    port: int,
    speech_data: tuple[str, ...],
    voice: str | None,
    microphone_name: str | None,
    camera_name: str | None,
    url: str | None,
    record_path: str | None,
    open_browser: bool,
) -> None:
    """Command a robot by words and signs from a page in the browser.

    Prints an address; open it in a browser on this computer and press Start. The page shows the camera, the level, the
    most probable words and signs, which rule fired, what the robot says and does, and STOP, which is heeded at any
    moment. With --imitate a button makes the robot follow your arms, too. The address lets in one visitor, and nothing
    leaves this computer, unless it goes to a NAO at --url. Ctrl-C stops the robot and ends. With --record each session
    is a file: FILE, and FILE-2 and so on after a word was added or the session began anew.

    \b
    Examples:
      hri train speech --data spoken/
      hri train gesture --data signed/
      hri serve --open
      hri serve --no-gesture --wake robot
      hri serve --imitate follow
      hri serve --grammar robot.jsgf --stand --no-gesture
      hri serve --grammar robot.jsgf --speech-data spoken/ --voice en --no-gesture
      hri serve --no-speech --sentence-begin start --sentence-end end --knowledge sentences.csv
      hri serve --no-speech --gesture-model sentences.hri --knowledge sentences.csv
      hri serve --motions examples/motions/commands.toml
      hri serve --record class.mcap
      hri serve --robot nao --url tcp://nao.local --camera nao --microphone nao
      hri serve --backend kinematic --port 0 --speech-model words.hri --gesture-model signs.hri
    """
    if chosen.no_speech and chosen.no_gesture:
        raise click.UsageError("--no-speech and --no-gesture leave nothing")
    if speech_data and (chosen.grammar_path is None or chosen.no_speech):
        raise click.UsageError("--speech-data goes with --grammar: single words are added without it")
    if voice is not None and not speech_data:
        raise click.UsageError("--voice goes with --speech-data")
    require_nao(chosen, url, camera_name, microphone_name)
    if (microphone_name and chosen.no_speech) or (camera_name and chosen.no_gesture):
        raise click.UsageError("--no-speech and --no-gesture leave out --microphone and --camera")
    refuse_unused(not chosen.no_speech, not chosen.no_gesture)
    for module in ("starlette", "uvicorn", "websockets"):
        import_optional(module, "web", "to serve the page")
    from hri.serve import PageServer, Stage

    if voice is not None:
        speak_words({voice: {"1": "1"}}, num_speakers=1)  # refuses one that espeak-ng does not have
    options = chosen.session_options(retry_s=0.2)
    words = None if chosen.no_speech else chosen.load_words()
    signs = None if chosen.no_gesture else chosen.load_signs()
    chosen.warn_of_stop(words, signs)
    learned, stored, faces = chosen.load_fusion(), chosen.load_knowledge(words, signs), chosen.person_finder()
    chosen.require_sentences(signs)
    motions = chosen.load_motions()
    recordings, spoken = None, None
    if speech_data:
        recordings = [sample for folder in speech_data for sample in load_dataset(folder, "speech", None, None)]
        spoken = SpokenWords.read_beside(chosen.speech_model or connected_model())
    with ExitStack() as stack:
        stack.enter_context(broken_pipes_as_errors())
        robot = chosen.open_robot(url=url)
        if robot is not None:
            stack.enter_context(robot)
        paths = _numbered("" if record_path is None else in_a_folder(record_path))
        note("preparing the robot's motions")
        ids = chosen.model_ids
        stage = Stage(
            words,
            signs,
            robot,
            options,
            motions=motions,
            model_ids=ids,
            fusion=learned,
            knowledge=stored,
            faces=faces,
            recordings=recordings,
            spoken=None if spoken is None else partial(_say_again, spoken),
            spoken_labels=() if spoken is None else spoken.texts,
            speak=None if voice is None else lambda word: speak_words({voice: {word: word}}),
            hear=None if microphone_name is None else lambda: open_microphone(microphone_name, STALL_S, url),
            see=None if camera_name is None else lambda: open_camera(camera_name, STALL_S, url),
            voice=open_voice(stack, robot, ""),
            record=None if record_path is None else lambda: McapRecorder(next(paths)),
        )
        stack.callback(stage.close)
        chosen.note_motions(stage.session, motions)
        server = PageServer(stage, port)
        click.echo(f"Open {server.address}")
        note("in a browser on this computer; the address lets in one visitor. Ctrl-C ends.")
        if open_browser:
            webbrowser.open(server.address)
        server.run()


def _numbered(path: str | Path) -> Iterator[Path]:
    """The file, and then those of the same name with the next number that is free."""
    first = Path(path)
    yield first
    for number in count(2):
        other = first.with_stem(f"{first.stem}-{number}")
        if not other.exists():
            yield other


def _say_again(words: SpokenWords) -> tuple[list[Audio], list[str], list[str]]:
    return speak_words({words.language: words.texts}, words.num_voices, 1, words.seed)
