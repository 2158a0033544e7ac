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
    return subprocess.run([sys.executable, str(RUN_ALL), *arguments], capture_output=True, text=True, check=True).stdout


@pytest.mark.slow
def test_every_bench_agrees_with_its_peer_and_is_reported(tmp_path: Path) -> None:
    report = tmp_path / "bench.json"
    table = run("--quick", "--json", str(report))
    written = json.loads(report.read_text())
    assert written["machine"] and written["measured"]["version"]
    entries = written["benches"]
    listed = [line.split("\t")[0] for line in run("--list").splitlines()]
    assert [entry["name"] for entry in entries] == listed
    for entry in entries:
        assert set(entry) == {"name", "what", "ours", "peer", "unit", "peer_name", "ratio", "details"}
        assert entry["ratio"] == pytest.approx(entry["peer"] / entry["ours"]) and entry["ratio"] > 0
        assert entry["what"].endswith(".") and entry["name"] in table
