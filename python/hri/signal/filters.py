# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Wavelets by name: their filters, their families, and how many levels a signal has."""

from __future__ import annotations

from dataclasses import dataclass, field

from hri import _native
from hri.core.errors import InvalidArgument

FAMILIES = ("haar", "db", "sym", "coif", "bior", "rbio", "dmey")
_BIORTHOGONAL = ("bior", "rbio")


@dataclass(frozen=True)
class Wavelet:
    """A discrete wavelet.

    Parameters
    ----------
    name : str
        One of `wavelist()`.

    Attributes
    ----------
    dec_lo, dec_hi : tuple of float
        Analysis filters, low-pass and high-pass.
    rec_lo, rec_hi : tuple of float
        Synthesis filters.

    Raises
    ------
    InvalidArgument
        For a name that there is not.

    Examples
    --------
    >>> Wavelet("haar").dec_len
    2
    """

    name: str
    dec_lo: tuple[float, ...] = field(init=False, repr=False)
    dec_hi: tuple[float, ...] = field(init=False, repr=False)
    rec_lo: tuple[float, ...] = field(init=False, repr=False)
    rec_hi: tuple[float, ...] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        filters = _native.wavelet_filters(self.name)
        for name, values in zip(("dec_lo", "dec_hi", "rec_lo", "rec_hi"), filters, strict=True):
            object.__setattr__(self, name, tuple(values))

    @property
    def filter_bank(self) -> tuple[tuple[float, ...], ...]:
        """``(dec_lo, dec_hi, rec_lo, rec_hi)``."""
        return self.dec_lo, self.dec_hi, self.rec_lo, self.rec_hi

    @property
    def dec_len(self) -> int:
        """Taps of the analysis filters."""
        return len(self.dec_lo)

    @property
    def rec_len(self) -> int:
        """Taps of the synthesis filters."""
        return len(self.rec_lo)

    @property
    def short_family_name(self) -> str:
        """``db`` of ``db4``."""
        return self.name.rstrip("0123456789.")

    @property
    def orthogonal(self) -> bool:
        """Whether the synthesis filters are the analysis filters reversed."""
        return self.short_family_name not in _BIORTHOGONAL

    def __str__(self) -> str:
        return self.name


def name_of(wavelet: str | Wavelet) -> str:
    """The name of a wavelet that is given by name or as an object."""
    return wavelet.name if isinstance(wavelet, Wavelet) else wavelet


def wavelist(family: str | None = None) -> list[str]:
    """Names of the wavelets there are, of all families or of one (`FAMILIES`)."""
    names: list[str] = _native.wavelet_names()
    if family is None:
        return names
    if family not in FAMILIES:
        raise InvalidArgument(f"no family {family!r}; there are: {', '.join(FAMILIES)}")
    return [name for name in names if name.rstrip("0123456789.") == family]


def dwt_max_level(data_len: int, filter_len: int | str | Wavelet) -> int:
    """Levels until the border reaches every coefficient.

    Parameters
    ----------
    data_len : int
        Samples of the signal.
    filter_len : int, str or Wavelet
        Taps of the filters, at least 2, or the wavelet.
    """
    taps = filter_len if isinstance(filter_len, int) else Wavelet(name_of(filter_len)).dec_len
    if data_len < 0 or taps < 2:
        raise InvalidArgument(f"data_len must be at least 0 and filter_len at least 2, got {data_len} and {taps}")
    return max(0, (data_len // (taps - 1)).bit_length() - 1)
