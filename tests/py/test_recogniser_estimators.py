# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Recognisers as scikit-learn's classifiers of recordings: copies, searches, pipelines, groups, probabilities."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
import sklearn.exceptions
from sklearn.base import clone, is_classifier
from sklearn.model_selection import GridSearchCV, GroupKFold, cross_val_predict, cross_val_score
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import FunctionTransformer
from sklearn.utils.validation import check_is_fitted

import hri
from conftest import PERSONS, RATE_HZ, tone_word
from drawn_hands import stills
from hri import Audio, FormatError, NotFittedError

CHEAP_WORDS = {"num_states": 4, "num_vtlp_factors": 1, "num_noisy_copies": 0, "max_iterations": 5}


@dataclass
class Case:
    """A recogniser that trains in a moment, and recordings of two labels by three persons.

    `grid` is to be searched, `wrong` out of range; `quieter` is a step that may come before the recogniser.
    """

    make: Callable[[], Any]
    items: list[Any]
    labels: list[str]
    persons: list[str]
    grid: dict[str, list[Any]]
    wrong: dict[str, Any]
    quieter: Callable[[list[Any]], list[Any]]


def words() -> Case:
    rows = [
        (Audio(tone_word(base_hz, slope, 7 * take + number), RATE_HZ), label, person)
        for number, (person, base_hz) in enumerate(PERSONS.items())
        for take in range(2)
        for label, slope in (("rise", 800.0), ("fall", -350.0))
    ]
    items, labels, persons = map(list, zip(*rows, strict=True))
    return Case(
        make=lambda: hri.WordRecognizer(**CHEAP_WORDS),
        items=items,
        labels=labels,
        persons=persons,
        grid={"num_states": [3, 5], "cepstra__num_filters": [20, 26]},
        wrong={"cepstra__num_filters": -1},
        quieter=lambda clips: [Audio(0.5 * clip.samples, clip.sample_rate_hz) for clip in clips],
    )


def signs() -> Case:
    rows = [
        (stills(label, 10 * take + number), label, person)
        for number, person in enumerate(PERSONS)
        for take in range(2)
        for label in ("flat", "tall")
    ]
    items, labels, persons = map(list, zip(*rows, strict=True))
    return Case(
        make=lambda: hri.GestureRecognizer(model="svm"),
        items=items,
        labels=labels,
        persons=persons,
        grid={"model": ["svm", "hmm"], "hands__silhouette__blur_px": [3, 5]},
        wrong={"hands__silhouette__min_quality": 7.0},
        quieter=lambda clips: [[frame - frame // 8 for frame in clip] for clip in clips],
    )


@pytest.fixture(scope="module", params=[words, signs], ids=["words", "signs"])
def case(request: pytest.FixtureRequest) -> Case:
    made: Case = request.param()
    return made


@pytest.fixture(scope="module")
def trained(case: Case) -> Any:
    return case.make().fit(case.items, case.labels, groups=case.persons)


def test_clones_are_untrained_and_have_the_same_parameters(case: Case, trained: Any) -> None:
    assert is_classifier(trained)
    check_is_fitted(trained)
    copied = clone(trained)
    assert type(copied) is type(trained) and copied.get_params() == trained.get_params()
    assert copied.options == case.make().options
    with pytest.raises(sklearn.exceptions.NotFittedError):
        check_is_fitted(copied)
    with pytest.raises(NotFittedError):
        copied.predict(case.items)


def test_what_was_set_as_attributes_is_read_cloned_and_trained_with() -> None:
    words = hri.WordRecognizer(num_states=4, cepstra={"num_filters": 20})
    words.options.num_states = 10
    words.options.cepstra.num_filters = 22
    for read in (words, clone(words), words.set_params(seed=3)):
        assert read.get_params()["num_states"] == read.options.num_states == 10
        assert read.get_params()["cepstra__num_filters"] == read.options.cepstra.num_filters == 22
    signs = hri.GestureRecognizer()
    signs.faces = "never"
    assert clone(signs).faces == signs.untrained().faces == "never"


def test_parameters_are_read_and_set_by_their_names(case: Case) -> None:
    recogniser = case.make()
    for path, values in case.grid.items():
        for value in values:
            assert recogniser.set_params(**{path: value}) is recogniser
            assert recogniser.get_params()[path] == value
    top_level = recogniser.get_params(deep=False)
    assert type(recogniser)(**top_level).get_params() == recogniser.get_params()
    before = recogniser.get_params()
    for wrong in (case.wrong, {"no_such": 1}, {"model": "no_such"}):
        with pytest.raises(ValueError, match=next(iter(wrong)).split("__")[-1]):
            recogniser.set_params(**wrong)
    assert recogniser.get_params() == before, "what was refused changed nothing"


def test_parameters_that_are_set_later_leave_the_trained_model_alone(case: Case, trained: Any) -> None:
    recogniser = copy.deepcopy(trained)
    name, values = next(iter(case.grid.items()))
    recogniser.set_params(**{name: values[-1]})
    assert recogniser.decide(case.items) == trained.decide(case.items)
    assert clone(recogniser).get_params()[name] == values[-1]


def test_probabilities_logs_labels_and_score_agree(case: Case, trained: Any) -> None:
    posterior = trained.predict_proba(case.items)
    assert posterior.shape == (len(case.items), 2) and posterior.dtype == np.float64
    np.testing.assert_allclose(posterior.sum(axis=1), 1, atol=1e-6)
    with np.errstate(divide="ignore"):
        np.testing.assert_array_equal(trained.predict_log_proba(case.items), np.log(posterior))
    predicted = trained.predict(case.items)
    np.testing.assert_array_equal(trained.classes_[posterior.argmax(axis=1)], predicted)
    assert trained.score(case.items, case.labels) == np.mean(predicted == case.labels) > 0.9
    swapped = [trained.classes_[1 - list(trained.classes_).index(label)] for label in case.labels]
    assert trained.score(case.items, swapped) < 0.1


def test_labels_that_are_numbers_are_scored_as_they_were_trained(case: Case) -> None:
    numbers = np.array([10 + (label == case.labels[0]) for label in case.labels])
    recogniser = case.make().fit(case.items, numbers)
    assert list(recogniser.classes_) == ["10", "11"]
    assert recogniser.score(case.items, numbers) > 0.9
    with pytest.raises(ValueError, match="X and y differ in length: 12, 11"):
        recogniser.score(case.items, numbers[1:])
    with pytest.raises(ValueError, match="one item or more"):
        recogniser.score([], [])


def test_groups_are_left_out_whole(case: Case) -> None:
    scores = cross_val_score(case.make(), case.items, case.labels, groups=case.persons, cv=GroupKFold(3))
    assert scores.shape == (3,) and scores.min() >= 0.75
    losses = cross_val_score(case.make(), case.items, case.labels, cv=2, scoring="neg_log_loss", n_jobs=2)
    assert np.isfinite(losses).all()
    posterior = cross_val_predict(case.make(), case.items, case.labels, cv=2, method="predict_proba")
    assert posterior.shape == (len(case.items), 2)


def test_grid_search_finds_parameters(case: Case) -> None:
    search = GridSearchCV(case.make(), case.grid, cv=2, error_score="raise").fit(case.items, case.labels)
    assert len(search.cv_results_["params"]) == 4
    assert set(search.best_params_) == set(case.grid) and search.best_score_ > 0.7
    best = search.best_estimator_
    assert {name: best.get_params()[name] for name in case.grid} == search.best_params_
    assert search.score(case.items, case.labels) > 0.9
    np.testing.assert_array_equal(search.predict(case.items), best.predict(case.items))


def test_a_step_before_the_recogniser_makes_a_pipeline(case: Case) -> None:
    pipeline = make_pipeline(FunctionTransformer(case.quieter), case.make()).fit(case.items, case.labels)
    last = pipeline[-1]
    np.testing.assert_array_equal(pipeline.predict(case.items), last.predict(case.quieter(case.items)))
    assert pipeline.score(case.items, case.labels) > 0.9 and list(pipeline.classes_) == list(last.classes_)
    name, values = next(iter(case.grid.items()))
    step = pipeline.steps[-1][0]
    assert type(last).__name__ in repr(pipeline) and type(last).__name__ in pipeline._repr_html_()
    assert clone(pipeline).set_params(**{f"{step}__{name}": values[0]})[-1].get_params()[name] == values[0]


@pytest.mark.parametrize("copied_by", [copy.copy, copy.deepcopy, lambda r: pickle.loads(pickle.dumps(r))])
def test_copies_decide_to_the_bit_alike(case: Case, trained: Any, copied_by: Callable[[Any], Any]) -> None:
    copied = copied_by(trained)
    assert copied.decide(case.items) == trained.decide(case.items)
    assert copied.get_params() == trained.get_params() and copied.options == trained.options
    assert repr(copied) == repr(trained)
    untrained = copied_by(case.make())
    assert untrained.get_params() == case.make().get_params() and not untrained.__sklearn_is_fitted__()


def test_a_copy_does_not_follow_its_original(case: Case, trained: Any) -> None:
    copied = copy.deepcopy(trained)
    name, values = next(iter(case.grid.items()))
    copied.set_params(**{name: values[0]}).fit(case.items, case.labels[::-1])
    assert trained.score(case.items, case.labels) > 0.9


def test_a_broken_state_is_refused(case: Case, trained: Any) -> None:
    state = trained.__getstate__()
    broken = [
        (b"", "params and model"),
        ({**state, "model": "text"}, "dict and bytes"),
        ({**state, "model": state["model"][:-7]}, "state of"),
    ]
    for wrong, message in broken:
        empty = type(trained).__new__(type(trained))
        with pytest.raises(FormatError, match=message):
            empty.__setstate__(wrong)
