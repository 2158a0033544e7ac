# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""How far a mode can be trusted, by the quality of its signal and by whether it rejected what it got."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import FormatError
from hri.io import ModelFile
from hri.models import LogisticRegression

LEAST, MOST = 0.02, 0.98
"""A reliability stays within these: no mode is worth nothing, or beyond doubt, by the quality of its signal alone."""
_NUMBERS = ("bias", "slope", "rejection", "prior")


@dataclass(frozen=True)
class Reliability:
    """P(the mode's best class is right | quality of its signal, rejected or not), logistic in both.

    Attributes
    ----------
    bias, slope : float
        Log odds at quality 0, and what they grow by for a unit of quality, 0 or more.
    rejection : float
        What a rejection adds to the log odds, 0 or less.
    prior : float
        Stands for the quality where it is not known: the mean of those that were.
    """

    bias: float
    slope: float
    rejection: float
    prior: float

    @classmethod
    def fit(cls, quality: NDArray[np.float64], rejected: NDArray[np.bool_], right: NDArray[np.bool_]) -> Reliability:
        """From held-out decisions.

        Parameters
        ----------
        quality : float64 array, shape (num_samples,)
            NaN where it was not measured.
        rejected, right : bool arrays, shape (num_samples,)
            Whether the recogniser rejected its input, and whether its best class is right all the same.
        """
        known = np.isfinite(quality)
        prior = float(quality[known].mean()) if known.any() else 0.0
        columns = np.column_stack([np.where(known, quality, prior), rejected])
        if len(set(right.tolist())) < 2:
            odds = (float(right.sum()) + 1) / (float((~right).sum()) + 1)  # Laplace's rule
            return cls(math.log(odds), 0.0, 0.0, prior)
        # What would be trusted more for a worse signal, or a rejection, is left out: it says nothing.
        used = [True, True]
        while True:
            weights, bias = _regression(columns * used, right)
            wrong = [weights[0] < 0, weights[1] > 0]
            if not any(wrong):
                return cls(bias, float(weights[0]), float(weights[1]), prior)
            used = [u and not w for u, w in zip(used, wrong, strict=True)]

    def of(self, quality: NDArray[np.float64], rejected: NDArray[np.bool_]) -> NDArray[np.float64]:
        """The reliability for every quality (NaN where it is not known) and rejection, `LEAST`..`MOST`."""
        known = np.where(np.isfinite(quality), quality, self.prior)
        log_odds = np.clip(self.bias + self.slope * known + self.rejection * rejected, -30, 30)
        return np.clip(1 / (1 + np.exp(-log_odds)), LEAST, MOST)

    def write(self, file: ModelFile, prefix: str) -> None:
        """Add it to a model file."""
        for name in _NUMBERS:
            file.set_number(prefix + name, getattr(self, name))

    @classmethod
    def read(cls, file: ModelFile, prefix: str) -> Reliability:
        """The inverse of `write`. Raises FormatError that names the field."""
        found = cls(*(file.number(prefix + name) for name in _NUMBERS))
        if found.slope < 0:
            raise FormatError(f"{prefix}slope is {found.slope}, must be 0 or more")
        if found.rejection > 0:
            raise FormatError(f"{prefix}rejection is {found.rejection}, must be 0 or less")
        return found


def _regression(columns: NDArray[np.float64], right: NDArray[np.bool_]) -> tuple[NDArray[np.float64], float]:
    """Weights and bias of a logistic regression; columns that are constant get no weight."""
    model = LogisticRegression().fit(columns, right)
    return model.coef_[0], float(model.intercept_[0])
