# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri train-fusion``."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import click
import numpy as np

from hri.cli.choices import (
    asked_options,
    chosen_options,
    front_end_option,
    hands_option,
    network_option,
    refuse_wrong_noises,
    source_option,
    what_words_are_of,
)
from hri.cli.groups import CheckedCommand, FiniteRange
from hri.cli.messages import note
from hri.cli.output import OutputFile, json_option, say, write_json
from hri.cli.progress import Progress, progress_bars
from hri.cli.recognizers import embedding_for, embedding_option, load_dataset, recognizer_factory
from hri.core.display import count
from hri.core.errors import InvalidArgument
from hri.datasets import Dataset
from hri.evaluation import EvaluationResult, cross_validate
from hri.fusion import KINDS, LearnedFusion, fuse, pair_decisions
from hri.recognition import Decision, SpeechEmbedding, WordRecognizer

PARTS = 2
"""Into which persons are parted to measure: fusion learns on one, and is measured on the other."""
_folder = click.Path(exists=True, file_okay=False)


@click.command("train-fusion", cls=CheckedCommand)
@click.option("--speech-data", required=True, type=_folder, metavar="DIR", help="Folder of recorded words.")
@click.option("--gesture-data", required=True, type=_folder, metavar="DIR", help="Folder of signs of the same labels.")
@click.option(
    "--speech-pattern", metavar="TEXT", help="How paths of words name label and person, as --pattern of train."
)
@click.option("--gesture-pattern", metavar="TEXT", help="The same of signs.")
@click.option("--out", required=True, type=OutputFile(), metavar="FILE", help="What --fusion of other commands reads.")
@click.option("--kind", type=click.Choice(KINDS), default=KINDS[0], show_default=True, help="What learns.")
@click.option("--folds", type=click.IntRange(2), help="Folds by person, of each folder; the default is as of evaluate.")
@click.option("--noise", help="Also learn from words in this noise: white, pink, or a recording.")
@click.option("--snr", type=FiniteRange(-30, 60), metavar="DB", help="Signal-to-noise ratio of --noise.")
@click.option("--exposure", type=FiniteRange(0.05, 20), help="Also learn from signs of another brightness: a factor.")
@click.option("--speech-option", multiple=True, metavar="NAME=VALUE", help="Of the words' recogniser, as of train.")
@click.option("--gesture-option", multiple=True, metavar="NAME=VALUE", help="Of the signs' recogniser, as of train.")
@front_end_option("--speech-option")
@embedding_option
@network_option("--speech-option")
@source_option("--gesture-option")
@hands_option("--gesture-option")
@click.option("--seed", type=click.IntRange(0), default=0, show_default=True, help="Of everything random.")
@json_option
def train_fusion(
    speech_data: str,
    gesture_data: str,
    speech_pattern: str | None,
    gesture_pattern: str | None,
    out: str,
    kind: str,
    folds: int | None,
    noise: str | None,
    snr: float | None,
    exposure: float | None,
    speech_option: tuple[str, ...],
    gesture_option: tuple[str, ...],
    front_end: str | None,
    embedding_path: str | None,
    network: bool | None,
    source: str | None,
    hands: str | None,
    seed: int,
    json_path: str | None,
) -> None:
    """Learn how to combine words and signs, from what recognisers decide on persons who are left out of training.

    Recognisers are trained on all but some persons, and decide on those, until each was left out once. They are those
    that 'hri train' makes of the same recordings by the same options: a fusion is for recognisers like those that it
    learned from. --folds 5 and --no-network take a fraction of the time. Each word goes with two signs of the same
    label. How often the result is right is measured on half of the persons, by what was
    learned from the other half; what is written has learned from all.

    \b
    Examples:
      hri train-fusion --speech-data spoken/ --gesture-data signed/ --out fusion.hri
      hri train-fusion --speech-data spoken/ --gesture-data signed/ --out fusion.hri --noise pink --snr 10
      hri train-fusion --speech-data spoken/ --gesture-data signed/ --out fusion.hri --front-end cepstra --folds 5
      hri session --fusion fusion.hri
    """
    if (noise is None) != (snr is None):
        raise click.UsageError("--noise and --snr go together")
    if noise is not None:
        refuse_wrong_noises([noise])
    options = {
        "speech": asked_options(
            "speech",
            speech_option,
            front_end=front_end,
            embedding_path=embedding_path,
            network=network,
            option="--speech-option",
        ),
        "gesture": asked_options("gesture", gesture_option, source=source, hands=hands, option="--gesture-option"),
    }
    for mode, asked in options.items():
        recognizer_factory(mode, asked, seed)  # what is wrong with them is said before recordings are looked for
    data = {
        "speech": load_dataset(speech_data, "speech", speech_pattern, "--speech-pattern"),
        "gesture": load_dataset(gesture_data, "gesture", gesture_pattern, "--gesture-pattern"),
    }
    for mode, dataset in data.items():
        if len(dataset.persons) < 2:
            raise InvalidArgument(f"{dataset.root}: {mode} of two persons or more is needed, one is left out at a time")
    common = [label for label in data["speech"].labels if label in data["gesture"].labels]
    if len(common) < 2:
        raise InvalidArgument(f"{speech_data} and {gesture_data} need two labels in common, and have {len(common)}")
    changed: dict[str, dict[str, Any]] = {
        "speech": {} if noise is None else {"noise": noise, "snr_db": snr},
        "gesture": {} if exposure is None else {"exposure": exposure},
    }
    notes: list[str] = []
    makes: dict[str, Callable[[], Any]] = {}
    for mode, dataset in data.items():
        options[mode], why_source = chosen_options(options[mode], dataset)
        makes[mode] = recognizer_factory(mode, options[mode], seed)
        recognizer = makes[mode]()
        notes += what_words_are_of(recognizer.options) if isinstance(recognizer, WordRecognizer) else [why_source]
    embeddings = {"speech": embedding_for(makes["speech"](), embedding_path), "gesture": None}
    path = Path(out)
    path.parent.mkdir(parents=True, exist_ok=True)
    decided: dict[str, list[list[tuple[str, Decision]]]] = {}
    with progress_bars() as progress:
        for mode, dataset in data.items():
            decided[mode] = _held_out(dataset, makes[mode], embeddings[mode], folds, seed, changed[mode], progress)
    said, shown = ([one for part in decided[mode] for one in part] for mode in ("speech", "gesture"))
    pairs = pair_decisions(said, shown, seed=seed)
    LearnedFusion(kind, seed).fit_decisions(pairs.speech, pairs.gesture, pairs.labels).save(path)
    say(str(path), json_path)
    num_pairs = count(len(pairs.labels), "pair")
    note(f"{num_pairs} of words and signs of held-out persons, {len(common)} labels: {' '.join(common)}")
    for line in filter(None, notes):
        note(line)
    shares = _measured(decided, kind, seed)
    for name, share in (shares or {}).items():
        note(f"{name}: {100 * share:.1f} % right on persons that it was not learned from")
    left_out = sorted({*data["speech"].labels, *data["gesture"].labels}.difference(common))
    if left_out:
        note(f"labels of one folder only, not learned from: {' '.join(left_out)}")
    synthetic = any(dataset.synthetic for dataset in data.values())
    report = {"model": str(path), "kind": kind, "labels": common, "num_pairs": len(pairs.labels), "held_out": shares}
    used = {mode: make().options.as_dict() for mode, make in makes.items()}
    write_json(json_path, {**report, "options": used, "synthetic": synthetic, "seed": seed})


def _held_out(
    dataset: Dataset,
    make: Callable[[], Any],
    embedding: SpeechEmbedding | None,
    folds: int | None,
    seed: int,
    changed: dict[str, Any],
    progress: Progress,
) -> list[list[tuple[str, Decision]]]:
    """Right labels and decisions, in `PARTS` parts of different persons; also of the changed signal, where it is."""
    parts: list[list[tuple[str, Decision]]] = [[] for _ in range(PARTS)]
    for conditions in ({}, changed) if changed else ({},):
        result: EvaluationResult = cross_validate(
            dataset, make, num_folds=folds, seed=seed, embedding=embedding, progress=progress, **conditions
        )
        for number, fold in enumerate(result.folds):
            parts[number % PARTS] += [(item.truth, item.decision) for item in fold.items]
    return parts


def _measured(decided: dict[str, list[list[tuple[str, Decision]]]], kind: str, seed: int) -> dict[str, float] | None:
    """How often each mode, the fixed product and what was learned on the other persons are right.

    None, and a note why, where half of the persons have too few labels in common to learn from.
    """
    try:
        parts = [pair_decisions(*both, seed=seed) for both in zip(decided["speech"], decided["gesture"], strict=True)]
        others = [LearnedFusion(kind, seed).fit_decisions(one.speech, one.gesture, one.labels) for one in parts[::-1]]
    except InvalidArgument as error:
        note(f"cannot be measured on persons that it was not learned from: of half of them, {error}")
        return None
    right: dict[str, list[bool]] = {"speech": [], "gesture": [], "product": [], f"learned {kind}": []}
    for test, learned in zip(parts, others, strict=True):
        for speech, gesture, label in zip(test.speech, test.gesture, test.labels, strict=True):
            right["speech"].append(_best(speech) == label)
            right["gesture"].append(_best(gesture) == label)
            right["product"].append(_best(fuse(speech, gesture, rule="product")) == label)
            right[f"learned {kind}"].append(_best(learned.fuse(speech, gesture)) == label)
    return {name: float(np.mean(of)) for name, of in right.items()}


def _best(decision: Any) -> str:
    """The best label, whether or not it was rejected."""
    nbest: Sequence[Any] = decision.nbest
    return str(nbest[0].label) if nbest else ""
