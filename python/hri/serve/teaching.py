# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Adding words and gestures at the page."""

from __future__ import annotations

from typing import Any

from hri.serve.command_teacher import CommandWordTeacher
from hri.serve.gesture_teacher import GestureTeacher
from hri.serve.stage import Stage
from hri.serve.teacher import Teacher
from hri.serve.word_teacher import WordTeacher


class Teaching:
    """Who adds what, by the mode of a command.

    Parameters
    ----------
    stage : Stage

    Attributes
    ----------
    words : WordTeacher or CommandWordTeacher
    gestures : GestureTeacher
    """

    def __init__(self, stage: Stage) -> None:
        self.words = WordTeacher(stage) if stage.recordings is None else CommandWordTeacher(stage)
        self.gestures = GestureTeacher(stage)
        self._teachers: dict[str, Teacher] = {one.mode: one for one in (self.words, self.gestures)}
        stage.on_stop = self.interrupt
        stage.teaching_state = self.state

    def obey(self, command: dict[str, Any]) -> None:
        """A command of the page with its "mode"."""
        self._teachers[command["mode"]].obey(command)

    def state(self) -> dict[str, Any]:
        """How far each is, by its mode."""
        return {mode: teacher.state() for mode, teacher in self._teachers.items()}

    def interrupt(self) -> None:
        """STOP: a sample that is being taken is not kept; by any thread."""
        for teacher in self._teachers.values():
            teacher.interrupt()

    def forget(self) -> None:
        """The page is gone: samples of what is not added yet are dropped."""
        for teacher in self._teachers.values():
            teacher.forget()
