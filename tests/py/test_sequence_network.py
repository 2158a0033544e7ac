# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Networks of sequences against their definition in NumPy, and as estimators."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import hri
from hri.core.errors import InvalidArgument
from hri.models import SequenceNetwork

Frames = NDArray[np.float32]
DIM = 10


def sweep(rises: bool, rng: np.random.Generator) -> Frames:
    """A bump that rises or falls over the bands, in noise."""
    frames = int(rng.integers(20, 32))
    way = np.linspace(0, DIM - 1, frames)
    bands = np.arange(DIM) - (way if rises else way[::-1])[:, None]
    return (np.exp(-0.5 * bands**2) + 0.3 * rng.standard_normal((frames, DIM))).astype(np.float32)


@pytest.fixture(scope="module")
def network() -> SequenceNetwork:
    rng = np.random.default_rng(1)
    labels = ["rise", "fall"] * 40
    sequences = [sweep(label == "rise", rng) for label in labels]
    return SequenceNetwork(num_channels=16, num_blocks=2, num_epochs=10, batch_size=32).fit(sequences, labels)


def convolved(frames: Frames, kernel: Frames, step: int) -> Frames:
    """Every column by its own kernel, centred, zeros around."""
    columns = [
        np.correlate(np.pad(column, len(kernel) // 2), taps, "valid")
        for column, taps in zip(frames.T, kernel.T, strict=True)
    ]
    return np.stack(columns, axis=1)[::step]


def by_definition(network: SequenceNetwork, frames: Frames) -> Frames:
    """Log posteriors, from the numbers in the model file."""
    file = network.to_model_file()
    num_layers = file.integer("model.layers")

    def layer(number: int, x: Frames, step: int = 1) -> Frames:
        at = f"model.layer.{number}."
        weights, bias = file.matrix_f(at + "weights"), file.matrix_f(at + "bias")
        return convolved(x, file.matrix_f(at + "kernel"), step) @ weights + bias.reshape(-1)

    padding = file.matrix_f("model.layer.0.kernel").shape[1] - frames.shape[1]
    x = np.maximum(layer(0, np.pad(frames, ((0, 0), (0, padding))), 2), 0)
    for number in range(1, num_layers - 1, 2):
        x = np.maximum(x + layer(number + 1, np.maximum(layer(number, x), 0)), 0)
    x = np.maximum(layer(num_layers - 1, x), 0)
    pooled = np.concatenate([x.mean(axis=0), x.max(axis=0)])
    scores = file.matrix_f("model.head.weights") @ pooled + file.matrix_f("model.head.bias").reshape(-1)
    return scores - np.log(np.exp(scores).sum())


def test_it_computes_what_its_definition_says(network: SequenceNetwork) -> None:
    rng = np.random.default_rng(2)
    for frames in (sweep(True, rng), sweep(False, rng)[:7]):
        found = network.predict_log_proba([frames])[0]
        np.testing.assert_allclose(found, by_definition(network, frames), rtol=1e-4, atol=1e-4)


def test_it_learns_and_gives_probabilities(network: SequenceNetwork) -> None:
    rng = np.random.default_rng(3)
    labels = ["fall", "rise"] * 20
    sequences = [sweep(label == "rise", rng) for label in labels]
    assert network.score(sequences, labels) >= 0.95
    np.testing.assert_allclose(network.predict_proba(sequences).sum(axis=1), 1, atol=1e-5)
    assert network.classes_.tolist() == ["fall", "rise"]


def test_it_comes_back_to_the_bit(network: SequenceNetwork, tmp_path: Path) -> None:
    frames = [sweep(True, np.random.default_rng(4))]
    network.save(tmp_path / "network.hri")
    for again in (
        SequenceNetwork.load(tmp_path / "network.hri"),
        pickle.loads(pickle.dumps(network)),
        copy.deepcopy(network),
    ):
        assert (again.predict_log_proba(frames) == network.predict_log_proba(frames)).all()


def test_bad_input_is_refused(network: SequenceNetwork) -> None:
    rows = [np.ones((9, DIM), np.float32)] * 4
    with pytest.raises(InvalidArgument):
        SequenceNetwork(num_channels=12).fit(rows, [0, 1, 0, 1])
    with pytest.raises(InvalidArgument):
        SequenceNetwork().fit(rows, [0, 1, 0])
    with pytest.raises(InvalidArgument):
        SequenceNetwork().fit([*rows[:3], np.full((9, DIM), np.nan)], [0, 1, 0, 1])
    with pytest.raises(InvalidArgument):
        network.predict([np.ones((9, DIM + 1))])


def test_words_take_a_network_by_keyword(spoken: Path) -> None:
    files = sorted(spoken.glob("*.wav"))
    labels = [file.name.split("_")[0] for file in files]
    persons = [file.name.split("_")[1] for file in files]
    words = hri.WordRecognizer(use_network=True, network={"num_channels": 16, "num_epochs": 5})
    words.fit([str(file) for file in files], labels, groups=persons)
    assert words.predict([str(file) for file in files]).tolist() == labels
    again = pickle.loads(pickle.dumps(words))
    assert (again.scores(str(files[0])) == words.scores(str(files[0]))).all()
