# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri htk hed``."""

from __future__ import annotations

from pathlib import Path

import click

from hri.cli.htk.options import (
    ModelFiles,
    folder_option,
    listed_models_options,
    load_configuration,
    models_option,
    new_suffix_option,
)
from hri.cli.htk.standard import BINARY, INPUT, HtkCommand, refused_options, standard_options
from hri.cli.output import write_text
from hri.core.display import count
from hri.core.files import make_folder
from hri.htk import EditScript, read_list


@click.command(cls=HtkCommand)
@standard_options("ACDTV")
@models_option
@listed_models_options
@folder_option
@new_suffix_option
@click.option("-w", "master", metavar="MMF", help="One file for all models, in place of those that were read.")
@refused_options(
    Q=("CO writes lists of models", 1),
    r=("there are no regression classes", 1),
    z=("CO writes lists of models", 0),
    **BINARY,
)
@click.argument("script", type=INPUT)
@click.argument("model_list", type=INPUT)
def hed(
    configs: tuple[str, ...],
    macros: tuple[str, ...],
    trace: int,
    model_folder: str | None,
    model_suffix: str | None,
    folder: str | None,
    new_suffix: str | None,
    master: str | None,
    script: str,
    model_list: str,
) -> None:
    """Split mixtures, tie parameters, cluster states and change transitions, as HHEd.

    Commands are MU, TI, AT, RT, CL, RO, LS, QS, TB, TC, AU, CO, ST and LT. Every file of models that was read is
    written again, to the folder of -M; new macros come to the first one with a model.

    \b
    Example:
      hri htk hed -H hmm4/macros -H hmm4/hmmdefs -M hmm5 sil.hed list
      hri htk hed -H hmm12/macros -H hmm12/hmmdefs -M hmm13 tree.hed triphones1
    """
    load_configuration(configs)
    commands = EditScript.read(script)
    sources = ModelFiles(macros)
    listed = sources.add_listed(read_list(model_list).values(), model_folder, model_suffix)
    made, files = commands.apply_with_files(sources.models)
    if master is not None:
        target = Path(master) if folder is None else Path(folder, Path(master).name)
        make_folder(target.parent)
        made.write(target)
        targets = [target]
    else:
        renamed = {} if new_suffix is None else {path: str(Path(path).with_suffix(f".{new_suffix}")) for path in listed}
        targets = sources.write(sources.follow(made), folder, renamed)
    for path, text in files:
        make_folder(Path(path).parent)
        write_text(Path(path), text)
    if trace:
        click.echo(f"{script}: {count(commands.num_commands, 'command')} -> {' '.join(map(str, targets))}")
