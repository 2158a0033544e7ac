# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What commands that train say of recordings and of the model they replace, before the work begins."""

from __future__ import annotations

from collections import Counter
from datetime import datetime
from pathlib import Path

from hri.cli.messages import listed, note
from hri.core.display import count
from hri.core.errors import Error, InvalidArgument
from hri.datasets import Dataset
from hri.io import ModelFile

MOST_SINGLE = 10
"""Labels of one recording each of which a vocabulary may consist that replaces another one."""
_NAMED = 5


def check_recordings(dataset: Dataset, kept: Path | None) -> None:
    """Warn of labels with a single recording, and say which model is replaced if it has other labels.

    Parameters
    ----------
    dataset : Dataset
    kept : Path or None
        The model kept per user that is replaced; None where another file was named.

    Raises
    ------
    InvalidArgument
        Where each of more than `MOST_SINGLE` labels has a single recording, as of names that a wrong pattern takes for
        labels, and a model of others would be lost.
    """
    counts = Counter(str(sample.label) for sample in dataset)
    single = [str(label) for label in dataset.labels if counts[str(label)] == 1]
    before = None if kept is None else _labels(kept)
    others = before is not None and sorted(before) != sorted(counts)
    if single:
        some = "1 label has" if len(single) == 1 else f"{len(single)} labels have"
        number = f"each of the {len(single)} labels has" if len(single) == len(counts) > 1 else some
        more = f" and {len(single) - _NAMED} more" if len(single) > _NAMED else ""
        said = f"{number} a single recording: {' '.join(single[:_NAMED])}{more}; does the pattern fit the names?"
        if others and len(single) == len(counts) > MOST_SINGLE:
            assert before is not None
            raise InvalidArgument(
                f"{said} The model kept, of {count(len(before), 'other label')}, is not replaced: name --out"
            )
        note(f"WARNING: {said}")
    if others:
        assert kept is not None and before is not None
        made = datetime.fromtimestamp(kept.stat().st_mtime)
        note(f"{kept}: replaces the model of {made:%Y-%m-%d %H:%M}, {count(len(before), 'label')}: {' '.join(before)}")


def summary_of(dataset: Dataset) -> str:
    """How many recordings of how many persons there are, and of which labels."""
    persons = f"{count(len(dataset.persons), 'person')}, " if dataset.persons else ""
    labels = f"{count(len(dataset.labels), 'label')}: {listed(dataset.labels)}"
    return f"{count(len(dataset), 'recording')}, {persons}{labels}"


def _labels(path: Path) -> list[str] | None:
    """Of a model file; None where there is none, or it cannot be read."""
    if not path.is_file():
        return None
    try:
        return [str(label) for label in ModelFile.read(path).text_list("labels")]
    except Error:
        return None
