# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Words as they are spoken and signs as they are shown: microphones, cameras and recordings as streams, a listener and
a watcher that answer to every utterance and gesture, and recorders that keep them."""

from hri.live.attention import Attention
from hri.live.camera import CameraSource, FrameQueue
from hri.live.events import Event
from hri.live.frame_results import FrameResult, frame_results
from hri.live.frames import ClipSource, FrameSource, VideoSource
from hri.live.gesture_recorder import GestureRecorder
from hri.live.hand_frames import GestureRows, HandFrames, PersonTracks
from hri.live.listener import Listener
from hri.live.loudspeaker import Loudspeaker
from hri.live.microphone import MicrophoneSource, list_microphones
from hri.live.recorder import WordRecorder
from hri.live.ring import SampleRing
from hri.live.sign_watcher import SignWatcher
from hri.live.sources import ArraySource, AudioSource, FileSource, Stalled
from hri.live.utterances import UtteranceFinder
from hri.live.visibility import MISSING_TEXTS, Visibility, missing_text
from hri.live.watch_picture import draw_result
from hri.live.watcher import Watcher

__all__ = [
    "MISSING_TEXTS",
    "ArraySource",
    "Attention",
    "AudioSource",
    "CameraSource",
    "ClipSource",
    "Event",
    "FileSource",
    "FrameQueue",
    "FrameResult",
    "FrameSource",
    "GestureRecorder",
    "GestureRows",
    "HandFrames",
    "Listener",
    "Loudspeaker",
    "MicrophoneSource",
    "PersonTracks",
    "SampleRing",
    "SignWatcher",
    "Stalled",
    "UtteranceFinder",
    "VideoSource",
    "Visibility",
    "Watcher",
    "WordRecorder",
    "draw_result",
    "frame_results",
    "list_microphones",
    "missing_text",
]
