# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The N best sentences of `hri htk vite`, and its lattices."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from hri.htk import MasterLabelFile, ParameterFile, WordLattice
from htk_toys import clip, model_text, succeed

pytest_plugins = ("htk_folders",)

SENTENCE = (0, 8) * 6


@pytest.fixture
def spoken(work: Path) -> Path:
    """Models of two words, twice each, and a recording of twelve words."""
    one = "0 1 0\n0 .5 .5\n0 0 0\n"
    models = [model_text(name, (mean,), one) for name, mean in (("lo", 0), ("lo2", 0), ("hi", 8), ("hi2", 8))]
    Path("models").write_text("~o <VECSIZE> 1 <USER>\n" + "".join(models))
    Path("list").write_text("lo\nlo2\nhi\nhi2\n")
    Path("dict").write_text("low lo\nhigh hi\n")
    Path("twice").write_text("low lo\nlow lo2\nhigh hi\nhigh hi2\n")
    ParameterFile(clip(4, *SENTENCE), "USER", 100000).write("v.usr")
    Path("net").write_text(
        f"N=4 L=6\nI=0\nI=1 W=low\nI=2 W=high\nI=3\nJ=0 S=0 E=1 l={math.log(0.75)}\nJ=1 S=0 E=2 l={math.log(0.25)}\n"
        f"J=2 S=1 E=2 l={math.log(0.5)}\nJ=3 S=2 E=1 l={math.log(0.125)}\nJ=4 S=1 E=3\nJ=5 S=2 E=3\n"
    )
    return work


def found(hri, *options: str | int | float, dictionary: str = "dict", net: str = "net") -> list[tuple[str, float]]:
    """Words and score of every sentence."""
    given = ("htk", "vite", "-H", "models", "-w", net, "-i", "f.mlf", *options, dictionary, "list", "v.usr")
    succeed(hri(*given))
    sentences = MasterLabelFile.read("f.mlf").entries[0][1].alternatives
    return [(" ".join(label.name for label in one), sum(label.score for label in one)) for one in sentences]


def test_pronunciations_do_not_hide_sentences(hri, spoken: Path):
    """Each of twelve words has two pronunciations: 4096 ways to say the first sentence."""
    Path("gram").write_text("( < low | high > )\n")
    succeed(hri("htk", "parse", "gram", "any"))
    once = found(hri, "-n", 4, 5, net="any")
    twice = found(hri, "-n", 4, 5, net="any", dictionary="twice")
    assert len({words for words, _ in once}) == 5 and len(once[0][0].split()) >= 12
    assert [words for words, _ in twice] == [words for words, _ in once]
    assert [score for _, score in twice] == pytest.approx([score for _, score in once], abs=1e-2)


@pytest.mark.parametrize("dictionary", ["dict", "twice"])
def test_lattices_are_networks_again(hri, spoken: Path, dictionary: str):
    """Scale and penalty stand in the header, not in the weights: the same ones give the same scores."""
    weighed = ("-s", 6, "-p", -20, "-n", 2, 3)
    first = found(hri, *weighed, "-l", "lats", "-z", "lat", dictionary=dictionary)
    lattice = WordLattice.read("lats/v.lat")
    assert "\nlmscale=6 wdpenalty=-20\n" in Path("lats/v.lat").read_text()
    assert (lattice.language_scale, lattice.insertion_penalty) == (6, -20)
    weights = {round(math.exp(weight), 9) for _, _, weight in lattice.arcs}
    assert weights <= {1, 0.75, 0.25, 0.5, 0.125} and len(weights) > 2
    again = found(hri, *weighed, net="lats/v.lat", dictionary=dictionary)
    assert [words for words, _ in again] == [words for words, _ in first]
    assert [score for _, score in again] == pytest.approx([score for _, score in first], abs=1e-2)
    back = lattice.to_lattice(["low", "high"], [], 0.0, 0.01)
    assert back.best().log_score == pytest.approx(first[0][1], abs=1e-2)


def test_lattices_of_scale_0_have_no_weights(hri, spoken: Path):
    first = found(hri, "-s", 0, "-p", -20, "-n", 2, 2, "-l", "lats", "-z", "lat")
    lattice = WordLattice.read("lats/v.lat")
    assert {weight for _, _, weight in lattice.arcs} == {0}
    assert found(hri, "-s", 0, "-p", -20, net="lats/v.lat")[0] == pytest.approx(first[0], abs=1e-2)
