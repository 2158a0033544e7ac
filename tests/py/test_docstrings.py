# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Every example in a docstring runs and prints what it shows."""

from __future__ import annotations

import doctest
import importlib
from pathlib import Path
from typing import Any

import pytest

import hri
from conftest import PERSONS, RATE_HZ, tone_word
from drawn_hands import stills
from hri.io import write_wav_pcm16
from hri.media import write_image

PACKAGE = Path(hri.__file__).parent
SLOPES = {"one": -350.0, "seven": 800.0}
SIGNS = {"one": "tall", "seven": "flat"}


def modules_with_examples() -> list[str]:
    files = [path for path in sorted(PACKAGE.rglob("*.py")) if ">>>" in path.read_text(encoding="utf-8")]
    return [".".join(("hri", *path.relative_to(PACKAGE).with_suffix("").parts)) for path in files]


@pytest.fixture(scope="module")
def shown() -> dict[str, Any]:
    """What examples take as given: recordings of two labels, and recognisers trained on them."""
    rows = [(base_hz, label) for base_hz in PERSONS.values() for label in SLOPES]
    clips = [tone_word(base_hz, SLOPES[label], seed) for seed, (base_hz, label) in enumerate(rows)]
    pictures = [stills(SIGNS[label], seed) for seed, (_, label) in enumerate(rows)]
    labels = [label for _, label in rows]
    return {
        "clips": clips,
        "pictures": pictures,
        "labels": labels,
        "samples": clips[1],
        "picture": pictures[1][0],
        "words": hri.WordRecognizer(num_states=4).fit(clips, labels, sample_rate_hz=RATE_HZ),
        "signs": hri.GestureRecognizer().fit(pictures, labels),
    }


@pytest.mark.parametrize("name", modules_with_examples())
def test_examples_print_what_they_show(
    name: str, shown: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    write_wav_pcm16("seven.wav", shown["samples"], RATE_HZ)
    write_image("seven.jpg", shown["picture"])
    shown["words"].save("words.hri")
    module = importlib.import_module(name)
    given = {key: value for key, value in shown.items() if not hasattr(module, key)}
    result = doctest.testmod(module, extraglobs=given)
    assert result.attempted > 0 and result.failed == 0


ROOMS = (hri.io, hri.signal, hri.features, hri.models, hri.language, hri.vision, hri.recognition)


def undocumented(owner: type) -> list[str]:
    """Public methods and properties without a docstring; what pybind11 writes of a signature is none."""

    def says_nothing(member: Any) -> bool:
        doc = (getattr(member, "__doc__", None) or "").strip()
        return not doc or (not isinstance(member, property) and "->" in doc and len(doc.splitlines()) < 2)

    members = {name: member for name, member in vars(owner).items() if not name.startswith("_")}
    return [
        name
        for name, member in members.items()
        if callable(member) or isinstance(member, property | staticmethod)
        if says_nothing(member)
    ]


@pytest.mark.parametrize("room", ROOMS, ids=lambda room: room.__name__)
def test_every_public_name_has_a_docstring(room: Any) -> None:
    offered = [getattr(room, name) for name in room.__all__]
    things = [thing for thing in offered if callable(thing)]
    assert [thing.__name__ for thing in things if not (thing.__doc__ or "").strip()] == []
    classes = [thing for thing in things if isinstance(thing, type)]
    assert {c.__name__: found for c in classes if (found := undocumented(c))} == {}


def test_no_example_is_left_out() -> None:
    skipped = [path.name for path in sorted(PACKAGE.rglob("*.py")) if "doctest: +SKIP" in path.read_text("utf-8")]
    assert skipped == []
