# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a type checker says of programs that use the package."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("mypy")
ROOT = Path(__file__).resolve().parents[2]

WRONG = """import hri

hri.no_such_name
hri.signal.no_such_name
hri.vision.no_such_name
hri.models.LinearSvm().no_such_name
hri.load("speech.hri", "speech").recognise_features
"""


def check(tmp_path: Path, source: str) -> list[str]:
    """What `mypy --strict` finds in a program."""
    program = tmp_path / "program.py"
    program.write_text(source)
    command = [sys.executable, "-m", "mypy", "--strict", "--follow-imports=silent", f"--cache-dir={tmp_path}"]
    command += ["--config-file", str(ROOT / "pyproject.toml"), str(program)]
    found = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    return [line for line in found.stdout.splitlines() if "error" in line and line.startswith(str(tmp_path))]


@pytest.mark.slow
def test_the_readmes_program_is_typed(tmp_path: Path) -> None:
    programs = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)
    assert programs
    assert check(tmp_path, "\n".join(programs)) == []


@pytest.mark.slow
def test_names_that_there_are_not_are_errors(tmp_path: Path) -> None:
    lines = [int(line.split(":")[1]) for line in check(tmp_path, WRONG)]
    assert lines == [3, 4, 5, 6, 7]
