# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri evaluate``."""

from __future__ import annotations

from typing import Any

import click

from hri.cli.output import json_option, say, write_json
from hri.cli.progress import progress_bars
from hri.cli.recognizers import mode_argument, options_option, pattern_option, recognizer_factory
from hri.datasets import Dataset
from hri.evaluation import EvaluationResult, cross_validate, evaluate_split

_folder = click.Path(exists=True, file_okay=False)


@click.command()
@mode_argument
@click.option("--data", type=_folder, help="Folder of recordings, split into folds by person.")
@click.option("--train", "train_dir", type=_folder, help="Train on this folder ...")
@click.option("--test", "test_dir", type=_folder, help="... and test on this one.")
@pattern_option
@click.option("--folds", type=click.IntRange(2), help="Folds by person; the default holds out one person at a time.")
@click.option("--train-persons", type=click.IntRange(1), help="Train on so many persons only, drawn at random.")
@click.option("--noise", help="Added to the test clips: white, pink, or a recording.")
@click.option("--snr", type=click.FloatRange(-30, 60), metavar="DB", help="Signal-to-noise ratio of --noise.")
@click.option("--train-noise", is_flag=True, help="Train on a noisy copy of every clip too.")
@click.option("--exposure", type=click.FloatRange(0.05, 20), help="Factor on the brightness of the test pictures.")
@options_option
@click.option("--seed", type=int, default=0, show_default=True, help="Of folds and noise.")
@click.option("--confusion", type=click.Path(dir_okay=False), help="Draw the confusion matrix as .png, .svg or .pdf.")
@json_option
def evaluate(
    mode: str,
    data: str | None,
    train_dir: str | None,
    test_dir: str | None,
    pattern: str | None,
    folds: int | None,
    train_persons: int | None,
    noise: str | None,
    snr: float | None,
    train_noise: bool,
    exposure: float | None,
    options: tuple[str, ...],
    seed: int,
    confusion: str | None,
    json_path: str | None,
) -> None:
    """Measure the accuracy of MODE on people who were not trained on.

    \b
    Examples:
      hri evaluate speech --data spoken/
      hri evaluate gesture --data signed/ --folds 5 --confusion confusion.png
      hri evaluate speech --train ours/ --test theirs/ --json result.json
      hri evaluate speech --data spoken/ --noise white --snr 10 --train-noise
      hri evaluate gesture --data signed/ --exposure 0.5
    """
    if (data is None) == (train_dir is None) or (train_dir is None) != (test_dir is None):
        raise click.UsageError("give either --data DIR, or --train DIR and --test DIR")
    if (noise is None) != (snr is None):
        raise click.UsageError("--noise and --snr go together")
    if mode == "gesture" and noise is not None:
        raise click.UsageError("--noise is for speech; pictures have --exposure")
    if mode == "speech" and exposure is not None:
        raise click.UsageError("--exposure is for gestures; speech has --noise")
    if data is None and (folds is not None or train_persons is not None):
        raise click.UsageError("--folds and --train-persons need --data")
    make = recognizer_factory(mode, options)
    conditions: dict[str, Any] = {
        "seed": seed,
        "noise": noise,
        "snr_db": snr,
        "train_noise": train_noise,
        "exposure": exposure,
    }
    with progress_bars() as progress:
        conditions["progress"] = progress
        if data is not None:
            dataset = Dataset.load(data, mode, pattern)
            result = cross_validate(dataset, make, num_folds=folds, train_persons=train_persons, **conditions)
        else:
            assert train_dir is not None and test_dir is not None
            parts = [Dataset.load(folder, mode, pattern) for folder in (train_dir, test_dir)]
            result = evaluate_split(parts[0], parts[1], make, **conditions)
    for line in _table(result):
        say(line, json_path)
    if confusion is not None:
        result.plot_confusion(confusion)
        click.echo(f"confusion matrix: {confusion}", err=True)
    write_json(json_path, {"mode": mode, **result.to_dict(), "options": make().get_params()})


def _table(result: EvaluationResult) -> list[str]:
    """Tab-separated: a line a fold, then mean and spread."""
    lines = ["held out\trecordings\taccuracy\trejected"]
    lines += [
        f"{fold.name}\t{len(fold.trials)}\t{100 * fold.accuracy:.1f} %\t{100 * fold.rejected:.1f} %"
        for fold in result.folds
    ]
    lines.append(f"all\t{len(result.trials)}\t{100 * result.mean:.1f} % ± {100 * result.std:.1f}")
    if "stratified" in str(result.conditions.get("folds", "")):
        lines.append(f"note\t{result.conditions['folds']}")
    return lines
