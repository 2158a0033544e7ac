#!/usr/bin/env python3
# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Write the tables and example programs in README.md and docs/; --check only says whether they are up to date.

A table stands between ``<!-- results: FILE option=value ... -->`` and ``<!-- end -->``. FILE is a result in
docs/results/ without its ``.json``. Options, in the syntax of a shell:

rows=AXIS,...       axes along the rows, in this order; all that vary, if not given
columns=AXIS        the axis along the columns; "measures": one column a measure; if not given, as the study has it
measures=M,...      what was measured, for columns=measures; all, if not given; of other columns the one that they show
where=AXIS:V,V;...  only the rows of the result with these values
names=KEY:TEXT;...  what axes, values and measures are called in the table
spread=no           means only
digits=N            decimals

``<!-- results: readme-accuracy -->`` and the like are put together from several results: see `tools/readme_tables.py`.
``<!-- example: PATH -->`` holds the program of that path. Below the table of a result whose study depends on code that
has changed since (see `hri.studies.kept`) this is said. `--check` fails where it is not, for such a result in the
README, and for one of the present code whose commit is not in the history. Benches that are older than their code are
a note.
"""

from __future__ import annotations

import argparse
import functools
import re
import shlex
import sys
from pathlib import Path

import readme_tables
from hri.core.errors import InvalidArgument
from hri.studies import STUDIES
from hri.studies.kept import code_of, command_of, read_kept, stale_rooms
from hri.studies.provenance import fault_of_commit, hash_benches, history_of
from hri.studies.rendering import Pivot, markdown_table, pivot

ROOT = Path(__file__).resolve().parents[1]
RESULTS = ROOT / "docs" / "results"
_BLOCK = re.compile(
    r"^<!-- (?P<kind>results|example): (?P<spec>[^\n]*?) -->\n.*?^<!-- end -->$", re.DOTALL | re.MULTILINE
)


CHANGED_SINCE = ", and not since the code has changed"


def caption(kept: dict, is_stale: bool) -> str:
    """The command that repeats a result, and the code that it was last verified with, or measured with."""
    how = "verified" if "verified" in kept else "measured"
    return f"<sub>`{command_of(kept)}`, {how} at `{code_of(kept)['commit']}`{CHANGED_SINCE * is_stale}</sub>"


def make_table(spec: str) -> str:
    """The Markdown between the markers of `spec`."""
    name, *words = shlex.split(spec)
    if name in readme_tables.TABLES:
        return readme_tables.TABLES[name](RESULTS)
    options = dict(word.split("=", 1) for word in words)
    path = RESULTS / f"{name}.json"
    kept = read_kept(path)
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
    return (
        markdown_table(pivot(kept["rows"], study.layout, shown)) + "\n" + caption(kept, path in stale_results()) + "\n"
    )


def show_example(path: str) -> str:
    """A program as a block of code."""
    return f"```cpp\n{(ROOT / path).read_text(encoding='utf-8')}```\n"


def _listed(text: str) -> tuple[str, ...]:
    return tuple(text.split(",")) if text else ()


def _pairs(text: str) -> list[tuple[str, str]]:
    return [tuple(part.split(":", 1)) for part in text.split(";") if part]  # type: ignore[misc]


def written_anew(page: Path) -> str:
    """The text of a page with its tables as they should be."""

    def replaced(block: re.Match[str]) -> str:
        kind, spec = block["kind"], block["spec"]
        try:
            text = make_table(spec) if kind == "results" else show_example(spec)
        except (InvalidArgument, OSError, KeyError, ValueError) as error:
            raise SystemExit(f"{page.relative_to(ROOT)}: <!-- {kind}: {spec} -->: {error}") from error
        return f"<!-- {kind}: {spec} -->\n{text}<!-- end -->"

    return _BLOCK.sub(replaced, page.read_text(encoding="utf-8"))


def kept_paths() -> list[Path]:
    """The results of studies."""
    return [path for path in sorted(RESULTS.glob("*.json")) if path.name != readme_tables.BENCHES]


@functools.cache
def stale_results() -> dict[Path, str]:
    """The results that are older than the code of their study, and why."""
    found = {}
    for path in kept_paths():
        kept = read_kept(path)
        if kept["study"] not in STUDIES:
            found[path] = f"there is no study {kept['study']}"
        elif rooms := stale_rooms(ROOT, STUDIES[kept["study"]], kept):
            found[path] = f"measured with other code in {', '.join(rooms)}; run tools/verify_results.sh"
    return found


def stale_headlines() -> dict[Path, str]:
    """Those of the README among them."""
    shown = {RESULTS / f"{line.file}.json" for line in readme_tables.ACCURACY}
    return {path: why for path, why in stale_results().items() if path in shown}


def lost_commits() -> dict[Path, str]:
    """The results of the present code whose commit cannot be checked out, and why.

    Of a clone without its history only a note is printed.
    """
    history = history_of(ROOT)
    if history is None:
        print("commits of the results are not checked: no history of git is here", file=sys.stderr)
        return {}
    found = {path: fault_of_commit(code_of(read_kept(path))["commit"], history) for path in kept_paths()}
    found = {path: fault for path, fault in found.items() if path not in stale_results()}
    return {
        path: f"{fault}; run tools/verify_results.sh {path.relative_to(ROOT)}" for path, fault in found.items() if fault
    }


def without_marks(text: str) -> str:
    """A page that does not say which results are older than their code."""
    return text.replace(CHANGED_SINCE, "")


def stale_benches() -> str:
    """Where the code differs from that which the benches have measured; "" where it does not."""
    then = readme_tables.read_benches(RESULTS).get("sources", {})
    return ", ".join(room for room, now in hash_benches(ROOT).items() if then.get(room) != now)


def main() -> int:
    """Exit code 1 for tables or results that are out of date."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="write nothing")
    parser.add_argument("--tables", action="store_true", help="do not ask whether results are older than their code")
    parser.add_argument("--stale", action="store_true", help="list the results that are older than their code, and end")
    arguments = parser.parse_args()
    if arguments.stale:
        for path in stale_results():
            print(path.relative_to(ROOT))
        if stale_benches():
            print((RESULTS / readme_tables.BENCHES).relative_to(ROOT))
        return 0
    check = arguments.check
    wrong = []
    for page in (ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))):
        text = written_anew(page)
        shown = page.read_text(encoding="utf-8")
        if text == shown or (arguments.tables and without_marks(text) == without_marks(shown)):
            continue
        if check:
            wrong.append(f"{page.relative_to(ROOT)}: tables differ from docs/results; run tools/generate_tables.py")
        else:
            page.write_text(text, encoding="utf-8")
    if check and not arguments.tables:
        for found in (stale_headlines(), lost_commits()):
            wrong += [f"{path.relative_to(ROOT)}: {why}" for path, why in found.items()]
        if rooms := stale_benches():  # no failure: benches need a machine of their own, and cannot be verified in part
            print(f"note: the benches were measured with other code in {rooms}; ./run bench --json", file=sys.stderr)
    print("\n".join(wrong), end="\n" if wrong else "", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
