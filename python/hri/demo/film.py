# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Signer and robot side by side."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.optional import import_opencv
from hri.demo.scenes import Scene
from hri.fusion import FusedDecision
from hri.media import write_video
from hri.recognition import Decision
from hri.recognition.decision import RECOGNISED
from hri.robot import Robot, gesture_trajectory, open_robot

Frame = NDArray[np.uint8]

FPS = 15.0
_PANE_PX = (400, 300)
_TITLE_PX = 40
_CAPTION_PX = 56
_PAUSE_FRAMES = 12
_INK = (60, 50, 40)
_PAPER = (250, 248, 245)
STOPPED = "stop"


def robot_moves(decision: FusedDecision) -> bool:
    """Whether the robot answers this decision by moving; on unknown, no input, ask and stop it rests."""
    return decision.status == RECOGNISED and decision.label != STOPPED


@dataclass(frozen=True)
class Answer:
    """What the robot did in a scene.

    Attributes
    ----------
    still : ndarray of uint8, shape (height, width, 3)
        One telling frame of the film, BGR.
    moved : bool
        It has moved.
    completed : bool
        The motion was carried out to its end.
    duration_s : float
        Of the motion, with the way to its first row, in the robot's time.
    message : str
        Why it did not end as it should; "" when it did.
    """

    still: Frame
    moved: bool = False
    completed: bool = False
    duration_s: float = 0.0
    message: str = ""


def make_film(path: Path, scenes: list[Scene], backend: str, progress: Callable[[int, int], None]) -> list[Answer]:
    """Write the film of all scenes, and give what the robot did in each."""
    answers: list[Answer] = []

    def frames() -> Iterator[Frame]:
        with open_robot(backend) as robot:
            for number, scene in enumerate(scenes):
                begin_s, num_events = robot.time_s, len(robot.events)
                shown, completed = _scene_frames(scene, robot, f"{number + 1}. {scene.script.title}")
                # The robot's pose is reached half-way through its motion, behind the signer's clip.
                moving = max(1, len(shown) - len(scene.frames))
                answers.append(
                    Answer(
                        shown[len(scene.frames) + moving // 2],
                        completed is not None,
                        completed is True,
                        robot.time_s - begin_s,
                        "; ".join(event.message for event in robot.events[num_events:]),
                    )
                )
                yield from shown
                progress(number + 1, len(scenes))

    write_video(path, frames(), FPS)
    return answers


def _scene_frames(scene: Scene, robot: Robot, title: str) -> tuple[list[Frame], bool | None]:
    """The film of a scene, and whether the robot's motion was carried out to its end; None where it rests."""
    resting = np.ascontiguousarray(robot.render(*_PANE_PX)[:, :, ::-1])
    film = [_side_by_side(frame, resting, title, "what is said and shown", "") for frame in scene.frames]
    said = f"heard: {_short(scene.decision.speech)}     seen: {_short(scene.decision.gesture)}"
    decided = f"fused: {_short(scene.decision)}  ({scene.decision.rule})"
    held = scene.frames[len(scene.frames) // 2]
    answer: list[Frame] = []
    completed = None
    if robot_moves(scene.decision):
        completed = robot.perform(
            gesture_trajectory(scene.decision.label),
            lambda image, time_s: answer.append(np.ascontiguousarray(image[:, :, ::-1])),
            FPS,
            _PANE_PX,
        )
    for image in [resting] * _PAUSE_FRAMES + (answer or [resting] * _PAUSE_FRAMES * 2):
        film.append(_side_by_side(held, image, title, said, decided))
    return film, completed


def _short(decision: Decision | FusedDecision | None) -> str:
    if decision is None:
        return "nothing"
    return f"{decision.label} {100 * decision.confidence:.0f}%"


def _side_by_side(signer: Frame, robot: Frame, title: str, first: str, second: str) -> Frame:
    cv2 = import_opencv("to draw the film")
    width, height = _PANE_PX
    canvas = np.full((_TITLE_PX + height + _CAPTION_PX, 2 * width, 3), _PAPER, dtype=np.uint8)
    canvas[_TITLE_PX : _TITLE_PX + height, :width] = cv2.resize(signer, _PANE_PX, interpolation=cv2.INTER_CUBIC)
    canvas[_TITLE_PX : _TITLE_PX + height, width:] = robot

    def write(text: str, row: int, scale: float) -> None:
        place: Any = (12, row)
        cv2.putText(canvas, text, place, cv2.FONT_HERSHEY_DUPLEX, scale, _INK, 1, cv2.LINE_AA)

    write(title, 27, 0.65)
    write(first, _TITLE_PX + height + 22, 0.5)
    write(second, _TITLE_PX + height + 45, 0.5)
    return canvas
