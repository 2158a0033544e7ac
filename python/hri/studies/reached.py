# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Which files of the package a study can reach: what its module imports, what that imports, and the data they read.

Imports are read from the sources, those inside functions among them. What a package imports only to pass it on is
followed by name, so that ``from hri.features import CepstraComputer`` reaches the module that has it and not all of
`hri.features`. A file of data is reached where a module of its folder names it.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from hri.core.files import read_text

_DATA_NAME = re.compile(r"[\w.-]+\.(?:npz|onnx|toml)")
OUTSIDE = ("hri.cli", "hri.serve", "hri.page", "hri.studies.registry")
"""What shows, starts or describes studies, and decides nothing that they measure."""

Import = tuple[str, str]
"""A module, and the name that is imported from it; "" for the module itself."""


@dataclass(frozen=True)
class _Source:
    """What a file imports when it runs, by which name it has what it imports, and the files of data that it names."""

    imports: tuple[Import, ...]
    names: dict[str, Import]
    data: frozenset[str]


def reached_files(root: Path, modules: Iterable[str]) -> set[Path]:
    """The files of ``python/hri`` below `root` that `modules` (dotted names) reach, themselves included."""
    return _follow(root / "python", [(module, "") for module in modules])


def reached_from(root: Path, path: Path) -> set[Path]:
    """Those that a program outside the package reaches, such as a bench."""
    return _follow(root / "python", list(_read(path).imports))


def _follow(top: Path, waiting: list[Import]) -> set[Path]:
    found: set[Path] = set()
    met = set(waiting)
    while waiting:
        home, following = _home(top, *waiting.pop())
        if home is not None and home not in found:
            source = _read(home)
            found.add(home)
            found |= {path for name in source.data if (path := home.parent / name).is_file()}
            following = source.imports
        waiting += [one for one in following if one not in met]
        met |= set(following)
    return found


def _home(top: Path, module: str, name: str) -> tuple[Path | None, tuple[Import, ...]]:
    """The file that has what is imported; of what a package passes on, where it has it from instead."""
    if not f"{module}.".startswith("hri.") or _is_outside(module):
        return None, ()
    if name and (inner := _path(top, f"{module}.{name}")) is not None:
        return (None if _is_outside(f"{module}.{name}") else inner), ()
    if name and top.joinpath(*module.split("."), f"{name}.pyi").is_file():  # compiled: its sources are rooms of C++
        return None, ()
    path = _path(top, module)
    if path is not None and path.name == "__init__.py" and name in (names := _read(path).names):
        return None, (names[name],)
    return path, ()


def _is_outside(module: str) -> bool:
    return any(f"{module}.".startswith(f"{outside}.") for outside in OUTSIDE)


def _path(top: Path, module: str) -> Path | None:
    place = top.joinpath(*module.split("."))
    for path in (place.with_suffix(".py"), place / "__init__.py"):
        if path.is_file():
            return path
    return None


def _read(path: Path) -> _Source:
    return _parsed(path, path.stat().st_mtime_ns)


@cache  # studies share most of what they reach
def _parsed(path: Path, changed_ns: int) -> _Source:
    tree = ast.parse(read_text(path))
    texts = {node.value for node in ast.walk(tree) if isinstance(node, ast.Constant) and isinstance(node.value, str)}
    data = frozenset(text for text in texts if _DATA_NAME.fullmatch(text))
    running = tuple(one for one, _ in _imports(tree, for_types=False))
    return _Source(running, {name: one for one, name in _imports(tree, for_types=True)}, data)


def _imports(tree: ast.AST, for_types: bool) -> Iterator[tuple[Import, str]]:
    """What is imported, and as what; with `for_types` also what is imported for type checkers only."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.Import):
            yield from (((alias.name, ""), alias.asname or alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            yield from (((node.module, alias.name), alias.asname or alias.name) for alias in node.names)
        elif isinstance(node, ast.If) and "TYPE_CHECKING" in ast.dump(node.test) and not for_types:
            yield from _imports(ast.Module(node.orelse, []), for_types)
        else:
            yield from _imports(node, for_types)
