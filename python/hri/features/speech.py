# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Cepstra of recordings in one call: MFCC, HFCC and LPCC, also as HTK, Kaldi and librosa make them."""

from __future__ import annotations

from typing import Any, Literal

from numpy.typing import ArrayLike, NDArray

from hri._native import CepstraComputer, CepstraOptions
from hri.core.errors import InvalidArgument

Kind = Literal["mfcc", "hfcc", "lpcc"]
Preset = Literal["hri", "htk", "kaldi", "librosa"]

KINDS: dict[str, dict[str, str]] = {
    "mfcc": {"kind": "filter_bank", "filter_bank": "mel"},
    "hfcc": {"kind": "filter_bank", "filter_bank": "hfcc"},
    "lpcc": {"kind": "linear_prediction"},
}
"""What each kind sets of `CepstraOptions`."""

PRESETS = {
    "hri": lambda rate_hz: CepstraOptions(sample_rate_hz=rate_hz),
    "htk": CepstraOptions.htk,
    "kaldi": CepstraOptions.kaldi,
    "librosa": CepstraOptions.librosa,
}
"""By name, what makes the options for a sampling rate."""


def cepstra_options(sample_rate_hz: int, kind: Kind = "mfcc", preset: Preset = "hri", **options: Any) -> CepstraOptions:
    """Options of a preset, with some of them changed.

    Parameters
    ----------
    sample_rate_hz : int
    kind : {"mfcc", "hfcc", "lpcc"}
        Mel filters, filters as wide as the ear's, or linear prediction.
    preset : {"hri", "htk", "kaldi", "librosa"}
        Where all other options come from; the last three give those programs' numbers for "mfcc".
    **options
        Fields of `CepstraOptions` to change, such as ``num_cepstra=19``.

    Returns
    -------
    CepstraOptions

    Raises
    ------
    InvalidArgument
        For a kind or a preset that there is not.
    TypeError
        For a field that `CepstraOptions` has not.
    """
    for name, value, known in (("kind", kind, KINDS), ("preset", preset, PRESETS)):
        if value not in known:
            raise InvalidArgument(f"{name} must be one of {', '.join(known)}, got {value!r}")
    return CepstraOptions(**(PRESETS[preset](sample_rate_hz).as_dict() | KINDS[kind] | options))


def cepstra(
    samples: ArrayLike, sample_rate_hz: int, kind: Kind = "mfcc", preset: Preset = "hri", **options: Any
) -> NDArray[Any]:
    """Cepstra of a recording.

    Parameters
    ----------
    samples : array_like, shape (num_samples,)
        Mono, -1 to 1.
    sample_rate_hz : int
    kind, preset, **options
        As `cepstra_options` takes them.

    Returns
    -------
    ndarray of float32, shape (num_frames, num_features)
        Columns as `column_names` lists them.

    Raises
    ------
    InvalidArgument
        For less than one frame, a sample that is not finite, or an option out of range (named).

    Examples
    --------
    >>> import numpy as np
    >>> tone = np.sin(2 * np.pi * 440 * np.arange(16000) / 16000)
    >>> cepstra(tone, 16000, preset="kaldi").shape
    (98, 13)
    """
    return CepstraComputer(cepstra_options(sample_rate_hz, kind, preset, **options)).compute(samples)


def column_names(options: CepstraOptions) -> list[str]:
    """Names of the columns of features: ``c0`` or ``energy``, ``c1``, ...; deltas begin with ``d_``, theirs ``dd_``.

    Parameters
    ----------
    options : CepstraOptions

    Returns
    -------
    list of str
    """
    names = [f"c{n}" for n in range(1, options.num_cepstra + 1)]
    if options.use_c0:
        names.insert(len(names) if options.htk_c0 else 0, "energy" if options.use_energy else "c0")
    return [prefix + name for prefix in ("", "d_", "dd_")[: 1 + options.delta_orders] for name in names]
