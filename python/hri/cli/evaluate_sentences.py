# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri evaluate sentences``."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import click

from hri.cli.messages import note
from hri.cli.output import say_table, write_json
from hri.cli.progress import progress_bars
from hri.cli.recognizers import naming_options, parse_options, refuse_chosen
from hri.datasets.asl_sentences import read_asl_sentences
from hri.evaluation import SentenceResult, cross_validate_sentences
from hri.evaluation.sentences import signers_of
from hri.recognition import SentenceRecognizer


def evaluate_sentences(
    data: str | None, folds: int | None, options: tuple[str, ...], seed: int, json_path: str | None
) -> None:
    """Print word errors of signed sentences held out."""
    if data is None:
        raise click.UsageError("give --data DIR")
    fields = parse_options((f"seed={seed}", *options))
    refuse_chosen(fields, "choose_weights")
    with naming_options():
        measured = SentenceRecognizer(**fields)
    sentences = read_asl_sentences(Path(data))
    with progress_bars() as progress:
        results = cross_validate_sentences(
            sentences, lambda: SentenceRecognizer(**fields), num_folds=folds, seed=seed, progress=progress
        )
    total = SentenceResult.pooled(results)
    say_table(_table([*results, total]), json_path)
    held_out = "videos" if signers_of(sentences) is None else "signers"
    if held_out == "videos":
        note("all videos are of one signer: how well another one is understood is not measured")
    if total.num_unknown:
        note(f"{total.num_unknown} of {total.errors.num_words} words stand in no sentence trained on")
    found = {"held_out": held_out, "folds": [result.to_dict() for result in results]}
    all_of_them = {name: value for name, value in total.to_dict().items() if name not in ("name", "items")}
    write_json(json_path, {"mode": "sentences", **found, **all_of_them, "options": measured.options.as_dict()})


def _table(results: Sequence[SentenceResult]) -> list[tuple[str, ...]]:
    """A row a fold, and one of all sentences together."""
    rows: list[tuple[str, ...]] = [
        ("held out", "sentences", "words", "word errors", "substituted", "deleted", "inserted", "sentences right")
    ]
    for result in results:
        errors = result.errors
        rate = f"{100 * errors.rate:.1f} %" if errors.num_words else ""
        kinds = (str(errors.substitutions), str(errors.deletions), str(errors.insertions))
        right = f"{100 * result.right:.1f} %"
        rows.append((result.name, str(len(result.items)), str(errors.num_words), rate, *kinds, right))
    return rows
