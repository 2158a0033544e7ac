# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Kept results: what they say of themselves, when they are out of date, and how they are verified."""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from hri.core.errors import InvalidArgument
from hri.studies import kept, provenance, reached
from hri.studies.registry import Layout, Study
from hri.studies.rendering import Pivot, markdown_table, pivot
from hri.studies.tables import by_fold, further_statistics, statistics

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
        sources=("cpp/signal",),
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
    monkeypatch.setattr(provenance, "module_of", lambda study: "hri.evaluation.noise")
    monkeypatch.setattr(kept, "source_root", lambda: ROOT)
    monkeypatch.setattr(kept, "newer_than_build", lambda root: [])
    monkeypatch.setattr(kept, "describe_code", lambda root: {"version": "1.0", "commit": "0123456789"})
    return ROOT


def measure(data_dir: Path, **arguments: Any) -> dict[str, Any]:
    return kept.measure(study(), data_dir, lambda *progress: None, **arguments)


def test_a_result_names_its_arguments_data_and_code(data_dir: Path) -> None:
    found = measure(data_dir, only={"kind": ["far"]}, folds=2)
    assert found["data"]["clips"].items() >= {"files": 1, "bytes": 3}.items() and found["data"]["clips"]["sha256"]
    assert found["measured"] == {"version": "1.0", "commit": "0123456789"}
    assert found["sources"].keys() >= {"cpp/signal", "python/evaluation"}
    assert kept.command_of(found) == "hri study made-up --folds 2 --only kind=far"
    assert str(data_dir) not in json.dumps(found)


def test_a_result_is_stale_when_a_room_has_changed(data_dir: Path) -> None:
    found = measure(data_dir)
    assert kept.stale_rooms(ROOT, study(), found) == []
    found["sources"]["cpp/signal"] = "another"
    assert kept.stale_rooms(ROOT, study(), found) == ["cpp/signal"]
    del found["sources"]
    assert {"cpp/signal", "python/evaluation"} <= set(kept.stale_rooms(ROOT, study(), found))


def test_the_same_values_stamp_a_stale_result(data_dir: Path) -> None:
    found = measure(data_dir)
    stamped = kept.verify(study(), {**found, "sources": {}}, data_dir, lambda *progress: None)
    assert stamped["sources"] == found["sources"] and stamped["verified"]["commit"] == "0123456789"
    assert stamped["rows"] == found["rows"]


def test_a_value_that_differs_by_more_than_rounding_is_refused(data_dir: Path) -> None:
    found = measure(data_dir)
    kept.verify(study(1e-7), found, data_dir, lambda *progress: None)
    with pytest.raises(InvalidArgument, match=r"made-up: far, ann was 0\.5, is 0\.50001"):
        kept.verify(study(1e-5), found, data_dir, lambda *progress: None)


@pytest.mark.parametrize(
    ("then", "now", "same"),
    [
        (1000.0, 1000.0005, True),
        (1000.0, 1000.002, False),
        (6.08015e-05, 6.07967e-05, True),
        (6.0e-05, 6.2e-05, False),
        (3, 4, False),
        (3000000, 3000001, False),
        (math.nan, math.nan, True),
        (math.inf, -math.inf, False),
        (0.0, math.nan, False),
        (True, False, False),
        ("a", "b", False),
        ({"a": [0.5, 1]}, {"a": [0.5 + 1e-9, 1]}, True),
        ({"a": [0.5, 1]}, {"a": [0.5, 2]}, False),
        ({"a": [0.5]}, {"a": [0.5, 0.5]}, False),
        ({"a": 0.5}, {"b": 0.5}, False),
    ],
)
def test_counts_are_compared_to_the_last_digit_and_other_numbers_to_a_millionth(
    then: object, now: object, same: bool
) -> None:
    row = {"kind": "far", "value_mean": then}
    again = {"rows": [{**row, "value_mean": now}]}
    if same:
        kept.compare("x", {"rows": [row]}, again)
    else:
        with pytest.raises(InvalidArgument, match="value_mean was"):
            kept.compare("x", {"rows": [row]}, again)


def several(right: float = 0.6, pooled: float = 0.7, folds: int | None = None) -> dict[str, Any]:
    """A row of which further measures have folds, or none, and one that has no folds at all."""
    values = {who: right + 0.1 * n for n, who in enumerate(PEOPLE[:folds])}
    row = {"kind": "far", **statistics(dict.fromkeys(values, 0.5)), **further_statistics(values, "right")}
    row |= {"calibration_mean": pooled, **by_fold("calibration", values), "counts": {"words": 10 * pooled}}
    return {"rows": [row, {"kind": "alone", "accuracy_mean": pooled}]}


def test_every_measure_that_has_folds_is_compared() -> None:
    result = several()
    assert set(result["rows"][0]["right_per_fold"]) == set(PEOPLE) and result["rows"][0]["right_mean"]
    kept.compare("x", result, several(pooled=0.1, folds=1), limited=True)  # a pooled measure says nothing of one fold
    with pytest.raises(InvalidArgument, match=r"x: far, right, ann was 0\.6, is 0\.61"):
        kept.compare("x", result, several(right=0.61, folds=1), limited=True)


def test_an_option_that_has_changed_is_refused() -> None:
    result = several() | {"options": {"states": 8, "front": {"shift_ms": 10.0, "old": 1}}}
    kept.compare("x", result, several() | {"options": {"states": 8, "front": {"shift_ms": 10.0, "new": True}}})
    kept.compare("x", several(), result)
    with pytest.raises(InvalidArgument, match=r"x: option front\.shift_ms was 10\.0, is 5\.0"):
        kept.compare("x", result, several(folds=1) | {"options": {"front": {"shift_ms": 5.0}}}, limited=True)


def test_a_row_measured_whole_is_compared_in_all_its_measures() -> None:
    result = several()
    kept.compare("x", result, several())
    with pytest.raises(InvalidArgument, match=r"x: far, calibration_mean was 0\.7, is 0\.1"):
        kept.compare("x", result, several(pooled=0.1), limited=True)
    same = several(pooled=0.1)
    same["rows"][0] = dict(result["rows"][0])
    kept.compare("x", result, same, limited=True)
    with pytest.raises(InvalidArgument, match=r"x: alone, accuracy_mean was 0\.7, is 0\.1"):
        kept.compare("x", result, same)
    del same["rows"][1], same["rows"][0]["right_mean"]
    with pytest.raises(InvalidArgument, match="right_mean is no longer measured"):
        kept.compare("x", result, same)


def test_a_result_with_the_folds_of_one_measure_is_compared_in_that_one() -> None:
    older = several()
    for measure in ("right", "calibration"):
        del older["rows"][0][f"{measure}_per_fold"]
    kept.compare("x", older, several(right=0.61, folds=1), limited=True)
    with pytest.raises(InvalidArgument, match="far, right_mean was"):
        kept.compare("x", older, several(right=0.61))


def test_other_recordings_verify_nothing(data_dir: Path) -> None:
    found = measure(data_dir)
    (data_dir / "clips" / "a.wav").write_bytes(b"abd")  # as many bytes
    with pytest.raises(InvalidArgument, match="not those that were measured"):
        kept.verify(study(), found, data_dir, lambda *progress: None)
    del found["data"]["clips"]["sha256"]  # as in results from before there was a hash
    stamped = kept.verify(study(), found, data_dir, lambda *progress: None)
    assert stamped["data"]["clips"]["sha256"]
    (data_dir / "clips" / "a.wav").rename(data_dir / "clips" / "b.wav")
    with pytest.raises(InvalidArgument, match="not those that were measured"):
        kept.verify(study(), stamped, data_dir, lambda *progress: None)


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
    from hri.studies import _MODULES

    for module in _MODULES:
        for found in module.STUDIES:
            assert provenance.module_of(found) == module.__name__, (
                "what it reaches is read from the module it stands in"
            )
            rooms = provenance.hash_rooms(ROOT, found)
            assert "python/studies" in rooms and len(rooms) > 2, f"{found.name} depends on nothing but itself"
            assert all(room.startswith("cpp/") for room in found.sources), found.name
            assert set(found.quick) <= set(found.axes), found.name
    with pytest.raises(InvalidArgument, match="cpp/nowhere"):
        provenance.hash_rooms(ROOT, Study("x", "", (), "", study().run, Layout(), sources=("cpp/nowhere",)))


def reached_by(name: str) -> set[str]:
    from hri.studies import STUDIES

    found = reached.reached_files(ROOT, [provenance.module_of(STUDIES[name])])
    return {path.relative_to(ROOT / "python" / "hri").as_posix() for path in found}


def test_a_study_depends_on_what_its_module_reaches(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.undo()
    spoken = reached_by("unknown-words")
    assert {"studies/unknown_words.py", "studies/word_features.py", "datasets/folds.py", "media/audio.py"} <= spoken
    assert {f"recognition/word/{name}" for name in ("filler_words.npz", "embedding_filler_words.npz")} <= spoken
    assert "studies/webcam_conditions.toml" in reached_by("webcam-conditions") - spoken
    assert not {
        name for name in spoken if name.startswith(("cli/", "serve/", "page/", "robot/", "session/", "vision/"))
    }
    assert not {"studies/registry.py", "studies/rendering.py", "studies/kept.py"} & spoken


def test_every_file_of_data_is_named_beside_it() -> None:
    package = ROOT / "python" / "hri"
    data = [path for path in package.rglob("*") if path.suffix in (".npz", ".onnx", ".toml")]
    for path in data:
        modules = [f"hri.{'.'.join(m.relative_to(package).with_suffix('').parts)}" for m in path.parent.glob("*.py")]
        assert path in reached.reached_files(ROOT, modules), f"{path}: no module of its folder names it"
    assert len(data) >= 8


def test_imports_are_followed_by_name_in_functions_too_and_not_outside(tmp_path: Path) -> None:
    package = tmp_path / "python" / "hri"
    for name, text in {
        "__init__.py": "import hri.page\n",
        "_native.pyi": "",
        "studies/own.py": "from hri.tools import used\ndef f():\n    from hri import late\n",
        "tools/__init__.py": "from hri.tools.one import f as used\nfrom hri.tools.two import other\n",
        "tools/one.py": "from hri._native import x\nfrom hri import _native\nNAME = 'table.npz'\nimport hri.page\n",
        "tools/two.py": "",
        "tools/table.npz": "1",
        "tools/other.npz": "1",
        "late/__init__.py": "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from hri.tools import two\n",
        "page/__init__.py": "",
    }.items():
        (package / name).parent.mkdir(parents=True, exist_ok=True)
        (package / name).write_text(text)

    def names() -> set[str]:
        found = reached.reached_files(tmp_path, ["hri.studies.own"])
        return {path.relative_to(package).as_posix() for path in found}

    assert names() == {"studies/own.py", "tools/one.py", "tools/table.npz", "late/__init__.py"}

    def hashes() -> dict[str, str]:
        return provenance.hash_python(tmp_path, reached.reached_files(tmp_path, ["hri.studies.own"]))

    before = hashes()
    (package / "tools" / "two.py").write_text("x = 1\n")
    assert hashes() == before
    (package / "tools" / "table.npz").write_bytes(b"another")
    assert {room for room, now in hashes().items() if before[room] != now} == {"python/tools"}


def test_code_that_is_in_no_commit_verifies_nothing(data_dir: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    found = measure(data_dir)
    monkeypatch.setattr(kept, "describe_code", lambda root: {"version": "1.0", "commit": "0123456789+"})
    with pytest.raises(InvalidArgument, match="changes that are not in a commit; commit them first"):
        kept.verify(study(), found, data_dir, lambda *progress: None)


def test_results_do_not_count_as_changes_and_commits_are_looked_up(tmp_path: Path) -> None:
    def git(*arguments: str) -> None:
        who = ("-c", "user.name=a", "-c", "user.email=a@b.c")
        subprocess.run(["git", *who, *arguments], cwd=tmp_path, check=True, capture_output=True)

    assert provenance.history_of(tmp_path) is None
    git("init")
    for name in ("python/a.py", "docs/results/a.json"):
        (tmp_path / name).parent.mkdir(parents=True)
        (tmp_path / name).write_text("1")
    git("add", ".")
    git("commit", "-m", "first")
    (tmp_path / "docs" / "results" / "a.json").write_text("2")
    (tmp_path / "python" / "_native.so").write_text("")
    commit = provenance.describe_code(tmp_path)["commit"]
    history = provenance.history_of(tmp_path)
    assert history is not None and provenance.fault_of_commit(commit, history) == ""
    assert "is no commit" in provenance.fault_of_commit("1a68fe3000", history)
    (tmp_path / "python" / "a.py").write_text("2")
    assert "in no commit" in provenance.fault_of_commit(provenance.describe_code(tmp_path)["commit"], history)
    git("clone", "--depth", "1", f"file://{tmp_path}", "shallow")
    git("-C", "shallow", "fetch", "--unshallow")
    assert provenance.history_of(tmp_path / "shallow") == history


def test_the_page_shows_the_commit_verified_and_lost_ones_are_refused(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.syspath_prepend(str(ROOT / "tools"))
    import generate_tables

    result = {"study": "fsdd", "arguments": {"only": {}}, "data": {}, "rows": [], "measured": {"commit": "aa+"}}
    assert generate_tables.caption(result, False) == "<sub>`hri study fsdd`, measured at `aa+`</sub>"
    stale = generate_tables.caption(result, True)
    assert stale == "<sub>`hri study fsdd`, measured at `aa+`, and not since the code has changed</sub>"
    assert generate_tables.without_marks(stale) == generate_tables.caption(result, False)
    verified = {**result, "verified": {"commit": "bb"}}
    assert generate_tables.caption(verified, False) == "<sub>`hri study fsdd`, verified at `bb`</sub>"
    for name, content in (("a", result), ("b", verified), ("c", {**result, "verified": {"commit": "cc"}})):
        (tmp_path / f"{name}.json").write_text(json.dumps(content))
    monkeypatch.setattr(generate_tables, "ROOT", tmp_path)
    monkeypatch.setattr(generate_tables, "RESULTS", tmp_path)
    monkeypatch.setattr(generate_tables, "history_of", lambda root: ["bbbb"])
    monkeypatch.setattr(generate_tables, "stale_results", lambda: {})
    assert {path.name for path in generate_tables.lost_commits()} == {"a.json", "c.json"}
    # What is said to be older than the code need not be verified at a commit of it, but in the README.
    monkeypatch.setattr(generate_tables, "stale_results", lambda: {tmp_path / "a.json": "", tmp_path / "fsdd.json": ""})
    assert {path.name for path in generate_tables.lost_commits()} == {"c.json"}
    assert {path.name for path in generate_tables.stale_headlines()} == {"fsdd.json"}
    monkeypatch.setattr(generate_tables, "history_of", lambda root: None)
    assert generate_tables.lost_commits() == {} and "not checked" in capsys.readouterr().err


def test_benches_are_stale_where_their_code_differs_and_those_without_a_figure_are_listed(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.syspath_prepend(str(ROOT / "tools"))
    import generate_tables
    import readme_tables

    hashes = provenance.hash_benches(ROOT)
    assert hashes.keys() >= {"benchmarks", "cpp/...", "python/recognition/word", "python/signal"}
    entry = {"name": "dwt1d", "what": "A transform.", "peer_name": "PyWavelets", "ratio": 2.0}
    report = {"measured": {"commit": "aa", "date": "2026-01-31"}, "machine": "x", "benches": [entry], "sources": hashes}
    monkeypatch.setattr(generate_tables, "RESULTS", tmp_path)
    (tmp_path / "bench.json").write_text(json.dumps(report))
    assert generate_tables.stale_benches() == ""
    page = readme_tables.all_benches(tmp_path)
    assert "`aa` of 2026-01-31" in page and "Without a kept figure: `mfcc`" in page and "`train_digits`" in page
    (tmp_path / "bench.json").write_text(json.dumps({**report, "sources": {**hashes, "benchmarks": "other"}}))
    assert generate_tables.stale_benches() == "benchmarks"


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
