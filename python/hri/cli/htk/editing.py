# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri htk hed``."""

from __future__ import annotations

from pathlib import Path

import click

from hri.cli.groups import CheckedCommand
from hri.cli.htk.embedded import models_of
from hri.cli.htk.options import INPUT, models_option, trace_option
from hri.core.files import make_folder
from hri.htk import EditScript, read_list


@click.command(cls=CheckedCommand)
@models_option
@trace_option
@click.option("-d", "model_folder", metavar="DIR", help="Folder of models that no -H defines, a file for each.")
@click.option("-M", "folder", metavar="DIR", help="Where the models go; over those that were read else.")
@click.option("-w", "master", metavar="MMF", help="One file for all models; needed where several were read.")
@click.argument("script", type=INPUT)
@click.argument("model_list", type=INPUT)
def hed(
    macros: tuple[str, ...],
    trace: int,
    model_folder: str | None,
    folder: str | None,
    master: str | None,
    script: str,
    model_list: str,
) -> None:
    """Split mixtures, tie parameters and change transitions, as HHEd: commands MU, TI, AT and RT.

    \b
    Example:
      hri htk hed -H hmm3/models -M hmm4 split.hed list
    """
    commands = EditScript.read(script)
    sources = models_of(read_list(model_list), macros, model_folder)
    if master is None and len(sources.paths) > 1:
        raise click.UsageError("models of several files go to one: name it with -w")
    made = commands.apply(sources.models)
    name = Path(master or sources.paths[0])
    target = name if folder is None else Path(folder, name.name)
    make_folder(target.parent)
    made.write(target)
    if trace:
        click.echo(f"{script}: {commands.num_commands} commands -> {target}")
