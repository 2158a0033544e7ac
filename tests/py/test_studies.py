# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Studies as commands: what they write, and each of them whole on a small made-up data folder."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import cv2
import numpy as np
import pytest

from conftest import RATE_HZ
from hri import _native, studies
from hri.errors import InvalidArgument
from hri.studies import noise, tables
from hri.studies.registry import Layout


@pytest.fixture(scope="module")
def data_dir(tmp_path_factory: pytest.TempPathFactory, spoken: Path) -> Path:
    """The layout of the recordings: tones for words, and noises."""
    folder = tmp_path_factory.mktemp("data")
    (folder / "fsdd").mkdir()
    (folder / "fsdd" / "recordings").symlink_to(spoken)
    (folder / "noise").mkdir()
    rng = np.random.default_rng(0)
    for file in noise.NOISES.values():
        hiss = (0.1 * rng.standard_normal(3 * RATE_HZ)).astype("f4")
        _native.write_wav_pcm16(str(folder / "noise" / file), hiss, RATE_HZ)
    return folder


ROWS = [
    {"features": "mfcc", "snr_db": snr_db, **tables.statistics({"ann": 0.5 + snr_db / 100, "bob": 0.7})}
    for snr_db in (20, 10)
] + [{"features": "hfcc", "snr_db": 10, **tables.statistics({"ann": 1.0, "bob": 0.8})}]
RESULT = {"study": "made-up", "target": "to be shown", "passed": True, "rows": ROWS}


def test_statistics_are_over_persons() -> None:
    found = tables.statistics({"ann": 0.5, "bob": 0.7, "cem": 0.9})
    assert found["accuracy_mean"] == pytest.approx(0.7)
    assert found["accuracy_std"] == pytest.approx(np.std([0.5, 0.7, 0.9]))
    assert found["per_fold"] == {"ann": 0.5, "bob": 0.7, "cem": 0.9}


def test_a_table_spreads_one_axis_over_its_columns() -> None:
    assert tables.table(RESULT, Layout(columns="snr_db")) == [
        ["features", "snr_db 20", "snr_db 10"],
        ["mfcc", "70.0 ± 0.0", "65.0 ± 5.0"],
        ["hfcc", "", "90.0 ± 10.0"],
    ]
    text = tables.markdown(RESULT, Layout(columns="snr_db"))
    assert "target: to be shown (met)" in text and "| mfcc | 70.0 ± 0.0 | 65.0 ± 5.0 |" in text


def test_the_csv_holds_every_fold_in_full() -> None:
    rows = list(csv.DictReader(tables.csv_text(RESULT, Layout()).splitlines()))
    assert [row["features"] for row in rows] == ["mfcc", "mfcc", "hfcc"]
    assert float(rows[1]["per_fold: ann"]) == 0.6 and float(rows[1]["accuracy_mean"]) == pytest.approx(0.65)


def test_a_result_without_rows_is_shown_by_its_parts() -> None:
    result = {"accuracy_mean": 0.5, "accuracy_std": 0.1, "dark": {"hmm": {"accuracy_mean": 0.25, "folds": [1]}}}
    assert tables.table(result, Layout()) == [["part", "accuracy %"], ["all", "50.0 ± 10.0"], ["dark / hmm", "25.0"]]


@pytest.mark.parametrize("layout", [Layout(x="snr_db"), Layout(panel="features"), Layout(x="features", panel="snr_db")])
def test_pictures_are_drawn(tmp_path: Path, layout: Layout) -> None:
    studies.draw(RESULT, layout, tmp_path / "picture.png")
    picture = cv2.imread(str(tmp_path / "picture.png"))
    assert picture is not None and picture.std() > 5


def test_a_study_writes_table_picture_and_json(hri, data_dir: Path, tmp_path: Path) -> None:
    out = tmp_path / "results"
    only = ("--only", "front_end=plain", "--only", "noise=white,tap")
    result = hri("study", "fsdd-noise", "--data", data_dir, "--out", out, *only)
    assert result.code in (0, 1)
    assert sorted(path.name for path in out.iterdir()) == [f"fsdd-noise.{end}" for end in ("csv", "json", "md", "png")]
    found = json.loads((out / "fsdd-noise.json").read_text())
    assert len(found["rows"]) == 2 * 2 * 5 and found["passed"] is (result.code == 0)
    assert "| plain | noisy | tap |" in (out / "fsdd-noise.md").read_text()
    clean = [row for row in found["rows"] if row["snr_db"] == "clean"]
    assert min(row["accuracy_mean"] for row in clean) >= 0.9
    white = {
        row["training"]: row["accuracy_mean"] for row in found["rows"] if (row["noise"], row["snr_db"]) == ("white", 10)
    }
    assert found["passed_by_training"] == {name: white[name] >= noise.TARGETS[name] for name in noise.TRAINING}


def test_a_part_of_a_study_without_its_target_is_no_miss(data_dir: Path) -> None:
    study = studies.get_study("fsdd-noise")
    only = {"front_end": ["plain"], "training": ["clean"], "noise": ["pink"]}
    first, second = (studies.run_study(study, data_dir, lambda *progress: None, only) for _ in range(2))
    assert first["passed"] is None and first == second
    with pytest.raises(InvalidArgument, match="no axis 'speaker'; there are: front_end, training, noise"):
        studies.run_study(study, data_dir, lambda *progress: None, {"speaker": ["theo"]})
