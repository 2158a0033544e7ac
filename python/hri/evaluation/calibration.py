# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Whether confidences are what they say: the reliability diagram, and the expected calibration error."""

from __future__ import annotations

from dataclasses import dataclass
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hri.core.checks import check_integer
from hri.core.display import count, shown, summary
from hri.core.errors import InvalidArgument
from hri.core.plotting import new_axes, save_figure

NUM_BINS = 15
"""As of Guo et al., "On calibration of modern neural networks", ICML 2017."""
MAX_BINS = 1000


@dataclass(frozen=True)
class ReliabilityBin:
    """Decisions whose confidence lies in ``(low, high]``; the first bin holds 0, too.

    Attributes
    ----------
    low, high : float
        0..1.
    num_items : int
    confidence, accuracy : float or None
        Mean confidence, and the share that is right; None in an empty bin.
    """

    low: float
    high: float
    num_items: int
    confidence: float | None
    accuracy: float | None


@dataclass(frozen=True)
class Reliability:
    """Confidence against accuracy, in bins of equal width.

    Attributes
    ----------
    bins : tuple of ReliabilityBin
        In rising order; they cover 0..1.
    """

    bins: tuple[ReliabilityBin, ...]

    def __repr__(self) -> str:
        error = f"expected error {100 * self.expected_error:.1f} %"
        return summary("Reliability", count(self.num_items, "decision"), count(len(self.bins), "bin"), error)

    @property
    def num_items(self) -> int:
        """Decisions in all bins."""
        return sum(one.num_items for one in self.bins)

    @property
    def expected_error(self) -> float:
        """The expected calibration error (ECE), 0..1: how far accuracy and mean confidence of a bin lie apart, averaged
        over the bins with the number of their decisions as weights."""
        gaps = (one.num_items * abs(one.accuracy - one.confidence) for one in self._filled())
        return float(sum(gaps) / self.num_items)

    def _filled(self) -> list[Any]:
        return [one for one in self.bins if one.num_items]

    def to_dict(self) -> dict[str, Any]:
        """As plain values that can be written as JSON."""
        return {"expected_error": self.expected_error, "bins": [vars(one) for one in self.bins]}

    def plot(self, path: str | PathLike[str] | None = None, *, ax: Any = None) -> Any:
        """Draw the reliability diagram: accuracy by confidence, and how many decisions each bin holds.

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
        axes = new_axes((4.5, 4.5), "to draw the reliability diagram") if ax is None else ax
        filled = self._filled()
        left, width = [one.low for one in filled], [one.high - one.low for one in filled]
        accuracy = [one.accuracy for one in filled]
        shares = [one.num_items / self.num_items for one in filled]
        axes.bar(left, accuracy, width, align="edge", color="#9ecae1", edgecolor="#3182bd", label="right")
        axes.bar(left, shares, width, align="edge", color="#636363", alpha=0.6, label="share of the decisions")
        axes.plot([one.confidence for one in filled], accuracy, "o", color="#08519c", markersize=4)
        axes.plot([0, 1], [0, 1], "--", color="black", linewidth=1, label="perfect calibration")
        axes.set_xlim(0, 1)
        axes.set_ylim(0, 1)
        axes.set_xlabel("confidence")
        axes.set_ylabel("share")
        axes.set_title(f"expected calibration error {100 * self.expected_error:.1f} %")
        axes.legend(loc="upper left", fontsize="small")
        if path is not None:
            save_figure(axes.figure, path)
        return axes


def reliability(confidence: ArrayLike, right: ArrayLike, num_bins: int = NUM_BINS) -> Reliability:
    """Confidences of decisions against the share that is right.

    Parameters
    ----------
    confidence : array-like of float, shape (num_decisions,)
        Of the class that was decided for, 0..1.
    right : array-like of bool, shape (num_decisions,)
        Whether that class is the true one; integers 0 and 1 will do.
    num_bins : int
        1..1000.

    Raises
    ------
    InvalidArgument
        For no decision, lengths that differ, confidences that are no numbers, outside 0..1 or NaN, `right` of anything
        but truth values, or a number of bins out of range.

    Examples
    --------
    >>> found = reliability([0.9, 0.9, 0.6, 0.6], [True, True, True, False])
    >>> print(f"{found.expected_error:.3f}")
    0.100
    """
    check_integer(num_bins, "num_bins")
    values, truths = _as_numbers(confidence), _as_truths(right)
    if values.ndim != 1 or values.shape != truths.shape or not values.size:
        raise InvalidArgument(
            f"confidence and right need one value for each decision, got shapes {values.shape} and {truths.shape}"
        )
    if not ((values >= 0) & (values <= 1)).all():
        raise InvalidArgument("confidence must lie in 0..1")
    if not 1 <= num_bins <= MAX_BINS:
        raise InvalidArgument(f"num_bins is {num_bins}, must be 1..{MAX_BINS}")
    edges = np.linspace(0.0, 1.0, num_bins + 1)
    places: NDArray[np.intp] = np.searchsorted(edges[1:-1], values, side="left")
    bins = []
    for place in range(num_bins):
        here = places == place
        found = int(here.sum())
        means = (float(values[here].mean()), float(truths[here].mean())) if found else (None, None)
        bins.append(ReliabilityBin(float(edges[place]), float(edges[place + 1]), found, *means))
    return Reliability(tuple(bins))


def _as_numbers(confidence: ArrayLike) -> NDArray[np.float64]:
    array = _as_array(confidence, "confidence")
    try:
        if array.dtype.kind not in "biufO":  # text would be read as a number
            raise TypeError(f"got {array.dtype}")
        return np.asarray(array, float)
    except (TypeError, ValueError) as error:
        raise InvalidArgument(f"confidence must be numbers: {error}") from error


def _as_truths(right: ArrayLike) -> NDArray[np.bool_]:
    array = _as_array(right, "right")
    # Text, NaN and None would all count as True or False.
    if array.size and not (array.dtype.kind == "b" or (array.dtype.kind in "iu" and np.isin(array, (0, 1)).all())):
        raise InvalidArgument(f"right must be True or False for each decision, got {shown(array.ravel().tolist())}")
    return np.asarray(array, bool)


def _as_array(values: ArrayLike, name: str) -> NDArray[Any]:
    """Of the type that its items have: columns of tables come as objects."""
    try:
        array = np.asarray(values)
        return np.array(array.tolist()) if array.dtype.kind == "O" else array
    except (TypeError, ValueError) as error:  # lists of different lengths
        raise InvalidArgument(f"{name} needs one value for each decision: {error}") from error
