# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Models as scikit-learn's estimators: its own checks, its searches and pipelines, copies and files."""

from __future__ import annotations

import copy
import pickle
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sklearn.exceptions
from sklearn.base import clone, is_classifier
from sklearn.model_selection import GridSearchCV, GroupKFold, cross_val_score
from sklearn.pipeline import make_pipeline
from sklearn.utils.estimator_checks import parametrize_with_checks
from sklearn.utils.validation import check_is_fitted

from hri import FormatError, InvalidArgument, NotFittedError, models
from hri.io import ModelFile

CLASSIFIERS = [
    models.LinearSvm(),
    models.RbfClassifier(),
    models.GaussianBayes(),
    models.LogisticRegression(),
    models.SoftmaxRegression(),
    models.KnnClassifier(),
    models.DistanceClassifier(),
    models.PossibilityClassifier(),
]
ESTIMATORS = [*CLASSIFIERS, models.PCA(), models.LDA(), models.Codebook(num_codewords=2)]

EARLY = "parameters are checked when they are passed, not only by fit"


def expected_failures(estimator: Any) -> dict[str, str]:
    return {"check_do_not_raise_errors_in_init_or_set_params": EARLY}


@parametrize_with_checks(ESTIMATORS, expected_failed_checks=expected_failures)
def test_scikit_learns_checks(estimator: Any, check: Any) -> None:
    check(estimator)


def blobs(seed: int = 0, count: int = 90) -> tuple[np.ndarray, np.ndarray]:
    """Rows around three centres and their names."""
    rng = np.random.default_rng(seed)
    classes = np.arange(count) % 3
    rows = rng.normal(size=(count, 4)) + 4 * np.eye(3, 4)[classes]
    return rows, np.array(["stop", "go", "left"])[classes]


@pytest.mark.parametrize("estimator", CLASSIFIERS, ids=lambda e: type(e).__name__)
def test_searches_pipelines_and_groups(estimator: Any) -> None:
    rows, labels = blobs()
    if isinstance(estimator, models.LogisticRegression):
        labels = np.where(labels == "stop", "stop", "other")
    groups = np.arange(len(rows)) // 10
    assert is_classifier(estimator)
    scores = cross_val_score(estimator, rows, labels, groups=groups, cv=GroupKFold(3))
    assert scores.shape == (3,) and scores.min() > 0.8
    pipeline = make_pipeline(models.PCA(3), clone(estimator)).fit(rows, labels)
    assert pipeline.score(rows, labels) > 0.8


def test_grid_search_sets_parameters() -> None:
    rows, labels = blobs()
    search = GridSearchCV(models.KnnClassifier(), {"num_neighbours": [1, 5]}, cv=3).fit(rows, labels)
    assert search.best_params_["num_neighbours"] in (1, 5) and search.best_score_ > 0.9


def test_predictions_are_labels_of_any_kind_and_probabilities_sum_to_one() -> None:
    rows, names = blobs()
    for labels in (names, np.unique(names, return_inverse=True)[1] * 10, names.astype(object), names == "go"):
        model = models.GaussianBayes().fit(rows, labels)
        predicted = model.predict(rows)
        assert predicted.dtype == labels.dtype and np.mean(predicted == labels) > 0.9
        assert model.classes_.tolist() == sorted(set(labels.tolist()))
        posterior = model.predict_proba(rows)
        np.testing.assert_allclose(posterior.sum(axis=1), 1, rtol=1e-12)
        np.testing.assert_allclose(np.log(posterior), model.predict_log_proba(rows), atol=1e-9)
        np.testing.assert_array_equal(model.classes_[posterior.argmax(axis=1)], predicted)


@pytest.mark.parametrize("kind", ["rows", "sequences", "symbols"])
def test_scores_are_of_labels_one_for_each_item(kind: str) -> None:
    rows, labels = blobs(count=12)
    items: Any = rows
    model: Any = models.GaussianBayes()
    if kind == "sequences":
        items, model = [np.tile(row, (20, 1)) for row in rows], models.SequenceNetwork(num_epochs=1)
    elif kind == "symbols":
        items, model = [[i % 3] * 5 for i in range(12)], models.PTBHMM(topology={"num_states": 2})
    model.fit(items, labels)
    right = np.mean(model.predict(items) == labels)
    assert all(model.score(items, same) == right for same in (labels, labels[:, None], list(labels)))
    for wrong, complaint in ((labels[:1], "differ in length: 12, 1"), (labels[:3], "differ in length: 12, 3"),
                             (np.tile(labels, (12, 1)), "one-dimensional"), ("go", "one-dimensional")):  # fmt: skip
        with pytest.raises(InvalidArgument, match=complaint):
            model.score(items, wrong)
    with pytest.raises(InvalidArgument):
        model.score([], [])


def test_parameters_are_checked_when_passed_and_by_fit() -> None:
    rows, labels = blobs()
    with pytest.raises(TypeError, match="cost"):
        models.LinearSvm(cost="high")
    model = models.LinearSvm(cost=2.0)
    with pytest.raises(TypeError, match="cost"):
        model.set_params(cost="high")
    assert model.cost == 2.0 and repr(model) == "LinearSvm(cost=2.0)"
    model.cost = -1.0
    with pytest.raises(ValueError, match="cost"):
        model.fit(rows, labels)
    with pytest.raises(TypeError, match=r"penalty.*cost"):
        models.LinearSvm(penalty=1.0)
    with pytest.raises(ValueError, match=r"penalty.*cost"):
        model.set_params(penalty=1.0)
    with pytest.raises(AttributeError):
        _ = model.no_such_name


def test_nested_options_are_parameters_too() -> None:
    model = models.CategoricalHMM(topology={"num_states": 3})
    assert model.get_params()["topology__num_states"] == 3
    assert model.get_params(deep=False)["topology"] == {"num_states": 3}
    copied = clone(model).set_params(topology__num_states=4, max_iterations=3)
    assert copied.get_params()["topology__num_states"] == 4 and copied.max_iterations == 3
    assert model.get_params()["topology__num_states"] == 3
    with pytest.raises(ValueError):
        model.set_params(topology__no_such_field=1)
    options = models.Topology(num_states=5)
    assert models.CategoricalHMM(topology=options).get_params(deep=False)["topology"] is options


def test_what_is_not_trained_says_so_in_every_way() -> None:
    for estimator in ESTIMATORS:
        with pytest.raises(sklearn.exceptions.NotFittedError):
            check_is_fitted(estimator)
        with pytest.raises(NotFittedError, match="call fit or load first") as caught:
            _ = estimator.n_features_in_
        assert isinstance(caught.value, sklearn.exceptions.NotFittedError | ValueError | AttributeError)
        assert not hasattr(estimator, "n_features_in_")


@pytest.mark.parametrize("estimator", ESTIMATORS, ids=lambda e: type(e).__name__)
def test_copies_pickles_and_files_answer_alike(estimator: Any, tmp_path: Path) -> None:
    rows, labels = blobs()
    if isinstance(estimator, models.LogisticRegression):
        labels = np.where(labels == "stop", "stop", "other")
    unfitted = pickle.loads(pickle.dumps(estimator))
    assert unfitted.get_params() == estimator.get_params() and not unfitted.__sklearn_is_fitted__()
    model = clone(estimator).fit(rows, labels)
    model.save(tmp_path / "model.hri")
    method = "transform" if hasattr(model, "transform") else "decision_function"
    expected = getattr(model, method)(rows)
    copies = [copy.deepcopy(model), pickle.loads(pickle.dumps(model)), type(model).load(tmp_path / "model.hri")]
    for copied in copies:
        np.testing.assert_array_equal(getattr(copied, method)(rows), expected)
        assert copied.get_params() == model.get_params()
    other = models.PCA if not isinstance(model, models.PCA) else models.LDA
    with pytest.raises(FormatError, match="estimator"):
        other.load(tmp_path / "model.hri")


def test_a_broken_state_is_refused() -> None:
    rows, labels = blobs()
    model = models.LinearSvm().fit(rows, labels)
    state = model.__getstate__()
    with pytest.raises(FormatError):
        models.LinearSvm.__new__(models.LinearSvm).__setstate__(state[:-3])
    with pytest.raises(FormatError, match="bytes"):
        models.LinearSvm.__new__(models.LinearSvm).__setstate__({"_params": {}})  # type: ignore[arg-type]
    for key, value in (
        ("params", "[]"),
        ("params", '{"cost": "high"}'),
        ("params", '{"no": 1}'),
        ("classes", "{}"),
        ("classes", '{"type": "str", "dtype": "<U4", "labels": ["a", "b"]}'),
        ("classes", '{"type": "str", "dtype": "<U4", "labels": ["a", 1, "c"]}'),
        ("classes", '{"type": "int", "dtype": "V9", "labels": [1, 2, 3]}'),
    ):
        file = ModelFile.from_bytes(state)
        file.set_text(key, value)
        with pytest.raises(FormatError, match=key):
            models.LinearSvm.from_model_file(ModelFile.from_bytes(file.to_bytes()))
    with pytest.raises(InvalidArgument, match="labels must be"):
        pickle.dumps(models.LinearSvm().fit(rows, [(1 + 0j) if x == "go" else 2j for x in labels]))


def test_importing_models_imports_no_scikit_learn() -> None:
    code = "import sys, hri.models; hri.models.LinearSvm(); assert not {'sklearn', 'scipy'} & set(sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize("num_classes", [2, 3])
def test_rows_beyond_all_densities_are_of_no_class(num_classes: int) -> None:
    rng = np.random.default_rng(0)
    y = np.arange(60) % num_classes
    X = (rng.normal(size=(60, 3)) + 4.0 * y[:, None]).astype(np.float32)
    far = np.full((1, 3), 1e20, np.float32)
    bayes = models.GaussianBayes().fit(X, y)
    with np.errstate(all="raise"):
        np.testing.assert_allclose(bayes.predict_proba(far), 1.0 / num_classes)
        np.testing.assert_allclose(bayes.predict_log_proba(far), -np.log(num_classes))
        np.testing.assert_array_equal(models.PossibilityClassifier().fit(X, y).decision_function(far), 0.0)
    assert not np.isnan(bayes.decision_function(far)).any()
    np.testing.assert_allclose(bayes.predict_proba(np.vstack([X, far]))[:-1], bayes.predict_proba(X))
