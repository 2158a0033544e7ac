# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Write what follows from the options classes: python tools/generate_option_tables.py [--check].

That is the table of every field, docs/options.md, and the typed keywords of the recognisers,
python/hri/recognition/keywords.py. With --check nothing is written; the exit code is 1 when a file in the tree is not
what the compiled modules say today.
"""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from hri import _native, _native_vision

ROOT = Path(__file__).resolve().parent.parent
KEYWORDS_OF = (
    _native.WordRecognizerOptions,
    _native.GestureRecognizerOptions,
    _native.SpeakerAdapterOptions,
    _native.SpeechEmbeddingOptions,
    _native.ConnectedWordRecognizerOptions,
    _native.SentenceRecognizerOptions,
    _native.SentenceStreamOptions,
    _native.SubwordRecognizerOptions,
)

KEYWORDS_HEAD = '''# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
# Written by tools/generate_option_tables.py from the compiled module; do not edit.
"""Keywords of the recognisers, as type checkers read them; what each does stands in the class named after it."""

from __future__ import annotations

from typing import Literal, TypedDict

from hri import _native

'''

DOCS_HEAD = """# Options

<!-- Written by tools/generate_option_tables.py from the compiled modules; do not edit. -->

Every option of every class, as the library itself lists them. In Python they are keywords
(`hri.WordRecognizer(num_states=8, cepstra={"num_filters": 30})`) and attributes; on the command line
`--option num_states=8 --option cepstra.num_filters=30`, and `hri options speech` prints what it takes; in C++ they are
the fields of the structs. A value outside its range is refused when it is set. A field of another class takes an
object of that class or a dict of the fields to change.

`hri train` and `hri.train` decide three of them by the recordings and the extras where they are not given, in place of
the defaults below: `front_end` and `use_network` of words, `source` of gestures; `hri options` says by what.
"""


def options_classes() -> Iterator[type[Any]]:
    """Every class with fields, by name."""
    found = {c for m in (_native, _native_vision) for c in vars(m).values() if hasattr(c, "fields")}
    yield from sorted(found, key=lambda c: str(c.__name__))


def values_of(field: _native.OptionField) -> str:
    """The values that a field may hold."""
    if field.options is not None:
        name = field.options.__name__
        return f"[{name}](#{name.lower()})"
    if field.choices:
        return ", ".join(f"`{choice}`" for choice in field.choices)
    return f"{field.range} {field.unit}".strip() if field.range else field.type


def table(options_class: Any) -> str:
    """The section of one class."""
    doc = options_class.__doc__.split("\n")[0]
    lines = [f"## {options_class.__name__}", "", doc, "", "| field | default | values | |", "|---|---|---|---|"]
    for field in options_class.fields():
        default = "" if field.options is not None else f"`{field.default!r}`"
        lines.append(
            f"| `{field.name}` | {default} | {values_of(field)} | {field.description.replace('|', chr(92) + '|')} |"
        )
    return "\n".join(lines) + "\n"


def typed_dicts() -> str:
    """A TypedDict for each options class that the recognisers take, nested ones first."""
    written: dict[str, str] = {}

    def write(options_class: Any) -> str:
        name = re.sub("Options$", "Keywords", options_class.__name__)
        if name in written:
            return name
        lines = [f"class {name}(TypedDict, total=False):", f'    """Fields of `{options_class.__name__}`."""', ""]
        for field in options_class.fields():
            kind = field.type.replace("typing.", "")
            if field.options is not None:
                kind = f"_native.{field.options.__name__} | {write(field.options)}"
            lines.append(f"    {field.name}: {kind}")
        written[name] = "\n".join(lines)
        return name

    for options_class in KEYWORDS_OF:
        write(options_class)
    return KEYWORDS_HEAD + "\n\n\n".join(written.values()) + "\n"


def formatted(text: str) -> str:
    """As `ruff format` leaves it."""
    command = [sys.executable, "-m", "ruff", "format", "--config", str(ROOT / "pyproject.toml"), "-"]
    return subprocess.run(command, input=text, capture_output=True, text=True, check=True).stdout


def main() -> int:
    """Write or check both files."""
    docs = DOCS_HEAD + "".join("\n" + table(c) for c in options_classes())
    files = {
        ROOT / "docs" / "options.md": docs,
        ROOT / "python" / "hri" / "recognition" / "keywords.py": formatted(typed_dicts()),
    }
    stale = [path for path, text in files.items() if not path.exists() or path.read_text(encoding="utf-8") != text]
    if "--check" in sys.argv[1:]:
        if stale:
            names = ", ".join(str(path.relative_to(ROOT)) for path in stale)
            print(f"out of date: {names}; run tools/generate_option_tables.py", file=sys.stderr)
        return 1 if stale else 0
    for path in stale:
        path.write_text(files[path], encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
