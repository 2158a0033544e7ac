# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri htk init`` and ``hri htk rest``."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

import click
import numpy as np
from numpy.typing import NDArray

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

_label = click.option("-l", "label", metavar="NAME", help="Train on segments with this label, not on whole files.")
_folder = click.option("-M", "folder", default=".", show_default=True, metavar="DIR", help="Where the model goes.")
_iterations = click.option("-i", "iterations", type=click.IntRange(1), default=20, help="Iterations at most.")
_floor = click.option(
    "-v",
    "floor",
    type=click.FloatRange(0, min_open=True),
    default=0.01,
    help="Least variance, as a share of the global one.",
)


@click.command()
@config_option
@labels_option
@label_folder_option
@label_suffix_option
@script_option
@trace_option
@_label
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
    sequences = _segments(all_arguments(files, scripts), source.kind, configs, references, label)
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


@click.command()
@config_option
@labels_option
@label_folder_option
@label_suffix_option
@script_option
@trace_option
@_label
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
    sequences = _segments(all_arguments(files, scripts), source.kind, configs, references, label)
    made = ModelSet(source.kind)
    retrain_model(made, source, model, sequences, max_iterations=iterations, variance_floor=floor)
    _write(made, model, folder, len(sequences), trace)


def _only_model(path: str) -> tuple[ModelSet, str]:
    source = load_models([path])
    if len(source.hmm_names) != 1:
        raise FormatError(f"{path}: defines {len(source.hmm_names)} models, not one")
    return source, source.hmm_names[0]


def _segments(
    names: Sequence[str], kind: str, configs: Iterable[str], references: References, label: str | None
) -> list[NDArray[np.float32]]:
    """Whole files, or the parts of them that have the label."""
    configuration = load_configuration(configs)
    found = []
    for name in names:
        frames, period = load_observations(name, kind, configuration)
        if label is None:
            found.append(frames)
            continue
        for one in references.find(name).labels:
            if one.name != label:
                continue
            if one.first is None or one.last is None:
                raise FormatError(f"{name}: its label {label!r} has no times")
            segment = frames[round(one.first / period) : round(one.last / period)]
            if len(segment):
                found.append(segment)
    if not found:
        raise click.UsageError("there is nothing to train on")
    return found


def _write(models: ModelSet, name: str, folder: str, count: int, trace: int) -> None:
    target = Path(make_folder(folder), name)
    models.write(target)
    if trace:
        click.echo(f"{name}: {count} recordings -> {target}")
