# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Decisions as people read them. The confidence of what is rejected is that of the nearest label: it is not shown."""

from __future__ import annotations

from hri.fusion import FusedDecision
from hri.recognition import Decision
from hri.recognition.decision import UNKNOWN


def confidence_text(decision: Decision | FusedDecision) -> str:
    """The confidence of what was recognised; what an unknown is nearest to; "-" where there was no input."""
    if decision.status == UNKNOWN and decision.nbest:
        return f"nearest: {decision.nbest[0].label}"
    return f"{decision.confidence:.3f}" if decision.nbest else "-"


def alternatives(decision: Decision, top: int) -> str:
    """The best labels with their probabilities, of an unknown without; or why there are none."""
    if not decision.nbest:
        return decision.status
    if decision.status == UNKNOWN:
        return f"nearest: {', '.join(entry.label for entry in decision.nbest[:top])}"
    return ", ".join(f"{entry.label} {entry.probability:.3f}" for entry in decision.nbest[:top])
