# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Word errors against all alignments there are, and against NIST's sclite where it is installed."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from foreign_programs import SCLITE, sclite_counts
from hri.core.errors import InvalidArgument
from hri.htk import HTK_COSTS
from hri.language import WordErrors, align_words, count_word_errors
from hri.language.word_errors import NIST_COSTS

Pair = tuple[str | None, str | None]


def sentences(count: int, longest: int, seed: int) -> list[list[str]]:
    rng = np.random.default_rng(seed)
    return [[str(w) for w in rng.choice(["a", "b", "c"], rng.integers(0, longest + 1))] for _ in range(count)]


def all_alignments(reference: list[str], hypothesis: list[str]) -> Iterator[list[Pair]]:
    if not reference and not hypothesis:
        yield []
    if reference and hypothesis:
        for rest in all_alignments(reference[1:], hypothesis[1:]):
            yield [(reference[0], hypothesis[0]), *rest]
    if reference:
        for rest in all_alignments(reference[1:], hypothesis):
            yield [(reference[0], None), *rest]
    if hypothesis:
        for rest in all_alignments(reference, hypothesis[1:]):
            yield [(None, hypothesis[0]), *rest]


def cost(pairs: list[Pair], costs: tuple[int, int, int]) -> int:
    substitution, deletion, insertion = costs
    return sum(
        deletion if found is None else insertion if said is None else substitution * (said != found)
        for said, found in pairs
    )


@pytest.mark.parametrize("costs", [NIST_COSTS, HTK_COSTS, (1, 2, 5)])
def test_alignments_cost_the_least_of_all(costs: tuple[int, int, int]) -> None:
    for reference, hypothesis in zip(sentences(60, 5, 1), sentences(60, 5, 2), strict=True):
        found: list[Pair] = [(p.reference, p.hypothesis) for p in align_words(reference, hypothesis, costs)]
        assert [said for said, _ in found if said is not None] == reference
        assert [word for _, word in found if word is not None] == hypothesis
        assert cost(found, costs) == min(cost(pairs, costs) for pairs in all_alignments(reference, hypothesis))


def test_errors_are_counted_by_kind() -> None:
    assert count_word_errors([["go", "left", "now"]], [["go", "right", "now"]]) == WordErrors(3, 1, 0, 0)
    assert count_word_errors([["go", "left", "now"]], [["go", "now"]]) == WordErrors(3, 0, 1, 0)
    assert count_word_errors([["go"]], [["go", "left", "now"]]) == WordErrors(1, 0, 0, 2)
    both = count_word_errors([["go", "left"], []], [["go", "left"], ["stop"]])
    assert both == WordErrors(2, 0, 0, 1)
    assert both.total == 1
    assert both.rate == 0.5


def test_what_has_no_rate_is_refused() -> None:
    with pytest.raises(InvalidArgument, match="a reference with a word"):
        _ = WordErrors().rate
    with pytest.raises(InvalidArgument, match="1 references and 0 hypotheses"):
        count_word_errors([["a"]], [])
    with pytest.raises(InvalidArgument, match="split it"):
        count_word_errors(["a b"], [["a"]])


@pytest.mark.skipif(SCLITE is None, reason="sclite (Debian: sctk) is not installed")
def test_sclite_counts_the_same(tmp_path: Path) -> None:
    references, hypotheses = sentences(200, 9, 3), sentences(200, 9, 4)
    references = [[*words, "end"] for words in references]
    # Alignments that cost the same have other numbers of errors here, and sclite takes the one with an insertion last.
    references.append(["one", "one", "one", "one", "two", "two", "six", "end"])
    hypotheses.append(["two", "six", "six", "six", "two", "end"])
    found = count_word_errors(references, hypotheses)
    expected = [201, found.num_words, found.num_words - found.substitutions - found.deletions]
    counted = sclite_counts(tmp_path, references, hypotheses)
    assert counted == [*expected, found.substitutions, found.deletions, found.insertions, found.total]
