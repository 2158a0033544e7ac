# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Parameter files as text, as HList prints them."""

from __future__ import annotations

from collections.abc import Iterator

from hri._native import HtkParameterFile
from hri.core.errors import InvalidArgument

WIDTH = 86
MARGIN = 7
ITEMS_A_LINE = 10
OF_INTEGERS = ("WAVEFORM", "DISCRETE")


def list_parameters(
    file: HtkParameterFile,
    name: str,
    first: int = 0,
    last: int = -1,
    header: bool = False,
    items: int = ITEMS_A_LINE,
    values: bool = True,
    title: str = "Source",
    header_lines: bool = True,
) -> Iterator[str]:
    """Lines of a listing.

    Parameters
    ----------
    file : ParameterFile
    name : str
        Of the file, for the header.
    first, last : int
        Frames to print, both included; -1: to the end.
    header : bool
        Whether what the file's header says is printed, too.
    items : int
        Values in a line.
    values : bool
        Whether frames are printed.
    title : str
        Of the header.
    header_lines : bool
        Whether, with `header`, its lines are printed, too, and not only those that frame the values.
    """
    frames = file.values
    if header and header_lines:
        width = 2 if file.kind.startswith((*OF_INTEGERS, "IREFC")) or "_C" in file.kind else 4
        yield f" {title}: {name} ".center(WIDTH, "-")
        yield f"  Sample Bytes:  {frames.shape[1] * width:<8} Sample Kind:   {file.kind}"
        yield f"  Num Comps:     {frames.shape[1]:<8} Sample Period: {file.sample_period / 10:.1f} us"
        yield f"  Num Samples:   {len(frames):<8} File Format:   HTK"
    if values:
        whole = file.kind.startswith(OF_INTEGERS)
        end = len(frames) if last < 0 else min(last + 1, len(frames))
        if header:
            yield f" Samples: {first}->{last} ".center(WIDTH, "-")
        for number in range(first, end):
            cells = [f"{value:8.0f}" if whole else f"{value:8.3f}" for value in frames[number]]
            for at in range(0, len(cells), items):
                mark = f"{number}:" if at == 0 else ""
                yield mark.ljust(MARGIN) + " ".join(cells[at : at + items])
    if header:
        yield " END ".center(WIDTH, "-")


def observation_names(kind: str, num_columns: int) -> list[str]:
    """The name of every value of a frame, as HList has them: MFCC-1 .., C0, E, then Del-1 .., Acc-1 .., Th-1 ..

    Parameters
    ----------
    kind : str
    num_columns : int
        Blocks of static values and of each order of differences, all of one size.

    Raises
    ------
    InvalidArgument
        For columns that the kind cannot have.
    """
    base, *letters = kind.split("_")
    orders = [letter for letter in "DAT" if letter in letters]
    if num_columns % (1 + len(orders)):
        raise InvalidArgument(f"{num_columns} columns cannot be {kind}")
    size = num_columns // (1 + len(orders))
    extra = [name for letter, name in (("0", "C0"), ("E", "E")) if letter in letters]
    names = [f"{base}-{number}" for number in range(1, size - len(extra) + 1)] + extra
    for letter, prefix in (("D", "Del"), ("A", "Acc"), ("T", "Th")):
        if letter in orders:
            numbered = [f"{prefix}-{number}" for number in range(1, size - len(extra) + 1)]
            names += numbered + [f"{prefix}{name}" for name in extra]
    return names
