# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What training saw on recordings held out."""

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
    """How well a recogniser of words or of gestures did in training on recordings held out, as they were recorded.

    Whole people are held out where every label is left without them. Else single recordings are, and the rates are too
    good for other people.

    Attributes
    ----------
    labels : tuple of str
        Sorted, as they were in training: without what was added since.
    confusion : ndarray of int, shape (num_labels, num_labels)
        How many recordings of the label of the row were most like that of the column, whether rejected or not.
    false_reject_rate : float
        Share of right decisions that the threshold rejects, 0..1; 0 where none is right.
    num_others : int
        How many recordings were also decided upon as if their label were not in the vocabulary. None of a vocabulary of
        two, of which neither can be left out, nor of gestures whose model is neither ``rbf`` nor ``trajectory``.
    false_accept_rate : float or None
        Share of these that the threshold accepts as another label, 0..1; None where there are none of them: nothing is
        known of what it accepts then.
    confused_pairs : tuple of ConfusedPair
        Those that are confused in a tenth of their recordings or more, the worst first.
    """

    labels: tuple[str, ...]
    confusion: NDArray[np.int64]
    false_reject_rate: float
    num_others: int
    false_accept_rate: float | None
    confused_pairs: tuple[ConfusedPair, ...]

    @classmethod
    def of(cls, trained: _native.WordRecognizer | _native.GestureRecognizer) -> HeldOutReport | None:
        """What C++ counted while it trained a recogniser; None where nothing could be held out."""
        native = trained.held_out
        if native is None:
            return None
        labels = tuple(native.labels)
        return cls(
            labels,
            np.asarray(native.confusion).astype(np.int64),
            native.false_reject_rate,
            native.num_others,
            native.false_accept_rate if native.num_others else None,
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

    def lines(self, noun: str) -> list[str]:
        """For people: the rates, then each pair.

        Parameters
        ----------
        noun : str
            What a label is of, "word" or "gesture".
        """
        held_out = f"of {self.num_samples} recordings held out in training, by person where that was possible"
        right = f"{held_out}, {_percent(self.accuracy)} are right"
        rejected = f"; {_percent(self.false_reject_rate)} of these are rejected as unknown" if self.accuracy else ""
        others = f"{noun}s that are not in the vocabulary"
        if self.false_accept_rate is None:
            accepted = f"; how many {others} are accepted was not measured"
        else:
            accepted = f", and {_percent(self.false_accept_rate)} of {others} are accepted"
        return [
            right + rejected + accepted,
            *(
                f"{p.first!r} and {p.second!r} are hard to distinguish ({_percent(p.rate)} taken for one another): "
                f"choose another {noun} for one of them, or record more of both"
                for p in self.confused_pairs
            ),
        ]

    def to_dict(self) -> dict[str, Any]:
        """As JSON holds it."""
        return {
            "num_samples": self.num_samples,
            "accuracy": self.accuracy,
            "false_reject_rate": self.false_reject_rate,
            "num_others": self.num_others,
            "false_accept_rate": self.false_accept_rate,
            "confused_pairs": [{"first": p.first, "second": p.second, "rate": p.rate} for p in self.confused_pairs],
        }


def _percent(share: float) -> str:
    return f"{100 * share:.1f} %"
