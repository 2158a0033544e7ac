# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri export``."""

from __future__ import annotations

import re
from pathlib import Path

import click

from hri.cli.groups import CheckedCommand
from hri.cli.messages import note
from hri.cli.output import OutputFile, write_text
from hri.io import ModelFile, model_as_cpp, model_as_json

_SUFFIXES = (".hpp", ".h", ".json")
_CPP_WORDS = frozenset(
    (  # noqa: SIM905
        "alignas alignof and and_eq asm auto bitand bitor bool break case catch char char16_t char32_t class "
        "compl const const_cast constexpr continue decltype default delete do double dynamic_cast else enum "
        "explicit export extern false float for friend goto if inline int long mutable namespace new noexcept "
        "not not_eq nullptr operator or or_eq private protected public register reinterpret_cast return short "
        "signed sizeof static static_assert static_cast struct switch template this thread_local throw true "
        "try typedef typeid typename union unsigned using virtual void volatile wchar_t while xor xor_eq"
    ).split()
)


@click.command(cls=CheckedCommand)
@click.argument("model", type=click.Path(exists=True, dir_okay=False))
@click.option("--out", "-o", required=True, type=OutputFile(_SUFFIXES), metavar="FILE", help="FILE.hpp or FILE.json.")
@click.option("--name", metavar="NAME", help="Of the C++ function that gives the bytes; the default is made of FILE's.")
def export(model: str, out: str, name: str | None) -> None:
    """Write a model as a C++ header, to be compiled into a program, or as JSON, for programs of other kinds.

    \b
    Examples:
      hri export words.hri -o words_model.hpp
      hri export words.hri -o words.json
    """
    file = ModelFile.read(model)
    target = Path(out)
    if target.suffix.lower() == ".json":
        if name is not None:
            raise click.UsageError("--name is for C++: FILE must end in .hpp or .h")
        write_text(target, model_as_json(file))
        return
    function = _function_of(target) if name is None else name
    if function in _CPP_WORDS:
        raise click.UsageError(f"--name {name}: it is a word of C++")
    write_text(target, model_as_cpp(file, function))
    note(f'load it with hri::ModelFile::parse({function}(), "{function}")')


def _function_of(target: Path) -> str:
    """What the name of a file gives: a name for C++ that is none of its words."""
    name = re.sub(r"[^A-Za-z0-9_]", "_", target.stem)
    if not name[:1].isalpha():
        name = f"model_{name.strip('_')}".rstrip("_")
    return f"{name}_model" if name in _CPP_WORDS else name
