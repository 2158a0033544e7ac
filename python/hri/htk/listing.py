# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Parameter files as text, as HList prints them."""

from __future__ import annotations

from collections.abc import Iterator
from os import PathLike

import numpy as np
from numpy.typing import NDArray

from hri._native import HtkParameterFile
from hri.core.errors import InvalidArgument
from hri.htk.coding import ParameterHeader, read_header

WIDTH = 86
MARGIN = 7
ITEMS_A_LINE = 10
OF_INTEGERS = ("WAVEFORM", "DISCRETE")
_VALUES_AT_ONCE = 1 << 18


def header_of(file: HtkParameterFile | str | PathLike[str]) -> ParameterHeader:
    """What a file, or the one of this path, says of itself; errors as of `read_header`."""
    if not isinstance(file, HtkParameterFile):
        return read_header(file)
    num_frames, num_columns = file.values.shape
    return ParameterHeader(file.kind, file.sample_period, num_frames, num_columns)


def blocks_of(
    file: HtkParameterFile | str | PathLike[str], first: int = 0, last: int = -1
) -> Iterator[NDArray[np.float32]]:
    """Frames of a file, one array behind the other; of a path no more is in memory than one of bounded size.

    Parameters
    ----------
    file : ParameterFile or path
        Of a path that is read from end to end the checksum of _K is checked before the first.
    first, last : int
        Both included, as far as there are so many; -1: to the end.

    Raises
    ------
    IoError, FormatError
        As `ParameterFile.read` does; of a path for the frames asked for.
    """
    if isinstance(file, HtkParameterFile):
        yield file.values[first : None if last < 0 else last + 1]
        return
    header = read_header(file)
    end = header.num_frames if last < 0 else min(last + 1, header.num_frames)
    if first == 0 and end == header.num_frames:
        HtkParameterFile.verify(file)
    step = max(1, _VALUES_AT_ONCE // header.num_columns)
    for begin in range(first, end, step):
        yield HtkParameterFile.read_frames(file, begin, min(begin + step, end)).values


def list_parameters(
    file: HtkParameterFile | str | PathLike[str],
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
    file : ParameterFile or path
        Of a path a bounded part is in memory at a time.
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
    shown = header_of(file)
    if header and header_lines:
        width = 2 if shown.kind.startswith((*OF_INTEGERS, "IREFC")) or "_C" in shown.kind else 4
        yield f" {title}: {name} ".center(WIDTH, "-")
        yield f"  Sample Bytes:  {shown.num_columns * width:<8} Sample Kind:   {shown.kind}"
        yield f"  Num Comps:     {shown.num_columns:<8} Sample Period: {shown.sample_period / 10:.1f} us"
        yield f"  Num Samples:   {shown.num_frames:<8} File Format:   HTK"
    if values:
        whole = shown.kind.startswith(OF_INTEGERS)
        if header:
            yield f" Samples: {first}->{last} ".center(WIDTH, "-")
        number = first
        for block in blocks_of(file, first, last):
            for row in block:
                cells = [f"{value:8.0f}" if whole else f"{value:8.3f}" for value in row]
                for at in range(0, len(cells), items):
                    mark = f"{number}:" if at == 0 else ""
                    yield mark.ljust(MARGIN) + " ".join(cells[at : at + items])
                number += 1
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
