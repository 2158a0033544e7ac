# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The files that pages share, served by their names or written into a page that needs no server."""

from __future__ import annotations

import base64
import json
import re
from importlib.resources import files

from hri.core.phrases import phrases

_TABLE = "table.js"
COMPONENTS = ("page.css", "bars.js", "conversation.js", "phrases.js", "robot.js", _TABLE, "words.js")
"""Names of the files beside this one, and of the table of texts as a script."""
_IMPORT = re.compile(r'from "\./([\w.]+)"')


def component(name: str) -> bytes:
    """One of `COMPONENTS`."""
    if name == _TABLE:
        table = json.dumps(phrases(), ensure_ascii=False, separators=(",", ":"))
        return f"export const PHRASES = {table};\n".encode()
    return files("hri.page").joinpath(name).read_bytes()


def in_one_file(script: str) -> str:
    """A module whose imports of components stand in it, as addresses that hold their text.

    A browser loads no module from a file beside a page that was opened as a file; one inside the page it does.

    Parameters
    ----------
    script : str
        JavaScript that imports from ``"./NAME"``.
    """
    return _IMPORT.sub(lambda found: f'from "{_address(found[1])}"', script)


def _address(name: str) -> str:
    text = in_one_file(component(name).decode("utf-8"))
    return f"data:text/javascript;base64,{base64.b64encode(text.encode('utf-8')).decode('ascii')}"
