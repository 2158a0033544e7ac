# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri evaluate``."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

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
from hri.cli.evaluate_connected import evaluate_connected
from hri.cli.evaluate_sentences import evaluate_sentences
from hri.cli.faces import faces_option, require_faces
from hri.cli.groups import CheckedCommand, FiniteRange, refuse_given
from hri.cli.messages import note
from hri.cli.output import OutputFile, json_option, say_table, write_json
from hri.cli.progress import progress_bars
from hri.cli.recognizers import (
    CLASSES,
    embedding_for,
    embedding_option,
    load_dataset,
    options_option,
    pattern_option,
    recognizer_factory,
)
from hri.core.optional import import_optional
from hri.datasets import Dataset
from hri.evaluation import EvaluationResult, FoldResult, cross_validate, evaluate_split
from hri.recognition import GestureRecognizer, WordRecognizer

CONNECTED, SENTENCES = "connected", "sentences"
_folder = click.Path(exists=True, file_okay=False)


@click.command(cls=CheckedCommand)
@click.argument("mode", type=click.Choice([*CLASSES, CONNECTED, SENTENCES]))
@click.option("--data", type=_folder, help="Folder of recordings, split into folds by person.")
@click.option("--train", "train_dir", type=_folder, help="Train on this folder ...")
@click.option("--test", "test_dir", type=_folder, help="... and test on this one.")
@click.option(
    "--transcripts",
    type=click.Path(exists=True, dir_okay=False),
    metavar="FILE",
    help="Connected words: what was said in recordings beside this file, as MLF or trn.",
)
@pattern_option
@click.option("--folds", type=click.IntRange(2), help="Folds by person; the default holds out one person at a time.")
@click.option("--train-persons", type=click.IntRange(1), help="Train on so many persons only, drawn at random.")
@click.option("--leave-out", metavar="CONDITION", help="Hold out a condition's values, such as background.")
@click.option("--noise", help="Added to the test clips: white, pink, or a recording.")
@click.option("--snr", type=FiniteRange(-30, 60), metavar="DB", help="Signal-to-noise ratio of --noise.")
@click.option("--train-noise", is_flag=True, help="Train on a noisy copy of every clip too.")
@click.option("--exposure", type=FiniteRange(0.05, 20), help="Factor on the brightness of the test pictures.")
@options_option("MODE", "num_states=8")
@front_end_option()
@embedding_option
@network_option()
@source_option()
@hands_option()
@faces_option("never, as of train")
@click.option("--seed", type=click.IntRange(0), default=0, show_default=True, help="Of folds, training and noise.")
@click.option(
    "--confusion",
    type=OutputFile((".png", ".svg", ".pdf")),
    metavar="FILE",
    help="Draw the confusion matrix as .png, .svg or .pdf.",
)
@click.option(
    "--reliability",
    type=OutputFile((".png", ".svg", ".pdf")),
    metavar="FILE",
    help="Draw accuracy by confidence as .png, .svg or .pdf.",
)
@json_option
def evaluate(
    mode: str,
    data: str | None,
    train_dir: str | None,
    test_dir: str | None,
    transcripts: str | None,
    pattern: str | None,
    folds: int | None,
    train_persons: int | None,
    leave_out: str | None,
    noise: str | None,
    snr: float | None,
    train_noise: bool,
    exposure: float | None,
    options: tuple[str, ...],
    front_end: str | None,
    embedding_path: str | None,
    network: bool | None,
    source: str | None,
    hands: str | None,
    faces: str | None,
    seed: int,
    confusion: str | None,
    reliability: str | None,
    json_path: str | None,
) -> None:
    """Measure the accuracy of MODE on persons who are not in the training data.

    What is measured is what 'hri train' makes of the same recordings by those of its options that stand here. Words
    are trained with the filler words of hri, whatever 'hri train' takes by --fillers or --no-fillers, and in noise by
    --train-noise only. That may take hours where many people are held out one by one: --folds 5 and --no-network take a
    fraction of that.

    Of signed sentences, in the files that 'hri train-sentences' reads, word errors are measured, each signer held out
    in turn, or a fifth of the videos where there is one signer; --folds, --option, --seed and --json apply.

    \b
    Examples:
      hri evaluate speech --data spoken/
      hri evaluate speech --data spoken/ --front-end cepstra --no-network --folds 5
      hri evaluate gesture --data signed/ --folds 5 --confusion confusion.png --reliability reliability.png
      hri evaluate speech --train ours/ --test theirs/ --json result.json
      hri evaluate speech --data spoken/ --noise white --snr 10 --train-noise
      hri evaluate gesture --data signed/ --exposure 0.5
      hri evaluate gesture --data skig/ --leave-out illumination
      hri evaluate connected --data spoken/ --transcripts numbers/said.mlf
      hri evaluate sentences --data signed/ --json errors.json
    """
    if mode == CONNECTED:
        _refuse_all_but("data", "transcripts", "pattern", "front_end", "embedding_path", "options", "seed", "json_path")
        if front_end == "embedding":
            raise click.UsageError("--front-end embedding is for single words: it does not say where words lie")
        if data is None or transcripts is None:
            raise click.UsageError("connected takes --data DIR, of one word each, and --transcripts FILE")
        evaluate_connected(data, transcripts, pattern, options, front_end, embedding_path, seed, json_path)
        return
    refuse_given(("transcripts",), "is for connected")
    if mode == SENTENCES:
        _refuse_all_but("data", "folds", "options", "seed", "json_path")
        evaluate_sentences(data, folds, options, seed, json_path)
        return
    if (data is None) == (train_dir is None) or (train_dir is None) != (test_dir is None):
        raise click.UsageError("give either --data DIR, or --train DIR and --test DIR")
    if (noise is None) != (snr is None):
        raise click.UsageError("--noise and --snr go together")
    if train_noise and noise is None:
        raise click.UsageError("--train-noise needs --noise and --snr")
    if mode == "gesture" and noise is not None:
        raise click.UsageError("--noise is for speech; pictures have --exposure")
    if mode == "speech" and exposure is not None:
        raise click.UsageError("--exposure is for gestures; speech has --noise")
    if noise is not None:
        refuse_wrong_noises([noise], ("first", "second") if train_noise else ("all",))
    if data is None and (folds is not None or train_persons is not None or leave_out is not None):
        raise click.UsageError("--folds, --train-persons and --leave-out need --data")
    if leave_out is not None and (folds is not None or train_persons is not None):
        raise click.UsageError("--leave-out goes without --folds and --train-persons")
    if confusion is not None or reliability is not None:
        import_optional("matplotlib", "plots", "to draw the confusion matrix or the reliability diagram")
    options = asked_options(
        mode,
        options,
        front_end=front_end,
        embedding_path=embedding_path,
        network=network,
        source=source,
        hands=hands,
        faces=faces,
    )
    require_faces(faces)
    folder = data or train_dir
    assert folder is not None
    dataset = load_dataset(folder, mode, pattern)
    options, why_source = chosen_options(options, dataset, train_persons)
    untrained = recognizer_factory(mode, options, seed)

    def make() -> WordRecognizer | GestureRecognizer:
        recognizer = untrained()
        if isinstance(recognizer, GestureRecognizer):
            recognizer.faces = faces
        return recognizer

    conditions: dict[str, Any] = {
        "seed": seed,
        "noise": noise,
        "snr_db": snr,
        "train_noise": train_noise,
        "exposure": exposure,
        "embedding": embedding_for(make(), embedding_path),
    }
    test: Dataset | None = None
    with progress_bars() as progress:
        conditions["progress"] = progress
        if test_dir is None:
            result = cross_validate(
                dataset, make, num_folds=folds, train_persons=train_persons, leave_out=leave_out, **conditions
            )
        else:
            test = load_dataset(test_dir, mode, pattern)
            result = evaluate_split(dataset, test, make, **conditions)
    say_table(_table(result), json_path)
    if "stratified" in str(result.conditions.get("folds", "")):
        note(f"WARNING: folds are {result.conditions['folds']}")
    if test is not None:
        _warn_of_shared_persons(dataset, test)
    measured = make()
    lines = what_words_are_of(measured.options) if isinstance(measured, WordRecognizer) else [why_source]
    for line in filter(None, lines):
        note(line)
    if confusion is not None:
        Path(confusion).parent.mkdir(parents=True, exist_ok=True)
        result.plot_confusion(confusion)
        note(f"confusion matrix: {confusion}")
    has_input = result.calibration_error is not None
    if reliability is not None and has_input:
        Path(reliability).parent.mkdir(parents=True, exist_ok=True)
        result.reliability().plot(reliability)
        note(f"reliability diagram: {reliability}")
    elif reliability is not None:
        note("no reliability diagram: no recording has a word or a sign in it")
    found = {**result.to_dict(), "reliability": result.reliability().to_dict() if has_input else None}
    write_json(json_path, {"mode": mode, **found, "options": measured.options.as_dict()})


def _refuse_all_but(*names: str) -> None:
    """Refuse options that are for words and gestures one by one."""
    params = click.get_current_context().params
    refuse_given(tuple(name for name in params if name not in (*names, "mode")), "is for speech and gesture")


def _warn_of_shared_persons(train: Dataset, test: Dataset) -> None:
    shared = [person for person in test.persons if person in train.persons]
    if shared:
        named = " ".join(shared)
        note(f"WARNING: in both folders: {named}; if they are the same persons, the test is not speaker-independent")


def _table(result: EvaluationResult) -> list[tuple[str, ...]]:
    """A row a fold, then mean and spread of the accuracy, and the other figures of all recordings."""
    header = ("held out", "recordings", "accuracy", "rejected", "recognised and right", "calibration error")
    rows: list[tuple[str, ...]] = [header]
    for fold in result.folds:
        accuracy = f"{100 * fold.accuracy:.1f} %"
        rows.append((fold.name, *_cells(len(fold.items), accuracy, fold.rejected, fold)))
    rejected = sum(fold.rejected * len(fold.items) for fold in result.folds) / len(result.items)
    accuracy = f"{100 * result.mean:.1f} %" + (f" ± {100 * result.std:.1f}" if len(result.folds) > 1 else "")
    return [*rows, ("all", *_cells(len(result.items), accuracy, rejected, result))]


def _cells(number: int, accuracy: str, rejected: float, part: FoldResult | EvaluationResult) -> tuple[str, ...]:
    error = part.calibration_error
    shares = (f"{100 * rejected:.1f} %", f"{100 * part.recognised_right:.1f} %")
    return str(number), accuracy, *shares, "" if error is None else f"{100 * error:.1f} %"
