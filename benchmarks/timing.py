# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""How benches are timed: one process, one thread, the same input, in turns."""

from __future__ import annotations

import os

# Thread pools read these when their library is loaded, so this module comes first.
for _pool in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"):
    os.environ[_pool] = "1"

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from hri.recognition import embedding_weights

Details = dict[str, float | list[float]]
"""Further figures of a bench, by name."""
Timed = tuple[float, float] | tuple[float, float, Details]
"""Seconds of ours and of the peer, and what else there is to report."""


@dataclass(frozen=True)
class Bench:
    """One comparison.

    Attributes
    ----------
    name : str
    run : callable
        Gives the medians (ours, peer's) in seconds, after checking that both give the same answer where they should,
        and further figures if there are any.
    peer_name : str
    """

    name: str
    run: Callable[[], Timed]
    peer_name: str

    @property
    def what(self) -> str:
        """What is timed, in a sentence."""
        return " ".join((self.run.__doc__ or "").split())


class Skipped(Exception):
    """What a bench needs is not here; says what."""


def need_embedding() -> None:
    """Raise Skipped without the extra embedding."""
    try:
        embedding_weights()
    except ImportError as error:
        raise Skipped(str(error)) from error


def need_recordings(folder: str) -> Path:
    """A folder of recordings below what HRI_DATA names; raises Skipped where there is none."""
    data = os.environ.get("HRI_DATA")
    if not data or not (Path(data) / folder).is_dir():
        raise Skipped(f"HRI_DATA names no folder with {folder}")
    return Path(data) / folder


most_repeats: int | None = None
"""With a number, no bench is timed more often, whatever it asks for: its answers are checked, no more."""


def medians(ours: Callable[[], object], peer: Callable[[], object], repeats: int = 15) -> tuple[float, float]:
    """Median seconds of both, run in turns after one warm-up each."""
    seconds: tuple[list[float], list[float]] = ([], [])
    ours()
    peer()
    for _ in range(repeats if most_repeats is None else min(repeats, most_repeats)):
        for run, times in zip((ours, peer), seconds, strict=True):
            start = time.perf_counter()
            run()
            times.append(time.perf_counter() - start)
    return statistics.median(seconds[0]), statistics.median(seconds[1])
