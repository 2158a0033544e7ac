# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A live session: words and signs paired, a dialogue, a robot that answers."""

from hri.session.dialogue import STATES, Action, Dialogue
from hri.session.event_schema import event_schema
from hri.session.feeds import SessionRecorder
from hri.session.imitation import Imitator
from hri.session.live import EventQueue
from hri.session.motions import LabelMotions, read_motions
from hri.session.mover import Guided
from hri.session.nao_camera import NaoCamera
from hri.session.nao_microphone import NaoMicrophone
from hri.session.options import SessionOptions
from hri.session.pairing import Observation, Pair, Pairer
from hri.session.reading import Recording, read_recording
from hri.session.recording import McapRecorder
from hri.session.replay import decisions, is_repeated, replay
from hri.session.session import Session
from hri.session.voice import Voice

__all__ = [
    "STATES",
    "Action",
    "Dialogue",
    "EventQueue",
    "Guided",
    "Imitator",
    "LabelMotions",
    "McapRecorder",
    "NaoCamera",
    "NaoMicrophone",
    "Observation",
    "Pair",
    "Pairer",
    "Recording",
    "Session",
    "SessionOptions",
    "SessionRecorder",
    "Voice",
    "decisions",
    "event_schema",
    "is_repeated",
    "read_motions",
    "read_recording",
    "replay",
]
