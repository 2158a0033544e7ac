# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Groups that say what was meant by a command they do not have, and commands that never write over what they read."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import click
from click.core import ParameterSource

from hri.cli.output import OutputFile
from hri.core.suggest import did_you_mean
from hri.media import kind_of_file


class FiniteRange(click.FloatRange):
    """A range of numbers; NaN, which is neither below nor above anything, and infinity lie in none."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        number = super().convert(value, param, ctx)
        if not math.isfinite(number):
            self.fail(f"{value} is not a finite number", param, ctx)
        return number


_OF_ONE_MODE = {"--model": ("--speech-model", "--gesture-model"), "--device": ("--microphone", "--camera")}
"""What commands of one mode call that for which those of both modes have two names."""
_MEANT = _OF_ONE_MODE | {long: (short,) for short, both in _OF_ONE_MODE.items() for long in both}


class CheckedCommand(click.Command):
    """A command whose outputs are none of its inputs, no recording of a folder that it reads, and not one another.

    Its error for an option of commands of one mode, or of both, names its own for that.
    """

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        try:
            return super().parse_args(ctx, args)
        except click.NoSuchOption as error:
            own = {name for param in self.params for name in param.opts}
            meant = [name for name in _MEANT.get(error.option_name, ()) if name in own]
            if not meant:
                raise
            message = f"No such option '{error.option_name}'. Did you mean {' or '.join(meant)}?"
            raise click.UsageError(message, error.ctx) from error

    def invoke(self, ctx: click.Context) -> Any:
        self._require_outputs_apart(ctx)
        return super().invoke(ctx)

    def files_named_by(self, param: click.Parameter, value: str) -> Iterator[str]:
        """Other files that a value of this parameter means to be read, as those in a list; none in most commands."""
        yield from ()

    def _require_outputs_apart(self, ctx: click.Context) -> None:
        outputs = _outputs(ctx)
        there = {place: name for place, name in outputs.items() if _exists(place)}
        if not there:  # what is new is nothing that is read: lists of many files need not be looked into
            return
        for param in ctx.command.params:
            if isinstance(param.type, OutputFile):
                continue
            for value in _texts(ctx.params.get(param.name or "")):
                for file in (value, *self.files_named_by(param, value)):
                    for place, name in there.items():
                        _require_apart(file, place, name, param, ctx)


def _outputs(ctx: click.Context) -> dict[str, str]:
    """Real paths of the files to write, with the names of their options; no two are the same."""
    outputs: dict[str, str] = {}  # real path to the name of the option
    for param in ctx.command.params:
        if not isinstance(param.type, OutputFile):
            continue
        for value in _texts(ctx.params.get(param.name or "")):
            name, place = param.get_error_hint(ctx), os.path.realpath(value)
            if value == "-" and param.type.allow_dash:
                continue
            if place in outputs:
                raise click.UsageError(f"{outputs[place]} and {name} are both {value}", ctx)
            outputs[place] = name
    return outputs


def _exists(path: str) -> bool:
    try:
        return bool(path) and Path(path).exists()
    except OSError:  # text that is too long for a name is none
        return False


def _require_apart(value: str, place: str, name: str, param: click.Parameter, ctx: click.Context) -> None:
    """The output `place` of the option `name`, which exists, is not what `param` reads."""
    there = Path(value)
    if not _exists(value):
        return
    writer = next(one for one in ctx.command.params if one.get_error_hint(ctx) == name)
    assert isinstance(writer.type, OutputFile)
    if there.is_dir():
        inside = Path(os.path.realpath(value)) in Path(place).parents
        if inside and kind_of_file(Path(place)) in ("a sound file", "a picture", "a video"):
            raise click.UsageError(f"{name}: {place} is a recording in {value}, which is read", ctx)
    elif there.samefile(place) and param.name not in writer.type.replaces:
        raise click.UsageError(f"{name}: {value} is read, and would be written over", ctx)


def _texts(value: Any) -> Iterator[str]:
    if isinstance(value, str | Path):
        yield str(value)
    elif isinstance(value, tuple):
        for one in value:
            yield from _texts(one)


def is_given(*names: str) -> bool:
    """Whether one of these parameters of the present command was given, and is not its default."""
    context = click.get_current_context()
    return any(context.get_parameter_source(name) is ParameterSource.COMMANDLINE for name in names)


def refuse_given(names: tuple[str, ...], why: str) -> None:
    """Refuse the first of these parameters that was given: it would have no effect.

    Raises
    ------
    click.UsageError
        It begins with the name of the option.
    """
    for param in click.get_current_context().command.params:
        if param.name in names and is_given(param.name):
            raise click.UsageError(f"{param.opts[0]} {why}")


class SuggestingGroup(click.Group):
    """A group whose error for an unknown command names those spelt alike."""

    command_class = CheckedCommand

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        name = args[0]
        if self.get_command(ctx, name) is None and not name.startswith("-") and not ctx.resilient_parsing:
            raise click.UsageError(f"no command {name!r}; {did_you_mean(name, self.list_commands(ctx))}", ctx)
        return super().resolve_command(ctx, args)
