# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What an evaluation found."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.display import count, html_table, summary
from hri.core.plotting import new_axes, save_figure
from hri.evaluation.calibration import NUM_BINS, Reliability, reliability
from hri.recognition.decision import NO_INPUT, RECOGNISED, Decision


@dataclass(frozen=True)
class EvaluationItem:
    """One test item: its index in the data set that is tested, its true label, and what was decided."""

    index: int
    truth: str
    decision: Decision

    def __repr__(self) -> str:
        return summary("EvaluationItem", self.index, f"truth={self.truth!r}", repr(self.decision))

    @property
    def best(self) -> str:
        """The best label, whether or not it was rejected; "no_input" where there is none."""
        return self.decision.nbest[0].label if self.decision.nbest else NO_INPUT


@dataclass(frozen=True)
class FoldResult:
    """The test items of one fold."""

    name: str
    items: tuple[EvaluationItem, ...]

    def __repr__(self) -> str:
        accuracy = f"accuracy {100 * self.accuracy:.1f} %" if self.items else ""
        return summary("FoldResult", repr(self.name), count(len(self.items), "item"), accuracy)

    @property
    def accuracy(self) -> float:
        """Share of items whose best label is right, rejected or not, 0..1."""
        return float(np.mean([t.best == t.truth for t in self.items]))

    @property
    def rejected(self) -> float:
        """Share of items that were rejected or had no input, 0..1."""
        return float(np.mean([t.decision.status != RECOGNISED for t in self.items]))

    @property
    def recognised_right(self) -> float:
        """Share of items that were recognised (not rejected), and rightly, 0..1."""
        return _recognised_right(self.items)

    @property
    def calibration_error(self) -> float | None:
        """Expected calibration error of the items that had input, 0..1; None where none had."""
        return _calibration_error(self.items)


@dataclass(frozen=True)
class EvaluationResult:
    """Accuracy over folds.

    Attributes
    ----------
    labels : list of str
    folds : list of FoldResult
    conditions : dict
        Noise, SNR, exposure, seed and the like, as they were asked for.
    """

    labels: list[str]
    folds: list[FoldResult]
    conditions: dict[str, Any] = field(default_factory=dict)

    def __repr__(self) -> str:
        accuracy = f"accuracy {100 * self.mean:.1f} % ± {100 * self.std:.1f}" if self.items else ""
        found = (count(len(self.items), "item"), count(len(self.folds), "fold"), count(len(self.labels), "label"))
        return summary("EvaluationResult", accuracy, *found)

    def _repr_html_(self) -> str:
        rows = [
            (fold.name, len(fold.items), f"{100 * fold.accuracy:.1f} %", f"{100 * fold.rejected:.1f} %")
            for fold in self.folds
        ]
        return html_table(("fold", "items", "accuracy", "rejected"), rows, repr(self))

    @property
    def items(self) -> list[EvaluationItem]:
        """The test items of all folds."""
        return [t for fold in self.folds for t in fold.items]

    @property
    def mean(self) -> float:
        """Mean of the folds' accuracies, 0..1."""
        return float(np.mean([fold.accuracy for fold in self.folds]))

    @property
    def std(self) -> float:
        """Standard deviation over the folds (population)."""
        return float(np.std([fold.accuracy for fold in self.folds]))

    @property
    def recognised_right(self) -> float:
        """Share of all items that were recognised (not rejected), and rightly, 0..1."""
        return _recognised_right(self.items)

    @property
    def calibration_error(self) -> float | None:
        """Expected calibration error of all items that had input, 0..1; None where none had."""
        return _calibration_error(self.items)

    def reliability(self, num_bins: int = NUM_BINS) -> Reliability:
        """Confidence of the best label, rejected or not, against how often it is right.

        Items without input, which have no best label, are left out.

        Parameters
        ----------
        num_bins : int
            1..1000.

        Raises
        ------
        InvalidArgument
            For a number of bins out of range, or where no item had input.
        """
        return _reliability(self.items, num_bins)

    def confusion(self) -> NDArray[np.int64]:
        """Counts, shape (num_labels, num_labels + 1): row truth, column best label, last column no input."""
        index = {label: i for i, label in enumerate(self.labels)}
        counts = np.zeros((len(self.labels), len(self.labels) + 1), dtype=np.int64)
        for t in self.items:
            counts[index[t.truth], index.get(t.best, len(self.labels))] += 1
        return counts

    def to_dict(self) -> dict[str, Any]:
        """As plain values that can be written as JSON."""
        return {
            "accuracy_mean": self.mean,
            "accuracy_std": self.std,
            "recognised_right": self.recognised_right,
            "calibration_error": self.calibration_error,
            "num_samples": len(self.items),
            "folds": [
                {
                    "name": fold.name,
                    "accuracy": fold.accuracy,
                    "rejected": fold.rejected,
                    "recognised_right": fold.recognised_right,
                    "calibration_error": fold.calibration_error,
                    "num_samples": len(fold.items),
                }
                for fold in self.folds
            ],
            "labels": self.labels,
            "confusion": self.confusion().tolist(),
            "conditions": self.conditions,
        }

    def plot_confusion(self, path: str | PathLike[str] | None = None, *, ax: Any = None) -> Any:
        """Draw the confusion matrix, each row shaded by its shares.

        Parameters
        ----------
        path : path-like, optional
            Also write it as a picture (PNG, SVG or PDF by suffix).
        ax : matplotlib.axes.Axes, optional
            Where to draw; by default in a figure of its own.

        Returns
        -------
        matplotlib.axes.Axes
        """
        side = 2.5 + 0.45 * len(self.labels)
        axes = new_axes((side, side), "to draw the confusion matrix") if ax is None else ax
        counts = self.confusion()
        columns = [*self.labels, "none"] if counts[:, -1].any() else self.labels
        counts = counts[:, : len(columns)]
        axes.imshow(counts / np.maximum(counts.sum(axis=1, keepdims=True), 1), cmap="Blues", vmin=0, vmax=1)
        for (row, column), number in np.ndenumerate(counts):
            if number:
                dark = number > 0.5 * counts[row].sum()
                axes.text(column, row, str(number), ha="center", va="center", color="white" if dark else "black")
        axes.set_xticks(range(len(columns)), columns, rotation=60, ha="right")
        axes.set_yticks(range(len(self.labels)), self.labels)
        axes.set_xlabel("recognised as")
        axes.set_ylabel("truth")
        axes.set_title(f"accuracy {100 * self.mean:.1f} % ± {100 * self.std:.1f} ({len(self.folds)} folds)")
        if path is not None:
            save_figure(axes.figure, path)
        return axes


def _recognised_right(items: Sequence[EvaluationItem]) -> float:
    return float(np.mean([t.decision.label == t.truth for t in items]))


def _reliability(items: Sequence[EvaluationItem], num_bins: int) -> Reliability:
    heard = [t for t in items if t.decision.nbest]
    return reliability([t.decision.confidence for t in heard], [t.best == t.truth for t in heard], num_bins)


def _calibration_error(items: Sequence[EvaluationItem]) -> float | None:
    if not any(t.decision.nbest for t in items):
        return None
    return _reliability(items, NUM_BINS).expected_error
