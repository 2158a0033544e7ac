# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Print the requirements of libhri with the given extras, as pyproject.toml lists them; extras of extras included."""

from __future__ import annotations

import re
import sys
import tomllib
from pathlib import Path

PROJECT = tomllib.loads((Path(__file__).parent.parent / "pyproject.toml").read_text())["project"]


def requirements(extra: str) -> set[str]:
    """What `extra` asks for, with references to the project's own extras followed."""
    found: set[str] = set()
    for requirement in PROJECT["optional-dependencies"][extra]:
        own = re.fullmatch(rf"{PROJECT['name']}\[(.+)\]", requirement)
        found |= set().union(*map(requirements, own[1].split(","))) if own else {requirement}
    return found


if __name__ == "__main__":
    names = set(PROJECT["dependencies"]).union(*map(requirements, sys.argv[1:]))
    print("\n".join(sorted(names)))
