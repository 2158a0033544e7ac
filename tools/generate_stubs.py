# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Write the type stubs of the compiled modules: python tools/generate_stubs.py [--check].

With --check nothing is written; the exit code is 1 when a stub in the tree is not what the modules say today.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
MODULES = ("_native", "_native_vision")
HEADER = """# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
# Written by tools/generate_stubs.py from the compiled module; do not edit.
"""


# The package says that its errors are its own (hri.core.errors); here they stand where they are made.
_STUBGEN = """
import hri._native, pybind11_stubgen
for value in vars(hri._native).values():
    if isinstance(value, type) and issubclass(value, BaseException):
        value.__module__ = "hri._native"
pybind11_stubgen.main()
"""


def generate(module: str, directory: Path) -> Path:
    """The stub of hri.`module`, formatted, in `directory`."""
    command = [sys.executable, "-c", _STUBGEN, f"hri.{module}", "--output-dir", str(directory)]
    command += ["--numpy-array-use-type-var", "--ignore-invalid-expressions=.*", "--exit-code"]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    stub = directory / "hri" / f"{module}.pyi"
    stub.write_text(HEADER + stub.read_text())
    ruff = [sys.executable, "-m", "ruff"]
    config = ["--config", str(ROOT / "pyproject.toml")]
    # pybind11 writes "x: T = None" for optional arguments.
    optional = ["--isolated", "--target-version", "py311", "--select", "RUF013", "--unsafe-fixes"]
    subprocess.run([*ruff, "check", "--fix-only", "--quiet", *optional, str(stub)], check=True)
    subprocess.run([*ruff, "format", "--quiet", *config, str(stub)], check=True)
    return stub


def main() -> int:
    """Write or check all stubs."""
    check = "--check" in sys.argv[1:]
    stale = []
    with tempfile.TemporaryDirectory() as directory:
        for module in MODULES:
            made = generate(module, Path(directory))
            target = ROOT / "python" / "hri" / made.name
            if check and (not target.exists() or target.read_text() != made.read_text()):
                stale.append(target.name)
            elif not check:
                shutil.copyfile(made, target)
    if stale:
        print(f"out of date: {', '.join(stale)}; run tools/generate_stubs.py", file=sys.stderr)
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
