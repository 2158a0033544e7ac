# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri htk copy`` and ``hri htk list``."""

from __future__ import annotations

from pathlib import Path

import click

from hri.cli.groups import CheckedCommand
from hri.cli.htk.options import all_arguments, config_option, load_configuration, script_option, trace_option
from hri.core.files import make_folder
from hri.htk import ParameterFile, code_file, list_parameters


@click.command(cls=CheckedCommand)
@config_option
@script_option
@trace_option
@click.argument("files", nargs=-1)
def copy(configs: tuple[str, ...], scripts: tuple[str, ...], trace: int, files: tuple[str, ...]) -> None:
    """Convert recordings to parameter files, as HCopy; FILES are pairs of a source and a target.

    \b
    Example:
      hri htk copy -C config -S copy.scp
    """
    configuration = load_configuration(configs)
    names = all_arguments(files, scripts)
    if not names or len(names) % 2:
        raise click.UsageError("files come in pairs of a source and a target")
    for source, target in zip(names[::2], names[1::2], strict=True):
        file = code_file(source, configuration)
        make_folder(Path(target).parent)
        file.write(target)
        if trace:
            click.echo(f"{source} -> {target}")


@click.command("list", cls=CheckedCommand, context_settings={"help_option_names": ["--help"]})
@script_option
@click.option("-h", "header", is_flag=True, help="Also what the header says.")
@click.option("-r", "raw", is_flag=True, help="Values alone, a frame a line.")
@click.option("-z", "no_values", is_flag=True, help="No frames.")
@click.option("-s", "first", type=click.IntRange(0), default=0, metavar="N", help="The first frame.")
@click.option("-e", "last", type=click.IntRange(-1), default=-1, metavar="N", help="The last frame.")
@click.option("-i", "items", type=click.IntRange(1), default=10, metavar="N", help="Values in a line.")
@click.argument("files", nargs=-1)
def list_files(
    scripts: tuple[str, ...],
    header: bool,
    raw: bool,
    no_values: bool,
    first: int,
    last: int,
    items: int,
    files: tuple[str, ...],
) -> None:
    """Print parameter files, as HList.

    \b
    Example:
      hri htk list -h -e 9 seven.mfc
    """
    for name in all_arguments(files, scripts):
        file = ParameterFile.read(name)
        if raw:
            for row in file.values[first : None if last < 0 else last + 1]:
                click.echo(" ".join(f"{value:e}" for value in row))
        else:
            for line in list_parameters(file, name, first, last, header, items, not no_values):
                click.echo(line)
