# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Which joints cannot follow what they are sent: at their greatest torque, and still elsewhere, for a while."""

from __future__ import annotations

from collections.abc import Iterable

PATIENCE_S = 0.25
"""Longer than the soft joints of a robot on its feet take to catch up with an isolated jump."""


class Straining:
    """Reports each joint once, until it follows again."""

    def __init__(self) -> None:
        self._since_s: dict[str, float] = {}
        self._reported: set[str] = set()

    def late(self, names: Iterable[str], time_s: float) -> list[str]:
        """Of the joints that cannot follow at this moment, those whose patience ends now.

        Parameters
        ----------
        names : iterable of str
            All joints that cannot follow at this moment.
        time_s : float
            Later than in the call before.
        """
        self._since_s = {name: self._since_s.get(name, time_s) for name in names}
        self._reported.intersection_update(self._since_s)
        late = [
            name
            for name, since_s in self._since_s.items()
            if time_s - since_s > PATIENCE_S - 1e-9 and name not in self._reported
        ]
        self._reported.update(late)
        return late
