# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Which turns a session decided on whole, took apart, joined with something else, or missed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from hri.live import Event
from hri.live.events import DECISION
from hri.studies.session_turns import Span, Talk, Turn

Thing = Turn | Talk | None


@dataclass(frozen=True)
class Decided:
    """What was decided on together, or alone: when its word was said and its sign shown, as they were found."""

    final: str
    said_s: Span | None
    shown_s: Span | None
    rejected: bool
    """The word was."""


def decided_in(events: Sequence[Event]) -> list[Decided]:
    """The fused decisions of a session, but those without input, with the decisions that they were made of."""
    waiting: dict[str, list[Event]] = {"speech": [], "gesture": []}
    found = []
    for event in events:
        if event.event == DECISION:
            waiting[event.mode].append(event)
        elif event.event == "fused":
            spans = {mode: _taken(some, event, mode) for mode, some in waiting.items()}
            if event.fields["status"] != "no_input":
                rejected = (event.fields["speech"] or {}).get("status") == "unknown"
                found.append(Decided(event.fields["final"], spans["speech"], spans["gesture"], rejected))
    return found


def _taken(waiting: list[Event], fused: Event, mode: str) -> Span | None:
    """When that of this mode was, which waits no longer; None where there is none."""
    given = fused.fields[mode]
    if given is None:
        return None
    for one in waiting:
        first_s, last_s = one.fields["first_s"], one.fields["last_s"]
        within = fused.fields["first_s"] <= first_s and last_s <= fused.fields["last_s"]
        if within and one.fields["confidence"] == given["confidence"]:
            waiting.remove(one)
            return first_s, last_s
    raise AssertionError(f"nothing was decided on that {fused.to_json()} is of")


def judge(turns: Sequence[Turn], talk: Sequence[Talk], decided: Sequence[Decided]) -> list[dict[str, Any]]:
    """For every turn: what was decided ("" for nothing), and whether it came whole, taken apart or joined wrongly.

    It is joined wrongly where something else was decided on with it, or was found with it as one word;
    `beside_rejected` says that this was a word by itself that had been rejected, beside the turn's sign.
    """
    things = [things_of(one, turns, talk) for one in decided]
    found: list[dict[str, Any]] = []
    for turn in turns:
        own = [(one, *of) for one, of in zip(decided, things, strict=True) if turn in (*of[0], *of[1])]
        joined = [(one, said) for one, said, shown in own if any(other is not turn for other in (*said, *shown))]
        heard, seen = any(turn in said for _, said, _ in own), any(turn in shown for _, _, shown in own)
        found.append(
            {
                "label": next((one.final for one, _, _ in own if one.final), ""),
                "joined": bool(joined),
                "beside_rejected": bool(joined) and all(one.rejected and turn not in said for one, said in joined),
                "apart": all(turn.modes) and heard and seen and len(own) > 1,
                "missed": (turn.word >= 0 and not heard) or (turn.sign >= 0 and not seen),
            }
        )
    return found


def things_of(one: Decided, turns: Sequence[Turn], talk: Sequence[Talk]) -> tuple[list[Thing], list[Thing]]:
    """What was said, and what was shown, of a decision; None for what was neither."""
    words: list[tuple[Thing, Span]] = [(turn, turn.word_s) for turn in turns if turn.word >= 0]
    words += [(other, other.span_s) for other in talk]
    signs: list[tuple[Thing, Span]] = [(turn, turn.sign_s) for turn in turns if turn.sign >= 0]
    return _within(one.said_s, words), _within(one.shown_s, signs)


def _within(span: Span | None, things: Sequence[tuple[Thing, Span]]) -> list[Thing]:
    """Those that share more than half of their time, or of that of the span, with it."""
    if span is None:
        return []
    first_s, last_s = span
    return [
        thing
        for thing, (begin_s, end_s) in things
        if min(last_s, end_s) - max(first_s, begin_s) > 0.5 * min(last_s - first_s, end_s - begin_s)
    ] or [None]
