# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Random sentences of a word network, as HSGen makes them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hri._native import HtkDictionary, HtkWordLattice
from hri.core.errors import FormatError, InvalidArgument

NULL = "!NULL"
MAX_STEPS = 100_000


@dataclass(frozen=True)
class DrawnSentence:
    """A sentence of a network.

    Attributes
    ----------
    words : tuple of str
    bits : float
        -log2 of the probability that its path was drawn.
    """

    words: tuple[str, ...]
    bits: float


def random_sentence(lattice: HtkWordLattice, rng: np.random.Generator) -> list[str]:
    """The words of `draw_sentence`."""
    return list(draw_sentence(lattice, rng).words)


def draw_sentence(lattice: HtkWordLattice, rng: np.random.Generator) -> DrawnSentence:
    """A path from the first node to the last; of several arcs one is drawn by its weight.

    Raises
    ------
    InvalidArgument
        For a path that does not come to the end within 100000 steps.
    """
    arcs: dict[int, list[tuple[int, float]]] = {}
    for start, end, log_weight in lattice.arcs:
        arcs.setdefault(start, []).append((end, log_weight))
    node, last, nodes = lattice.first, lattice.last, lattice.words
    words, bits = [], 0.0
    for _ in range(MAX_STEPS):
        if nodes[node] != NULL:
            words.append(nodes[node])
        if node == last:
            return DrawnSentence(tuple(words), bits)
        if node not in arcs:
            raise InvalidArgument(f"node {node} of the network leads nowhere")
        logs = np.array([log_weight for _, log_weight in arcs[node]])
        weights = np.exp(logs - logs.max())
        weights /= weights.sum()
        drawn = int(rng.choice(len(weights), p=weights))
        bits -= float(np.log2(weights[drawn]))
        node = arcs[node][drawn][0]
    raise InvalidArgument(f"a sentence of the network did not end within {MAX_STEPS} steps")


def require_words(network: HtkWordLattice, network_name: str, dictionary: HtkDictionary, dictionary_name: str) -> None:
    """Check that a dictionary has all words of a network.

    Raises
    ------
    FormatError
        For a word that it has not: names both files, and the line of the network.
    """
    known = {entry.word for entry in dictionary.entries}
    lines = network.lines or [0] * len(network.words)
    for word, line in zip(network.words, lines, strict=True):
        if word not in known and word != NULL:
            where = f"{network_name}: line {line}" if line else network_name
            raise FormatError(f"{where}: the dictionary {dictionary_name} does not have the word {word!r}")


def network_statistics(network: HtkWordLattice, sentences: Sequence[DrawnSentence]) -> list[str]:
    """Lines on a network and on sentences drawn from it: size, entropy a word, lengths; as HSGen estimates them.

    Parameters
    ----------
    network : WordLattice
    sentences : list of DrawnSentence
    """
    words = [word for word in network.words if word != NULL]
    lengths = [len(sentence.words) for sentence in sentences] or [0]
    entropy = sum(sentence.bits for sentence in sentences) / max(sum(lengths), 1)
    return [
        f"Number of Nodes = {len(network.words)} [{len(words)} words], Vocab Size = {len(set(words))}",
        f"Entropy = {entropy:.6f},  Perplexity = {2**entropy:.6f}",
        f"{len(sentences)} Sentences: average len = {np.mean(lengths):.1f}, min={min(lengths)}, max={max(lengths)}",
    ]
