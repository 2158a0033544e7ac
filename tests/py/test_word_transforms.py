# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Transforms of frames and minimum error training, on synthetic frames whose best answer is known."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import soundfile
from sklearn.discriminant_analysis import LinearDiscriminantAnalysis

from hri.models import GaussianMixtureHmm, MarkovChain, Topology
from hri.studies import get_study
from hri.studies.frame_transforms import (
    StateMoments,
    fit_discriminants,
    fit_heteroscedastic,
    log_likelihood,
    with_neighbours,
    with_third_differences,
)
from hri.studies.minimum_error import mean_loss, train_minimum_error
from hri.studies.word_transforms import METHODS
from hri.synthetic.speech import make_speaker, speak

RNG = np.random.default_rng(0)


def _two_kinds(spreads: tuple[float, float], means: tuple[float, float] = (0.0, 0.0)) -> StateMoments:
    """Two states of 4 values that differ in the first alone, in mean or in spread, mixed by a random matrix."""
    mixing = np.random.default_rng(1).normal(size=(4, 4))
    rows, states = [], []
    for state in (0, 1):
        own = np.random.default_rng(state + 2).normal(size=(3000, 4))
        own[:, 0] = means[state] + spreads[state] * own[:, 0]
        rows.append((own @ mixing.T).astype(np.float32))
        states.append(np.full(len(own), state))
    return StateMoments.of(rows, states)


def _answer() -> np.ndarray:
    """The row that gives the first value back."""
    return np.linalg.inv(np.random.default_rng(1).normal(size=(4, 4)))[0]


def _cosine(a: np.ndarray, b: np.ndarray) -> float:
    return float(abs(a @ b) / np.linalg.norm(a) / np.linalg.norm(b))


def test_discriminants_are_those_of_scikit_learn() -> None:
    rows, labels = RNG.normal(size=(300, 5)), RNG.integers(0, 3, 300)
    rows[:, :2] += labels[:, None] * (1.0, -2.0)
    peer = LinearDiscriminantAnalysis(solver="eigen").fit(rows, labels).scalings_.T[:2]
    ours = fit_discriminants(StateMoments.of([rows.astype(np.float32)], [labels]))
    assert all(_cosine(a, b) > 0.9999 for a, b in zip(ours[:2], peer, strict=True))


def test_hlda_finds_what_differs_in_spread_where_lda_cannot() -> None:
    moments = _two_kinds((0.2, 3.0))
    start = fit_discriminants(moments)
    assert _cosine(start[0], _answer()) < 0.9
    assert _cosine(fit_heteroscedastic(moments, 1, start)[0], _answer()) > 0.99


def test_hlda_agrees_with_lda_on_means() -> None:
    moments = _two_kinds((1.0, 1.0), (0.0, 6.0))
    start = fit_discriminants(moments)
    assert _cosine(start[0], _answer()) > 0.99
    assert _cosine(fit_heteroscedastic(moments, 1, start)[0], _answer()) > 0.99


@pytest.mark.parametrize("num_kept", [2, 4])
def test_the_search_never_makes_frames_less_likely(num_kept: int) -> None:
    moments = _two_kinds((0.3, 2.0))
    start = fit_discriminants(moments)
    found = fit_heteroscedastic(moments, num_kept, start)
    assert log_likelihood(found, moments, num_kept) > log_likelihood(start, moments, num_kept)


def test_frames_with_neighbours_and_differences() -> None:
    ramp = np.arange(12, dtype=np.float32).reshape(6, 2)
    wide = with_neighbours(ramp, 1, 1)
    assert wide.tolist()[0] == [0, 0, 2]
    assert wide.tolist()[2] == [2, 4, 6]
    longer = with_third_differences(ramp, 1)
    assert longer.shape == (6, 3)
    assert longer[2:4, 2].tolist() == [2, 2]  # the slope of the last value


def _two_words() -> tuple[list[GaussianMixtureHmm], list[np.ndarray], list[int]]:
    """One-state models that overlap, the second too far from its own words."""
    chain = MarkovChain(Topology(num_states=1), np.ones(1), np.ones((1, 1)))
    models = [GaussianMixtureHmm(chain, np.ones((1, 1)), [[mean]], [[1.0]]) for mean in (0.0, 3.0)]
    rng = np.random.default_rng(4)
    frames = [rng.normal(1.2 * (i % 2), 0.3, (8, 1)).astype(np.float32) for i in range(60)]
    return models, frames, [i % 2 for i in range(60)]


def test_minimum_error_training_makes_fewer_errors() -> None:
    models, frames, classes = _two_words()

    def errors(trained: list[GaussianMixtureHmm]) -> int:
        return sum(
            int(np.argmax([model.log_likelihood(own) for model in trained])) != label
            for own, label in zip(frames, classes, strict=True)
        )

    trained = train_minimum_error(models, frames, classes)
    assert mean_loss(trained, frames, classes) < mean_loss(models, frames, classes)
    assert errors(trained) < errors(models) / 2
    assert [model.means.tolist() for model in models] == [[[0.0]], [[3.0]]]  # those given stay as they are


def test_the_study_runs_on_synthetic_voices(tmp_path: Path) -> None:
    for voice in range(1, 7):
        for word in ("go", "left"):
            folder = tmp_path / "commands" / word
            folder.mkdir(parents=True, exist_ok=True)
            for take in (1, 2):
                audio = speak(word, "en", make_speaker(voice), take)
                soundfile.write(folder / f"{word}_0{voice}_0{take}.flac", audio.samples, audio.sample_rate_hz)
    result = get_study("word-transforms").run(tmp_path, lambda *_: None, folds=1)
    assert [row["method"] for row in result["rows"]] == list(METHODS)
    assert all(row["accuracy_mean"] > 0.7 for row in result["rows"])
