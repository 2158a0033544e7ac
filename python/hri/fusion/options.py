# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Options and result of fusion."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, field
from typing import Any

from hri.core.display import html_table, summary
from hri.core.errors import InvalidArgument
from hri.recognition.decision import Decision, NBest, nbest_table, plain, rivals

ASK = "ask"
"""Status and label where the robot should rest and ask."""

RULES = ("table_6_9", "weighted_sum", "product", "dempster_shafer")


@dataclass(frozen=True)
class FusionOptions:
    """How two decisions become one.

    Attributes
    ----------
    threshold_gesture, threshold_speech : float
        Theta of table 6.9, 0..1; they suppose calibrated confidences.
    weight_gesture, weight_speech : float
        w of table 6.9, and the weights of the other rules, > 0.
    reliability_gesture, reliability_speech : float
        For Dempster-Shafer, 0..1: 1 - reliability is the mass given to ignorance.
    probability_floor : float
        No class falls below this in the product rule, 0..0.1: one mode alone cannot veto a class.
    stop_labels : tuple of str
        Recognised in either mode, these win over everything; see `stop_threshold`.
    stop_threshold : float, optional
        Confidence from which a stop label is sure, 0..1. None takes ``Decision.class_threshold``, which training chose
        from the label's own false alarms and misses. Below it, a mode that is sure of another class makes the answer
        "ask".
    """

    threshold_gesture: float = 0.8
    threshold_speech: float = 0.85
    weight_gesture: float = 1.0
    weight_speech: float = 1.0
    reliability_gesture: float = 0.95
    reliability_speech: float = 0.9
    probability_floor: float = 1e-3
    stop_labels: tuple[str, ...] = ("stop",)
    stop_threshold: float | None = None

    def __post_init__(self) -> None:
        for name in ("threshold_gesture", "threshold_speech", "reliability_gesture", "reliability_speech"):
            if not 0 <= getattr(self, name) <= 1:
                raise InvalidArgument(f"FusionOptions.{name} must lie in 0..1, got {getattr(self, name)}")
        for name in ("weight_gesture", "weight_speech"):
            if not 0 < getattr(self, name) < math.inf:
                raise InvalidArgument(f"FusionOptions.{name} must be positive and finite, got {getattr(self, name)}")
        if not 0 <= self.probability_floor <= 0.1:
            raise InvalidArgument(f"FusionOptions.probability_floor must lie in 0..0.1, got {self.probability_floor}")
        if self.stop_threshold is not None and not 0 <= self.stop_threshold <= 1:
            raise InvalidArgument(
                f"FusionOptions.stop_threshold must lie in 0..1 or be None, got {self.stop_threshold}"
            )
        labels: object = self.stop_labels
        if not isinstance(labels, tuple | list) or not all(isinstance(label, str) and label for label in labels):
            raise InvalidArgument(f"FusionOptions.stop_labels must be a tuple of labels, got {labels!r}")


@dataclass(frozen=True)
class FusedDecision:
    """The common decision of two modes.

    Attributes
    ----------
    label, status, confidence
        As in `Decision`; besides, all of them may say "ask", with confidence 0: a stop label is unsure, and the other
        mode is sure of another class.
    rule : str
        The rule that fired, for example "table 6.9: only gesture above its threshold".
    nbest : tuple of NBest
        Fused probabilities of every class, falling; for table 6.9 the list of the mode that won; for "ask" the two
        classes to choose between.
    speech, gesture : Decision or None
        What was fused.
    """

    label: str
    status: str
    confidence: float
    rule: str
    nbest: tuple[NBest, ...] = field(default=())
    speech: Decision | None = None
    gesture: Decision | None = None

    def __repr__(self) -> str:
        others = rivals(self.nbest, self.label)
        return summary("FusedDecision", repr(self.label), f"{self.confidence:.3f}", repr(self.rule), others)

    def _repr_html_(self) -> str:
        return html_table(*nbest_table(self.nbest), repr(self))

    def to_dict(self) -> dict[str, Any]:
        """As plain values that can be written as JSON; a score that is not finite is None."""
        result: dict[str, Any] = plain(asdict(self))
        return result
