# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Tables that are put together from several results: accuracy and speed in the README, and the page of benches."""

from __future__ import annotations

import ast
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from hri.studies.kept import code_of, command_of, read_kept
from hri.studies.registry import Layout
from hri.studies.rendering import markdown_table, show

BENCHES = "bench.json"
BENCHMARKS = Path(__file__).resolve().parents[1] / "benchmarks"


@dataclass(frozen=True)
class Line:
    """One row of the table of accuracy: what was measured, and where the figure stands."""

    text: str
    file: str
    where: Mapping[str, Any] = field(default_factory=dict)


ACCURACY = (
    Line("English digits (FSDD), each of 4 speakers held out", "fsdd", {"listening": "alone"}),
    Line("English digits, the same, with a pretrained speech embedding", "fsdd-both", {"listening": "alone"}),
    Line("Hindi digits, the same, with a pretrained speech embedding", "hindi-digits-both", {"listening": "alone"}),
    Line("40 commands, 4 of 24 speakers held out", "commands", {"front_end": "cepstra", "test": "quiet"}),
    Line("The same with the embedding", "commands-both", {"front_end": "both", "test": "quiet"}),
    Line(
        "The same with the embedding and a network of the same words, as `hri train speech` makes of so many",
        "commands-network",
        {"front_end": "both-network", "test": "quiet"},
    ),
    Line("Still hand signs 0-9, 130 persons, 5 folds by person", "sign-digits", {"light": "as recorded"}),
    Line(
        "8 dynamic gestures before webcams, each of ten conditions of light and background held out",
        "webcam-gestures",
        {"left out": "all clips", "source": "silhouettes"},
    ),
)
SPEED = {
    "mfcc": "13 MFCC of 10 s of audio at 16 kHz",
    "dwt1d": "Three levels of the db4 wavelet transform of 16000 samples",
    "gmm_hmm_word": "A spoken word scored by ten Gaussian HMMs",
    "lbg": "An iteration of k-means, 64 codewords, 20000 frames",
    "hand_frame": "A picture of 640 x 480 to hand features",
}


def accuracy(results: Path) -> str:
    """The rows of `ACCURACY`; a measure that a result lacks is a dash."""
    table = [["recordings", "accuracy, %", "right, %", "measured by", "at commit"]]
    for line in ACCURACY:
        kept = read_kept(results / f"{line.file}.json")
        (row,) = (row for row in kept["rows"] if all(row[axis] == value for axis, value in line.where.items()))
        shares = [show(row, Layout(), measure) or "–" for measure in ("accuracy", "right")]
        table.append([line.text, *shares, f"`{command_of(kept)}`", f"`{code_of(kept)['commit']}`"])
    return markdown_table(table)


def speed(results: Path) -> str:
    """The rows of `SPEED`."""
    report = read_benches(results)
    benches = {bench["name"]: bench for bench in report["benches"]}
    table = [["what", "peer", "peer's time / ours", "at commit"]]
    for name, text in SPEED.items():
        found = benches[name]
        table.append([text, found["peer_name"], f"{found['ratio']:.1f}", f"`{_commit(found, report)}`"])
    return markdown_table(table) + _machine(report)


def all_benches(results: Path) -> str:
    """Every bench."""
    report = read_benches(results)
    table = [["bench", "what", "peer", "peer's time / ours", "at commit"]]
    for found in report["benches"]:
        ratio = f"{found['ratio']:.2f}"
        table.append([f"`{found['name']}`", found["what"], found["peer_name"], ratio, f"`{_commit(found, report)}`"])
    kept = {found["name"] for found in report["benches"]}
    lacking = [f"`{name}`" for name in bench_names() if name not in kept]
    listed = f"\nWithout a kept figure: {', '.join(lacking)}.\n" if lacking else ""
    return markdown_table(table) + listed + _machine(report)


def bench_names() -> list[str]:
    """The benches that there are, read from their sources: most need peers that are not installed everywhere."""
    calls = (
        node
        for path in sorted(BENCHMARKS.glob("bench_*.py"))
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "Bench"
    )
    return [call.args[0].value for call in calls if isinstance(call.args[0], ast.Constant)]


def read_benches(results: Path) -> dict[str, Any]:
    """What ``./run bench --json`` wrote; a bench that was measured at another commit than the others names it."""
    found: dict[str, Any] = json.loads((results / BENCHES).read_text(encoding="utf-8"))
    return found


def _commit(bench: dict[str, Any], report: dict[str, Any]) -> str:
    return str(bench.get("commit") or report["measured"]["commit"])


def _machine(report: dict[str, Any]) -> str:
    measured = report["measured"]
    code = f"`{measured['commit']}` of {measured['date']}"
    return f"\n<sub>`./run bench` at {code}, one thread of {report['machine']}</sub>\n"


TABLES: dict[str, Callable[[Path], str]] = {
    "readme-accuracy": accuracy,
    "readme-speed": speed,
    "benches": all_benches,
}
