# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Results that are kept as JSON, and whether they still hold for the code as it is.

A kept result names the commit it was measured at and the hash of every room of the source tree that it depends on.
Where one of these has changed since, `verify` measures a part of it anew: every value of every fold in that part has to
be the kept one to the last digit. Then the result is stamped with the present code; otherwise it has to be measured
again. Where ``"rounded_to"`` says that only means were kept, rounded to so many decimals, these are compared.
"""

from __future__ import annotations

import os
import shlex
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from hri.core.errors import FormatError, InvalidArgument, IoError
from hri.core.files import read_json
from hri.studies.provenance import describe_code, describe_data, hash_rooms, newer_than_build, source_root
from hri.studies.registry import Progress, Study, find_data, run_study
from hri.studies.tables import Row, axes_of

Only = Mapping[str, Sequence[str]]


def measure(
    study: Study,
    directory: str | os.PathLike[str] | None,
    progress: Progress,
    only: Only | None = None,
    takes: int | None = None,
    folds: int | None = None,
) -> Row:
    """Run a study; the result also names its arguments, its data and, in a checkout, the code it was measured with."""
    arguments: Row = {"only": {axis: list(values) for axis, values in (only or {}).items()}}
    arguments |= {name: value for name, value in (("takes", takes), ("folds", folds)) if value is not None}
    root = source_root()
    # Taken before the study runs: what is edited meanwhile was not measured.
    code = {"measured": describe_code(root), **({} if root is None else {"sources": hash_rooms(root, study)})}
    result = run_study(study, directory, progress, only, takes, folds)
    return {
        "study": study.name,
        "arguments": arguments,
        "data": describe_data(find_data(directory), study),
        **code,
        **result,
    }


def command_of(kept: Row) -> str:
    """What repeats a kept result."""
    arguments = kept["arguments"]
    words = ["hri", "study", kept["study"]]
    for name in ("takes", "folds"):
        if name in arguments:
            words += [f"--{name}", str(arguments[name])]
    for axis, values in arguments["only"].items():
        words += ["--only", shlex.quote(f"{axis}={','.join(values)}")]
    return " ".join(words)


def stale_rooms(root: Path, study: Study, kept: Row) -> list[str]:
    """The rooms that have changed since the result was measured or last verified."""
    then = kept.get("sources", {})
    return [room for room, now in hash_rooms(root, study).items() if then.get(room) != now]


def verify(study: Study, kept: Row, directory: str | os.PathLike[str] | None, progress: Progress) -> Row:
    """The kept result stamped with the code as it is, after a part of it was measured anew and is the same.

    Raises
    ------
    InvalidArgument
        For other data, a value that differs (names the first), compiled modules that are older than their sources, or
        an installed package instead of a checkout.
    """
    root = source_root()
    if root is None:
        raise InvalidArgument("results are verified in a checkout of the sources")
    if newer := newer_than_build(root):
        raise InvalidArgument(f"{newer[0].relative_to(root)} is newer than the compiled modules; run ./run build")
    data = describe_data(find_data(directory), study)
    if data != kept["data"]:
        raise InvalidArgument(f"{study.name}: the recordings are not those that were measured: {data}")
    arguments = kept["arguments"]
    code = {"verified": describe_code(root), "sources": hash_rooms(root, study)}
    # Of results that were kept as rounded means only, every fold is needed.
    folds = 1 if study.folds and "rounded_to" not in kept else arguments.get("folds")
    fresh = run_study(study, directory, progress, _quick(study, arguments["only"]), arguments.get("takes"), folds)
    compare(study.name, kept, fresh)
    return {**kept, **code}


def _quick(study: Study, only: Only) -> dict[str, list[str]]:
    chosen = {axis: list(values) for axis, values in only.items()}
    for axis, values in study.quick.items():
        there = [value for value in values if value in chosen.get(axis, values)]
        chosen[axis] = there or chosen[axis][:1]
    return chosen


def compare(name: str, kept: Row, fresh: Row) -> None:
    """Raise InvalidArgument unless every measured value of `fresh` is one of `kept`, to the last digit kept."""
    digits = kept.get("rounded_to")
    old, new = dict(fold_values(kept, digits)), dict(fold_values(fresh, digits))
    if digits is not None:  # what was never kept cannot be compared
        new = {place: value for place, value in new.items() if place in old}
    if not new:
        raise InvalidArgument(f"{name}: nothing was measured that can be compared")
    for place, value in new.items():
        if place not in old:
            raise InvalidArgument(f"{name}: the kept result has no {_said(place)}")
        if old[place] != value:
            raise InvalidArgument(f"{name}: {_said(place)} was {old[place]}, is {value}")


def fold_values(result: Row, digits: int | None = None) -> Iterator[tuple[tuple[str, ...], float]]:
    """Every fold's value by what was varied; the means, rounded to `digits`, of a result that has no folds."""
    rows = result["rows"]
    axes = axes_of(rows)
    with_folds = digits is None and any("per_fold" in row for row in rows)
    for row in rows:
        place = tuple(str(row.get(axis, "")) for axis in axes)
        if with_folds:
            yield from (((*place, fold), value) for fold, value in row.get("per_fold", {}).items())
        else:
            means = {key: value for key, value in row.items() if key.endswith(("_mean", "_std"))}
            yield from (
                ((*place, key), value if digits is None else round(value, digits)) for key, value in means.items()
            )


def _said(place: Sequence[str]) -> str:
    return ", ".join(place)


def read_kept(path: Path) -> Row:
    """A result of `measure` from its file. Raises InvalidArgument for anything else."""
    try:
        found = read_json(path)
    except (IoError, FormatError) as error:
        raise InvalidArgument(f"not a kept result: {error}") from error
    if not isinstance(found, dict) or not {"study", "arguments", "data", "rows"} <= found.keys():
        raise InvalidArgument(f"{path}: not a kept result: study, arguments, data or rows are missing")
    return found
