# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""HMMs by hmmlearn's methods and against it."""

from __future__ import annotations

import pickle

import hmmlearn.hmm
import numpy as np
import pytest

from hri import InvalidArgument, models

RNG = np.random.default_rng(0)
LENGTHS = [40, 25, 35]
SYMBOLS = np.concatenate([np.repeat([0, 1, 2, 0], RNG.integers(3, 12, 4))[:n] for n in (40, 40, 40, 40, 40)])[:100]
FRAMES = RNG.normal(size=(100, 3)) + np.repeat(np.eye(4, 3) * 6, 25, axis=0)


def ergodic(num_states: int) -> dict[str, object]:
    return {"kind": "ergodic", "num_states": num_states}


def same_as_hmmlearn(ours: models.CategoricalHMM | models.GMMHMM, theirs: object, X: np.ndarray) -> None:
    """Score, best path and posteriors of sequences, at float32's precision."""
    column = X.reshape(len(X), -1)
    assert ours.score(X, LENGTHS) == pytest.approx(theirs.score(column, LENGTHS), rel=1e-5)  # type: ignore[attr-defined]
    log_prob, states = ours.decode(X, LENGTHS)
    expected, path = theirs.decode(column, LENGTHS)  # type: ignore[attr-defined]
    assert log_prob == pytest.approx(expected, rel=1e-5)
    np.testing.assert_array_equal(states, path)
    np.testing.assert_array_equal(ours.predict(X, LENGTHS), path)
    np.testing.assert_allclose(
        ours.predict_proba(X, LENGTHS),
        theirs.predict_proba(column, LENGTHS),  # type: ignore[attr-defined]
        atol=1e-4,
    )


def test_categorical_answers_as_hmmlearn_does() -> None:
    ours = models.CategoricalHMM(topology=ergodic(3), seed=2).fit(SYMBOLS, LENGTHS)
    theirs = hmmlearn.hmm.CategoricalHMM(3)
    theirs.startprob_, theirs.transmat_, theirs.emissionprob_ = ours.startprob_, ours.transmat_, ours.emissionprob_
    same_as_hmmlearn(ours, theirs, SYMBOLS)
    assert ours.emissionprob_.shape == (3, 3) and ours.report_.log_likelihoods


def test_gaussians_answer_as_hmmlearn_does() -> None:
    ours = models.GaussianHMM(topology=ergodic(4), seed=1).fit(FRAMES, LENGTHS)
    theirs = hmmlearn.hmm.GaussianHMM(4, "diag")
    theirs.startprob_, theirs.transmat_, theirs.means_ = ours.startprob_, ours.transmat_, ours.means_
    theirs.covars_ = ours.covars_
    same_as_hmmlearn(ours, theirs, FRAMES)
    assert ours.n_features_in_ == 3


def test_mixtures_answer_as_hmmlearn_does() -> None:
    ours = models.GMMHMM(topology=ergodic(2), num_mixtures=2, seed=1).fit(FRAMES, LENGTHS)
    theirs = hmmlearn.hmm.GMMHMM(2, 2, covariance_type="diag")
    theirs.startprob_, theirs.transmat_ = ours.startprob_, ours.transmat_
    theirs.weights_, theirs.means_, theirs.covars_ = ours.weights_, ours.means_, ours.covars_
    theirs.n_features = 3
    same_as_hmmlearn(ours, theirs, FRAMES)


def test_training_finds_as_likely_a_model_as_hmmlearn() -> None:
    ours = models.GaussianHMM(topology=ergodic(4), max_iterations=100, tolerance=0.0, variance_floor=1e-6)
    theirs = hmmlearn.hmm.GaussianHMM(4, "diag", n_iter=100, random_state=0, covars_prior=0, min_covar=1e-9)
    assert ours.fit(FRAMES, LENGTHS).score(FRAMES, LENGTHS) > theirs.fit(FRAMES, LENGTHS).score(FRAMES, LENGTHS) - 1


def test_samples_have_the_shape_of_data_and_repeat_with_their_seed() -> None:
    for model, X in (
        (models.CategoricalHMM(topology=ergodic(3)), SYMBOLS),
        (models.GaussianHMM(topology=ergodic(4)), FRAMES),
        (models.GMMHMM(topology=ergodic(2), num_mixtures=2), FRAMES),
    ):
        model.fit(X, LENGTHS)
        drawn, states = model.sample(500, seed=3)
        assert drawn.shape == (500, X.reshape(100, -1).shape[1]) and states.shape == (500,)
        np.testing.assert_array_equal(drawn, model.sample(500, seed=3)[0])
        assert not np.array_equal(drawn, model.sample(500, seed=4)[0])
        # A model explains its own samples as well as what it was trained on.
        assert abs(model.score(drawn) / 500 - model.score(X, LENGTHS) / 100) < 0.7
        assert np.mean(model.predict(drawn) == states) > 0.5
        loaded = pickle.loads(pickle.dumps(model))
        assert loaded.score(X, LENGTHS) == model.score(X, LENGTHS)


def test_wrong_input_is_named() -> None:
    model = models.CategoricalHMM(topology=ergodic(2))
    for lengths in ([50], [40, 61], [0, 100], []):
        with pytest.raises(InvalidArgument, match="lengths"):
            model.fit(SYMBOLS, lengths)
    with pytest.raises(InvalidArgument, match="whole numbers"):
        model.fit(FRAMES)
    with pytest.raises(ValueError, match="call fit or load"):
        model.score(SYMBOLS)
    gaussian = models.GaussianHMM(topology=ergodic(2)).fit(FRAMES)
    with pytest.raises(InvalidArgument, match="2 features"):
        gaussian.score(FRAMES[:, :2])
    with pytest.raises(InvalidArgument, match="num_mixtures"):
        models.GaussianHMM(num_mixtures=3)
    with pytest.raises(InvalidArgument, match="2D"):
        gaussian.fit(FRAMES[0])
    assert gaussian.n_features_in_ == 3  # the model before it is kept


def test_a_model_of_its_own_parameters() -> None:
    chain = models.MarkovChain(models.Topology(kind="ergodic", num_states=2), [0.5, 0.5], [[0.9, 0.1], [0.2, 0.8]])
    hmm = models.CategoricalHMM.from_model(models.DiscreteHmm(chain, [[1.0, 0.0], [0.0, 1.0]]))
    assert hmm.predict([0, 0, 1]).tolist() == [0, 0, 1]
    assert hmm.score([0, 1]) == pytest.approx(np.log(0.5 * 0.1))


def test_possibility_models_classify_sequences() -> None:
    words = [np.repeat(order, RNG.integers(3, 9, 3)) for order in ((0, 1, 2), (2, 1, 0)) for _ in range(10)]
    labels = ["abc"] * 10 + ["cba"] * 10
    model = models.PTBHMM(topology={"num_states": 3}, emission_floor=0.01).fit(words, labels)
    assert model.score(words, labels) == 1.0 and model.classes_.tolist() == ["abc", "cba"]
    possibility, necessity = model.possibilities(words)
    assert possibility.max(axis=1).tolist() == [1.0] * 20 and (necessity.max(axis=1) > 0.5).all()
    score, path = model.decode(words[0], "abc")
    assert len(path) == len(words[0]) and score <= model.decision_function(words[:1])[0, 0] + 1e-4
    copied = pickle.loads(pickle.dumps(model))
    np.testing.assert_array_equal(copied.decision_function(words), model.decision_function(words))
    with pytest.raises(InvalidArgument, match="no class"):
        model.decode(words[0], "xyz")
    with pytest.raises(InvalidArgument, match=r"X\[1\]"):
        model.predict([words[0], [0.5]])


def test_codebooks_are_clusters() -> None:
    frames = (RNG.normal(size=(400, 2)) + RNG.integers(0, 2, (400, 2)) * 10).astype(np.float32)
    codebook = models.Codebook(num_codewords=4).fit(frames)
    symbols = codebook.predict(frames)
    distances = np.linalg.norm(frames[:, None] - codebook.cluster_centers_[None], axis=2)
    np.testing.assert_array_equal(symbols, distances.argmin(axis=1))
    np.testing.assert_allclose(codebook.transform(frames), distances, rtol=1e-4, atol=1e-3)
    back = codebook.inverse_transform(symbols)
    assert np.mean(np.sum((back - frames) ** 2, axis=1)) == pytest.approx(codebook.distortion(frames), rel=1e-4)
    assert codebook.score(frames) == pytest.approx(-400 * codebook.distortion(frames)) and len(codebook) == 4
    again = models.Codebook().fit(frames, init=codebook.cluster_centers_)
    assert again.distortion(frames) <= codebook.distortion(frames) * 1.001
    given = models.Codebook.from_centers([[0, 0], [10, 10]])
    assert given.predict([[1, 1], [9, 9]]).tolist() == [0, 1]
    for wrong in ([4], [-1], [[0]], [0.5]):
        with pytest.raises(InvalidArgument, match="symbol"):
            codebook.inverse_transform(wrong)
