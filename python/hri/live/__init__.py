# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Words as they are spoken: microphones and recordings as streams, a listener that answers to every utterance, and a
recorder that keeps it."""

from hri.live.events import Event
from hri.live.listener import Listener
from hri.live.microphone import MicrophoneSource, list_microphones
from hri.live.recorder import WordRecorder
from hri.live.ring import SampleRing
from hri.live.sources import ArraySource, AudioSource, FileSource, Stalled

__all__ = [
    "ArraySource",
    "AudioSource",
    "Event",
    "FileSource",
    "Listener",
    "MicrophoneSource",
    "SampleRing",
    "Stalled",
    "WordRecorder",
    "list_microphones",
]
