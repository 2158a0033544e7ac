# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a recogniser says of one utterance or gesture; fusion knows nothing else of recognition."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, field
from typing import Any

from hri.core.display import html_table, summary

RECOGNISED = "recognised"
UNKNOWN = "unknown"
NO_INPUT = "no_input"


@dataclass(frozen=True)
class NBest:
    """One class of the n-best list: its calibrated probability (0..1) and the model's own log score."""

    label: str
    probability: float
    log_score: float


@dataclass(frozen=True)
class Decision:
    """One decision.

    Attributes
    ----------
    mode : str
        "speech" or "gesture".
    label : str
        A class, or "unknown" or "no_input".
    status : str
        "recognised", "unknown" or "no_input".
    confidence : float
        Calibrated probability of the best class, 0..1; 0 without input.
    score : float
        What the rejection threshold was compared with; larger is surer.
    nbest : tuple of NBest
        Every class in falling order; empty without input.
    notes : tuple of str
        What was converted or assumed on the way.
    class_threshold : float
        Confidence from which the best class is sure, by its false alarms and misses on held-out people in training;
        0 where there were none.
    quality : float, optional
        How good the signal was, measured on it alone: of speech the estimated ratio of speech to noise in dB, of a
        gesture the mean quality of the masks of the hand, 0..1. None where it was not measured. No part of what was
        decided: decisions of other quality may be equal.
    slots : dict of str to str
        What a command of several words says beside its label, see `hri.CommandRecognizer`; else empty.
    """

    mode: str
    label: str
    status: str
    confidence: float
    score: float = 0.0
    nbest: tuple[NBest, ...] = ()
    notes: tuple[str, ...] = ()
    class_threshold: float = 0.0
    quality: float | None = field(default=None, compare=False)
    slots: dict[str, str] = field(default_factory=dict, hash=False)

    def __repr__(self) -> str:
        return summary(
            "Decision", self.mode, repr(self.label), f"{self.confidence:.3f}", rivals(self.nbest, self.label)
        )

    def _repr_html_(self) -> str:
        return html_table(*nbest_table(self.nbest), repr(self))

    @classmethod
    def from_native(cls, mode: str, native: Any) -> Decision:
        """Copy what the C++ library decided."""
        return cls(
            mode=mode,
            label=native.label,
            status=native.status,
            confidence=native.confidence,
            score=native.score,
            nbest=tuple(NBest(n.label, n.probability, n.log_score) for n in native.nbest),
            notes=tuple(native.notes),
            class_threshold=native.class_threshold,
        )

    def to_dict(self) -> dict[str, Any]:
        """As plain values that can be written as JSON; a score that is not finite is None."""
        result: dict[str, Any] = plain(asdict(self))
        return result


def rivals(nbest: tuple[NBest, ...], label: str, limit: int = 2) -> str:
    """The best classes other than `label`, for one line."""
    others = [entry for entry in nbest if entry.label != label][:limit]
    return f"then {', '.join(f'{entry.label!r} {entry.probability:.3f}' for entry in others)}" if others else ""


def nbest_table(nbest: tuple[NBest, ...]) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """Header and rows of an n-best list."""
    rows: list[tuple[str, ...]] = [(n.label, f"{n.probability:.3f}", f"{n.log_score:.2f}") for n in nbest]
    return ("label", "probability", "log score"), rows


def plain(value: Any) -> Any:
    """`value` with None for numbers that JSON cannot hold."""
    if isinstance(value, dict):
        return {key: plain(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [plain(entry) for entry in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
