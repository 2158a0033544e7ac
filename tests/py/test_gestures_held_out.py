# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What the training of gestures saw on recordings held out."""

from __future__ import annotations

import json
import shutil
from copy import copy
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hri import GestureRecognizer
from hri.core.errors import FormatError


def rows(kind: int, seed: int) -> np.ndarray:
    """Features of a still hand of one of several shapes."""
    shape = np.random.default_rng(seed).uniform(size=6) + 2 * np.eye(6)[kind]
    return np.concatenate((shape, np.full(3, 0.5)))[None].astype("f4")


def trained(kinds: dict[str, int], **options: Any) -> GestureRecognizer:
    """A recogniser of gestures of these shapes, twenty of each by five persons."""
    labels = [label for label in kinds for _ in range(20)]
    persons = [f"p{take % 5}" for _ in kinds for take in range(20)]
    samples = [rows(kinds[label], seed) for seed, label in enumerate(labels)]
    return GestureRecognizer(**options).fit_features(samples, labels, groups=persons)


def test_gestures_say_how_they_did_on_people_held_out(tmp_path: Path) -> None:
    signs = trained({"fist": 0, "ok": 1, "palm": 2, "point": 3, "stop": 2})
    found = signs.held_out
    assert found is not None and found.labels == ("fist", "ok", "palm", "point", "stop")
    assert found.confusion.dtype == np.int64 and found.confusion.sum(axis=1).tolist() == [20] * 5
    assert found.num_samples == 100 and found.accuracy == np.trace(found.confusion) / 100
    assert [(pair.first, pair.second) for pair in found.confused_pairs] == [("palm", "stop")]
    assert found.num_others == 40 and found.false_accept_rate is not None and 0 < found.false_accept_rate < 1
    most = signs.options.false_reject_rate + 1 / np.trace(found.confusion)  # the threshold lies between scores
    assert 0 <= found.false_reject_rate <= most

    signs.save(tmp_path / "signs.hri")
    loaded = GestureRecognizer.load(tmp_path / "signs.hri").held_out
    assert loaded is not None and loaded.to_dict() == found.to_dict() and (loaded.confusion == found.confusion).all()
    more = copy(signs).add_gesture_features("new", [rows(4, 200 + take) for take in range(3)])
    assert "new" in more.classes_ and more.held_out is not None and more.held_out.to_dict() == found.to_dict()


def test_what_was_not_measured_is_none() -> None:
    for signs in (trained({"fist": 0, "palm": 1}), trained({"fist": 0, "palm": 1, "stop": 2}, model="svm")):
        found = signs.held_out
        assert found is not None and found.num_samples > 0
        assert found.num_others == 0 and found.false_accept_rate is None
    one_each = GestureRecognizer().fit_features([rows(0, 0), rows(1, 1)], ["fist", "palm"])
    assert not one_each.is_calibrated and one_each.held_out is None


@pytest.mark.parametrize(
    ("field", "value"), [("num_others", -1), ("num_others", 10**9), ("num_others", 3), ("false_reject_rate", 2)]
)
def test_a_report_that_no_training_writes_is_refused(tmp_path: Path, field: str, value: int) -> None:
    file = trained({"fist": 0, "palm": 1}).to_model_file()
    file.set_integer(f"held_out.{field}", value)
    (tmp_path / "signs.hri").write_bytes(file.to_bytes())
    with pytest.raises(FormatError, match=r"signs\.hri.*held_out"):
        GestureRecognizer.load(tmp_path / "signs.hri")


def test_train_and_info_print_it_and_name_what_is_confused(hri: Any, signed: Path, tmp_path: Path) -> None:
    folder, model, out = tmp_path / "signed", tmp_path / "signs.hri", tmp_path / "train.json"
    for label, name in (("1", "1"), ("2", "2"), ("1", "one")):  # the same pictures by two names
        shutil.copytree(signed / label, folder / name)
    command = ("train", "gesture", "--data", folder, "--pattern", "{label}/{person}_still1.jpg", "--out", model)
    done = hri(*command, "--source", "silhouettes", "--json", out)
    assert done.code == 0, done.err
    found = GestureRecognizer.load(model).held_out
    assert found is not None
    assert "of 12 recordings held out in training" in done.err
    assert f"{100 * found.accuracy:.1f} % are right" in done.err
    assert "'1' and 'one' are hard to distinguish" in done.err and "choose another gesture for one of them" in done.err
    assert json.loads(out.read_text())["held_out"] == found.to_dict()

    shown = hri("info", model)
    assert f"held_out accuracy\t{100 * found.accuracy:.1f} %\n" in shown.out
    assert f"held_out num_others\t{found.num_others}\n" in shown.out and "held_out confused\t1 one " in shown.out
    as_json = json.loads(hri("info", model, "--json", "-").out)["held_out"]
    assert as_json == {**found.to_dict(), "labels": ["1", "2", "one"]}
