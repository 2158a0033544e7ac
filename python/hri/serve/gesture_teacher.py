# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Gestures that a person adds at the page, shown to its camera or by files dropped on it."""

from __future__ import annotations

import copy
import time
from collections import Counter
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import FormatError
from hri.core.phrases import phrase, phrase_of
from hri.live import FrameSource, Stalled, events, frame_results
from hri.live.frames import Frame, TimedFrame
from hri.live.spotting import FEWEST_FRAMES, SpottingStream, fault_of
from hri.recognition import GestureRecognizer
from hri.recognition.decision import RECOGNISED
from hri.serve.clips import read_clip
from hri.serve.devices import PageCamera
from hri.serve.messages import Media
from hri.serve.stage import Stage
from hri.serve.teacher import NUM_SAMPLES, STOPPED, Teacher, detail_of

LONGEST_S = 10.0
PAUSE_S = 2.5
"""After a sample, for the hand to go back, which is no command."""
_NO_PICTURES = phrase("no_pictures_come")
_NO_HAND = phrase("saw_no_hand")
_CHANGED = phrase("pictures_changed")
_HELD = phrase("show_held")
_DYNAMIC = phrase("show_moving")


class GestureTeacher(Teacher):
    """Adds gestures to the recogniser of a stage.

    Samples are found as `hri.live.GestureRecorder` finds them. While one is recorded only STOP is a command. Adding is
    tried with every sample left out before it is done with all, so that what the gesture is confused with can be said.

    Parameters
    ----------
    stage : Stage
    """

    mode = "gesture"
    noun = phrase("gesture_noun")
    alike_code = "sample_looks_like"

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        self._before: list[GestureRecognizer] = []
        self._camera = PageCamera(stage.limits.stall_s)
        self._recording = False

    def forget(self) -> None:
        """The page is gone, or another gesture begins: samples of a gesture that is not added yet are dropped."""
        super().forget()
        self._recording = False

    def see(self, picture: Media) -> None:
        """A picture of the page, by the server's thread."""
        if self._recording:
            self._camera.put(picture)

    def take_file(self, path: Path, name: str) -> str:
        """A sample from a file that was dropped on the page; returns why it was refused, or "".

        Parameters
        ----------
        path : Path
        name : str
            The file's name as the person knows it.
        """
        refused = self._refusal() or self._unnamed() or self._complete()
        if refused:
            return refused
        self._busy.acquire()
        with self._working():
            try:
                refused = self._keep(read_clip(path, name, self._stage.limits))
            except Exception as error:  # else the page hears nothing of it
                refused = detail_of(error)
        if refused:
            if not refused.startswith(f"{name}: "):
                refused = phrase("of_file", name=name, why=refused)
            self._answer(refused)
        return refused

    def _complete(self) -> str:
        """Why no sample more is taken, where adding by those that are there has failed; else ""."""
        complete = len(self._samples) == NUM_SAMPLES
        return phrase("samples_complete", label=self._label, most=NUM_SAMPLES) if complete else ""

    def _labels(self) -> list[str] | None:
        return None if self._stage.gestures is None else [str(label) for label in self._signs.classes_]

    @property
    def _signs(self) -> GestureRecognizer:
        assert self._stage.gestures is not None
        return self._stage.gestures

    def _prompt(self, label: str) -> str:
        return phrase("show_or_choose", label=label, most=NUM_SAMPLES)

    def _sample(self) -> None:
        self._recording = True
        self._stage.only_stop(LONGEST_S + PAUSE_S)
        self._answer(_DYNAMIC if self._signs.is_dynamic else _HELD, recording=True)
        self._in_background(self._record)

    @property
    def _is_recording(self) -> bool:
        return self._recording

    def _end_sample(self) -> bool:
        recording, self._recording = self._recording, False
        return recording

    def _record(self) -> None:
        try:
            frames, refused = self._watch()
        except Stalled:
            frames, refused = [], _NO_PICTURES
        except FormatError as error:
            frames, refused = [], phrase_of(error)
        finally:
            self._stage.only_stop(PAUSE_S)
            ended = not self._end_sample()
        if ended:
            if self._label:  # by STOP; else the page is gone
                self._answer(STOPPED)
            return
        refused = refused or self._keep(frames, shown=True)
        if refused:
            self._answer(refused)

    def _watch(self) -> tuple[list[Frame], str]:
        """The pictures of the gesture that is shown next, or why there are none."""
        stream = SpottingStream.for_recognizer(self._signs)
        self._camera.expect()
        source = _OneSize(self._camera.stream())
        until_s = time.monotonic() + LONGEST_S
        with closing(frame_results(source, stream)) as results:
            for result in results:
                for event in result.events:
                    if event.event == events.GESTURE_END:
                        refused = fault_of(stream.gesture, bool(event.fields["cut"]), source.num_lost)
                        return [frame for frame, _ in stream.gesture.frames], refused and phrase(
                            "once_more", why=refused
                        )
                if time.monotonic() > until_s or not self._recording:
                    break
        return [], phrase("saw_no_gesture")

    def _keep(self, frames: list[Frame], shown: bool = False) -> str:
        """Keep a sample, from a file or shown; why it is refused, or ""."""
        rows = self._signs.features(frames)
        if len(rows) == 0:
            return _NO_HAND
        if self._signs.is_dynamic and len(rows) < FEWEST_FRAMES:
            return phrase("too_few_pictures", count=len(rows), least=FEWEST_FRAMES)
        decision = self._signs.recognise_features(rows)
        if shown and self._is_stop(decision):
            return ""
        if decision.status == RECOGNISED:
            self._keep_sample(rows, decision.label)
        else:
            self._keep_sample(rows)
        return ""

    def _mistaken(self, label: str, samples: list[Any]) -> Counter[str]:
        return self._mistaken_by(self._best_of, label, samples)

    def _best_of(self, sample: NDArray[np.float32], added: dict[str, list[NDArray[np.float32]]]) -> str:
        signs = copy.copy(self._before[0])
        for label, samples in added.items():
            signs.add_gesture_features(label, samples)
        return str(signs.recognise_features(sample).nbest[0].label)

    def _add(self, label: str, samples: list[Any]) -> None:
        num_steps = len(samples) + 1
        for step in range(num_steps):
            self._answer(
                phrase("learning_step", label=label, step=step + 1, steps=num_steps), progress=step / num_steps
            )
            kept = [rows for number, rows in enumerate(samples) if number != step]
            more = copy.copy(self._signs).add_gesture_features(label, kept)
            if step == len(samples):  # none was left out
                self._before.append(self._signs)
                self._stage.signs = more
            elif (best := more.recognise_features(samples[step]).nbest[0].label) != label:
                self._alike[best] += 1

    def _remove(self, label: str) -> None:
        self._stage.signs = self._before.pop()


class _OneSize:
    """Pictures of one size; FormatError from `read` where that changes."""

    def __init__(self, source: FrameSource) -> None:
        self.name, self.fps = source.name, source.fps
        self._source = source
        self._shape: tuple[int, ...] | None = None

    @property
    def num_lost(self) -> int:
        return self._source.num_lost

    def read(self) -> TimedFrame | None:
        """The next picture and its time."""
        timed = self._source.read()
        if timed is not None:
            shape, self._shape = self._shape or timed[0].shape, timed[0].shape
            if shape != self._shape:
                raise FormatError(_CHANGED)
        return timed

    def reconnect(self) -> bool:
        """Never."""
        return False

    def close(self) -> None:
        """Read no more."""
        self._source.close()
