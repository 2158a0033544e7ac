# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Signer and robot side by side, and what the robot did."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.demo.scenes import Scene
from hri.fusion import FusedDecision
from hri.media import write_video
from hri.media.optional import import_opencv
from hri.recognition import Decision
from hri.recognition.decision import RECOGNISED, UNKNOWN
from hri.robot import Robot, Trajectory, check_trajectory, gesture_trajectory, open_robot

Frame = NDArray[np.uint8]

FPS = 15.0
_PANE_PX = (480, 360)
_HEAD_PX = 104
_PAUSE_FRAMES = 12
_INK, _PALE, _PAPER = (60, 50, 40), (130, 115, 100), (250, 248, 245)
STOPPED = "stop"


@dataclass
class Answer:
    """What the robot did in one scene.

    Attributes
    ----------
    trajectory : Trajectory or None
        None when it rests.
    num_warnings : int
        Of the check; a motion with an error is not carried out.
    times_s, measured_rad : list
        Where the trajectory's joints were, frame by frame.
    still : ndarray or None
        A telling frame of the film, BGR.
    """

    trajectory: Trajectory | None = None
    num_warnings: int = 0
    times_s: list[float] = field(default_factory=list)
    measured_rad: list[NDArray[np.float64]] = field(default_factory=list)
    still: Frame | None = None

    @property
    def largest_error_deg(self) -> float:
        """The most that a joint was off its commanded angle, over all frames."""
        if self.trajectory is None:
            return 0.0
        commanded = np.array([self.trajectory.at(time_s) for time_s in self.times_s])
        return float(np.degrees(np.abs(commanded - np.array(self.measured_rad)).max()))

    def to_dict(self) -> dict[str, Any]:
        """As plain values that can be written as JSON."""
        if self.trajectory is None:
            return {"moved": False}
        rows, joints = self.trajectory.positions_rad.shape
        return {
            "moved": True,
            "rows": rows,
            "joints": joints,
            "duration_s": self.trajectory.duration_s,
            "check_errors": 0,
            "check_warnings": self.num_warnings,
            "largest_error_deg": self.largest_error_deg,
        }


def robot_moves(decision: FusedDecision) -> bool:
    """Whether the robot answers this decision by moving; on unknown, no input and stop it rests."""
    return decision.status == RECOGNISED and decision.label != STOPPED


def make_film(path: Path, scenes: list[Scene], backend: str, progress: Callable[[int, int], None]) -> list[Answer]:
    """Write the film of all scenes, and tell what the robot did in each."""
    answers = [Answer() for _ in scenes]

    def frames() -> Iterator[Frame]:
        with open_robot(backend) as robot:
            for number, scene in enumerate(scenes):
                yield from _scene_frames(scene, robot, answers[number], f"{number + 1}. {scene.script.title}")
                progress(number + 1, len(scenes))

    write_video(path, frames(), FPS)
    return answers


def _scene_frames(scene: Scene, robot: Robot, answer: Answer, title: str) -> Iterator[Frame]:
    resting = np.ascontiguousarray(robot.render(*_PANE_PX)[:, :, ::-1])
    clip = scene.frames or [_no_camera()] * _PAUSE_FRAMES
    for frame in clip:
        yield _side_by_side(
            frame, resting, title, "listening and watching ..." if scene.frames else "listening ...", ""
        )
    said = f"heard: {told(scene.decision.speech)}     seen: {told(scene.decision.gesture)}"
    decided = f"decided: {told(scene.decision)}   [{scene.decision.rule}]"
    images = _perform(scene.decision.label, robot, answer) if robot_moves(scene.decision) else []
    images = [resting] * _PAUSE_FRAMES + (images or [resting] * _PAUSE_FRAMES * 2)
    held = clip[len(clip) // 2]
    shown = [_side_by_side(held, image, title, said, decided) for image in images]
    answer.still = shown[len(shown) // 2 + (_PAUSE_FRAMES // 2 if answer.trajectory else 0)]
    yield from shown


def _perform(label: str, robot: Robot, answer: Answer) -> list[Frame]:
    """Check the motion, carry it out, and keep pictures and joint angles."""
    trajectory = gesture_trajectory(label)
    answer.num_warnings = len(check_trajectory(trajectory))  # perform refuses errors
    names = trajectory.joint_names
    robot.reset(dict(zip(names, trajectory.positions_rad[0].tolist(), strict=True)))  # so that it begins at once
    images: list[Frame] = []

    def keep(image: Frame, time_s: float) -> None:
        positions = robot.joint_positions_rad()
        answer.times_s.append(time_s)
        answer.measured_rad.append(np.array([positions[name] for name in names]))
        images.append(np.ascontiguousarray(image[:, :, ::-1]))

    robot.perform(trajectory, keep, FPS, _PANE_PX)
    answer.trajectory = trajectory
    return images


def told(decision: Decision | FusedDecision | None) -> str:
    """A decision in a few words; the probability of what was rejected is said to be that of the closest class."""
    if decision is None or not decision.nbest:
        return decision.label if decision else "nothing"
    if decision.status == UNKNOWN:
        return f"unknown (closest: {decision.nbest[0].label}, {100 * decision.nbest[0].probability:.0f} %)"
    return f"{decision.label} ({100 * decision.confidence:.0f} %)"


def _no_camera() -> Frame:
    cv2 = import_opencv("to draw the film")
    width, height = _PANE_PX
    frame = np.full((height, width, 3), 225, dtype=np.uint8)
    place: Any = (width // 2 - 66, height // 2)
    cv2.putText(frame, "no camera", place, cv2.FONT_HERSHEY_DUPLEX, 0.8, _PALE, 1, cv2.LINE_AA)
    return frame


def _side_by_side(signer: Frame, robot: Frame, title: str, first: str, second: str) -> Frame:
    cv2 = import_opencv("to draw the film")
    width, height = _PANE_PX
    canvas = np.full((_HEAD_PX + height, 2 * width, 3), _PAPER, dtype=np.uint8)
    canvas[_HEAD_PX:, :width] = cv2.resize(signer, _PANE_PX, interpolation=cv2.INTER_CUBIC)
    canvas[_HEAD_PX:, width:] = robot

    # Above the pictures, for players lay their buttons over the lower edge.
    for text, row, scale in ((title, 32, 0.75), (first, 63, 0.55), (second, 89, 0.55)):
        place: Any = (14, row)
        cv2.putText(canvas, text, place, cv2.FONT_HERSHEY_DUPLEX, scale, _INK, 1, cv2.LINE_AA)
    return canvas
