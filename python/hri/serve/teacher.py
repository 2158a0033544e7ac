# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What adding words and adding gestures at the page have in common: a name, three samples, and an undo."""

from __future__ import annotations

import logging
import threading
import time
from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, ClassVar

from hri.core.errors import Error
from hri.core.phrases import Phrase, phrase, phrase_of
from hri.recognition import Decision
from hri.recognition.decision import RECOGNISED
from hri.robot import load_gestures
from hri.serve.stage import Stage

NUM_SAMPLES = 3
BestOf = Callable[[Any, dict[str, list[Any]]], str]
_WAIT_S = 0.1
_MOVES = phrase("counts_at_rest")
STOPPED = phrase("sample_stopped")

log = logging.getLogger("hri.serve")


class Teacher(ABC):
    """Adds labels to a recogniser of a stage.

    Parameters
    ----------
    stage : Stage
    """

    mode: ClassVar[str]
    alike_code: ClassVar[str]
    noun: ClassVar[Phrase]

    def __init__(self, stage: Stage) -> None:
        self._stage = stage
        self._label = ""
        self._full = ""
        self._samples: list[Any] = []
        self._likes: list[str] = []
        self._alike: Counter[str] = Counter()
        self._added: dict[str, list[Any]] = {}
        self._busy = threading.Lock()
        self._worker = 0
        self._last: dict[str, Any] | None = None

    def obey(self, command: dict[str, Any]) -> None:
        """A command of the page: "teach" a label, take a "sample", or "undo"; answers are published."""
        refusal = self._refusal()
        if refusal:
            self._answer(refusal)
        elif command["type"] == "teach":
            self._begin(command["label"])
        elif command["type"] == "sample":
            unnamed = self._unnamed()
            if unnamed:
                self._answer(unnamed)
            elif len(self._samples) == NUM_SAMPLES:
                self._in_background(self._add_kept)  # which has failed before
            else:
                self._sample()
        elif command["type"] == "undo":
            self._in_background(self._undo)

    def state(self) -> dict[str, Any]:
        """How far it is, for a page that comes: name and samples of what is being added, and what was added here."""
        return {
            "label": self._label,
            "samples": len(self._samples),
            "wanted": NUM_SAMPLES,
            "added": list(self._added),
            "recording": self._is_recording,
            "busy": self._busy.locked(),
        }

    def forget(self) -> None:
        """The page is gone: the samples of what is not added yet are dropped."""
        self._label = self._full = ""
        self._samples, self._likes = [], []
        self._alike.clear()

    def interrupt(self) -> None:
        """STOP: a sample that is being taken is not kept; those before it are."""
        if self._end_sample() and not self._busy.locked():  # else who is at work answers
            self._answer(STOPPED)

    @abstractmethod
    def _labels(self) -> list[str] | None:
        """Those of the recogniser, None without one."""

    @abstractmethod
    def _prompt(self, label: str) -> str:
        """What to do after Record is pressed."""

    @abstractmethod
    def _sample(self) -> None:
        """Begin to take a sample."""

    @property
    @abstractmethod
    def _is_recording(self) -> bool:
        """Whether a sample is being taken."""

    @abstractmethod
    def _end_sample(self) -> bool:
        """Keep nothing of a sample that is being taken; whether there was one."""

    @abstractmethod
    def _mistaken(self, label: str, samples: list[Any]) -> Counter[str]:
        """How many samples of others, each left out in its turn, are recognised as `label`, which was just added.

        The others are those that were added here: of those trained before no samples are there.
        """

    @abstractmethod
    def _add(self, label: str, samples: list[Any]) -> None:
        """Change the recogniser."""

    @abstractmethod
    def _remove(self, label: str) -> None:
        """Take back what was added last."""

    def _refusal(self) -> str:
        """Why nothing can be done now; "" where it can."""
        if self._labels() is None:
            return phrase("no_recogniser", noun=self.noun)
        if not self._busy.locked():
            return ""
        if len(self._samples) == NUM_SAMPLES:
            return phrase("enough_samples", most=NUM_SAMPLES, noun=self.noun)
        return phrase("wait_until_added", noun=phrase("sample"))

    def _begin(self, label: str) -> None:
        if label in (self._labels() or ()):
            self._answer(phrase("already_known", label=label, noun=self.noun))
            return
        self.forget()
        self._label = label
        self._answer(self._prompt(label))

    def _unnamed(self) -> str:
        """Why no sample can be taken; "" where a label waits for one."""
        if self._label:
            return ""
        if self._full:
            return phrase("has_its_samples", label=self._full, most=NUM_SAMPLES, noun=self.noun)
        return phrase("first_a_name", noun=self.noun)

    def _is_stop(self, decision: Decision) -> bool:
        """Whether what was just recorded is STOP: it counts then, and is no sample."""
        stops = self._stage.session.options.fusion.stop_labels
        if decision.status != RECOGNISED or decision.label not in stops:
            return False
        self._stage.stop()
        self._answer(STOPPED)
        return True

    def _keep_sample(self, sample: Any, alike: str = "") -> None:
        """Keep a sample, which is like one of the label `alike`, if any; the last one is followed by adding."""
        if not self._label:  # the page is gone
            return
        self._samples.append(sample)
        self._likes.append(alike)
        if len(self._samples) < NUM_SAMPLES:
            values = {"number": len(self._samples), "most": NUM_SAMPLES}
            self._answer(phrase(self.alike_code, label=alike, **values) if alike else phrase("sample_of", **values))
            return
        self._add_kept()

    def _add_kept(self) -> None:
        """Add the label by its samples; where that fails both stay, and Record tries it once more."""
        label, samples, likes = self._label, self._samples, self._likes
        self._alike.clear()
        try:
            self._add(label, samples)
        except Exception as error:  # whatever it is: the samples cost the person more than another try
            self._answer(phrase("adding_failed", label=label, detail=detail_of(error)))
            return
        likened = Counter(like for like in likes if like) + self._alike
        self.forget()
        self._full = label
        try:
            mistaken = self._mistaken(label, samples)
        finally:
            self._added[label] = samples  # it can be undone, whatever else fails
        self._renew()
        moves = label in self._stage.session.motions
        more = [] if moves or label not in load_gestures() else [phrase("cannot_move_so")]
        labels = [other for other, _ in (likened + mistaken).most_common()]
        confused = [{"label": one, "samples": likened[one], "samples_of_other": mistaken[one]} for one in labels]
        more = [*self._warning(labels), *more, *self._advice()]
        text = phrase("added_with", first=phrase("added", label=label), more=more)
        self._answer(text, confused=confused)

    def _advice(self) -> list[Phrase]:
        """What is to be done after adding."""
        return []

    def _mistaken_by(self, best_of: BestOf, label: str, samples: list[Any]) -> Counter[str]:
        """As `_mistaken`, by what gives the most probable label of a sample, were these labels added, and no others."""
        counts: Counter[str] = Counter()
        for other, theirs in self._added.items():
            self._answer(phrase("trying_beside", other=other, label=label), progress=1.0)
            for number, sample in enumerate(theirs):
                kept = theirs[:number] + theirs[number + 1 :]
                counts[other] += best_of(sample, {other: kept, label: samples}) == label
        return +counts

    def _warning(self, confused: list[str]) -> list[Phrase]:
        """Which of the others it may be confused with."""
        if not confused:
            return []
        others = [phrase("quoted", label=other) for other in confused]
        return [phrase("may_be_confused", others=others, noun=self.noun)]

    def _undo(self) -> None:
        """Take back what came last: a sample that is recorded, one that is kept, a name, or what was added."""
        label, samples, likes = self._label, self._samples, self._likes
        if self._end_sample():
            self._answer(phrase("recording_ended"))
        elif samples:
            samples.pop()
            likes.pop()
            self._answer(phrase("sample_taken_back", label=label, number=len(samples), most=NUM_SAMPLES))
        elif label:
            self.forget()
            self._answer(phrase("name_taken_back", label=label))
        elif self._added:
            self._remove_last()
        else:
            self._answer(phrase("nothing_to_undo"))

    def _remove_last(self) -> None:
        self.forget()
        label = next(reversed(self._added))
        self._remove(label)
        del self._added[label]
        self._renew()
        self._answer(phrase("removed", label=label), confused=[])

    def _renew(self) -> None:
        """Begin a new session as soon as the robot rests: commands count while something is learned."""
        if self._stage.moving:
            self._answer(_MOVES, progress=1.0)
        while self._stage.moving:
            time.sleep(_WAIT_S)
        self._stage.renew()

    def _in_background(self, work: Callable[[], None]) -> None:
        self._busy.acquire()  # before the thread runs: the next command is refused already

        def run() -> None:
            with self._working():
                try:
                    work()
                except Exception as error:  # else the page waits for ever
                    self._answer(phrase("did_not_work", detail=detail_of(error)))

        threading.Thread(target=run, daemon=True, name=f"hri-teach-{self.mode}").start()

    @contextmanager
    def _working(self) -> Iterator[None]:
        """While `_busy` is held, and gives it back; only then is published what the work came to."""
        self._worker = threading.get_ident()
        try:
            yield
        finally:
            self._worker = 0
            last, self._last = self._last, None
            self._busy.release()
            if last is not None:
                self._stage.publish(last)

    def _answer(self, text: str, recording: bool = False, **more: Any) -> None:
        message = {"type": "teach", "mode": self.mode, "text": text, "label": self._label, "recording": recording}
        message |= {"samples": len(self._samples), "wanted": NUM_SAMPLES, "added": list(self._added), **more}
        if threading.get_ident() == self._worker and "progress" not in more:
            self._last = message
        else:
            self._stage.publish(message)


def detail_of(error: Exception) -> str:
    """What an error says, for the page; one that was not foreseen is logged whole."""
    if isinstance(error, Error):
        return phrase_of(error)
    log.error("a word or a gesture could not be added", exc_info=error)
    return f"{type(error).__name__}: {error}"
