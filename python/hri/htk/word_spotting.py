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

    A keyword that was found is a hit where it covers the middle of one that was said, as HResults has it: found twice
    there it is a hit twice.

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
        for label in found:
            if label.name not in self._keywords or label.first is None or label.last is None:
                continue
            is_hit = any(
                said.name == label.name and label.first <= ((said.first or 0) + (said.last or 0)) / 2 <= label.last
                for said in reference
            )
            self._keywords[label.name].found.append((label.score or 0.0, is_hit))

    def figure_of_merit(self, name: str, unit_hours: float = 1.0) -> float:
        """Mean percent of the occurrences of a keyword that rank above 1, 2, ... 10 false alarms in a unit of time.

        With a time of T units it is (p1 + ... + pN + a p(N+1)) / 10 T: pi percent rank above false alarm i, N is the
        first whole number that is at least 10 T - 0.5, and a = 10 T - N.
        """
        return self._merit(self._keywords[name], unit_hours)

    def lines(self, unit_hours: float = 1.0) -> list[str]:
        """A table: hits, false alarms, occurrences and figure of merit of every keyword, and of all.

        The figure of all is the mean over what was said.
        """
        rows = [" Figures of Merit ".center(WIDTH, "-"), f"{'KeyWord:':>12}    #Hits     #FAs  #Actual      FOM"]
        for name, one in self._keywords.items():
            rows.append(self._row(name, self._counts(one), self._merit(one, unit_hours)))
        counts = [sum(column) for column in zip(*map(self._counts, self._keywords.values()), strict=True)]
        return [*rows, self._row("Overall", counts or [0, 0, 0], self._mean_merit(unit_hours)), "-" * WIDTH]

    @staticmethod
    def _counts(one: _Keyword) -> list[int]:
        """Hits, false alarms, occurrences."""
        hits = sum(hit for _, hit in one.found)
        return [hits, len(one.found) - hits, one.num_actual]

    @staticmethod
    def _row(name: str, counts: Sequence[int], merit: float) -> str:
        return f"{name + ':':>12}" + "".join(f"{count:>9}" for count in counts) + f"{merit:>9.2f}"

    def _mean_merit(self, unit_hours: float) -> float:
        """Each keyword weighs as often as it was said."""
        keywords = self._keywords.values()
        num_actual = sum(one.num_actual for one in keywords)
        return sum(one.num_actual * self._merit(one, unit_hours) for one in keywords) / max(1, num_actual)

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
