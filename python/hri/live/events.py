# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a live session reports: one event at a time, one line of JSON each."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any

from hri.recognition.decision import Decision, plain
from hri.recognition.possibility import nbest_fields

LISTENING = "listening"
LEVEL = "level"
SPEECH_START = "speech_start"
SPEECH_END = "speech_end"
SPEECH_DROPPED = "speech_dropped"
PAUSE = "pause"
"""In an utterance, within or between its words; `Listener` does not pass it on."""
WATCHING = "watching"
HAND = "hand"
GESTURE_START = "gesture_start"
GESTURE_END = "gesture_end"
GESTURE_DROPPED = "gesture_dropped"
PARTIAL = "partial"
PRELIMINARY = "preliminary"
SIGNING = "signing"
SIGNED = "signed"
RECONNECTED = "reconnected"
DECISION = "decision"
WAKE = "wake"
IGNORED = "ignored"
OVERFLOW = "overflow"
STALL = "stall"
PROMPT = "prompt"
RECORDED = "recorded"
REFUSED = "refused"
ENDED = "ended"


@dataclass(frozen=True)
class Event:
    """One thing that happened in a stream of sound or pictures.

    Attributes
    ----------
    time : float
        Seconds since the stream began: of sound by counting samples, of pictures by their time stamps.
    event : str
        "listening", "level", "speech_start", "speech_end", "speech_dropped" (what seemed to be speech was none),
        "decision", "wake" or "ignored" (said without the wake word), "overflow", "stall" or "ended"; while recording,
        "prompt", "recorded" and "refused" too. Of pictures "watching", "hand", "gesture_start", "gesture_end",
        "gesture_dropped", "partial", "preliminary" and "reconnected" take the place of those of speech; of signed
        sentences "signing" and "signed" that of decisions.
    fields : dict
        What belongs to this kind of event, see docs/listening.md and docs/watching.md.
    decision : Decision or None
        Of a "decision", a "preliminary" or a "partial".
    mode : "speech" or "gesture"
    """

    time: float
    event: str
    fields: dict[str, Any] = field(default_factory=dict)
    decision: Decision | None = None
    mode: str = "speech"

    def to_dict(self) -> dict[str, Any]:
        """As plain values that can be written as JSON."""
        result: dict[str, Any] = plain({"time": round(self.time, 4), "event": self.event, "mode": self.mode})
        return result | dict(plain(self.fields))

    def to_json(self) -> str:
        """As one line of JSON."""
        return json_line(self.to_dict())


def json_line(value: Any) -> str:
    """A value as one line of JSON that is Unicode: a byte of a file's name that is not UTF-8 becomes an escape."""
    return json.dumps(value, ensure_ascii=False).encode("utf-8", "backslashreplace").decode("utf-8")


def decision_fields(decision: Decision, locale: str, model: str) -> dict[str, Any]:
    """A decision by the names of ROS's LiveSpeech, and what that message has no place for."""
    recognised = decision.status == "recognised"
    return {
        "incremental": "",
        "final": decision.label if recognised else "",
        "confidence": decision.confidence,
        "locale": locale,
        "status": decision.status,
        "rejected": not recognised,
        "score": decision.score,
        "nbest": [
            fields | {"log_score": entry.log_score}
            for fields, entry in zip(nbest_fields(decision.nbest), decision.nbest, strict=True)
        ],
        "slots": dict(decision.slots),
        "notes": list(decision.notes),
        "model": model,
    }
