# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Tables that are put together from several results: accuracy and speed in the README, and the page of benches."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from hri.studies.kept import command_of, read_kept
from hri.studies.registry import Layout
from hri.studies.tables import markdown_table, show

BENCHES = "bench.json"


@dataclass(frozen=True)
class Line:
    """One row of the table of accuracy: what was measured, and where the figure stands."""

    text: str
    file: str
    where: Mapping[str, Any] = field(default_factory=dict)


ACCURACY = (
    Line("English digits (FSDD), each of 4 speakers held out", "fsdd", {"listening": "alone"}),
    Line("the same, adapting to the speaker without supervision", "fsdd", {"listening": "adapting"}),
    Line("Hindi words, each of 4 speakers held out", "hindi-words", {"listening": "alone"}),
    Line("Still hand signs 0-9, 130 persons, 5 folds by person", "sign-digits", {"light": "as recorded"}),
    Line("8 dynamic gestures before webcams, 5 stratified folds", "webcam-gestures", {"source": "silhouettes"}),
)
SPEED = {
    "cepstra": "13 MFCC of 10 s of audio",
    "hmm_word": "Gaussian HMM, log-likelihood of a spoken word by ten models",
    "dwt1d": "3-level db4 wavelet transform of 1 s of audio",
    "kmeans": "k-means codebook, 64 codewords",
    "hands": "Hand features from a picture of 640 x 480",
}


def accuracy(results: Path) -> str:
    """The rows of `ACCURACY`."""
    table = [["recordings", "accuracy, %", "measured by", "at commit"]]
    for line in ACCURACY:
        kept = read_kept(results / f"{line.file}.json")
        (row,) = (row for row in kept["rows"] if all(row[axis] == value for axis, value in line.where.items()))
        table.append([line.text, show(row, Layout()), f"`{command_of(kept)}`", f"`{kept['measured']['commit']}`"])
    return markdown_table(table)


def speed(results: Path) -> str:
    """The rows of `SPEED`."""
    report, benches = _benches(results)
    table = [["what", "peer", "peer's time / ours"]]
    for name, text in SPEED.items():
        table.append([text, benches[name]["peer_name"], f"{benches[name]['ratio']:.1f}"])
    return markdown_table(table) + "\n" + _bench_caption(report)


def all_benches(results: Path) -> str:
    """Every bench."""
    report, benches = _benches(results)
    table = [["bench", "what", "ours, ms", "peer", "peer's time / ours"]]
    for name, bench in benches.items():
        table.append([name, bench["what"], f"{1e3 * bench['ours']:.3g}", bench["peer_name"], f"{bench['ratio']:.2f}"])
    return markdown_table(table) + "\n" + _bench_caption(report)


def _benches(results: Path) -> tuple[dict[str, Any], dict[str, dict[str, Any]]]:
    report = json.loads((results / BENCHES).read_text(encoding="utf-8"))
    return report, {bench["name"]: bench for bench in report["benches"]}


def _bench_caption(report: dict[str, Any]) -> str:
    return (
        f"<sub>`./run bench`, one thread of {report['machine']}, measured at `{report['measured']['commit']}`</sub>\n"
    )


TABLES: dict[str, Callable[[Path], str]] = {
    "readme-accuracy": accuracy,
    "readme-speed": speed,
    "benches": all_benches,
}
