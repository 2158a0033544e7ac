# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""HTK's standard options, options of several numbers, and those that are refused by name."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import Any, TypeVar

import click

from hri import __version__
from hri.cli.groups import CheckedCommand
from hri.htk import read_script

F = TypeVar("F", bound=Callable[..., Any])
INPUT = click.Path(exists=True, dir_okay=False)
_ARGUMENTS = "hri.htk.arguments"
_DISPLAY = "hri.htk.display"
_FORMAT = "hri.htk.format"
_PART = re.compile(r"\[\d+,\d+\]$")


class NumbersOption(click.Option):
    """An option that takes one value, and numbers behind it: HTK's ``-t f [i l]``.

    Parameters
    ----------
    *args, **kwargs
        As of `click.Option`, whose value becomes one text with blanks between the parts.
    most : int
        Parts at most; those behind the first are taken while they are numbers.
    """

    def __init__(self, *args: Any, most: int, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.most = most


class HtkCommand(CheckedCommand):
    """A tool of HTK: ``-h`` is no help, options may take several numbers, ``-A`` shows the arguments.

    What a script of ``-S`` names is read as what stands on the command line is, and never written over either.
    """

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        kwargs["context_settings"] = {"help_option_names": ["--help"], **kwargs.get("context_settings", {})}
        super().__init__(*args, **kwargs)

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        ctx.meta[_ARGUMENTS] = list(args)
        most = {name: p.most for p in self.params if isinstance(p, NumbersOption) for name in p.opts}
        given, at = list(args), 0
        while at < len(given):
            end = at + 2
            while end < len(given) and end - at - 1 < most.get(given[at], 0) and is_number(given[end]):
                end += 1
            if given[at] in most and end > at + 2:
                given[at + 1 : end] = [" ".join(given[at + 1 : end])]
            at += 1
        return super().parse_args(ctx, given)

    def files_named_by(self, param: click.Parameter, value: str) -> Iterator[str]:
        """Of a script, its arguments; of every argument `name=path[first,last]` also the path alone."""
        arguments = read_script(value) if param.name == "scripts" else []
        yield from arguments
        for argument in (value, *arguments):
            yield _PART.sub("", argument).rpartition("=")[2]


def is_number(text: str) -> bool:
    """Whether `text` is a number as HTK's tools take it."""
    try:
        float(text)
    except ValueError:
        return False
    return True


def _show_arguments(ctx: click.Context, param: click.Parameter, value: bool) -> None:
    if value:
        click.echo(" ".join([ctx.command_path, *ctx.meta[_ARGUMENTS]]))


def _show_version(ctx: click.Context, param: click.Parameter, value: bool) -> None:
    if value:
        click.echo(f"{ctx.command_path} {__version__}")


def _ask_for_settings(ctx: click.Context, param: click.Parameter, value: bool) -> None:
    ctx.meta[_DISPLAY] = value


def settings_are_shown() -> bool:
    """Whether ``-D`` was given."""
    return bool(click.get_current_context().meta.get(_DISPLAY))


def given_format() -> str | None:
    """What ``-F`` says, if it was given."""
    return click.get_current_context().meta.get(_FORMAT)


_BY_LETTER: dict[str, Callable[[F], F]] = {
    "A": click.option(
        "-A", is_flag=True, expose_value=False, is_eager=True, callback=_show_arguments, help="Print the arguments."
    ),
    "C": click.option(
        "-C", "configs", multiple=True, type=INPUT, metavar="CONFIG", help="A configuration file; the last one wins."
    ),
    "D": click.option(
        "-D", is_flag=True, expose_value=False, callback=_ask_for_settings, help="Print what configuration files set."
    ),
    "S": click.option("-S", "scripts", multiple=True, type=INPUT, metavar="SCRIPT", help="A file of arguments."),
    "T": click.option("-T", "trace", type=click.IntRange(0), default=0, metavar="N", help="Above 0: say what is done."),
    "V": click.option(
        "-V", is_flag=True, expose_value=False, is_eager=True, callback=_show_version, help="Print the version."
    ),
}


def standard_options(letters: str) -> Callable[[F], F]:
    """HTK's standard options with these letters: A C D S T V."""

    def add(command: F) -> F:
        for letter in reversed(letters):
            command = _BY_LETTER[letter](command)
        return command

    return add


def refused(flag: str, why: str, values: int = 0) -> Callable[[F], F]:
    """An option of HTK's that is refused by name, with the reason.

    Parameters
    ----------
    flag : str
    why : str
    values : int
        That it takes.
    """

    def refuse(ctx: click.Context, param: click.Parameter, value: Any) -> None:
        if value:
            raise click.UsageError(f"{flag} is not supported: {why}", ctx)

    given: dict[str, Any] = {"is_flag": True} if values == 0 else {"nargs": values, "metavar": " ".join(["X"] * values)}
    return click.option(flag, expose_value=False, callback=refuse, help=f"Refused: {why}.", **given)


def refused_options(**reasons: tuple[str, int]) -> Callable[[F], F]:
    """`refused` for several letters: the reason, and how many values each takes."""

    def add(command: F) -> F:
        for letter, (why, values) in reversed(reasons.items()):
            command = refused(f"-{letter}", why, values)(command)
        return command

    return add


def only_format(flag: str, of: str) -> Callable[[F], F]:
    """An option that names a format, of which there is HTK's alone."""

    def check(ctx: click.Context, param: click.Parameter, value: str | None) -> None:
        if value is not None and value.upper() != "HTK":
            raise click.UsageError(f"{flag} {value} is not supported: {of} are in HTK's format", ctx)

    return click.option(flag, expose_value=False, callback=check, metavar="FMT", help=f"HTK: format of {of}.")


def _set_format(ctx: click.Context, param: click.Parameter, value: str | None) -> None:
    ctx.meta[_FORMAT] = value


source_format_option = click.option(
    "-F", expose_value=False, callback=_set_format, metavar="FMT", help="Format of recordings: HTK or WAV."
)
label_format_option = only_format("-G", "label files")
BINARY = {"B": ("definitions and networks are written as text", 0)}
ADAPTATION = {
    "E": ("there are no transforms of models", 1),
    "J": ("there are no transforms of models", 1),
    "K": ("there are no transforms of models", 1),
}
