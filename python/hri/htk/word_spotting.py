# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Hits and false alarms of word spotting, and the figure of merit: hits up to ten false alarms an hour, on average."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from hri._native import HtkLabel

UNITS_PER_HOUR = 36_000_000_000
"""Of times in labels."""
MOST_ALARMS = 10
"""The figure of merit goes up to so many false alarms in a unit of time."""
WIDTH = 59


@dataclass
class _Keyword:
    num_actual: int = 0
    found: list[tuple[float, bool]] = field(default_factory=list)  # score, and whether it was a hit


class WordSpotting:
    """Keywords found in recordings against those that were said.

    A keyword that was found is a hit where its middle lies in a label of its name; of several for one label the best
    is a hit, the others are false alarms.

    Parameters
    ----------
    keywords : iterable of str
    """

    def __init__(self, keywords: Iterable[str]) -> None:
        self._keywords = {name: _Keyword() for name in keywords}
        self._duration = 0

    def add(self, reference: Sequence[HtkLabel], found: Sequence[HtkLabel]) -> None:
        """Count a recording, all of whose labels have times, those found a score, too."""
        self._duration += max([label.last or 0 for label in (*reference, *found)], default=0)
        for label in reference:
            if label.name in self._keywords:
                self._keywords[label.name].num_actual += 1
        taken: set[int] = set()
        for label in sorted(found, key=lambda one: -(one.score or 0.0)):
            if label.name not in self._keywords or label.first is None or label.last is None:
                continue
            middle = (label.first + label.last) / 2
            hit = next(
                (
                    number
                    for number, said in enumerate(reference)
                    if said.name == label.name
                    and number not in taken
                    and (said.first or 0) <= middle <= (said.last or 0)
                ),
                None,
            )
            if hit is not None:
                taken.add(hit)
            self._keywords[label.name].found.append((label.score or 0.0, hit is not None))

    def figure_of_merit(self, name: str, unit_hours: float = 1.0) -> float:
        """Mean percent of the occurrences of a keyword that rank above 1, 2, ... 10 false alarms in a unit of time.

        With a time of T units it is (p1 + ... + pN + a p(N+1)) / 10 T: pi percent rank above false alarm i, N is the
        first whole number that is at least 10 T - 0.5, and a = 10 T - N.
        """
        return self._merit(self._keywords[name], unit_hours)

    def lines(self, unit_hours: float = 1.0) -> list[str]:
        """A table: hits, false alarms, occurrences and figure of merit of every keyword, and of all."""
        rows = [" Figures of Merit ".center(WIDTH, "-"), f"{'KeyWord:':>12}    #Hits     #FAs  #Actual      FOM"]
        for name, one in self._keywords.items():
            rows.append(self._row(name, one, unit_hours))
        found = [each for one in self._keywords.values() for each in one.found]
        together = _Keyword(sum(one.num_actual for one in self._keywords.values()), found)
        return [*rows, self._row("Overall", together, unit_hours), "-" * WIDTH]

    def _row(self, name: str, one: _Keyword, unit_hours: float) -> str:
        hits = sum(hit for _, hit in one.found)
        merit = self._merit(one, unit_hours)
        return f"{name + ':':>12}{hits:>9}{len(one.found) - hits:>9}{one.num_actual:>9}{merit:>9.2f}"

    def _merit(self, one: _Keyword, unit_hours: float) -> float:
        alarms = MOST_ALARMS * self._duration / (UNITS_PER_HOUR * unit_hours)
        if not one.num_actual or not alarms:
            return 0.0
        whole = max(0, int(-(-(alarms - 0.5) // 1)))
        shares, hits = [], 0
        for _, is_hit in sorted(one.found, key=lambda each: -each[0]):
            if is_hit:
                hits += 1
            else:
                shares.append(100 * hits / one.num_actual)
        shares += [100 * hits / one.num_actual] * (whole + 1)
        return (sum(shares[:whole]) + (alarms - whole) * shares[whole]) / alarms
