# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri htk init`` and ``hri htk rest``: one model from recordings of its unit."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any, TypeVar

import click
import numpy as np
from numpy.typing import NDArray

from hri.cli.groups import FiniteRange
from hri.cli.htk.data import DataFile, check_headers, data_files, load_frames
from hri.cli.htk.options import (
    ModelFiles,
    References,
    folder_option,
    load_configuration,
    models_option,
    name_option,
    recording_options,
    stacked,
)
from hri.cli.htk.standard import BINARY, HtkCommand, refused_options
from hri.cli.messages import note
from hri.core.display import count
from hri.core.errors import FormatError, InvalidArgument
from hri.htk import (
    Configuration,
    EmbeddedTrainerOptions,
    ModelSet,
    ViterbiTrainerOptions,
    retrain_by_baum_welch,
    train_by_viterbi,
)
from hri.htk.training import min_frames_of

F = TypeVar("F", bound=Callable[..., Any])
NOTHING = "there is nothing to train on"
FLAGS = {"t": "update_transitions", "m": "update_means", "v": "update_variances", "w": "update_weights"}
label_option = click.option(
    "-l", "label", metavar="NAME", help="Train on segments with this label, not on whole files."
)


def _updates(ctx: click.Context, param: click.Parameter, value: str) -> dict[str, bool]:
    if set(value) - set(FLAGS):
        raise click.BadParameter(f"takes letters of {''.join(FLAGS)}")
    return {field: flag in value for flag, field in FLAGS.items()}


updates_option = click.option(
    "-u", "updates", default="tmvw", callback=_updates, metavar="FLAGS", help="What to estimate: tmvw."
)
weight_floor_option = click.option(
    "-w", "weight_floor", type=FiniteRange(0), default=0.0, help="Least mixture weight, times 1e-5."
)


def _training_options(min_variance: float) -> Callable[[F], F]:
    """Options that HInit and HRest share."""
    return stacked(
        recording_options,
        models_option,
        label_option,
        folder_option,
        updates_option,
        weight_floor_option,
        click.option(
            "-e",
            "tolerance",
            type=FiniteRange(0),
            default=1e-4,
            show_default=True,
            help="Stop when the log probability grows by less.",
        ),
        click.option(
            "-i", "iterations", type=click.IntRange(1, 100000), default=20, show_default=True, help="Passes at most."
        ),
        click.option(
            "-m",
            "min_examples",
            type=click.IntRange(1),
            default=3,
            show_default=True,
            help="Refuse to train on fewer recordings.",
        ),
        click.option(
            "-v",
            "min_variance",
            type=FiniteRange(0),
            default=min_variance,
            show_default=True,
            help="Least variance; varFloor1 of a -H holds beside it.",
        ),
        name_option,
        refused_options(**BINARY),
    )


@click.command(cls=HtkCommand)
@_training_options(0.01)
@click.option("-n", "is_begun", is_flag=True, help="The model is begun: no equal parts at first.")
@click.argument("prototype")
@click.argument("files", nargs=-1)
def init(updates: dict[str, bool], is_begun: bool, **given: Any) -> None:
    """Train one model from equal parts of recordings, then along best paths, as HInit.

    PROTOTYPE is its file, or its name in a file of -H: topology, number of Gaussians, macros and floors stay.

    \b
    Example:
      hri htk init -H hmm0/vFloors -M hmm1 -o seven proto seven_0.mfc seven_1.mfc seven_2.mfc
    """

    def train(models: ModelSet, model: str, sequences: list[NDArray[np.float32]]) -> tuple[ModelSet, list[float]]:
        options = ViterbiTrainerOptions(
            max_iterations=given["iterations"],
            tolerance=given["tolerance"],
            min_variance=given["min_variance"],
            weight_floor=given["weight_floor"],
            uniform_start=not is_begun,
            **updates,
        )
        made = train_by_viterbi(models, model, sequences, options)
        return made.models, made.log_probabilities

    _train(train, **given)


@click.command(cls=HtkCommand)
@_training_options(0.0)
@click.option("-c", "pruning", type=FiniteRange(0), help="Not needed: all Gaussians are summed.")
@click.option("-t", "short_ones", is_flag=True, help="As ever: what is too short for any path alone is left out.")
@click.argument("prototype", metavar="DEFINITION")
@click.argument("files", nargs=-1)
def rest(updates: dict[str, bool], pruning: float | None, short_ones: bool, **given: Any) -> None:
    """Train one model further by Baum-Welch, as HRest; DEFINITION is its file, or its name in a file of -H.

    \b
    Example:
      hri htk rest -M hmm1 hmm0/seven seven_0.mfc seven_1.mfc seven_2.mfc
    """

    def train(models: ModelSet, model: str, sequences: list[NDArray[np.float32]]) -> tuple[ModelSet, list[float]]:
        options = EmbeddedTrainerOptions(
            min_examples=0, min_variance=given["min_variance"], weight_floor=given["weight_floor"], **updates
        )
        return retrain_by_baum_welch(models, model, sequences, options, given["iterations"], given["tolerance"])

    _train(train, **given)


def _train(
    train: Callable[[ModelSet, str, list[NDArray[np.float32]]], tuple[ModelSet, list[float]]],
    configs: tuple[str, ...],
    macros: tuple[str, ...],
    masters: tuple[str, ...],
    label_folder: str | None,
    suffix: str,
    scripts: tuple[str, ...],
    trace: int,
    label: str | None,
    folder: str | None,
    min_examples: int,
    name: str | None,
    prototype: str,
    files: tuple[str, ...],
    **_: Any,
) -> None:
    """Read a prototype and recordings, train, and write what came of it."""
    configuration = load_configuration(configs)
    sources = ModelFiles(macros)
    model, path = sources.add_prototype(prototype)
    recordings = data_files(files, scripts, NOTHING)
    references = References(masters, label_folder, suffix)
    period = check_headers(recordings, sources.models, configuration)
    sequences = []
    try:
        least = min_frames_of(sources.models, model)
        for where, frames in segments(recordings, sources.models, configuration, references, label, period):
            if len(frames) < max(least, 1):
                note(f"{where}: {count(len(frames), 'frame')}, fewer than the {least} that {model} takes; left out")
            else:
                sequences.append(frames)
        if len(sequences) < min_examples:
            raise FormatError(
                f"{prototype}: {count(len(sequences), 'recording')} to train on, fewer than {min_examples} (-m)"
            )
        made, scores = train(sources.models, model, sequences)
        made.rename_hmm(model, name or model)
    except InvalidArgument as error:
        raise FormatError(f"{prototype}: {error}") from error
    target = sources.write(made, folder, {} if path is None else {path: name or path})[-1]
    if trace:
        frames_in_all = sum(map(len, sequences))
        for number, score in enumerate(scores, 1):
            click.echo(f"pass {number}: {score / frames_in_all:.4f} a frame")
        click.echo(f"{name or model}: {count(len(sequences), 'recording')} -> {target}")


def segments(
    files: Sequence[DataFile],
    models: ModelSet,
    configuration: Configuration,
    references: References,
    label: str | None,
    period: int,
) -> Iterator[tuple[str, NDArray[np.float32]]]:
    """Names and frames of whole files, or of the parts of them that have the label, one file at a time."""
    for file in files:
        if label is None:
            yield file.name, load_frames(file, models, configuration)
            continue
        transcription, source = references.locate(file.name)
        wanted = [one for one in transcription.labels if one.name == label]
        for one in wanted:
            if one.first is None or one.last is None:
                raise FormatError(f"{source}: line {one.line}: the label {label!r} has no times")
        if not wanted:
            continue
        frames = load_frames(file, models, configuration)
        for one in wanted:
            assert one.first is not None and one.last is not None
            segment = frames[round(one.first / period) : round(one.last / period)]
            if len(segment):
                yield f"{source}: line {one.line}", segment.copy()  # the others of the file are not kept with it
