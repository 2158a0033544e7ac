# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The file beside a model that says which of its words synthetic voices said."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from hri.core.errors import FormatError, InvalidArgument, IoError
from hri.io import SpokenWords

WORDS = SpokenWords("hi", {"ulta": "उल्टा", "sideways": "sideways"}, 3, 5)


@pytest.fixture
def model(tmp_path: Path) -> Path:
    path = tmp_path / "words.hri"
    path.write_bytes(b"a model")
    return path


def test_what_was_said_is_kept_beside_the_model(model: Path) -> None:
    assert SpokenWords.read_beside(model) is None
    path = WORDS.write_beside(model)
    assert path.name == "words.hri.spoken.json" and "उल्टा" in path.read_text(encoding="utf-8")
    assert SpokenWords.read_beside(model) == WORDS
    SpokenWords.remove_beside(model)
    SpokenWords.remove_beside(model)
    assert SpokenWords.read_beside(model) is None
    with pytest.raises(IoError):
        WORDS.write_beside(model.with_name("gone.hri"))
    path.mkdir()
    with pytest.raises(IoError, match=r"words\.hri\.spoken\.json"):
        SpokenWords.remove_beside(model)


def test_it_belongs_to_one_model(model: Path) -> None:
    WORDS.write_beside(model)
    model.write_bytes(b"another model")
    with pytest.raises(FormatError, match="belongs to another model"):
        SpokenWords.read_beside(model)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda v: v.update(kind="song"), "no list of spoken words"),
        (lambda v: v.update(version=2), "version 2"),
        (lambda v: v.pop("seed"), "no field 'seed'"),
        (lambda v: v.update(more=1), "'more' that is not known"),
        (lambda v: v.update(words=["ulta"]), "words texts by label"),
        (lambda v: v.update(words={"ulta": 3}), "words texts by label"),
        (lambda v: v.update(words={}), "no word to be said"),
        (lambda v: v.update(words={"ulta": "a" * 201}), "1 to 200 letters"),
        (lambda v: v.update(words={"": "ulta"}), "1 to 200 letters"),
        (lambda v: v.update(words={"ulta": "a\nb"}), "1 to 200 letters"),
        (lambda v: v.update(language="../../voice"), "no name of a language"),
        (lambda v: v.update(language="-w"), "no name of a language"),
        (lambda v: v.update(voices=0), "0 voices"),
        (lambda v: v.update(voices=10**9), "clips at most"),
        (lambda v: v.update(voices=True), "voices and seed numbers"),
        (lambda v: v.update(seed=-1), "seed must lie in"),
        (lambda v: v.update(seed=2**64), "seed must lie in"),
    ],
)
def test_hostile_files_are_refused(model: Path, change: Callable[[dict[str, Any]], Any], message: str) -> None:
    path = WORDS.write_beside(model)
    values = json.loads(path.read_text(encoding="utf-8"))
    change(values)
    path.write_text(json.dumps(values), encoding="utf-8")
    with pytest.raises(FormatError, match=message):
        SpokenWords.read_beside(model)


@pytest.mark.parametrize("data", [b"", b"[]", b"\xff\xfe", b"[" * 100_000, b'{"kind": NaN}', b" " * (2 << 20)])
def test_what_is_no_such_file_is_refused(model: Path, data: bytes) -> None:
    WORDS.write_beside(model).write_bytes(data)
    with pytest.raises(FormatError):
        SpokenWords.read_beside(model)


def test_arguments_are_checked() -> None:
    with pytest.raises(InvalidArgument, match="language"):
        SpokenWords("en+f3", {"a": "a"})
    with pytest.raises(InvalidArgument, match="clips at most"):
        SpokenWords("en", {"a": "a", "b": "b"}, 5001)
