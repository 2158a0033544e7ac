# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Wavelet packets: details are split as approximations are, so that a level divides the spectrum evenly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hri import _native
from hri._native import frequency_order
from hri.core.errors import InvalidArgument
from hri.signal.arrays import as_contiguous, as_mode
from hri.signal.filters import Wavelet, dwt_max_level, name_of

Array = NDArray[Any]
MAX_LEVEL = 20


@dataclass(frozen=True)
class PacketNode:
    """A node of a `WaveletPacket`: its path from the top (``a`` approximation, ``d`` detail) and its coefficients."""

    path: str
    data: Array

    @property
    def level(self) -> int:
        """Splits from the signal to here."""
        return len(self.path)


class WaveletPacket:
    """The tree of packets of a signal, as PyWavelets' `WaveletPacket`; read-only.

    Parameters
    ----------
    data : array_like, shape (num_samples,)
    wavelet : str or Wavelet
    mode : str
        What stands beyond the ends, one of `MODES`.
    maxlevel : int, optional
        0..20; by default `dwt_max_level`, 20 at most.

    Examples
    --------
    >>> packet = WaveletPacket([1.0, 2.0, 3.0, 4.0], "haar", maxlevel=2)
    >>> packet["aa"].data.round(6).tolist()
    [5.0]
    >>> [node.path for node in packet.get_level(2, "freq")]
    ['aa', 'ad', 'dd', 'da']
    """

    def __init__(
        self, data: ArrayLike, wavelet: str | Wavelet, mode: str = "symmetric", maxlevel: int | None = None
    ) -> None:
        self.data = as_contiguous(data)
        self.wavelet = Wavelet(name_of(wavelet))
        self.mode = mode
        self.maxlevel = min(MAX_LEVEL, dwt_max_level(self.data.size, self.wavelet)) if maxlevel is None else maxlevel
        if self.maxlevel == 0:
            self._levels = [self.data.reshape(1, -1)]
        else:
            self._levels = wavelet_packets(self.data, self.wavelet, mode, self.maxlevel)

    def __getitem__(self, path: str) -> PacketNode:
        if len(path) > self.maxlevel or set(path) - {"a", "d"}:
            raise InvalidArgument(f"no node {path!r}: a path has letters a and d, {self.maxlevel} at most")
        index = int("0" + path.replace("a", "0").replace("d", "1"), 2)
        return PacketNode(path, np.asarray(self._levels[len(path)])[index])

    def get_level(self, level: int, order: Literal["natural", "freq"] = "natural") -> list[PacketNode]:
        """The nodes of a level, by path or by rising frequency."""
        if not 0 <= level <= self.maxlevel:
            raise InvalidArgument(f"level must be 0..{self.maxlevel}, got {level}")
        if order not in ("natural", "freq"):
            raise InvalidArgument(f"order must be natural or freq, got {order!r}")
        indices = range(2**level) if order == "natural" else frequency_order(level)
        return [self[_path(level, index)] for index in indices]

    def best_basis(self) -> list[PacketNode]:
        """The nodes that together describe the signal with the least Shannon entropy of energy."""
        return [self[_path(level, index)] for level, index in best_basis(self._levels)]

    def reconstruct(self) -> Array:
        """The signal from the nodes of the last level."""
        if self.maxlevel == 0:
            return self.data.copy()
        basis = [(self.maxlevel, index) for index in range(2**self.maxlevel)]
        return waverec_packets(self._levels, basis, self.wavelet, self.mode)


def wavelet_packets(data: ArrayLike, wavelet: str | Wavelet, mode: str = "symmetric", level: int = 1) -> list[Array]:
    """All packets of a signal down to a level.

    Parameters
    ----------
    data : array_like, shape (num_samples,)
    wavelet, mode
        As for `hri.signal.dwt`.
    level : int
        1..20.

    Returns
    -------
    list of ndarray
        Item l has a row for each of the 2**l nodes of level l; item 0 is the signal. Rows stand in natural order:
        the binary digits of an index are the path from the top, 1 for the detail. ``packets[l][frequency_order(l)]``
        has them by rising frequency.
    """
    return _native.wavelet_packets(as_contiguous(data), name_of(wavelet), as_mode(mode), level)


def best_basis(packets: Sequence[ArrayLike]) -> list[tuple[int, int]]:
    """The nodes (level, index) that together describe the signal with the least Shannon entropy of energy."""
    return _native.best_basis([as_contiguous(level) for level in packets])


def waverec_packets(
    packets: Sequence[ArrayLike], basis: Sequence[tuple[int, int]], wavelet: str | Wavelet, mode: str = "symmetric"
) -> Array:
    """The signal from the nodes (level, index) of `basis` alone, which cover the signal exactly once.

    Raises
    ------
    InvalidArgument
        For nodes that do not, and for packets that no signal has.
    """
    levels = [as_contiguous(level) for level in packets]
    return _native.reconstruct_packets(levels, list(basis), name_of(wavelet), as_mode(mode))


def _path(level: int, index: int) -> str:
    return format(index, f"0{level}b").replace("0", "a").replace("1", "d") if level else ""
