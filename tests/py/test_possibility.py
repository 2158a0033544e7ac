# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Possibility and necessity of the classes that were considered."""

from __future__ import annotations

import numpy as np
import pytest

from hri.recognition import Decision, NBest, possibility_and_necessity
from hri.recognition.possibility import nbest_fields


def test_the_transformation_of_dubois_and_prade() -> None:
    degrees = possibility_and_necessity((0.1, 0.6, 0.3))
    assert [pi for pi, _ in degrees] == pytest.approx([0.1, 1.0, 0.4])
    assert [n for _, n in degrees] == pytest.approx([0.0, 0.6, 0.0])


def test_equal_probabilities_are_equally_possible_and_none_is_necessary() -> None:
    assert possibility_and_necessity((0.4, 0.4, 0.2)) == [(1.0, 0.0), (1.0, 0.0), (pytest.approx(0.2), 0.0)]
    assert possibility_and_necessity(()) == [] and possibility_and_necessity((0.3,)) == [(1.0, 1.0)]
    assert possibility_and_necessity((0.0, 0.0)) == [(1.0, 0.0)] * 2


def test_probability_lies_between_necessity_and_possibility() -> None:
    rng = np.random.default_rng(5)
    for size in (2, 3, 10, 300):
        p = [float(value) for value in rng.dirichlet(np.full(size, 0.3))]
        degrees = possibility_and_necessity(p)
        assert max(pi for pi, _ in degrees) == 1.0
        for i, (one, (pi, n)) in enumerate(zip(p, degrees, strict=True)):
            assert n - 1e-12 <= one <= pi + 1e-12
            rest = max(other for j, (other, _) in enumerate(degrees) if j != i)
            assert n == pytest.approx(1.0 - rest, abs=1e-12)
        order = np.argsort(p)
        assert np.all(np.diff(np.array([pi for pi, _ in degrees])[order]) >= 0)


def test_events_carry_both() -> None:
    from hri.live.events import decision_fields

    nbest = (NBest("a", 0.7, -1.0), NBest("b", 0.3, -2.0))
    (first, second) = decision_fields(Decision("speech", "a", "recognised", 0.7, nbest=nbest), "", "")["nbest"]
    assert first == {"label": "a", "probability": 0.7, "possibility": 1.0, "necessity": 0.7, "log_score": -1.0}
    assert second["possibility"] == pytest.approx(0.3) and second["necessity"] == 0.0
    assert list(nbest_fields(nbest)[0]) == ["label", "probability", "possibility", "necessity"]
