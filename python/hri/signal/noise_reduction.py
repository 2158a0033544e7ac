# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Noise reduction by wavelets: small details go (`denoise`), or all of them (`approximation`)."""

from __future__ import annotations

from typing import Any

from numpy.typing import ArrayLike, NDArray

from hri import _native
from hri.core.errors import InvalidArgument
from hri.signal.arrays import as_contiguous, as_mode
from hri.signal.filters import Wavelet, name_of

_CHOICES = {field.name: field.choices for field in _native.ShrinkageOptions.fields()}
RULES, SHAPES, NOISES = _CHOICES["rule"], _CHOICES["shape"], _CHOICES["noise"]

Array = NDArray[Any]


def denoise(
    samples: ArrayLike,
    wavelet: str | Wavelet = "sym8",
    mode: str = "symmetric",
    *,
    level: int | None = None,
    threshold: str = "bayes",
    shape: str = "soft",
    noise: str = "quietest",
    strength: float = 1.0,
) -> Array:
    """Take noise out of a signal: details of its wavelet transform below a threshold go.

    Parameters
    ----------
    samples : array_like, shape (num_samples,)
        Not empty, finite. float32 stays float32, everything else becomes float64.
    wavelet : str or Wavelet
    mode : str
        What stands beyond the ends, as for `hri.signal.dwt`.
    level : int, optional
        1..62; by default five, or as many as the signal has room for.
    threshold : str
        ``"universal"`` (VisuShrink: s sqrt(2 ln num_samples)), ``"sure"`` (SureShrink: the least estimate of the
        risk, universal where details are sparse) or ``"bayes"`` (BayesShrink: s**2 over the deviation of the clean
        details), from the noise level s.
    shape : str
        ``"soft"``, ``"hard"`` or ``"garrote"``.
    noise : str
        Where a level's noise is measured: ``"quietest"`` takes the quietest tenth of the signal (noise of any colour,
        if the signal pauses), ``"per_level"`` the median of each level (which takes what fills a level for noise),
        ``"finest"`` the median of the finest level for all (white noise).
    strength : float
        Factor of all thresholds, at least 0.

    Returns
    -------
    ndarray, shape (num_samples,)

    Raises
    ------
    InvalidArgument
        For an empty signal, a NaN or an infinity, and arguments out of range.
    """
    options = _native.ShrinkageOptions(
        wavelet=name_of(wavelet),
        border=as_mode(mode),
        num_levels=0 if level is None else level,
        rule=_named(RULES, "threshold", threshold),
        shape=_named(SHAPES, "shape", shape),
        noise=_named(NOISES, "noise", noise),
        strength=float(strength),
    )
    return _native.denoise(as_contiguous(samples), options)


def approximation(samples: ArrayLike, wavelet: str | Wavelet, mode: str = "symmetric", level: int = 1) -> Array:
    """The approximation of a level, as loud as the signal.

    About the signal at 1 / 2**level of its rate, with what lay above half of that gone; longer by what the border
    adds (``"periodization"`` adds nothing).
    """
    return _native.approximate(as_contiguous(samples), name_of(wavelet), as_mode(mode), level)


def noise_level(details: ArrayLike) -> float:
    """Standard deviation of normal noise among `details`: their median size over 0.6745."""
    return _native.noise_level(as_contiguous(details))


def shrinkage_threshold(details: ArrayLike, noise: float, num_samples: int, rule: str) -> float:
    """The threshold for the details of one level of a signal of num_samples; infinite where all is noise.

    Parameters
    ----------
    details : array_like
    noise : float
        Standard deviation, as by `noise_level`.
    num_samples : int
        Of the signal, which the universal threshold goes by.
    rule : str
        As `threshold` of `denoise`.
    """
    return _native.shrinkage_threshold(as_contiguous(details), noise, num_samples, _named(RULES, "rule", rule))


def shrink(details: ArrayLike, threshold: float, shape: str = "soft") -> Array:
    """Details with a threshold applied; `shape` as in `denoise`."""
    return _native.shrink(as_contiguous(details), threshold, _named(SHAPES, "shape", shape))


def _named(choices: list[str], what: str, name: str) -> Any:
    if name not in choices:
        raise InvalidArgument(f"no {what} {name!r}; there are: {', '.join(choices)}")
    return name
