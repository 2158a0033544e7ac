# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri evaluate connected``: word errors of connected words on one's own recordings."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from hri.cli.connected import connected_embedding, connected_options
from hri.cli.messages import listed, note
from hri.cli.output import say_table, write_json
from hri.cli.progress import progress_bars
from hri.cli.recognizers import load_dataset, naming_options
from hri.cli.transcript_tables import recordings_below
from hri.core.errors import FormatError, InvalidArgument
from hri.datasets import Dataset
from hri.language import WordErrors, count_word_errors
from hri.media import read_audio
from hri.recognition import ConnectedWordRecognizer, SpeechEmbedding

_OTHERS = "others"
"""Held out of nothing: recordings whose name has no person of the training data in it."""


@dataclass(frozen=True)
class SpokenString:
    """A recording of connected words: where it is, what was said, and by whom; "": by no person trained on."""

    path: Path
    words: list[str]
    person: str


def evaluate_connected(
    data: str,
    transcripts: str,
    pattern: str | None,
    options: tuple[str, ...],
    front_end: str | None,
    embedding_path: str | None,
    seed: int,
    json_path: str | None,
) -> None:
    """Train without each person who speaks connected words, count the errors in these, print and write them."""
    fields = connected_options(options, front_end, embedding_path, seed)
    with naming_options():
        embedding = connected_embedding(ConnectedWordRecognizer(**fields), embedding_path)
    dataset = load_dataset(data, "speech", pattern)
    strings = read_strings(transcripts, dataset.persons)
    _tell_of_words(strings, dataset, transcripts)
    persons = sorted({string.person for string in strings}, key=lambda person: (not person, person))
    folds: list[dict[str, Any]] = []
    total = WordErrors()
    with progress_bars() as progress:
        for number, person in enumerate(persons):
            progress("speakers held out", number, len(persons))
            recognizer = _trained_without(person, dataset, ConnectedWordRecognizer(**fields), embedding)
            items = _recognised([string for string in strings if string.person == person], recognizer)
            errors = count_word_errors([item["words"] for item in items], [item["found"] for item in items])
            total += errors
            folds.append({"held_out": person or None, **_figures(errors), "items": items})
        progress("speakers held out", len(persons), len(persons))
    say_table(_table(folds, total), json_path)
    measured = ConnectedWordRecognizer(**fields).options.as_dict()
    write_json(json_path, {"mode": "connected", **_figures(total), "folds": folds, "seed": seed, "options": measured})


def read_strings(path: str, persons: Sequence[str]) -> list[SpokenString]:
    """The recordings that a table of transcripts names, below the folder where it stands.

    Parameters
    ----------
    path : str
        A master label file of HTK, or lines of words with the name of their recording behind them in brackets (trn).
    persons : sequence of str
        Of the training data: one is the speaker of a recording whose name, or folder, has him or her in it, as a part
        between ``_``, ``-`` or ``.``.

    Raises
    ------
    FormatError
        For a line of another form, a name that belongs to no recording, or to several, and a recording of several rows.
    """
    root = Path(path).parent
    strings = []
    for recording in recordings_below(path):
        if recording.said is None:
            raise FormatError(recording.fault)
        found = Path(recording.name)
        parts = {part for piece in found.relative_to(root).parts for part in re.split(r"[_.-]", piece)}
        speakers = [person for person in persons if person in parts]
        strings.append(SpokenString(found, recording.said.words, speakers[0] if len(speakers) == 1 else ""))
    if not any(string.words for string in strings):
        raise FormatError(f"{path}: no recording has a word")
    return strings


def _tell_of_words(strings: Sequence[SpokenString], dataset: Dataset, path: str) -> None:
    """Words that nothing can recognise, and speakers who may have been trained on."""
    said = {word for string in strings for word in string.words}
    unknown = sorted(said - set(dataset.labels))
    if len(unknown) == len(said):
        raise InvalidArgument(f"{path}: none of its words is a label of {dataset.root}")
    if unknown:
        note(f"{path}: no labels of {dataset.root}, and errors wherever they stand: {listed(unknown)}")
    others = [string.path.name for string in strings if not string.person]
    if others:
        note(
            f"{len(others)} recordings, such as {others[0]}, name no person of {dataset.root}: no person is held out "
            "for them, and if one of these persons speaks there, the test is not speaker-independent"
        )


def _trained_without(
    person: str, dataset: Dataset, recognizer: ConnectedWordRecognizer, embedding: SpeechEmbedding | None
) -> ConnectedWordRecognizer:
    samples = [sample for sample in dataset.samples if not person or sample.person != person]
    missing = sorted(set(dataset.labels) - {sample.label for sample in samples})
    if missing:
        raise InvalidArgument(f"only {person}, who is held out, says {listed(missing)}")
    return recognizer.fit(
        [read_audio(sample.path) for sample in samples],
        [sample.label for sample in samples],
        groups=[sample.person for sample in samples],
        embedding=embedding,
    )


def _recognised(strings: Sequence[SpokenString], recognizer: ConnectedWordRecognizer) -> list[dict[str, Any]]:
    return [
        {"path": str(string.path), "words": string.words, "found": list(recognizer.recognise(string.path).labels)}
        for string in strings
    ]


def _figures(errors: WordErrors) -> dict[str, Any]:
    return {"word_error_rate": errors.rate if errors.num_words else None, **asdict(errors)}


def _table(folds: Sequence[dict[str, Any]], total: WordErrors) -> list[tuple[str, ...]]:
    """A row for each speaker held out, then all."""
    rows: list[tuple[str, ...]] = [
        ("held out", "recordings", "words", "substituted", "deleted", "inserted", "word error rate", "all words right")
    ]
    items = [item for fold in folds for item in fold["items"]]
    for name, figures, of_fold in [
        *((fold["held_out"] or _OTHERS, fold, fold["items"]) for fold in folds),
        ("all", _figures(total), items),
    ]:
        counts = [len(of_fold), *(figures[key] for key in ("num_words", "substitutions", "deletions", "insertions"))]
        rate = figures["word_error_rate"]
        right = sum(item["words"] == item["found"] for item in of_fold) / len(of_fold)
        shares = ("" if rate is None else f"{100 * rate:.1f} %", f"{100 * right:.1f} %")
        rows.append((name, *map(str, counts), *shares))
    return rows
