# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri htk compv``: models at the mean and variance of all frames."""

from __future__ import annotations

from pathlib import Path

import click

from hri.cli.groups import FiniteRange
from hri.cli.htk.data import check_headers, data_files
from hri.cli.htk.options import (
    ModelFiles,
    References,
    folder_option,
    load_configuration,
    models_option,
    name_option,
    recording_options,
)
from hri.cli.htk.standard import BINARY, HtkCommand, refused_options
from hri.cli.htk.training import NOTHING, label_option, segments
from hri.core.display import count
from hri.core.errors import FormatError, InvalidArgument
from hri.core.files import make_folder
from hri.htk import FlatStart

_OF_SPEAKERS = "means and variances of speakers (CMEANDIR) are not computed"


@click.command(cls=HtkCommand)
@recording_options
@models_option
@label_option
@folder_option
@click.option("-m", "means", is_flag=True, help="Set the means, too.")
@click.option("-f", "share", type=FiniteRange(0, min_open=True), help="Write vFloors: this share of the variance.")
@click.option("-v", "min_variance", type=FiniteRange(0), default=0.0, help="Least variance.")
@name_option
@refused_options(c=(_OF_SPEAKERS, 1), k=(_OF_SPEAKERS, 1), p=(_OF_SPEAKERS, 1), q=(_OF_SPEAKERS, 1), **BINARY)
@click.argument("prototype")
@click.argument("files", nargs=-1)
def compv(
    configs: tuple[str, ...],
    macros: tuple[str, ...],
    masters: tuple[str, ...],
    label_folder: str | None,
    suffix: str,
    scripts: tuple[str, ...],
    trace: int,
    label: str | None,
    folder: str | None,
    means: bool,
    share: float | None,
    min_variance: float,
    name: str | None,
    prototype: str,
    files: tuple[str, ...],
) -> None:
    """Set all Gaussians of a prototype to the variance of all frames, with -m to their mean, as HCompV.

    PROTOTYPE is its file, or its name in a file of -H.

    \b
    Example:
      hri htk compv -m -f 0.01 -M hmm0 -S train.scp proto
    """
    configuration = load_configuration(configs)
    sources = ModelFiles(macros)
    model, path = sources.add_prototype(prototype)
    recordings = data_files(files, scripts, NOTHING)
    references = References(masters, label_folder, suffix)
    period = check_headers(recordings, sources.models, configuration)
    start = FlatStart()
    try:
        for _, frames in segments(recordings, sources.models, configuration, references, label, period):
            start.add(frames)
        if not start.num_frames:
            raise click.UsageError(NOTHING)
        made = start.apply(sources.models, means, min_variance)
        floors = None if share is None else start.variance_floors(share)
        made.rename_hmm(model, name or model)
    except InvalidArgument as error:
        raise FormatError(f"{prototype}: {error}") from error
    target = sources.write(made, folder, {} if path is None else {path: name or path})[-1]
    if floors is not None:
        floors.write(Path(make_folder(folder or "."), "vFloors"))
    if trace:
        click.echo(f"{model}: {count(start.num_frames, 'frame')} -> {target}")
