# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Which utterances are commands: above a threshold and, with a wake word, said right after it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from hri.core.errors import InvalidArgument
from hri.recognition.decision import NO_INPUT, RECOGNISED, UNKNOWN, Decision

COMMAND = "command"
WAKE = "wake"
IGNORED = "ignored"


@dataclass(frozen=True)
class Attention:
    """When an utterance is a command.

    Attributes
    ----------
    wake : str
        A word of the vocabulary that precedes every command; "" makes every word a command.
    within_s : float
        Longest time from the end of the wake word to the beginning of the command, which is the first utterance after
        it: any other utterance in between ends the attention, since conversations would otherwise hold many commands.
    always : tuple of str
        Words that are commands at any moment, without the wake word, for safety. The default is without effect where
        the vocabulary has no "stop".
    min_score : float, optional
        Threshold on ``Decision.score`` of wake word and command, in place of the model's own.
    """

    wake: str = ""
    within_s: float = 3.0
    always: tuple[str, ...] = ("stop",)
    min_score: float | None = None

    def __post_init__(self) -> None:
        if not (math.isfinite(self.within_s) and self.within_s > 0):
            raise InvalidArgument(f"within_s must be above 0, got {self.within_s}")
        if self.min_score is not None and not math.isfinite(self.min_score):
            raise InvalidArgument(f"min_score must be finite, got {self.min_score}")


class AttentionTracker:
    """Classifies every utterance of one stream as wake word, command or ignored."""

    def __init__(self, attention: Attention) -> None:
        self._attention = attention
        self._awake_until_s = -math.inf

    def judge(self, first_s: float, last_s: float, decision: Decision) -> tuple[str, Decision]:
        """The utterance from `first_s` to `last_s`: "command", "wake" or "ignored", and the decision by `min_score`.

        Commands may be rejected all the same: their decision says so. Utterances come in the order they were said.
        """
        decision = with_threshold(decision, self._attention.min_score)
        wake = self._attention.wake
        if not wake:
            return COMMAND, decision
        if decision.status == NO_INPUT:
            return IGNORED, decision
        awake = first_s <= self._awake_until_s
        self._awake_until_s = -math.inf
        if decision.status == RECOGNISED and decision.label == wake:
            self._awake_until_s = last_s + self._attention.within_s
            return WAKE, decision
        if decision.status == RECOGNISED and decision.label in self._attention.always:
            return COMMAND, decision
        return COMMAND if awake else IGNORED, decision

    def judge_early(self, first_s: float, last_s: float, decision: Decision) -> bool:
        """Whether what has been said so far of an utterance is a command; where it is none, the end is still judged."""
        awake_until_s = self._awake_until_s
        is_command = self.judge(first_s, last_s, decision)[0] == COMMAND
        if not is_command:
            self._awake_until_s = awake_until_s
        return is_command


def with_threshold(decision: Decision, min_score: float | None) -> Decision:
    """`decision` as if the model's threshold had been `min_score`; None leaves it as it is."""
    if min_score is None or not decision.nbest:
        return decision
    if decision.score >= min_score:
        return replace(decision, status=RECOGNISED, label=decision.nbest[0].label)
    return replace(decision, status=UNKNOWN, label=UNKNOWN)
