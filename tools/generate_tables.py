#!/usr/bin/env python3
# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Write the tables of README.md and docs/ from docs/results/; --check only says whether they are up to date.

A table stands between ``<!-- results: FILE option=value ... -->`` and ``<!-- end -->``. FILE is a result in
docs/results/ without its ``.json``. Options, in the syntax of a shell:

rows=AXIS,...       axes along the rows, in this order; all that vary, if not given
columns=AXIS        the axis along the columns; "measures": one column a measure; if not given, as the study has it
measures=M,...      what was measured, for columns=measures; all, if not given
where=AXIS:V,V;...  only the rows of the result with these values
names=KEY:TEXT;...  what axes, values and measures are called in the table
spread=no           means only
digits=N            decimals

``<!-- results: readme-accuracy -->`` and the like are put together from several results: see `tools/readme_tables.py`.
`--check` also fails for a result whose study depends on code that has changed since (see `hri.studies.kept`).
"""

from __future__ import annotations

import argparse
import re
import shlex
import sys
from pathlib import Path

import readme_tables
from hri.core.errors import InvalidArgument
from hri.studies import STUDIES
from hri.studies.kept import command_of, read_kept, stale_rooms
from hri.studies.tables import Pivot, markdown_table, pivot

ROOT = Path(__file__).resolve().parents[1]
RESULTS = ROOT / "docs" / "results"
_BLOCK = re.compile(r"^<!-- results: (?P<spec>[^\n]*?) -->\n.*?^<!-- end -->$", re.DOTALL | re.MULTILINE)


def caption(kept: dict) -> str:
    """The command that repeats a result, and the code that it was measured with."""
    measured, verified = kept["measured"], kept.get("verified", {})
    text = f"`{command_of(kept)}`, measured at `{measured['commit']}`"
    if verified.get("commit", measured["commit"]) != measured["commit"]:
        text += f", verified at `{verified['commit']}`"
    return f"<sub>{text}</sub>"


def make_table(spec: str) -> str:
    """The Markdown between the markers of `spec`."""
    name, *words = shlex.split(spec)
    if name in readme_tables.TABLES:
        return readme_tables.TABLES[name](RESULTS)
    options = dict(word.split("=", 1) for word in words)
    kept = read_kept(RESULTS / f"{name}.json")
    study = STUDIES[kept["study"]]
    shown = Pivot(
        rows=_listed(options.pop("rows", "")),
        columns=options.pop("columns", study.layout.columns or "measures"),
        measures=_listed(options.pop("measures", "")),
        where={axis: values.split(",") for axis, values in _pairs(options.pop("where", ""))},
        names=dict(_pairs(options.pop("names", ""))),
        spread=options.pop("spread", "yes") == "yes",
        digits=int(options.pop("digits", "1")),
    )
    if options:
        raise InvalidArgument(f"unknown options: {', '.join(options)}")
    return markdown_table(pivot(kept["rows"], study.layout, shown)) + "\n" + caption(kept) + "\n"


def _listed(text: str) -> tuple[str, ...]:
    return tuple(text.split(",")) if text else ()


def _pairs(text: str) -> list[tuple[str, str]]:
    return [tuple(part.split(":", 1)) for part in text.split(";") if part]  # type: ignore[misc]


def written_anew(page: Path) -> str:
    """The text of a page with its tables as they should be."""

    def replaced(block: re.Match[str]) -> str:
        try:
            table = make_table(block["spec"])
        except (InvalidArgument, KeyError, ValueError) as error:
            raise SystemExit(f"{page.relative_to(ROOT)}: <!-- results: {block['spec']} -->: {error}") from error
        return f"<!-- results: {block['spec']} -->\n{table}<!-- end -->"

    return _BLOCK.sub(replaced, page.read_text(encoding="utf-8"))


def stale_results() -> list[str]:
    """What to say of every result that its study's code has left behind."""
    found = []
    for path in sorted(RESULTS.glob("*.json")):
        if path.name == readme_tables.BENCHES:
            continue
        kept = read_kept(path)
        if kept["study"] not in STUDIES:
            found.append(f"{path.name}: there is no study {kept['study']}")
            continue
        rooms = stale_rooms(ROOT, STUDIES[kept["study"]], kept)
        if rooms:
            found.append(
                f"{path.name}: measured with other code in {', '.join(rooms)}; "
                f"hri study {kept['study']} --verify docs/results/{path.name}"
            )
    return found


def main() -> int:
    """Exit code 1 for tables or results that are out of date."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="write nothing")
    parser.add_argument("--tables", action="store_true", help="do not ask whether results are older than their code")
    arguments = parser.parse_args()
    check = arguments.check
    wrong = []
    for page in (ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))):
        text = written_anew(page)
        if text == page.read_text(encoding="utf-8"):
            continue
        if check:
            wrong.append(f"{page.relative_to(ROOT)}: tables differ from docs/results; run tools/generate_tables.py")
        else:
            page.write_text(text, encoding="utf-8")
    if check and not arguments.tables:
        wrong += stale_results()
    print("\n".join(wrong), end="\n" if wrong else "", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
