#!/usr/bin/env python3
# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Write the Python reference by pdoc into a folder. A module that cannot be imported and a warning are errors."""

from __future__ import annotations

import importlib
import pkgutil
import sys
import warnings
from pathlib import Path

import pdoc

import hri


def public_modules() -> list[str]:
    """Every module of the package whose name has no underscore; the entry point is none of them."""
    names = [info.name for info in pkgutil.walk_packages(hri.__path__, "hri.")]
    return ["hri", *(name for name in names if not any(part.startswith("_") for part in name.split(".")))]


def resolve(name: str) -> None:
    """Load what a module offers on first use, as pdoc looks at what is there."""
    module = importlib.import_module(name)
    for offered in getattr(module, "__all__", ()):
        vars(module).setdefault(offered, getattr(module, offered))


def main() -> None:
    """Command line."""
    warnings.simplefilter("error", UserWarning)
    # Every module is named, as pdoc leaves out those that its package does not offer by __all__.
    warnings.filterwarnings("ignore", message="The module specification")
    names = public_modules()
    for name in names:
        resolve(name)
    pdoc.render.configure(docformat="numpy")
    pdoc.pdoc(*names, output_directory=Path(sys.argv[1]))


if __name__ == "__main__":
    main()
