# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Random sentences of a word network, as HSGen makes them."""

from __future__ import annotations

import numpy as np

from hri._native import HtkWordLattice
from hri.core.errors import InvalidArgument

NULL = "!NULL"
MAX_STEPS = 100_000


def random_sentence(lattice: HtkWordLattice, rng: np.random.Generator) -> list[str]:
    """The words of a path from the first node to the last; of several arcs one is drawn by its weight.

    Raises
    ------
    InvalidArgument
        For a path that does not come to the end within 100000 steps.
    """
    arcs: dict[int, list[tuple[int, float]]] = {}
    for start, end, log_weight in lattice.arcs:
        arcs.setdefault(start, []).append((end, log_weight))
    node, last, nodes = lattice.first, lattice.last, lattice.words
    words = []
    for _ in range(MAX_STEPS):
        if nodes[node] != NULL:
            words.append(nodes[node])
        if node == last:
            return words
        logs = np.array([log_weight for _, log_weight in arcs[node]])
        weights = np.exp(logs - logs.max())
        node = arcs[node][rng.choice(len(weights), p=weights / weights.sum())][0]
    raise InvalidArgument(f"a sentence of the network did not end within {MAX_STEPS} steps")
