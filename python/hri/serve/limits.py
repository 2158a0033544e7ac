# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""How much a page may send."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass, fields

from hri.core.errors import InvalidArgument


@dataclass(frozen=True)
class ServeLimits:
    """Limits of size and rate; what exceeds them is dropped, and reported on the page.

    Attributes
    ----------
    max_message_bytes : int
        A larger message ends its connection.
    max_picture_bytes : int
        Of one picture as JPEG.
    max_picture_px : int
        Width times height of one picture.
    max_clip_bytes, max_clip_pictures : int
        Of one file that shows a gesture.
    max_grammar_bytes, max_sentences : int
        Of the commands that a person writes on the page; a motion is checked for each.
    max_text_bytes : int
        Of one message of text.
    pictures_per_s, messages_per_s : float
        For longer than a second; twice as many messages end the connection.
    voice_s : float
        Longest time for which the page may say one text aloud: no spoken command but STOP counts meanwhile.
    stall_s : float
        Without sound or pictures for so long, a device counts as vanished.
    hello_s : float
        For how long a connection may wait with its first message.

    Raises
    ------
    InvalidArgument
        For a value that is not above 0 and finite.
    """

    max_message_bytes: int = 1 << 20
    max_picture_bytes: int = 1 << 19
    max_picture_px: int = 1920 * 1080
    max_clip_bytes: int = 1 << 25
    max_clip_pictures: int = 300
    max_grammar_bytes: int = 1 << 15
    max_sentences: int = 500
    max_text_bytes: int = 4096
    pictures_per_s: float = 30.0
    messages_per_s: float = 200.0
    voice_s: float = 20.0
    stall_s: float = 2.0
    hello_s: float = 5.0

    def __post_init__(self) -> None:
        for one in fields(self):
            value = getattr(self, one.name)
            if not (math.isfinite(value) and value > 0):
                raise InvalidArgument(f"ServeLimits.{one.name} must be above 0 and finite, got {value}")


class RateLimit:
    """A token bucket: so much a second, and as much at once as comes in `burst_s`.

    Parameters
    ----------
    per_s : float
    burst_s : float
    clock : callable
        Gives seconds that never fall.
    """

    def __init__(self, per_s: float, burst_s: float = 1.0, clock: Callable[[], float] = time.monotonic) -> None:
        self._per_s, self._most = per_s, per_s * burst_s
        self._left = self._most
        self._clock = clock
        self._at_s = clock()

    def take(self, amount: float = 1.0) -> bool:
        """Whether there is so much left; it is taken then."""
        now_s = self._clock()
        self._left = min(self._most, self._left + self._per_s * (now_s - self._at_s))
        self._at_s = now_s
        if self._left < amount:
            return False
        self._left -= amount
        return True
