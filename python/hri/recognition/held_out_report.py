# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What training saw on people held out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri import _native


@dataclass(frozen=True)
class ConfusedPair:
    """Two labels that are confused with one another.

    Attributes
    ----------
    first, second : str
        In sorted order.
    rate : float
        Share of the recordings of the two, decided for either, that are the other; 0..1.
    """

    first: str
    second: str
    rate: float


@dataclass(frozen=True)
class HeldOutReport:
    """How well a recogniser did in training on recordings of people held out, as they were recorded.

    Attributes
    ----------
    labels : tuple of str
        Sorted, as they were in training: without words added since.
    confusion : ndarray of int, shape (num_labels, num_labels)
        How many recordings of the label of the row were most like that of the column, whether rejected or not.
    false_reject_rate : float
        Share of right decisions that the threshold rejects, 0..1.
    false_accept_rate : float
        Share of recordings that it accepts as another word when their own is treated as unknown; 0..1, and 0 for a
        vocabulary of two words, of which neither can be left out.
    confused_pairs : tuple of ConfusedPair
        Those that are confused in a tenth of their recordings or more, the worst first.
    """

    labels: tuple[str, ...]
    confusion: NDArray[np.int64]
    false_reject_rate: float
    false_accept_rate: float
    confused_pairs: tuple[ConfusedPair, ...]

    @classmethod
    def from_native(cls, native: _native.HeldOutReport) -> HeldOutReport:
        """Wrap what C++ counted."""
        labels = tuple(native.labels)
        return cls(
            labels,
            np.asarray(native.confusion).astype(np.int64),
            native.false_reject_rate,
            native.false_accept_rate,
            tuple(ConfusedPair(labels[p.first], labels[p.second], p.rate) for p in native.confused_pairs()),
        )

    @property
    def num_samples(self) -> int:
        """How many recordings were held out."""
        return int(self.confusion.sum())

    @property
    def accuracy(self) -> float:
        """Share of recordings whose best label is right, rejected or not; 0..1."""
        return float(np.trace(self.confusion)) / self.num_samples

    def lines(self) -> list[str]:
        """For people: the rates, then each pair."""
        rates = (
            f"of {self.num_samples} recordings of people held out in training, {_percent(self.accuracy)} are right; "
            f"{_percent(self.false_reject_rate)} of these are rejected as unknown"
        )
        if len(self.labels) > 2:
            rates += f", and {_percent(self.false_accept_rate)} of words that are not in the vocabulary are accepted"
        return [
            rates,
            *(
                f"{p.first!r} and {p.second!r} are hard to distinguish ({_percent(p.rate)} taken for one another): "
                "choose another word for one of them, or record more of both"
                for p in self.confused_pairs
            ),
        ]

    def to_dict(self) -> dict[str, Any]:
        """As JSON holds it."""
        return {
            "num_samples": self.num_samples,
            "accuracy": self.accuracy,
            "false_reject_rate": self.false_reject_rate,
            "false_accept_rate": self.false_accept_rate,
            "confused_pairs": [{"first": p.first, "second": p.second, "rate": p.rate} for p in self.confused_pairs],
        }


def _percent(share: float) -> str:
    return f"{100 * share:.1f} %"
