# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""When a movement of the hand begins and ends, from its masks, one after the other."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, fields
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument
from hri.live.sources import require_positive

Mask = NDArray[np.uint8]

LEARNED_STILL_CHANGE = 0.12
"""`still_change` for hands found by colours of the stream: outlines hardly flicker, and slow movements are no rest."""

RESTED = "rested"
LEFT = "left"
CUT = "cut"
ENDED = "ended"
ARRIVED = "arrived"


@dataclass(frozen=True)
class MovementOptions:
    """When a movement begins and ends; times in seconds.

    Attributes
    ----------
    appear_s : float
        A hand is there, or moves again, when it has been seen or moving for so long.
    leave_s : float
        It has gone when it has not been seen for so long.
    rest_s : float
        A hand that is still for so long ends the movement: it rests, or holds a sign.
    still_change : float
        It is still while the outlines of now and of `compare_s` ago differ by less than this share of what they cover
        together, 0..1.
    compare_s : float
    min_movement_s : float
        What is shorter, and ends in the hand leaving, was nothing.
    max_movement_s : float
        What is longer is cut.
    take_away_s : float
        A hand that rested and leaves within this time is taken away, and shows nothing.
    context_s : float
        Kept before a movement.
    arrivals : bool
        A hand that comes into view and rests has shown something: a sign that it holds, say. Otherwise only what comes
        after that rest is a movement.
    """

    appear_s: float = 0.1
    leave_s: float = 0.3
    rest_s: float = 0.5
    still_change: float = 0.3
    compare_s: float = 0.2
    min_movement_s: float = 0.3
    max_movement_s: float = 6.0
    take_away_s: float = 1.0
    context_s: float = 0.1
    arrivals: bool = True

    def __post_init__(self) -> None:
        for one in fields(self):
            if one.name != "arrivals":
                require_positive(one.name, getattr(self, one.name))
        if self.still_change >= 1:
            raise InvalidArgument(f"still_change must be below 1, got {self.still_change}")
        if self.max_movement_s <= self.min_movement_s:
            raise InvalidArgument(
                f"max_movement_s must be above min_movement_s, got {self.max_movement_s} and {self.min_movement_s}"
            )


class MovementKind(Enum):
    """What happened."""

    start = "start"
    end = "end"
    dropped = "dropped"


@dataclass(frozen=True)
class Movement:
    """A movement that began, ended, or was none: its first and last moment, and why it ended: "rested", "left", "cut",
    "ended" with the stream, or "arrived" where arrivals are none."""

    kind: MovementKind
    first_s: float
    last_s: float
    reason: str = ""


class _Phase(Enum):
    away = 0
    moving = 1
    resting = 2


class MovementDetector:
    """Finds movements while the masks come in.

    Still signs and motions go the same way: the hand comes, and shows a sign until it rests, or moves until it rests or
    leaves. Outlines are compared and not places, as fingers may move while the hand stays.
    """

    def __init__(self, options: MovementOptions | None = None) -> None:
        self.options = options or MovementOptions()
        self._phase = _Phase.away
        self._masks: deque[tuple[float, Mask]] = deque()
        self._seen_since: float | None = None  # a hand without a gap, while it was away
        self._still_since: float | None = None
        self._moving_since: float | None = None
        self._last_hand_s = -np.inf
        self._first_s = 0.0
        self._from_rest = False
        self._spent = False  # cut: nothing new before the hand rests

    @property
    def in_movement(self) -> bool:
        """Whether a movement has begun and not ended."""
        return self._phase is _Phase.moving

    @property
    def may_have_begun_s(self) -> float | None:
        """Since when what is seen may turn out to be a movement."""
        return {
            _Phase.away: self._seen_since,
            _Phase.moving: self._first_s,
            _Phase.resting: self._moving_since,
        }[self._phase]

    def push(self, mask: Mask, time_s: float) -> Movement | None:
        """The next mask (0 is background; all 0 for no hand) and its time."""
        hand = bool(mask.any())
        still = hand and self._change(mask, time_s) < self.options.still_change
        if hand:
            self._last_hand_s = time_s
        gone = time_s - self._last_hand_s >= self.options.leave_s
        if self._phase is _Phase.away:
            return self._appear(hand, time_s)
        if self._phase is _Phase.resting:
            return self._rest(hand, still, gone, time_s)
        return self._move(still, gone, time_s)

    def finish(self) -> Movement | None:
        """The stream has ended, and with it any movement."""
        return self._end(ENDED, self._last_hand_s) if self.in_movement else None

    def see_anew(self, mask: Mask) -> None:
        """From now on the hand of now looks like `mask`, because it is found in another way; nothing has moved."""
        self._masks = deque((time_s, mask) for time_s, _ in self._masks)

    def _appear(self, hand: bool, time_s: float) -> Movement | None:
        if not hand:
            self._seen_since = None
            return None
        if self._seen_since is None:
            self._seen_since = time_s
        if time_s - self._seen_since < self.options.appear_s:
            return None
        return self._begin(self._seen_since, from_rest=False)

    def _rest(self, hand: bool, still: bool, gone: bool, time_s: float) -> Movement | None:
        if gone:
            self._leave()
        if not hand:
            return None
        if still:
            self._moving_since = None
            self._still_since = time_s if self._still_since is None else self._still_since
            self._spent = self._spent and time_s - self._still_since < self.options.rest_s
            return None
        self._still_since = None
        if self._moving_since is None:
            self._moving_since = time_s
        if self._spent or time_s - self._moving_since < self.options.appear_s:
            return None
        return self._begin(self._moving_since, from_rest=True)

    def _move(self, still: bool, gone: bool, time_s: float) -> Movement | None:
        if gone:
            return self._end(LEFT, self._last_hand_s)
        if not still:
            self._still_since = None
        elif self._still_since is None:
            self._still_since = time_s
        if self._still_since is not None and time_s - self._still_since >= self.options.rest_s:
            return self._end(RESTED, time_s)
        if time_s - self._first_s >= self.options.max_movement_s:
            return self._end(CUT, time_s)
        return None

    def _begin(self, first_s: float, from_rest: bool) -> Movement:
        self._phase, self._first_s, self._from_rest = _Phase.moving, first_s, from_rest
        self._still_since = None
        return Movement(MovementKind.start, first_s, first_s)

    def _end(self, reason: str, last_s: float) -> Movement:
        lasted_s = last_s - self._first_s
        taken_away = self._from_rest and reason == LEFT
        least_s = self.options.take_away_s if taken_away else self.options.min_movement_s
        kind = MovementKind.dropped if reason in (LEFT, ENDED) and lasted_s < least_s else MovementKind.end
        if reason in (LEFT, ENDED):
            self._leave()
        else:
            self._phase, self._moving_since, self._spent = _Phase.resting, None, reason == CUT
            self._still_since = None
        if reason == RESTED and not self._from_rest and not self.options.arrivals:
            return Movement(MovementKind.dropped, self._first_s, last_s, ARRIVED)
        return Movement(kind, self._first_s, last_s, reason)

    def _leave(self) -> None:
        self._phase, self._seen_since, self._spent = _Phase.away, None, False
        self._masks.clear()

    def _change(self, mask: Mask, time_s: float) -> float:
        """How much the outline differs from that of `compare_s` ago, 0..1."""
        if self._masks and self._masks[0][1].shape != mask.shape:
            self._masks.clear()
        self._masks.append((time_s, mask))
        while len(self._masks) > 1 and time_s - self._masks[1][0] >= self.options.compare_s:
            self._masks.popleft()
        before_s, before = self._masks[0]
        if time_s - before_s < self.options.compare_s:
            return 1.0
        first, second = mask > 0, before > 0
        return int(np.count_nonzero(first != second)) / max(1, int(np.count_nonzero(first | second)))
