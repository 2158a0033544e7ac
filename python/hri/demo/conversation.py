# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a session makes of a scene: the events that its page shows, and the robot's answer as figures."""

from __future__ import annotations

from typing import Any

import numpy as np

from hri.demo.film import Answer, robot_moves
from hri.demo.scenes import Scene
from hri.live import Event
from hri.page import figure
from hri.recognition import Decision
from hri.recognition.possibility import nbest_fields
from hri.robot import HOAP2, gesture_trajectory, load_gestures
from hri.session import Dialogue, Pair, SessionOptions
from hri.session.dialogue import IGNORE, SAY, STOP
from hri.session.logic import MOTION_END, fused_event, moved_event, session_event
from hri.session.mover import Moved

FIGURES_PER_S = 10.0


def shown(scene: Scene, answer: Answer) -> dict[str, Any]:
    """A scene, and what the robot did in it, as the page's script takes it.

    Returns
    -------
    dict
        "speech" and "gesture": the best classes of each mode; "events": as a session reports them; "figures": of the
        robot, `FIGURES_PER_S` of them a second, from rest.
    """
    return {
        **{mode: _best(getattr(scene.decision, mode)) for mode in ("speech", "gesture")},
        "events": [event.to_dict() for event in conversation(scene, answer)],
        "figures": _figures(scene),
        "figures_per_s": FIGURES_PER_S,
    }


def conversation(scene: Scene, answer: Answer) -> list[Event]:
    """The decision, what the robot says by `hri.session.Dialogue`, which never asks twice here, and how it moved."""
    end_s = max(len(scene.audio.samples) / scene.audio.sample_rate_hz, len(scene.frames) / scene.fps)
    pair = Pair(scene.decision, 0.0, end_s, 0.0, "a word and a sign at once")
    events = [fused_event(pair, end_s)]
    for action in Dialogue(SessionOptions(confirm_below=0.0), tuple(load_gestures())).decide(pair, end_s):
        if action.kind == SAY:
            events.append(session_event(end_s, SAY, text=action.text))
        elif action.kind in (STOP, IGNORE):
            events.append(session_event(end_s, action.kind, label=action.label, reason=action.text))
    if answer.moved:
        label, done_s = scene.decision.label, end_s + answer.duration_s
        ended = Moved(MOTION_END, label, done_s, number=1, message=answer.message, completed=answer.completed)
        events.append(moved_event(ended))
    return events


def _best(decision: Decision | None) -> list[dict[str, Any]]:
    return [] if decision is None else nbest_fields(decision.nbest)


def _figures(scene: Scene) -> list[dict[str, Any]]:
    if not robot_moves(scene.decision):
        return [figure(HOAP2.rest_rad, HOAP2)]
    motion = gesture_trajectory(scene.decision.label)
    times_s = np.arange(0.0, motion.duration_s + 1.0 / FIGURES_PER_S, 1.0 / FIGURES_PER_S)
    rows = motion.at(np.minimum(times_s, motion.duration_s))
    return [figure({**HOAP2.rest_rad, **dict(zip(motion.joint_names, row, strict=True))}, HOAP2) for row in rows]
