# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a type checker says of programs that use the package, those of the documentation first."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("mypy", reason="mypy is not installed")
ROOT = Path(__file__).resolve().parents[2]
# What a reader copies first is typed through and through; helpers of the other pages may go without annotations.
TYPED = [ROOT / "README.md", *sorted((ROOT / "docs").glob("tutorial_*.md"))]
OTHERS = [page for page in sorted((ROOT / "docs").glob("*.md")) if page not in TYPED]

WRONG = """import hri

hri.no_such_name
hri.signal.no_such_name
hri.vision.no_such_name
hri.models.LinearSvm().no_such_name
hri.load("speech.hri", "speech").recognise_features
hri.WordRecognizer(model="hmmm")
hri.GestureRecognizer(hands={"learning": "often"})
hri.fuse(speech="seven")
"""


def check(folder: Path, programs: dict[str, str], *options: str) -> list[tuple[str, int]]:
    """Program and line of every error that `mypy --strict` finds."""
    command = [sys.executable, "-m", "mypy", "--strict", "--follow-imports=silent", f"--cache-dir={folder}"]
    command += ["--config-file", str(ROOT / "pyproject.toml"), "--hide-error-context", "--no-pretty", *options]
    for name, source in programs.items():
        (folder / f"{name}.py").write_text(source, encoding="utf-8")
        command.append(str(folder / f"{name}.py"))
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode in (0, 1), done.stdout + done.stderr
    print(done.stdout)  # what a test that fails shows
    found = re.findall(rf"^{re.escape(str(folder))}/(\w+)\.py:(\d+): error", done.stdout, re.MULTILINE)
    assert bool(found) == bool(done.returncode), done.stdout
    return [(name, int(line)) for name, line in found]


def programs(pages: list[Path]) -> dict[str, str]:
    """The Python of each page that shows some."""
    shown = {page.stem: re.findall(r"^```python\n(.*?)^```", page.read_text("utf-8"), re.S | re.M) for page in pages}
    return {name: "\n".join(blocks) for name, blocks in shown.items() if blocks}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("typed")


def test_programs_of_the_readme_and_the_tutorials_are_typed(folder: Path) -> None:
    shown = programs(TYPED)
    assert shown.keys() >= {"README", "tutorial_python", "tutorial_robot"}
    assert check(folder, shown) == []


def test_programs_of_the_other_pages_are_used_as_they_are_typed(folder: Path) -> None:
    assert check(folder, programs(OTHERS), "--allow-untyped-defs", "--allow-untyped-calls") == []


def test_names_and_values_that_there_are_not_are_errors(folder: Path) -> None:
    lines = range(3, 1 + len(WRONG.splitlines()))
    assert list(dict.fromkeys(check(folder, {"wrong": WRONG}))) == [("wrong", line) for line in lines]
