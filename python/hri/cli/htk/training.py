# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri htk init`` and ``hri htk rest``."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import click
import numpy as np
from numpy.typing import NDArray

from hri.cli.groups import CheckedCommand, FiniteRange
from hri.cli.htk.options import (
    INPUT,
    References,
    all_arguments,
    config_option,
    label_folder_option,
    label_suffix_option,
    labels_option,
    load_configuration,
    load_models,
    script_option,
    trace_option,
)
from hri.core.errors import FormatError
from hri.core.files import make_folder
from hri.htk import ModelSet, load_observations, retrain_model, train_model

NOTHING = "there is nothing to train on"
label_option = click.option(
    "-l", "label", metavar="NAME", help="Train on segments with this label, not on whole files."
)
_folder = click.option("-M", "folder", default=".", show_default=True, metavar="DIR", help="Where the model goes.")
_iterations = click.option("-i", "iterations", type=click.IntRange(1), default=20, help="Iterations at most.")
_floor = click.option(
    "-v",
    "floor",
    type=FiniteRange(0, min_open=True),
    default=0.01,
    help="Least variance, as a share of the global one.",
)


@click.command(cls=CheckedCommand)
@config_option
@labels_option
@label_folder_option
@label_suffix_option
@script_option
@trace_option
@label_option
@_folder
@_iterations
@_floor
@click.option("-o", "name", metavar="NAME", help="Name of the model; that of the prototype else.")
@click.argument("prototype", type=INPUT)
@click.argument("files", nargs=-1)
def init(
    configs: tuple[str, ...],
    masters: tuple[str, ...],
    label_folder: str | None,
    suffix: str,
    scripts: tuple[str, ...],
    trace: int,
    label: str | None,
    folder: str,
    iterations: int,
    floor: float,
    name: str | None,
    prototype: str,
    files: tuple[str, ...],
) -> None:
    """Train one model from uniform segmentation, as HInit; PROTOTYPE says its states and mixtures.

    \b
    Example:
      hri htk init -M hmm0 -o seven proto seven_0.mfc seven_1.mfc
    """
    source, model = _only_model(prototype)
    references = References(masters, label_folder, suffix)
    sequences = _all_segments(all_arguments(files, scripts), source.kind, configs, references, label)
    shape = source.hmm(model)
    made = ModelSet(source.kind)
    num_states = shape.num_states
    train_model(
        made,
        name or model,
        sequences,
        num_states,
        shape.weights.shape[1],
        max_iterations=iterations,
        variance_floor=floor,
    )
    _write(made, name or model, folder, len(sequences), trace)


@click.command(cls=CheckedCommand)
@config_option
@labels_option
@label_folder_option
@label_suffix_option
@script_option
@trace_option
@label_option
@_folder
@_iterations
@_floor
@click.argument("definition", type=INPUT)
@click.argument("files", nargs=-1)
def rest(
    configs: tuple[str, ...],
    masters: tuple[str, ...],
    label_folder: str | None,
    suffix: str,
    scripts: tuple[str, ...],
    trace: int,
    label: str | None,
    folder: str,
    iterations: int,
    floor: float,
    definition: str,
    files: tuple[str, ...],
) -> None:
    """Train one model further by Baum-Welch, as HRest.

    \b
    Example:
      hri htk rest -M hmm1 hmm0/seven seven_0.mfc seven_1.mfc
    """
    source, model = _only_model(definition)
    references = References(masters, label_folder, suffix)
    sequences = _all_segments(all_arguments(files, scripts), source.kind, configs, references, label)
    made = ModelSet(source.kind)
    retrain_model(made, source, model, sequences, max_iterations=iterations, variance_floor=floor)
    _write(made, model, folder, len(sequences), trace)


def _only_model(path: str) -> tuple[ModelSet, str]:
    source = load_models([path])
    if len(source.hmm_names) != 1:
        raise FormatError(f"{path}: defines {len(source.hmm_names)} models, not one")
    return source, source.hmm_names[0]


def segments(
    names: Sequence[str], kind: str, configs: Iterable[str], references: References, label: str | None
) -> Iterator[NDArray[np.float32]]:
    """Frames of whole files, or of the parts of them that have the label, one file at a time."""
    configuration = load_configuration(configs)
    for name in names:
        frames, period = load_observations(name, kind, configuration)
        if label is None:
            yield frames
            continue
        for one in references.find(name).labels:
            if one.name != label:
                continue
            if one.first is None or one.last is None:
                raise FormatError(f"{name}: its label {label!r} has no times")
            segment = frames[round(one.first / period) : round(one.last / period)]
            if len(segment):
                yield segment


def _all_segments(
    names: Sequence[str], kind: str, configs: Iterable[str], references: References, label: str | None
) -> list[NDArray[np.float32]]:
    found = list(segments(names, kind, configs, references, label))
    if not found:
        raise click.UsageError(NOTHING)
    return found


def _write(models: ModelSet, name: str, folder: str, count: int, trace: int) -> None:
    target = Path(make_folder(folder), name)
    models.write(target)
    if trace:
        click.echo(f"{name}: {count} recordings -> {target}")
