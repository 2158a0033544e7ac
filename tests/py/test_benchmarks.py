# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The benches run, check their answers against the peers', and report what they measured."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

RUN_ALL = Path(__file__).resolve().parents[2] / "benchmarks" / "run_all.py"


def run(*arguments: str) -> str:
    done = subprocess.run([sys.executable, str(RUN_ALL), *arguments], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-3000:]
    return done.stdout


@pytest.mark.slow
def test_every_bench_agrees_with_its_peer_and_is_reported(tmp_path: Path) -> None:
    report = tmp_path / "bench.json"
    table = run("--quick", "--json", str(report))
    written = json.loads(report.read_text())
    assert written["machine"] and written["measured"]["version"]
    if "commit" in written["measured"]:  # in a checkout
        assert written["measured"]["date"] and "benchmarks" in written["sources"]
    entries = written["benches"]
    listed = [line.split("\t")[0] for line in run("--list").splitlines()]
    skipped = [line.split()[0] for line in table.splitlines() if " skipped: " in line]
    assert [entry["name"] for entry in entries] == [name for name in listed if name not in skipped]
    for entry in entries:
        assert set(entry) == {"name", "what", "ours", "peer", "unit", "peer_name", "ratio", "details"}
        assert entry["ratio"] == pytest.approx(entry["peer"] / entry["ours"]) and entry["ratio"] > 0
        assert entry["what"].endswith(".") and entry["name"] in table


def test_the_page_knows_every_bench(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(RUN_ALL.parents[1] / "tools"))
    import readme_tables

    assert sorted(readme_tables.bench_names()) == sorted(line.split("\t")[0] for line in run("--list").splitlines())


def test_a_bench_without_its_recordings_is_skipped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HRI_DATA", str(tmp_path))
    report = tmp_path / "bench.json"
    table = run("--quick", "--only", "train_digits", "train_commands_both", "--json", str(report))
    assert [line.split()[1] for line in table.splitlines()[1:]] == ["skipped:", "skipped:"]
    assert "fsdd/recordings" in table and json.loads(report.read_text())["benches"] == []


def test_training_is_timed_on_recordings(tmp_path: Path, spoken: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "fsdd").mkdir()
    (tmp_path / "fsdd" / "recordings").symlink_to(spoken)
    monkeypatch.setenv("HRI_DATA", str(tmp_path))
    report = tmp_path / "bench.json"
    table = run("--quick", "--only", "train_digits", "--json", str(report))
    (entry,) = json.loads(report.read_text())["benches"]
    assert "60 s budget" in table and entry["peer"] == 60 and entry["ours"] > 0
    assert entry["details"]["recordings"] == 6, "one of each word by each speaker"
