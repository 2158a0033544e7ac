# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Draw the figures of docs/ptbhmm.md into docs/images (or --out).

    python tools/draw_figures.py --study parity.json --bench bench.json

parity.json comes from "hri study ptbhmm-parity --json", bench.json from "./run bench --json"; without one of them the
figure that shows it is left as it is. Everything else is computed here, from synthetic words.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np

from hri.models import (
    MarkovChain,
    PossibilisticHmmOptions,
    PossibilisticHmmSet,
    PossibilisticHmmStream,
    PossibilisticRule,
    Topology,
    initial_transition,
)

mpl.use("svg")
import matplotlib.pyplot as plt

IMAGES = Path(__file__).resolve().parent.parent / "docs" / "images"
BLUE, ORANGE, GREEN, GREY = "#3b6fb6", "#d9822b", "#3f8f5f", "#9a948c"
FORMS = {
    "literal max (eq. 4.11)": {"conjunction": "max"},
    "plain min": {"conjunction": "min", "conditioned": False},
    "min, conditioned": {"conjunction": "min"},
    "product": {"conjunction": "product"},
}
METHODS = {
    "hmm_forward": ("HMM, forward", GREY),
    "product": ("PTBHMM, product", BLUE),
    "min_conditioned": ("PTBHMM, min conditioned", GREEN),
    "min_plain": ("PTBHMM, plain min", ORANGE),
    "max_literal": ("PTBHMM, literal max", "#c0392b"),
}
WORDS = ((0, 1, 2, 3), (3, 2, 1, 0), (1, 3, 0, 2))


def save(figure: Any, path: Path) -> None:
    """As SVG without date or random names, so that drawing again changes nothing."""
    with mpl.rc_context({"svg.hashsalt": "hri", "svg.fonttype": "path"}):
        figure.savefig(path, metadata={"Date": None}, bbox_inches="tight")
    plt.close(figure)


def say(order: tuple[int, ...], rng: np.random.Generator) -> np.ndarray:
    """A synthetic word: stretches of symbols with one symbol in six wrong."""
    symbols = np.repeat(order, rng.integers(4, 9, len(order)))
    wrong = rng.random(len(symbols)) < 1 / 6
    return np.where(wrong, rng.integers(0, 4, len(symbols)), symbols).astype(np.int32)


def draw_forms(path: Path) -> None:
    """Score of three word models while the first word is heard, under each form of the recursion."""
    rng = np.random.default_rng(3)
    options = PossibilisticHmmOptions(topology={"num_states": 4}, num_symbols=4, emission_floor=0.01)
    models = PossibilisticHmmSet.train([[say(order, rng) for _ in range(20)] for order in WORDS], options).models
    heard = say(WORDS[0], rng)
    figure, grid = plt.subplots(1, len(FORMS), figsize=(11, 2.7), sharex=True)
    for axes, (title, rule) in zip(grid, FORMS.items(), strict=True):
        stream = PossibilisticHmmStream(PossibilisticHmmSet(models, PossibilisticRule(**rule)), float("inf"))
        scores = []
        for symbol in heard:
            stream.push(int(symbol))
            scores.append(stream.log_possibilities())
        for c, color in enumerate((BLUE, ORANGE, GREEN)):
            axes.plot(np.array(scores)[:, c], color=color, label=f"word {c + 1}", linewidth=1.6, alpha=0.85)
        axes.set_title(title, fontsize=10)
        axes.set_xlabel("frame")
    grid[0].set_ylabel("log possibility")
    grid[-1].legend(fontsize=8, frameon=False)
    figure.tight_layout()
    save(figure, path)


def draw_structures(path: Path) -> None:
    """Transitions of each structure, 12 states; how many numbers define them."""
    rng = np.random.default_rng(1)
    n = 12
    figure, grid = plt.subplots(1, 4, figsize=(11, 3))
    kinds = ("left_right", "banded", "rank_one_plus_band", "ergodic")
    titles = ("left-right: 2N", "band: 3N", "rank-one plus band: 5N", "dense: N²")
    for axes, kind, title in zip(grid, kinds, titles, strict=True):
        topology = Topology(kind=kind, num_states=n)
        transition = rng.dirichlet(np.ones(n), n) if kind == "ergodic" else initial_transition(topology)
        if kind == "rank_one_plus_band":
            leave, land = rng.uniform(0.1, 0.4, n), rng.dirichlet(np.ones(n))
            band = transition * (1 - leave)[:, None]
            transition = MarkovChain(topology, np.full(n, 1 / n), band, leave, land).transition
        axes.imshow(np.sqrt(transition), cmap="Blues", vmin=0, vmax=0.9)
        axes.set_title(title, fontsize=10)
        axes.set(xticks=[], yticks=[], xlabel="to j")
    grid[0].set_ylabel("from i")
    figure.tight_layout()
    save(figure, path)


def draw_parity(path: Path, study: dict[str, Any]) -> None:
    """Accuracy of each form on every data set, with its spread over held-out persons."""
    figure, axes = plt.subplots(figsize=(9, 3.4))
    rows = {(row["data"], row["method"]): row for row in study["rows"]}
    names = list(dict.fromkeys(row["data"] for row in study["rows"]))
    width = 0.8 / len(METHODS)
    for m, (method, (label, color)) in enumerate(METHODS.items()):
        found = [rows[name, method] for name in names]
        x = np.arange(len(names)) + (m - (len(METHODS) - 1) / 2) * width
        axes.bar(x, [100 * f["accuracy_mean"] for f in found], width, color=color, label=label)
        spread = [100 * f.get("accuracy_std", 0.0) for f in found]
        axes.errorbar(x, [100 * f["accuracy_mean"] for f in found], spread, fmt="none", ecolor="#333", elinewidth=0.7)
    axes.set(xticks=range(len(names)), xticklabels=names, ylabel="% right", ylim=(0, 100))
    axes.legend(fontsize=8, frameon=False, ncols=3, loc="upper center", bbox_to_anchor=(0.5, 1.22))
    save(figure, path)


def draw_scaling(path: Path, bench: list[dict[str, Any]]) -> None:
    """Cost of 1000 frames under one model against its number of states."""
    details = {entry["name"]: entry["details"] for entry in bench["benches"]}
    figure, axes = plt.subplots(figsize=(6.5, 4))
    lines = (
        ("ptbhmm_scaling", "hmm_dense_us", "HMM, dense", GREY),
        ("ptbhmm_scaling_jumps", "ptbhmm_us", "PTBHMM, rank-one plus band", ORANGE),
        ("ptbhmm_scaling", "ptbhmm_us", "PTBHMM, left-right, float32", BLUE),
        ("ptbhmm_scaling", "ptbhmm_int16_us", "PTBHMM, left-right, 16 bit", GREEN),
    )
    for name, key, label, color in lines:
        axes.loglog(details[name]["num_states"], details[name][key], "o-", color=color, label=label, markersize=4)
    axes.set(xlabel="number of states N", ylabel="µs for 1000 frames of one model")
    axes.set_xticks(details["ptbhmm_scaling"]["num_states"], details["ptbhmm_scaling"]["num_states"])
    axes.minorticks_off()
    axes.grid(alpha=0.25)
    axes.legend(fontsize=8, frameon=False)
    save(figure, path)


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--study", type=Path, help="result of the study ptbhmm-parity")
    parser.add_argument("--bench", type=Path, help="report of the benches")
    parser.add_argument("--out", type=Path, default=IMAGES, help="folder to draw into")
    arguments = parser.parse_args()
    draw_forms(arguments.out / "ptbhmm_forms.svg")
    draw_structures(arguments.out / "ptbhmm_structures.svg")
    if arguments.study:
        draw_parity(arguments.out / "ptbhmm_parity.svg", json.loads(arguments.study.read_text()))
    if arguments.bench:
        draw_scaling(arguments.out / "ptbhmm_scaling.svg", json.loads(arguments.bench.read_text()))


if __name__ == "__main__":
    main()
