# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Results that are kept as JSON, and whether they still hold for the code as it is.

A kept result names the commit it was measured at and the hash of every room of the source tree that it depends on (see
`hri.studies.provenance`). Where one of these has changed since, `verify` measures a part of it anew: in that part every
value of every fold that is kept has to be the same, and of a row measured whole every measure. Counts are the same to
the last digit, other numbers to a millionth, as processors and orders of summation round
otherwise. Then the result is stamped with the present commit; otherwise it has to be measured again. Where
``"rounded_to"`` says that only means were kept, rounded to so many decimals, these are compared. Of what stands beside
the rows, the ``"options"`` are compared where both have them: a default that has changed may leave one fold as it was,
and not the others.
"""

from __future__ import annotations

import json
import math
import os
import shlex
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from hri.core.errors import FormatError, InvalidArgument, IoError
from hri.core.files import read_json
from hri.studies.provenance import describe_code, describe_data, hash_rooms, newer_than_build, source_root
from hri.studies.registry import Progress, Study, find_data, run_study
from hri.studies.tables import PER_FOLD, Row, axes_of, folds_of

Only = Mapping[str, Sequence[str]]
_NOTHING = object()
_ROUNDING = 1e-6
"""Of a number, or by itself where that is below 1: calibration errors are differences of confidences near 1 in single
precision, and another order of summation moved those of speech-distance-both by 1e-7."""


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
        For other data, a value that differs (names the first), compiled modules that are older than their sources,
        sources that are in no commit, or an installed package instead of a checkout.
    """
    root = source_root()
    if root is None:
        raise InvalidArgument("results are verified in a checkout of the sources")
    if newer := newer_than_build(root):
        raise InvalidArgument(f"{newer[0].relative_to(root)} is newer than the compiled modules; run ./run build")
    code = {"verified": describe_code(root), "sources": hash_rooms(root, study)}
    if code["verified"]["commit"].endswith("+"):
        raise InvalidArgument("cpp, bindings or python have changes that are not in a commit; commit them first")
    data = describe_data(find_data(directory), study)
    if not _same_data(kept["data"], data):
        raise InvalidArgument(f"{study.name}: the recordings are not those that were measured: {data}")
    arguments = kept["arguments"]
    # Of results that were kept as rounded means only, every fold is needed.
    folds = 1 if study.folds and "rounded_to" not in kept else arguments.get("folds")
    fresh = run_study(study, directory, progress, _quick(study, arguments["only"]), arguments.get("takes"), folds)
    compare(study.name, kept, fresh, limited=folds != arguments.get("folds"))
    return {**kept, "data": data, **code}


def _same_data(kept: Row, now: Row) -> bool:
    """Whether all that is kept of the recordings still holds; older results have no hash of them."""
    return kept.keys() == now.keys() and all(kept[name].items() <= now[name].items() for name in kept)


def code_of(kept: Row) -> Row:
    """Version and commit of the code that a result was last verified with, or measured with."""
    code: Row = kept["verified"] if "verified" in kept else kept["measured"]
    return code


def _quick(study: Study, only: Only) -> dict[str, list[str]]:
    chosen = {axis: list(values) for axis, values in only.items()}
    for axis, values in study.quick.items():
        there = [value for value in values if value in chosen.get(axis, values)]
        chosen[axis] = there or chosen[axis][:1]
    return chosen


def compare(name: str, kept: Row, fresh: Row, limited: bool = False) -> None:
    """Raise InvalidArgument unless every measured value of `fresh` is the one of `kept`, but for rounding.

    Of every row, each measure is compared in the folds measured anew, where the kept result has its folds; of a row of
    which all folds were measured, everything. With `limited`, not all folds were asked for: then a row without folds
    is not compared, unless the kept result has no folds at all.
    """
    fresh = json.loads(json.dumps(fresh, default=str))  # as kept results are written
    for option, then, now in _changed_options(kept.get("options"), fresh.get("options")):
        raise InvalidArgument(f"{name}: option {option} was {then}, is {now}")
    digits = kept.get("rounded_to")
    axes = axes_of(kept["rows"])
    old = {_place(row, axes): row for row in kept["rows"]}
    no_folds = not any(folds_of(row) for row in kept["rows"])
    compared = 0
    for row in fresh["rows"]:
        place = _place(row, axes)
        if place not in old:
            if digits is not None:  # what was never kept cannot be compared
                continue
            raise InvalidArgument(f"{name}: the kept result has no {_said(place)}")
        for what, then, now in _pairs(old[place], row, whole=no_folds or not limited):
            if digits is not None:
                if not _is_measure(what[-1]) or None in (then, now):
                    continue
                then, now = round(then, digits), round(now, digits)
            if then is _NOTHING:
                raise InvalidArgument(f"{name}: the kept result has no {_said((*place, *what))}")
            if now is _NOTHING:
                raise InvalidArgument(f"{name}: {_said((*place, *what))} is no longer measured")
            if not _same(then, now):
                raise InvalidArgument(f"{name}: {_said((*place, *what))} was {then}, is {now}")
            compared += 1
    if not compared:
        raise InvalidArgument(f"{name}: nothing was measured that can be compared")


def _same(then: Any, now: Any) -> bool:
    """Whether two measured values are one; of numbers that are not whole one is rounded otherwise at most."""
    if isinstance(then, dict) and isinstance(now, dict):
        return then.keys() == now.keys() and all(_same(then[key], now[key]) for key in then)
    if isinstance(then, list) and isinstance(now, list):
        return len(then) == len(now) and all(_same(a, b) for a, b in zip(then, now, strict=True))
    if isinstance(then, float) and isinstance(now, float) and math.isfinite(then) and math.isfinite(now):
        return math.isclose(then, now, rel_tol=_ROUNDING, abs_tol=_ROUNDING)
    return json.dumps(then) == json.dumps(now)  # as text: NaN is itself


def _changed_options(then: Any, now: Any, place: str = "") -> Iterator[tuple[str, Any, Any]]:
    """Options that both have and that differ: a new one has a default under which the others hold."""
    if isinstance(then, dict) and isinstance(now, dict):
        for key in then.keys() & now.keys():
            yield from _changed_options(then[key], now[key], f"{place}.{key}" if place else key)
    elif then is not None and now is not None and json.dumps(then, sort_keys=True) != json.dumps(now, sort_keys=True):
        yield place, then, now


def _place(row: Row, axes: Sequence[str]) -> tuple[str, ...]:
    return tuple(str(row.get(axis, "")) for axis in axes)


def _pairs(old: Row, new: Row, whole: bool) -> Iterator[tuple[tuple[str, ...], Any, Any]]:
    """What is compared of a row: its name, the kept value and the new one; `whole` is for a row without folds."""
    then, now = folds_of(old), folds_of(new)
    both = [key for key in now if key in then]
    for key in both:
        measure = key[: -len(PER_FOLD)].rstrip("_")
        for fold, value in now[key].items():
            yield (*((measure,) if measure else ()), fold), then[key].get(fold, _NOTHING), value
    if all(then[key].keys() == now[key].keys() for key in both) if both else whole:
        for key, value in old.items():
            if _is_measure(key) or (isinstance(value, dict) and key in new and key not in then):
                yield (key,), value, new.get(key, _NOTHING)


def _is_measure(key: str) -> bool:
    return key.endswith(("_mean", "_std"))


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
