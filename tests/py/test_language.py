# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Language models against their definitions in plain Python; ARPA files; the decoder from Python."""

from __future__ import annotations

import math
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from hri.core.errors import FormatError, InvalidArgument, IoError
from hri.language import ConnectedDecoder, ConnectedDecoderOptions, NGramModel, NGramOptions, WordChain, WordNetwork

TEXT = """go left
go right
go left two steps
stop
turn right
turn left and stop
go two steps and turn left
stop and go left"""
SENTENCES = [line.split() for line in TEXT.splitlines()]
WORDS = sorted({word for sentence in SENTENCES for word in sentence})
Counts = Counter[tuple[str, ...]]


def ngram_counts(order: int) -> list[Counts]:
    """Counts of n-grams by their length, from 1; <s> begins every sentence and is never predicted."""
    counts: list[Counts] = [Counter() for _ in range(order)]
    for sentence in SENTENCES:
        padded = ["<s>", *sentence, "</s>"]
        for last in range(1, len(padded)):
            for n in range(1, min(order, last + 1) + 1):
                counts[n - 1][tuple(padded[last + 1 - n : last + 1])] += 1
    return counts


def witten_bell(counts: list[Counts], history: tuple[str, ...], word: str) -> float:
    """P(word | history), interpolated, by the formula of the paper."""
    if len(history) == len(counts):
        history = history[1:]
    followers = {g: c for g, c in counts[len(history)].items() if g[:-1] == history}
    lower = witten_bell(counts, history[1:], word) if history else 1 / (len(WORDS) + 1)
    if not followers:
        return lower
    kinds, total = len(followers), sum(followers.values())
    return (followers.get((*history, word), 0) + kinds * lower) / (total + kinds)


def kneser_ney(counts: list[Counts], history: tuple[str, ...], word: str) -> float:
    """The same with one discount an order, and counts of contexts below the highest order."""
    if len(history) == len(counts):
        history = history[1:]
    n = len(history) + 1
    used = counts[n - 1]
    if n < len(counts):
        contexts = Counter(g[1:] for g in counts[n])
        used = Counter({g: c if g[0] == "<s>" else contexts[g] for g, c in used.items()})
    sizes = Counter(used.values())
    discount = sizes[1] / (sizes[1] + 2 * sizes[2]) if sizes[1] and sizes[2] else 0.5
    followers = {g: c for g, c in used.items() if g[:-1] == history}
    lower = kneser_ney(counts, history[1:], word) if history else 1 / (len(WORDS) + 1)
    if not followers:
        return lower
    total = sum(followers.values())
    seen = max(followers.get((*history, word), 0) - discount, 0)
    return (seen + discount * len(followers) * lower) / total


@pytest.mark.parametrize("order", [1, 2, 3])
@pytest.mark.parametrize("smoothing", ["witten_bell", "kneser_ney"])
def test_probabilities_are_those_of_the_definition(order: int, smoothing: str) -> None:
    model = NGramModel.train(SENTENCES, NGramOptions(order=order, smoothing=smoothing))
    define = {"witten_bell": witten_bell, "kneser_ney": kneser_ney}[smoothing]
    counts = ngram_counts(order)
    histories = [("<s>",), ("go",), ("go", "left"), ("left", "stop"), ("<s>", "turn"), ("steps", "right")]
    for history in histories:
        for word in (*WORDS, "</s>"):
            expected = define(counts, history[max(0, len(history) - order + 1) :], word)
            assert math.exp(model.log_probability(list(history), word)) == pytest.approx(expected, rel=1e-12)


def test_perplexity_is_the_inverse_geometric_mean_of_the_probabilities() -> None:
    model = NGramModel.train(SENTENCES)
    fit = model.fit_of([["go", "left"], ["stop", "dancing"]])
    logs = [
        model.log_probability(history, word)
        for history, word in [
            (["<s>"], "go"),
            (["go"], "left"),
            (["left"], "</s>"),
            (["<s>"], "stop"),
            (["dancing"], "</s>"),
        ]
    ]
    assert (fit.num_words, fit.num_unknown) == (5, 1)
    assert fit.perplexity == pytest.approx(math.exp(-np.mean(logs)), rel=1e-12)
    assert model.log_probability(["go"], "dancing") == -math.inf


def test_arpa_files_go_out_and_in(tmp_path: Path) -> None:
    model = NGramModel.train(SENTENCES, NGramOptions(order=3, smoothing="kneser_ney"))
    model.save(tmp_path / "commands.arpa")
    read = NGramModel.load(tmp_path / "commands.arpa")
    assert read.to_arpa() == model.to_arpa() == (tmp_path / "commands.arpa").read_text()
    assert read.order == 3
    with pytest.raises(IoError):
        NGramModel.load(tmp_path / "missing.arpa")
    text = model.to_arpa().replace("ngram 2=", "ngram 2=1")
    with pytest.raises(FormatError, match=r"commands: line \d+: there are"):
        NGramModel.parse(text, "commands")


def chain(num_states: int) -> WordChain:
    step = np.full((num_states, num_states), -np.inf)
    for i in range(num_states):
        step[i, i : i + 2] = np.log(0.5)
    start, leave = np.full(num_states, -np.inf), np.full(num_states, -np.inf)
    start[0], leave[-1] = 0, np.log(0.5)
    return WordChain(start, step, leave)


def test_the_decoder_finds_the_words_that_score() -> None:
    scores = np.full((12, 4), -10, np.float32)
    for first, state in ((0, 0), (3, 1), (6, 2), (9, 3)):
        scores[first : first + 3, state] = 0
    decoder = ConnectedDecoder([chain(2), chain(2)], WordNetwork.loop(2))
    decoder.push_all(scores)
    found = decoder.finish()
    assert found.complete
    assert [(w.model, w.first_frame, w.last_frame) for w in found.words] == [(0, 0, 6), (1, 6, 12)]
    assert found.log_score == pytest.approx(12 * math.log(0.5))


def test_wrong_shapes_are_refused() -> None:
    with pytest.raises(InvalidArgument, match="log_exit has 3 values, the chain 2 states"):
        ConnectedDecoder([WordChain(np.zeros(2), np.zeros((2, 2)), np.zeros(3))], WordNetwork.loop(1))
    decoder = ConnectedDecoder([chain(2)], WordNetwork.loop(1), ConnectedDecoderOptions(beam=50))
    with pytest.raises(InvalidArgument, match="3 values, the models have 2 states"):
        decoder.push(np.zeros(3, np.float32))
