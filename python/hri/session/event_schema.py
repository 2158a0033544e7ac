# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""JSON schemas (draft 2020-12) of the events of a session, and of the times of what was recorded."""

from __future__ import annotations

from typing import Any

EVENT, TIMING = "hri.Event", "hri.Timing"
_DIALECT = "https://json-schema.org/draft/2020-12/schema"
Schema = dict[str, Any]


def _of(kind: str, description: str, **more: Any) -> Schema:
    return {"type": kind, "description": description, **more}


def _list(items: Schema, description: str) -> Schema:
    return {"type": "array", "items": items, "description": description}


_TEXT, _NUMBER = {"type": "string"}, {"type": "number"}
_COUNTED = {"type": "integer", "minimum": 0}
_ENTRY = {
    "type": "object",
    "properties": {"label": _TEXT, "probability": _NUMBER, "log_score": _NUMBER},
    "required": ["label", "probability"],
}
_OF_ONE_MODE = {
    "type": ["object", "null"],
    "description": "What this mode brought; null where nothing",
    "properties": {
        "label": _of("string", "The label; status again unless it is recognised"),
        "status": _TEXT,
        "confidence": _NUMBER,
    },
    "required": ["label", "status", "confidence"],
}
_FIELDS: dict[str, Schema] = {
    "apart_s": _of("number", "Seconds between word and sign; 0 for one alone"),
    "area": _of("number", "Of the hand, as a share of the picture's area"),
    "before": _of("string", "The state that was left"),
    "carried_by": _of("string", "Which mode led to the decision", enum=["speech", "gesture", "both", ""]),
    "command": _of("string", "Which", enum=["stop", "resume", "imitate", "rest", "only_stop"]),
    "completed": _of("boolean", "The motion was carried out to its end"),
    "compute_ms": _of("number", "The computer's time in milliseconds, without waiting"),
    "confidence": _of("number", "Calibrated probability of the best label, 0 to 1, also where it is rejected"),
    "cut": _of("boolean", "It went on for too long and was cut off"),
    "distance": {"type": ["number", "null"], "description": "To the nearest stored sentence, 0 to 1; null without one"},
    "fault": _of("boolean", "The robot takes no commands"),
    "final": _of("string", "The label to act on; empty unless status is recognised"),
    "first_s": _of("number", "When it began, in seconds of the session's time"),
    "for_s": _of("number", "How long nothing but STOP counts, in seconds"),
    "fps": _of("number", "Pictures a second that the source says it gives"),
    "in_gesture": _of("boolean", "A gesture has begun and not ended"),
    "in_speech": _of("boolean", "Speech has begun and not ended"),
    "incremental": _of("string", "The label so far, not to be acted on; empty in a decision"),
    "label": _of("string", "Which; empty where none is meant"),
    "last_s": _of("number", "When it ended, in seconds of the session's time"),
    "level_db": _of("number", "Level in dB of full scale"),
    "locale": _of("string", "Language, as given to the recogniser's stream"),
    "log_score": _of("number", "Log-likelihood of the sentence"),
    "lost_frames": _of("integer", "Pictures lost", minimum=0),
    "lost_samples": _of("integer", "Samples lost", minimum=0),
    "message": _of("string", "What is wrong, in words; empty where nothing is"),
    "missing": _of("string", "What keeps the hand from being seen", enum=["", "light", "face", "hand"]),
    "model": _of("string", "Which model: its name and hash, where known"),
    "nbest": _list(_ENTRY, "The most probable labels, the best first"),
    "near": _of("string", "The urgent label that was rejected by little"),
    "nearest": _list(_TEXT, "Words of the nearest stored sentence"),
    "notes": _list(_TEXT, "What the recogniser noted about the input"),
    "num_stable": _of("integer", "So many of the first words stand until the end", minimum=0),
    "number": _of("integer", "Which motion of the session it is, from 1", minimum=1),
    "over_noise_db": _of("number", "Level over the noise floor in dB"),
    "quality": _of("number", "How well the hand stands out, 0 to 1"),
    "reason": _of("string", "Why"),
    "rejected": _of("boolean", "Not recognised"),
    "rule": _of("string", "Which rule of fusion fired"),
    "sample_rate_hz": _of("integer", "Samples a second", minimum=1),
    "score": _of("number", "What the rejection threshold is compared with"),
    "slots": _of("object", "Slots of a command of several words", additionalProperties=_TEXT),
    "source": _of("string", "Name of the microphone, camera or file"),
    "speech": _OF_ONE_MODE,
    "gesture": _OF_ONE_MODE,
    "state": _of("string", "The state that was entered"),
    "status": _of("string", "Of a decision", enum=["recognised", "unknown", "no_input", "ask"]),
    "text": _of("string", "What the robot says"),
    "times_s": _list({"type": "array", "items": _NUMBER, "minItems": 2, "maxItems": 2}, "Begin and end of each word"),
    "wait_ms": _of("number", "From the end of the word or sign to the decision, in milliseconds"),
    "whole": _of("string", "What an utterance is as a whole, where it was decided on early as something else"),
    "why": _of("string", "Why paired, or alone"),
    "words": _list(_TEXT, "Of the sentence"),
    "x": {
        "type": ["number", "null"],
        "description": "Middle of the hand, as a share of the width; null without a hand",
    },
    "y": {"type": ["number", "null"], "description": "The same of the height"},
}
_SPAN = ("first_s", "last_s")
_DECIDED = ("incremental", "final", "confidence", "locale", "status", "rejected", "score", "nbest", "slots", "notes")
_DECISION = (*_SPAN, *_DECIDED, "model", "compute_ms")
_MOTION = ("label", "number")
_KINDS: dict[str, tuple[str, ...]] = {
    "listening": ("source", "sample_rate_hz", "model"),
    "level": ("level_db", "over_noise_db", "in_speech"),
    "speech_start": ("first_s",),
    "speech_end": (*_SPAN, "cut"),
    "speech_dropped": _SPAN,
    "watching": ("source", "fps", "model"),
    "hand": ("area", "x", "y", "quality", "in_gesture", "missing"),
    "gesture_start": ("first_s",),
    "gesture_end": (*_SPAN, "reason", "cut"),
    "gesture_dropped": (*_SPAN, "reason"),
    "partial": (*_DECIDED, "model"),
    "preliminary": _DECISION,
    "decision": _DECISION,
    "signing": (*_SPAN, "words", "times_s", "num_stable"),
    "signed": (*_SPAN, "words", "times_s", "log_score", "locale", "model", "compute_ms"),
    "overflow": (),  # lost_samples or lost_frames
    "stall": ("message",),
    "reconnected": (),
    "ended": (),
    "fused": (
        *_SPAN,
        *("final", "slots", "status", "confidence", "rule", "why", "carried_by", "apart_s"),
        *("speech", "gesture", "nbest"),
    ),
    "state": ("state", "before"),
    "say": ("text",),
    "sentence": ("words", "nearest", "distance"),
    "ignored": ("label", "reason"),
    "stop": ("label", "reason"),
    "rest": ("label", "reason"),
    "resumed": (),
    "asked": ("command",),
    "tick": (),
    "voice_start": ("text", "message"),
    "voice_end": ("text", "message"),
    "motion_start": (*_MOTION, "wait_ms", "compute_ms"),
    "halt": (*_MOTION, "wait_ms", "compute_ms"),
    "motion_end": (*_MOTION, "completed", "message", "fault"),
}
"""Fields that events of each kind always have."""


def event_schema() -> Schema:
    """The schema of an event: fields that all have, and those that events of each kind must have."""
    common: Schema = {
        "time": _of("number", "Seconds since the session began"),
        "event": _of("string", "Kind of event", enum=sorted(_KINDS)),
        "mode": _of("string", "What it belongs to", enum=["speech", "gesture", "session", "robot"]),
    }
    return {
        "$schema": _DIALECT,
        "title": EVENT,
        "description": "Something that happened in a session, in the order in which it was heeded",
        "type": "object",
        "properties": {**common, **_FIELDS},
        "required": list(common),
        "additionalProperties": False,
        "allOf": [
            {"if": {"properties": {"event": {"const": kind}}}, "then": {"required": list(names)}}
            for kind, names in _KINDS.items()
            if names
        ],
    }


def timing_schema() -> Schema:
    """The schema of the time of a message of sound or pictures, which follows right after it."""
    fields: Schema = {
        "topic": _of("string", "Of the message"),
        "sequence": _of("integer", "Of the message in its topic, from 0", minimum=0),
        "stream": _of("integer", "From 0; a source that comes back begins the next one", minimum=0),
        "time_s": _of("number", "When the first sample, or the picture, was in its stream, in seconds"),
        "offset_s": _of("number", "By how much the session's time is ahead of the stream's, in seconds"),
    }
    return {
        "$schema": _DIALECT,
        "title": TIMING,
        "description": "When a message of sound or pictures was in its stream",
        "type": "object",
        "properties": fields,
        "required": list(fields),
        "additionalProperties": False,
    }
