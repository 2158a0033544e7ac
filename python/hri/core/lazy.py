# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Names of a package that are loaded on first use; type checkers read its imports under TYPE_CHECKING instead."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from typing import Any

from hri.core.suggest import nearest


def loader(package: str, homes: Mapping[str, Sequence[str]], modules: Sequence[str] = ()) -> Callable[[str], Any]:
    """The module-level `__getattr__` of a package.

    Parameters
    ----------
    package : str
        Its name.
    homes : mapping of str to sequence of str
        The names that each module has.
    modules : sequence of str
        Modules of the package that are names of it themselves.
    """
    home_of = {name: module for module, names in homes.items() for name in names}

    def get(name: str) -> Any:
        if name in modules:
            return import_module(f"{package}.{name}")
        if name not in home_of:
            raise AttributeError(_no_attribute(package, name, {*home_of, *modules}))
        value = getattr(import_module(home_of[name]), name)
        setattr(sys.modules[package], name, value)
        return value

    return get


def _no_attribute(package: str, name: str, known: set[str]) -> str:
    alike = [] if name.startswith("__") else nearest(name, known)
    hint = f"; did you mean {' or '.join(repr(entry) for entry in alike)}?" if alike else ""
    return f"module {package!r} has no attribute {name!r}{hint}"
