# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri serve``."""

from __future__ import annotations

import webbrowser
from contextlib import ExitStack
from pathlib import Path

import click

from hri.cli.messages import note
from hri.cli.session import load_model
from hri.core.optional import import_optional
from hri.fusion import RULES, FusionOptions
from hri.recognition import GestureRecognizer, WordRecognizer
from hri.robot import BACKENDS, ROBOTS, JointTable, open_robot
from hri.session import SessionOptions

PORT = 8019
_MODEL = click.Path(exists=True, dir_okay=False, path_type=Path)
_NO_ROBOT = "none"


@click.command()
@click.option("--speech-model", type=_MODEL, help="From 'hri train speech'; the default is the one kept per user.")
@click.option("--gesture-model", type=_MODEL, help="The same for gestures.")
@click.option("--no-speech", is_flag=True, help="Signs only: the page uses no microphone.")
@click.option("--no-gesture", is_flag=True, help="Words only: the page uses no camera.")
@click.option(
    "--port", type=click.IntRange(0, 65535), default=PORT, show_default=True, help="0 takes any that is free."
)
@click.option("--open", "open_browser", is_flag=True, help="Open the page in the browser.")
@click.option("--wake", multiple=True, metavar="LABEL", help="Take commands only after this word or sign.")
@click.option("--stop", "stops", multiple=True, default=("stop",), show_default=True, help="A label that stops.")
@click.option("--resume", multiple=True, metavar="LABEL", help="A word or sign that ends STOP, beside the button.")
@click.option(
    "--confirm-below", type=float, default=0.5, show_default=True, help="Ask for what is less sure; 1: always."
)
@click.option("--rule", type=click.Choice(RULES), default=RULES[0], show_default=True, help="How both are fused.")
@click.option(
    "--backend",
    type=click.Choice((*BACKENDS, _NO_ROBOT)),
    default="pybullet",
    show_default=True,
    help="The robot with physics, without, or no robot.",
)
@click.option(
    "--robot",
    "table",
    type=click.Choice(tuple(ROBOTS)),
    default="hoap2",
    show_default=True,
    callback=lambda context, option, name: ROBOTS[name],
)
def serve(
    speech_model: Path | None,
    gesture_model: Path | None,
    no_speech: bool,
    no_gesture: bool,
    port: int,
    open_browser: bool,
    wake: tuple[str, ...],
    stops: tuple[str, ...],
    resume: tuple[str, ...],
    confirm_below: float,
    rule: str,
    backend: str,
    table: JointTable,
) -> None:
    """Command a robot by words and signs from a page in the browser.

    Prints an address; open it in a browser on this computer and press Start. The page shows the camera, the level, the
    most probable words and signs, which rule fired, what the robot says and does, and STOP, which is heeded at any
    moment. The address lets in one visitor, and nothing leaves this computer. Ctrl-C stops the robot and ends.

    \b
    Examples:
      hri train speech --data spoken/
      hri train gesture --data signed/
      hri serve --open
      hri serve --no-gesture --wake robot
      hri serve --backend kinematic --port 0 --speech-model words.hri --gesture-model signs.hri
    """
    if no_speech and no_gesture:
        raise click.UsageError("--no-speech and --no-gesture leave nothing")
    for module in ("starlette", "uvicorn", "websockets"):
        import_optional(module, "web", "to serve the page")
    from hri.serve import PageServer, Stage

    options = SessionOptions(
        rule=rule,
        fusion=FusionOptions(stop_labels=stops),
        wake_labels=wake,
        resume_labels=resume,
        confirm_below=confirm_below,
        retry_s=0.2,
    )
    ids: dict[str, str] = {}
    words = None if no_speech else load_model(WordRecognizer, "speech", speech_model, ids)
    signs = None if no_gesture else load_model(GestureRecognizer, "gesture", gesture_model, ids)
    with ExitStack() as stack:
        robot = None if backend == _NO_ROBOT else stack.enter_context(open_robot(backend, table=table))
        note("preparing the robot's motions")
        stage = Stage(words, signs, robot, options, model_ids=ids)
        stack.callback(stage.close)
        for label, why in stage.session.refused.items():
            note(f"no motion for {label}: {why}")
        server = PageServer(stage, port)
        click.echo(f"Open {server.address}")
        note("in a browser on this computer; the address lets in one visitor. Ctrl-C ends.")
        if open_browser:
            webbrowser.open(server.address)
        server.run()
