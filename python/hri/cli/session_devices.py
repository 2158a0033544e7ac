# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Devices of `hri session` and `hri serve`: of this computer, or of a real NAO."""

from __future__ import annotations

from contextlib import ExitStack

import click

from hri.cli.groups import is_given
from hri.cli.live_screen import camera, microphone
from hri.cli.session_options import ChosenSession
from hri.cli.voice import SpokenText
from hri.live import CameraSource, MicrophoneSource
from hri.robot import NAO, NaoqiRobot, Robot
from hri.session import NaoCamera, NaoMicrophone, Voice

NAO_NAME = "nao"
"""In place of the name of a camera or microphone."""


def require_nao(chosen: ChosenSession, url: str | None, camera_name: str | None, microphone_name: str | None) -> None:
    """Raise UsageError for devices of a real NAO without its address, and for an address that nothing uses."""
    if url is not None and chosen.table is not NAO:
        raise click.UsageError("--url is of a real NAO: add --robot nao")
    if url is not None and is_given("backend", "stand"):
        raise click.UsageError("--backend and --stand are of a simulated robot, --url is of a real one")
    if url is None and NAO_NAME in (camera_name, microphone_name):
        raise click.UsageError("--camera nao and --microphone nao are of a real NAO: name its --url")


def open_camera(name: str, stall_s: float, url: str | None) -> CameraSource | NaoCamera:
    """A camera of this computer, or NAO's."""
    if url is not None and name == NAO_NAME:
        return NaoCamera(url, stall_s=stall_s)
    return camera(name, stall_s, "--camera")


def open_microphone(name: str | None, stall_s: float, url: str | None) -> MicrophoneSource | NaoMicrophone:
    """A microphone of this computer, or NAO's."""
    return NaoMicrophone(url, stall_s=stall_s) if url is not None and name == NAO_NAME else microphone(name, stall_s)


def open_voice(stack: ExitStack, robot: Robot | None, language: str) -> Voice | None:
    """NAO's own voice, or espeak-ng's in a language through the loudspeaker; None where there is to be none.

    It is closed by the stack. Raises what `SpokenText` raises.
    """
    if isinstance(robot, NaoqiRobot):
        voice = Voice(robot.say_cleaned)
    elif language:
        spoken = SpokenText(language)
        voice = Voice(spoken.say)
        stack.callback(voice.close)
        stack.callback(spoken.close)  # before the voice, which waits for it
        return voice
    else:
        return None
    stack.callback(voice.close)
    return voice
