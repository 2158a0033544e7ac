# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Which code and which data a kept result was measured with.

A room is a folder of the source tree whose files a result depends on: ``cpp/signal`` stands for the headers and the
sources of that folder, ``python/evaluation`` for a package below ``python/hri``; ``/...`` at the end takes what lies
below as well. Its hash is that of what the compiler and the interpreter see: comments, docstrings, white space,
includes and file names do not count.
"""

from __future__ import annotations

import ast
import hashlib
import re
import subprocess
from collections.abc import Iterator
from functools import cache, partial
from pathlib import Path
from typing import Any

from hri import __version__
from hri.core.errors import InvalidArgument
from hri.core.files import read_text
from hri.core.library import library_file
from hri.studies.registry import Study

SUFFIXES = {".cpp", ".hpp", ".py", ".toml"}
_CPP_TOKEN = re.compile(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\'|//[^\n]*|/\*.*?\*/', re.DOTALL)


def source_root() -> Path | None:
    """The checkout that this package is used from; None for an installed package."""
    root = Path(__file__).resolve().parents[3]
    return root if (root / "cpp" / "include" / "hri").is_dir() and (root / ".git").exists() else None


def rooms_of(study: Study) -> tuple[str, ...]:
    """The rooms that `study` depends on, its own file among them."""
    run = study.run.func if isinstance(study.run, partial) else study.run
    own = run.__module__.removeprefix("hri.").replace(".", "/")
    return (*study.sources, f"python/{own}.py")


def hash_rooms(root: Path, study: Study) -> dict[str, str]:
    """The hash of each room of `study`.

    Raises
    ------
    InvalidArgument
        For a room without files.
    """
    return {room: _hash_room(root, room) for room in rooms_of(study)}


def _hash_room(root: Path, room: str) -> str:
    hashes = sorted(_hash_file(path, path.stat().st_mtime_ns) for path in _files(root, room))
    if not hashes:
        raise InvalidArgument(f"a study depends on {room}, where there are no files")
    return hashlib.sha256("\n".join(hashes).encode()).hexdigest()[:16]


@cache  # studies share most of their rooms
def _hash_file(path: Path, changed_ns: int) -> str:
    return hashlib.sha256(normalised(path).encode()).hexdigest()


def _files(root: Path, room: str) -> Iterator[Path]:
    language, _, folder = room.partition("/")
    deep = folder.endswith("/...")
    folder = folder.removesuffix("/...")
    tops = ("cpp/include/hri", "cpp/src") if language == "cpp" else ("python/hri",)
    for top in tops:
        place = root / top / folder
        if place.is_file():
            yield place
        for path in place.rglob("*") if deep else place.glob("*"):
            if path.suffix in SUFFIXES:
                yield path


def normalised(path: Path) -> str:
    """The text of a source file without what cannot change what it does."""
    text = read_text(path)
    if path.suffix == ".py":
        return ast.dump(_WithoutDocstrings().visit(ast.parse(text)))
    if path.suffix not in (".cpp", ".hpp"):
        return text
    text = _CPP_TOKEN.sub(lambda found: " " if found[0].startswith("/") else found[0], text)
    text = re.sub(r"^\s*#\s*(?:include|pragma once).*$", "", text, flags=re.MULTILINE)
    return " ".join(text.split())


class _WithoutDocstrings(ast.NodeTransformer):
    def generic_visit(self, node: ast.AST) -> ast.AST:
        super().generic_visit(node)
        body = getattr(node, "body", None)
        if isinstance(body, list):
            kept = [part for part in body if not _is_text(part)]
            node.body = kept or [ast.Pass()]  # type: ignore[attr-defined]
        return node


def _is_text(statement: ast.AST) -> bool:
    return (
        isinstance(statement, ast.Expr)
        and isinstance(statement.value, ast.Constant)
        and isinstance(statement.value.value, str)
    )


def newer_than_build(root: Path) -> list[Path]:
    """The C++ files that changed after the compiled module was written."""
    built = library_file().stat().st_mtime
    files = [path for top in ("cpp", "bindings") for path in (root / top).rglob("*") if path.suffix in (".cpp", ".hpp")]
    return sorted(path for path in files if path.stat().st_mtime > built)


def describe_code(root: Path | None) -> dict[str, Any]:
    """Version and commit; a ``+`` after the commit stands for changes that are not committed, or not compiled."""
    found: dict[str, Any] = {"version": __version__}
    if root is not None:
        commit = _git(root, "rev-parse", "--short=10", "HEAD")
        changed = _git(root, "status", "--porcelain", "--", "cpp", "bindings", "python")
        found["commit"] = commit + ("+" if changed or newer_than_build(root) else "")
    return found


def _git(root: Path, *arguments: str) -> str:
    done = subprocess.run(["git", *arguments], cwd=root, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise InvalidArgument(f"git {arguments[0]} failed in {root}: {done.stderr.strip()}")
    return done.stdout.strip()


def describe_data(data_dir: Path, study: Study) -> dict[str, dict[str, int]]:
    """Number and total size of the files in each folder that the study reads."""
    found = {}
    for name in study.data:
        place = data_dir / name
        files = [place] if place.is_file() else [path for path in place.rglob("*") if path.is_file()]
        found[name] = {"files": len(files), "bytes": sum(path.stat().st_size for path in files)}
    return found
