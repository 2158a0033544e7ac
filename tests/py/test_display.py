# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Objects show themselves in one short line, and as small tables in notebooks; plots return what they drew on."""

from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hri.core.display import html_table, short_repr, summary
from hri.datasets import Dataset
from hri.evaluation import EvaluationItem, EvaluationResult, FoldResult
from hri.fusion import fuse
from hri.media import Audio, Clip
from hri.recognition import Decision, NBest, filler_words
from hri.robot import HOAP2, NAO, gesture_trajectory, load_gestures
from hri.robot.motion.plots import plot_trajectory

LABELS = [f"label{i}" for i in range(40)]


def decision(mode: str = "speech", best: int = 0) -> Decision:
    nbest = tuple(NBest(label, 1 / 40, math.log(1 / 40)) for label in LABELS[best:] + LABELS[:best])
    return Decision(mode, nbest[0].label, "recognised", 0.9, 1.0, nbest)


def result(num_folds: int = 30) -> EvaluationResult:
    items = tuple(EvaluationItem(i, label, decision(best=i)) for i, label in enumerate(LABELS))
    return EvaluationResult(LABELS, [FoldResult(f"person{i}", items) for i in range(num_folds)])


def dataset(root: Path) -> Dataset:
    for i in range(300):
        path = root / f"{'a' if i % 2 else 'b'}_person{i % 3}_{i}.wav"
        path.touch()
    return Dataset.load(root, "speech", "{label}_{person}_{take}.wav")


def shown(root: Path) -> list[Any]:
    found, heard, seen = dataset(root), decision(), decision("gesture", 3)
    evaluated = result()
    return [
        found,
        found.samples[0],
        *found.folds_by_person(),
        heard,
        heard.nbest[0],
        fuse(heard, seen),
        evaluated,
        evaluated.folds[0],
        evaluated.items[0],
        filler_words()[0],
        Audio(np.zeros(160000, np.float32), 16000, ["averaged 2 channels to mono"] * 20),
        Clip([np.zeros((480, 640, 3), np.uint8)] * 90, [i / 30 for i in range(90)], root / "clip.mp4"),
        gesture_trajectory("7"),
        load_gestures()["7"],
        HOAP2,
        NAO,
        HOAP2.base,
    ]


def test_every_object_shows_itself_in_one_short_line(tmp_path: Path) -> None:
    for value in shown(tmp_path):
        text = repr(value)
        assert len(text) < 200 and "\n" not in text, f"{type(value).__name__}: {len(text)} characters"
        assert text.startswith(type(value).__name__)


def test_lines_tell_what_matters(tmp_path: Path) -> None:
    assert repr(dataset(tmp_path)).startswith("Dataset(speech, 300 samples, 2 labels, 3 persons, ")
    assert repr(decision()) == "Decision(speech, 'label0', 0.900, then 'label1' 0.025, 'label2' 0.025)"
    assert repr(result(2)) == "EvaluationResult(accuracy 100.0 % ± 0.0, 80 items, 2 folds, 40 labels)"
    assert repr(Audio(np.zeros(8000, np.float32), 16000)) == "Audio(0.500 s, 16000 Hz)"


def test_notebooks_show_small_tables(tmp_path: Path) -> None:
    heard, seen = decision(), decision("gesture", 3)
    for value in (dataset(tmp_path), heard, fuse(heard, seen), result()):
        text = value._repr_html_()
        assert text.startswith("<table>") and text.count("<tr>") <= 14
    assert "... 28 more" in heard._repr_html_()


def test_tables_escape_what_labels_hold() -> None:
    assert "<script>" not in html_table(("label",), [("<script>",)], "<script>")


def test_long_lines_are_cut_and_empty_parts_left_out() -> None:
    assert summary("Thing", "", None, 0, "x") == "Thing(0, x)"
    assert len(summary("Thing", "x" * 1000)) < 200


def test_short_reprs_follow_the_fields() -> None:
    from dataclasses import dataclass, field

    @dataclass
    @short_repr
    class Thing:
        name: str
        rows: np.ndarray
        many: list[int]
        few: tuple[int, ...]
        hidden: int = field(default=0, repr=False)

    thing = Thing("a", np.zeros((3, 2)), list(range(100)), (1, 2))
    assert repr(thing) == "Thing(name='a', rows=float64[3, 2], many=<100 entries>, few=(1, 2))"


def test_plots_draw_where_they_are_told_and_return_it(tmp_path: Path) -> None:
    figures = pytest.importorskip("matplotlib.figure")
    ax = figures.Figure().subplots()
    evaluated = result(1)
    assert evaluated.plot_confusion(ax=ax) is ax and ax.get_ylabel() == "truth"
    own = evaluated.plot_confusion(tmp_path / "confusion.png")
    assert own is not ax and (tmp_path / "confusion.png").stat().st_size > 1000
    motion = gesture_trajectory("7")
    panels = plot_trajectory(motion)
    assert len(panels) == len(motion.joint_names) and panels[0].get_title() == motion.joint_names[0]
    ax = figures.Figure().subplots()
    assert plot_trajectory(motion, ax=ax) is ax and len(ax.lines) == len(motion.joint_names)
    assert "matplotlib.pyplot" not in sys.modules  # nothing is shown or kept open
