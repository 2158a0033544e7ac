# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Which code and which data a kept result was measured with.

A room is a folder of the source tree with files that a result depends on. Of C++, a study names them: ``cpp/signal``
stands for the headers and the sources of that folder, and ``/...`` at the end takes what lies below as well. Of Python,
``python/evaluation`` stands for those files of that folder below ``python/hri`` which the study's module reaches, data
such as ``.npz`` among them, see `hri.studies.reached`. The hash of a room is that of what the compiler and the
interpreter see: comments, docstrings, white space, includes and file names do not count.
"""

from __future__ import annotations

import ast
import hashlib
import re
import subprocess
from collections.abc import Iterable, Iterator
from functools import cache, partial
from pathlib import Path
from typing import Any

from hri import __version__
from hri.core.errors import InvalidArgument
from hri.core.files import read_text
from hri.core.library import library_file
from hri.studies.reached import reached_files, reached_from
from hri.studies.registry import Study

CPP_SUFFIXES = {".cpp", ".hpp"}
BINARY_SUFFIXES = {".npz", ".onnx"}
_CPP_TOKEN = re.compile(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\'|//[^\n]*|/\*.*?\*/', re.DOTALL)


def source_root() -> Path | None:
    """The checkout that this package is used from; None for an installed package."""
    root = Path(__file__).resolve().parents[3]
    return root if (root / "cpp" / "include" / "hri").is_dir() and (root / ".git").exists() else None


def module_of(study: Study) -> str:
    """The module that runs `study`."""
    run = study.run.func if isinstance(study.run, partial) else study.run
    return str(run.__module__)


def hash_rooms(root: Path, study: Study) -> dict[str, str]:
    """The hash of each room of `study`.

    Raises
    ------
    InvalidArgument
        For a room without files.
    """
    return {**hash_cpp(root, study.sources), **hash_python(root, reached_files(root, [module_of(study)]))}


def hash_benches(root: Path) -> dict[str, str]:
    """The hash of the benches, of all C++ sources, and of each folder of the package that the benches reach."""
    programs = sorted((root / "benchmarks").glob("*.py"))
    reached = set[Path]().union(*(reached_from(root, path) for path in programs))
    return {
        "benchmarks": _hash_files("benchmarks", programs),
        **hash_cpp(root, ["cpp/..."]),
        **hash_python(root, reached),
    }


def date_of_commit(root: Path) -> str:
    """The day of the present commit, such as 2026-01-31."""
    return _git(root, "show", "--no-patch", "--format=%cs", "HEAD")


def hash_cpp(root: Path, rooms: Iterable[str]) -> dict[str, str]:
    """The hash of each room of the C++ sources. Raises InvalidArgument for a room without files."""
    return {room: _hash_files(room, _cpp_files(root, room)) for room in rooms}


def hash_python(root: Path, files: Iterable[Path]) -> dict[str, str]:
    """The hash of `files` of the package, by the folder that they are in."""
    rooms: dict[str, list[Path]] = {}
    for path in files:
        folder = path.parent.relative_to(root / "python" / "hri").as_posix()
        rooms.setdefault("python" if folder == "." else f"python/{folder}", []).append(path)
    return {room: _hash_files(room, rooms[room]) for room in sorted(rooms)}


def _hash_files(room: str, files: Iterable[Path]) -> str:
    hashes = sorted(_hash_file(path, path.stat().st_mtime_ns) for path in files)
    if not hashes:
        raise InvalidArgument(f"a result depends on {room}, where there are no files")
    return hashlib.sha256("\n".join(hashes).encode()).hexdigest()[:16]


@cache  # studies share most of their rooms
def _hash_file(path: Path, changed_ns: int) -> str:
    binary = path.suffix in BINARY_SUFFIXES
    return hashlib.sha256(path.read_bytes() if binary else normalised(path).encode()).hexdigest()


def _cpp_files(root: Path, room: str) -> Iterator[Path]:
    folder = room.removeprefix("cpp/")
    deep = folder.endswith("...")
    for top in ("cpp/include/hri", "cpp/src"):
        place = root / top / folder.removesuffix("...")
        for path in place.rglob("*") if deep else place.glob("*"):
            if path.suffix in CPP_SUFFIXES:
                yield path


def normalised(path: Path) -> str:
    """The text of a source file without what cannot change what it does."""
    text = read_text(path)
    if path.suffix == ".py":
        return ast.dump(_WithoutDocstrings().visit(ast.parse(text)))
    if path.suffix not in CPP_SUFFIXES:
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
    files = [path for top in ("cpp", "bindings") for path in (root / top).rglob("*") if path.suffix in CPP_SUFFIXES]
    return sorted(path for path in files if path.stat().st_mtime > built)


def describe_code(root: Path | None) -> dict[str, Any]:
    """Version and commit; a ``+`` after the commit stands for changes that are not committed, or not compiled."""
    found: dict[str, Any] = {"version": __version__}
    if root is not None:
        commit = _git(root, "rev-parse", "--short=10", "HEAD")
        status = _git(root, "status", "--porcelain", "--", "cpp", "bindings", "python").splitlines()
        changed = [line for line in status if not line.endswith((".so", ".pyd"))]  # `newer_than_build` judges these
        found["commit"] = commit + ("+" if changed or newer_than_build(root) else "")
    return found


def history_of(root: Path) -> list[str] | None:
    """The commits up to the present one; None without git, or where the older ones were not fetched."""
    try:
        if _git(root, "rev-parse", "--is-shallow-repository") == "true":
            return None
        return _git(root, "rev-list", "HEAD").splitlines()
    except (InvalidArgument, OSError):
        return None


def fault_of_commit(commit: str, history: Iterable[str]) -> str:
    """Why `commit` (as `describe_code` gives it) cannot be checked out to repeat a result; "" where it can."""
    if commit.endswith("+"):
        return f"{commit} had changes that are in no commit"
    if not any(one.startswith(commit) for one in history):
        return f"{commit} is no commit of this history"
    return ""


def _git(root: Path, *arguments: str) -> str:
    done = subprocess.run(["git", *arguments], cwd=root, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise InvalidArgument(f"git {arguments[0]} failed in {root}: {done.stderr.strip()}")
    return done.stdout.strip()


def describe_data(data_dir: Path, study: Study) -> dict[str, dict[str, Any]]:
    """Number and total size of the files in each folder that the study reads, and the hash of names and contents."""
    found = {}
    for name in study.data:
        place = data_dir / name
        files = [place] if place.is_file() else sorted(path for path in place.rglob("*") if path.is_file())
        lines = [f"{path.relative_to(data_dir).as_posix()} {_hash_bytes(path)}" for path in files]
        found[name] = {
            "files": len(files),
            "bytes": sum(path.stat().st_size for path in files),
            "sha256": hashlib.sha256("\n".join(lines).encode()).hexdigest()[:16],
        }
    return found


def _hash_bytes(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
