# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Kept results: what they say of themselves, when they are out of date, and how they are verified."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from hri.core.errors import InvalidArgument
from hri.studies import kept, provenance
from hri.studies.registry import Layout, Study
from hri.studies.rendering import Pivot, markdown_table, pivot
from hri.studies.tables import statistics

ROOT = Path(__file__).resolve().parents[2]
PEOPLE = ("ann", "bob", "cem")


def shares(bonus: float = 0.0, folds: int | None = None, kind: tuple[str, ...] = ("near", "far")) -> dict[str, Any]:
    values = {"near": 0.8, "far": 0.5}
    rows = [
        {"kind": name, **statistics({who: values[name] + 0.1 * n / 3 + bonus for n, who in enumerate(PEOPLE[:folds])})}
        for name in kind
    ]
    return {"rows": rows, "passed": None}


def study(bonus: float = 0.0) -> Study:
    def run(data_dir: Path, progress: Any, **chosen: Any) -> dict[str, Any]:
        return shares(bonus, **chosen)

    return Study(
        "made-up",
        "a study",
        ("clips",),
        "none: a comparison",
        run,
        axes={"kind": ("near", "far")},
        sources=("cpp/signal", "python/evaluation"),
        folds=True,
        quick={"kind": ("far",)},
    )


@pytest.fixture
def data_dir(tmp_path: Path) -> Path:
    (tmp_path / "clips").mkdir()
    (tmp_path / "clips" / "a.wav").write_bytes(b"abc")
    return tmp_path


@pytest.fixture(autouse=True)
def root(monkeypatch: pytest.MonkeyPatch) -> Path:
    """The made-up study stands in a file of the package; a tree without git, as in an archive, has a commit too."""
    monkeypatch.setattr(provenance, "rooms_of", lambda study: study.sources)
    monkeypatch.setattr(kept, "source_root", lambda: ROOT)
    monkeypatch.setattr(kept, "newer_than_build", lambda root: [])
    monkeypatch.setattr(kept, "describe_code", lambda root: {"version": "1.0", "commit": "0123456789"})
    return ROOT


def measure(data_dir: Path, **arguments: Any) -> dict[str, Any]:
    return kept.measure(study(), data_dir, lambda *progress: None, **arguments)


def test_a_result_names_its_arguments_data_and_code(data_dir: Path) -> None:
    found = measure(data_dir, only={"kind": ["far"]}, folds=2)
    assert found["data"] == {"clips": {"files": 1, "bytes": 3}}
    assert found["measured"] == {"version": "1.0", "commit": "0123456789"}
    assert found["sources"].keys() == {"cpp/signal", "python/evaluation"}
    assert kept.command_of(found) == "hri study made-up --folds 2 --only kind=far"
    assert str(data_dir) not in json.dumps(found)


def test_a_result_is_stale_when_a_room_has_changed(data_dir: Path) -> None:
    found = measure(data_dir)
    assert kept.stale_rooms(ROOT, study(), found) == []
    found["sources"]["cpp/signal"] = "another"
    assert kept.stale_rooms(ROOT, study(), found) == ["cpp/signal"]
    del found["sources"]
    assert kept.stale_rooms(ROOT, study(), found) == ["cpp/signal", "python/evaluation"]


def test_the_same_values_stamp_a_stale_result(data_dir: Path) -> None:
    found = measure(data_dir)
    stamped = kept.verify(study(), {**found, "sources": {}}, data_dir, lambda *progress: None)
    assert stamped["sources"] == found["sources"] and stamped["verified"]["commit"] == "0123456789"
    assert stamped["rows"] == found["rows"]


def test_a_value_that_differs_in_its_last_digit_is_refused(data_dir: Path) -> None:
    found = measure(data_dir)
    with pytest.raises(InvalidArgument, match=r"made-up: far, ann was 0\.5, is 0\.50000"):
        kept.verify(study(1e-12), found, data_dir, lambda *progress: None)


def test_other_recordings_verify_nothing(data_dir: Path) -> None:
    found = measure(data_dir)
    (data_dir / "clips" / "b.wav").write_bytes(b"d")
    with pytest.raises(InvalidArgument, match="not those that were measured"):
        kept.verify(study(), found, data_dir, lambda *progress: None)


def test_modules_that_are_not_compiled_anew_verify_nothing(data_dir: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    found = measure(data_dir)
    monkeypatch.setattr(kept, "newer_than_build", lambda root: [root / "cpp" / "src" / "signal" / "dwt.cpp"])
    with pytest.raises(InvalidArgument, match=r"cpp/src/signal/dwt\.cpp is newer than the compiled modules"):
        kept.verify(study(), found, data_dir, lambda *progress: None)


def test_a_source_that_is_written_after_the_module_is_newer(tmp_path: Path) -> None:
    (tmp_path / "cpp").mkdir()
    source = tmp_path / "cpp" / "a.cpp"
    source.write_text("")
    assert provenance.newer_than_build(tmp_path) == [source]
    os.utime(source, (0, 0))
    assert provenance.newer_than_build(tmp_path) == []


def test_rounded_results_are_compared_as_rounded(data_dir: Path) -> None:
    rows = [{"kind": "far", "accuracy_mean": 0.533, "accuracy_std": 0.027}]
    found = {**measure(data_dir), "rows": rows, "rounded_to": 3}
    kept.verify(study(), found, data_dir, lambda *progress: None)
    with pytest.raises(InvalidArgument, match="far, accuracy_mean"):
        kept.verify(study(0.001), found, data_dir, lambda *progress: None)


def test_comments_do_not_count_and_code_does(tmp_path: Path) -> None:
    def text(name: str, content: str) -> str:
        (tmp_path / name).write_text(content)
        return provenance.normalised(tmp_path / name)

    cpp = text("a.cpp", '#include "a.hpp"\n// why\nint f() { /* so */ return 1; }\n')
    assert cpp == text("b.cpp", "int f() {\n  return 1;\n}\n") == "int f() { return 1; }"
    assert cpp != text("c.cpp", "int f() { return 2; }")
    assert text("d.cpp", 'auto x = "//";') == 'auto x = "//";'
    python = text("a.py", '"""Doc."""\ndef f():\n    """Doc."""\n    return 1  # so\n')
    assert python == text("b.py", "def f():\n    return 1\n") != text("c.py", "def f():\n    return 2\n")


def test_every_study_names_rooms_that_are_there(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.undo()
    from hri.studies import STUDIES

    for found in STUDIES.values():
        rooms = provenance.hash_rooms(ROOT, found)
        assert len(rooms) > 1, f"{found.name} depends on nothing but itself"
        assert set(found.quick) <= set(found.axes), found.name
    with pytest.raises(InvalidArgument, match="cpp/nowhere"):
        provenance.hash_rooms(ROOT, Study("x", "", (), "", study().run, Layout(), sources=("cpp/nowhere",)))


def test_a_pivot_spreads_an_axis_and_refuses_what_it_cannot_show() -> None:
    rows = shares()["rows"]
    across = pivot(rows, Layout(), Pivot(columns="kind", names={"near": "at 1 m"}))
    assert across == [["at 1 m", "far"], ["83.3 ± 2.7", "53.3 ± 2.7"]]
    assert pivot(rows, Layout(), Pivot(where={"kind": ["far"]}, spread=False, digits=0))[1] == ["53"]
    assert markdown_table(across).splitlines()[1] == "| --- | --- |"
    with pytest.raises(InvalidArgument, match="no axis colour; there are: kind"):
        pivot(rows, Layout(), Pivot(columns="colour"))
    with pytest.raises(InvalidArgument, match="several rows for one cell"):
        pivot([*rows, *rows], Layout(), Pivot(columns="kind"))
    more = [{**row, "right_mean": row["accuracy_mean"] / 2} for row in rows]
    of_right = pivot(more, Layout(), Pivot(columns="kind", measures=("right",), digits=0))
    assert of_right == [["near", "far"], ["42", "27"]]
    with pytest.raises(InvalidArgument, match="several measures for one cell: accuracy, right"):
        pivot(more, Layout(), Pivot(columns="kind", measures=("accuracy", "right")))


def test_tables_of_the_documentation_are_those_of_the_results() -> None:
    done = subprocess.run(
        [sys.executable, ROOT / "tools" / "generate_tables.py", "--check", "--tables"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
