# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What commands that train say of recordings and of the model they replace, before the work begins."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from datetime import datetime
from pathlib import Path

from hri.cli.messages import listed, note
from hri.core.display import count
from hri.core.errors import Error, InvalidArgument
from hri.datasets import Dataset
from hri.io import ModelFile
from hri.media import Audio
from hri.recognition import WordRecognizerOptions
from hri.signal import find_speech, resample

MOST_SINGLE = 10
"""Labels of one recording each of which a vocabulary may consist that replaces another one."""
_NAMED = 5
_SILENT_NAMED = 10
_DEFAULT_RATE_HZ = 16000
"""Of models whose options leave the rate to the recordings: the lowest of these, and no higher one."""


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


def warn_of_silence(clips: Sequence[Audio], options: WordRecognizerOptions) -> None:
    """Name the files in which training will find no speech: it leaves them out.

    Parameters
    ----------
    clips : sequence of Audio
        All that is trained on, as it was read.
    options : WordRecognizerOptions
        Of training.
    """
    rate_hz = options.cepstra.sample_rate_hz or min([_DEFAULT_RATE_HZ, *(clip.sample_rate_hz for clip in clips)])
    silent = [str(clip.path) for clip in clips if _is_silent(clip, rate_hz, options)]
    if silent:
        more = f" and {len(silent) - _SILENT_NAMED} more" if len(silent) > _SILENT_NAMED else ""
        which = "is" if len(silent) == 1 else "are"
        named = " ".join(silent[:_SILENT_NAMED])
        number = count(len(silent), "recording")
        note(f"WARNING: no speech is found in {number}, which {which} not learned from: {named}{more}")


def _is_silent(clip: Audio, rate_hz: int, options: WordRecognizerOptions) -> bool:
    samples = clip.samples
    try:
        if clip.sample_rate_hz != rate_hz:
            samples = resample(samples, clip.sample_rate_hz, rate_hz)
        return find_speech(samples, rate_hz, options.activity) is None
    except InvalidArgument:  # too short, or a rate that is none: training says so
        return False


def _labels(path: Path) -> list[str] | None:
    """Of a model file; None where there is none, or it cannot be read."""
    if not path.is_file():
        return None
    try:
        return [str(label) for label in ModelFile.read(path).text_list("labels")]
    except Error:
        return None
