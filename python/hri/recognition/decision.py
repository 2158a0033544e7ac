# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a recogniser says of one utterance or gesture; fusion knows nothing else of recognition."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

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
    """

    mode: str
    label: str
    status: str
    confidence: float
    score: float = 0.0
    nbest: tuple[NBest, ...] = ()
    notes: tuple[str, ...] = ()

    @classmethod
    def from_native(cls, mode: str, native: Any) -> Decision:
        """Copy what the C++ library decided."""
        return cls(
            mode=mode,
            label=native.label,
            status=native.status.name,
            confidence=native.confidence,
            score=native.score,
            nbest=tuple(NBest(n.label, n.probability, n.log_score) for n in native.nbest),
            notes=tuple(native.notes),
        )

    def to_dict(self) -> dict[str, Any]:
        """As plain values that can be written as JSON; a score that is not finite is None."""
        result: dict[str, Any] = plain(asdict(self))
        return result


def plain(value: Any) -> Any:
    """`value` with None for numbers that JSON cannot hold."""
    if isinstance(value, dict):
        return {key: plain(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [plain(entry) for entry in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
