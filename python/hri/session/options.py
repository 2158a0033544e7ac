# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Options of a session: what belongs together, what is a command, when the robot asks."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from numbers import Real

from hri.core.errors import InvalidArgument
from hri.core.suggest import did_you_mean
from hri.fusion import RULES, FusionOptions

_POSITIVE = ("onset_s", "max_wait_s", "attend_s", "confirm_s", "sentence_s", "retry_s")
_SENTENCE_LABELS = ("sentence_begin_labels", "sentence_end_labels")
_LABELS = ("wake_labels", "yes_labels", "no_labels", "resume_labels", "imitate_labels", *_SENTENCE_LABELS)


@dataclass(frozen=True)
class SessionOptions:
    """How a session pairs words with signs and leads the dialogue.

    Attributes
    ----------
    window_s : float
        Longest time between the end of a word or sign and the beginning of the one that belongs to it, 0 or more; what
        overlaps is 0 apart. The default pairs what is a second apart: ends are found up to a quarter of a second early.
    onset_s : float
        How long after it began a word or sign is reported at the latest, above 0: for so long after the window the
        other mode is still waited for.
    max_wait_s : float
        Longest time from the end of a word or sign to its decision, above 0, however long the other mode goes on.
    rule : {"table_6_9", "weighted_sum", "product", "dempster_shafer"}
        As of `hri.fuse`.
    fusion : FusionOptions
        Thresholds and weights of the rule; which labels stop, and from which confidence.
    stop_at_rest : float
        While nothing moves, STOP by a word alone that is less sure than this is asked about, 0..1; 0 never asks. Where
        the robot moves or has asked something, and within a sentence, every STOP stops. For rooms where people talk.
    wake_labels : tuple of str
        A word or sign that precedes every command; () makes each a command.
    attend_s : float
        Longest time from the end of the wake word to the beginning of the command, above 0.
    confirm_below : float
        The robot asks before it carries out a command of less confidence, 0..1; 0 never asks, 1 always.
    confirm_s : float
        For how long it waits for the answer, above 0.
    yes_labels, no_labels : tuple of str
        Answers, beside the label itself, which confirms too.
    resume_labels : tuple of str
        What ends STOP; () leaves that to `Session.resume`.
    imitate_labels : tuple of str
        Commands from which on the robot moves its arms as the person before the camera does, until "no" or STOP.
    sentence_begin_labels, sentence_end_labels : tuple of str
        Between one of the first and one of the second words and signs are no commands but a sentence, as section 5.1 of
        the thesis has it; () for both: there are no sentences.
    sentence_s : float
        Longest time in a sentence from one word or sign to the next, above 0; then it is dropped.
    language : str
        Of the texts of stored sentences, by code.
    retry_s : float
        How often a source that vanished is opened again, above 0.

    Raises
    ------
    InvalidArgument
        For a value out of range, an unknown rule, or a label of two meanings.
    """

    window_s: float = 1.25
    onset_s: float = 0.25
    max_wait_s: float = 6.0
    rule: str = "table_6_9"
    fusion: FusionOptions = field(default_factory=FusionOptions)
    stop_at_rest: float = 0.0
    wake_labels: tuple[str, ...] = ()
    attend_s: float = 3.0
    confirm_below: float = 0.5
    confirm_s: float = 8.0
    yes_labels: tuple[str, ...] = ("yes",)
    no_labels: tuple[str, ...] = ("no",)
    resume_labels: tuple[str, ...] = ()
    imitate_labels: tuple[str, ...] = ()
    sentence_begin_labels: tuple[str, ...] = ()
    sentence_end_labels: tuple[str, ...] = ()
    sentence_s: float = 10.0
    language: str = "en"
    retry_s: float = 0.5

    def __post_init__(self) -> None:
        for name in ("window_s", "confirm_below", "stop_at_rest", *_POSITIVE):
            number: object = getattr(self, name)
            if isinstance(number, bool) or not isinstance(number, Real):
                raise InvalidArgument(f"SessionOptions.{name} must be a number, got {number!r}")
        if not (math.isfinite(self.window_s) and self.window_s >= 0):
            raise InvalidArgument(f"SessionOptions.window_s must be 0 or more and finite, got {self.window_s}")
        for name in _POSITIVE:
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0):
                raise InvalidArgument(f"SessionOptions.{name} must be above 0 and finite, got {value}")
        for name in ("confirm_below", "stop_at_rest"):
            if not 0 <= getattr(self, name) <= 1:
                raise InvalidArgument(f"SessionOptions.{name} must lie in 0..1, got {getattr(self, name)}")
        for name in ("rule", "language"):
            text: object = getattr(self, name)
            if not isinstance(text, str):
                raise InvalidArgument(f"SessionOptions.{name} must be text, got {text!r}")
        if self.rule not in RULES:
            raise InvalidArgument(f"SessionOptions.rule: no rule {self.rule!r}; {did_you_mean(self.rule, RULES)}")
        fusion: object = self.fusion
        if not isinstance(fusion, FusionOptions):
            raise InvalidArgument(f"SessionOptions.fusion must be FusionOptions, got {type(fusion).__name__}")
        self._require_labels()

    def _require_labels(self) -> None:
        meaning = dict.fromkeys(self.fusion.stop_labels, "fusion.stop_labels")
        for name in _LABELS:
            labels: object = getattr(self, name)
            if not isinstance(labels, tuple) or not all(isinstance(label, str) and label for label in labels):
                raise InvalidArgument(f"SessionOptions.{name} must be a tuple of labels, got {labels!r}")
            for label in labels:
                if meaning.setdefault(label, name) != name:
                    raise InvalidArgument(f"SessionOptions.{name}: {label!r} is one of {meaning[label]}, too")
        if bool(self.sentence_begin_labels) != bool(self.sentence_end_labels):
            raise InvalidArgument("SessionOptions.sentence_begin_labels and sentence_end_labels go together")

    @property
    def control_labels(self) -> frozenset[str]:
        """Labels that lead the dialogue and are no commands: they belong to nothing said or shown beside them."""
        answers = (*self.yes_labels, *self.no_labels)
        return frozenset((*self.wake_labels, *answers, *self.resume_labels, *self.sentence_labels))

    @property
    def sentence_labels(self) -> frozenset[str]:
        """Labels that begin and end a sentence."""
        return frozenset((*self.sentence_begin_labels, *self.sentence_end_labels))
