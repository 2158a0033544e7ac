# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What cannot be evaluated is refused before anything is read or trained."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import hri
from hri.core.errors import InvalidArgument
from hri.datasets import Dataset
from hri.evaluation import AddNoise, cross_validate, evaluate_conditions, evaluate_split
from hri.evaluation.recognizers import factory_of
from hri.recognition import SpeakerAdapter


@pytest.fixture
def nothing_read(monkeypatch: pytest.MonkeyPatch) -> None:
    def read(path: Path) -> None:
        raise AssertionError(f"{path} was read")

    monkeypatch.setattr("hri.evaluation.speech.read_audio", read)
    monkeypatch.setattr("hri.evaluation.evaluate.read_frames", read)


class Named(hri.ConnectedWordRecognizer):
    pass


@pytest.mark.usefixtures("nothing_read")
@pytest.mark.parametrize(
    ("make", "found"),
    [
        (hri.ConnectedWordRecognizer, "ConnectedWordRecognizer"),
        (hri.ConnectedWordRecognizer(), "ConnectedWordRecognizer"),
        (lambda: hri.ConnectedWordRecognizer(), "ConnectedWordRecognizer"),
        (Named, "Named"),
        (hri.CommandRecognizer, "CommandRecognizer"),
        (hri.SentenceRecognizer, "SentenceRecognizer"),
        (lambda: hri.SentenceRecognizer(), "SentenceRecognizer"),
        (SpeakerAdapter, "SpeakerAdapter"),
        (lambda: None, "NoneType"),
        (repr(1), "str"),
        (None, "NoneType"),
    ],
)
def test_recognisers_that_do_not_decide_for_a_label_are_refused(
    spoken: Path, make: Callable[[], Any], found: str
) -> None:
    dataset = Dataset.load(spoken)
    for run in (lambda: cross_validate(dataset, make), lambda: evaluate_split(dataset, dataset, make)):
        with pytest.raises(InvalidArgument, match=rf"make_recognizer must be a WordRecognizer.* got {found}$"):
            run()


@pytest.mark.usefixtures("nothing_read")
def test_functions_that_make_recognisers_of_another_kind_are_refused(spoken: Path, signed: Path) -> None:
    with pytest.raises(InvalidArgument, match="the data set is for speech, the recogniser is for gesture"):
        cross_validate(Dataset.load(spoken), lambda: hri.GestureRecognizer())
    with pytest.raises(InvalidArgument, match="the data set is for gesture, the recogniser is for speech"):
        cross_validate(Dataset.load(signed), lambda: hri.WordRecognizer())


def test_words_of_phones_can_be_evaluated_but_take_no_embedding() -> None:
    assert isinstance(factory_of(hri.SubwordRecognizer, "speech")(), hri.SubwordRecognizer)
    with pytest.raises(InvalidArgument, match="embedding is for a WordRecognizer, got SubwordRecognizer"):
        factory_of(hri.SubwordRecognizer, "speech", embedding=object())  # type: ignore[arg-type]


@pytest.mark.usefixtures("nothing_read")
@pytest.mark.parametrize(
    ("given", "complaint"),
    [
        ({"seed": -1}, "^seed is -1, must be 0 or more"),
        ({"seed": 1.0}, r"^seed must be an integer, got 1\.0"),
        ({"seed": None}, "^seed must be an integer, got None"),
        ({"max_folds": 1.0}, r"^max_folds must be an integer, got 1\.0"),
        ({"max_folds": True}, "^max_folds must be an integer, got True"),
        ({"num_folds": 2.0}, r"^num_folds must be an integer, got 2\.0"),
        ({"num_folds": "2"}, "^num_folds must be an integer, got '2'"),
        ({"train_persons": 1.0}, r"^train_persons must be an integer, got 1\.0"),
        ({"noise": "white", "snr_db": "10"}, "^snr_db must be a number, got '10'"),
        ({"noise": 5, "snr_db": 10.0}, "^noise must be a name or a file, got 5"),
        ({"leave_out": ["background"]}, "^condition .* is not known"),
    ],
)
def test_arguments_of_words_are_checked_first(spoken: Path, given: dict[str, Any], complaint: str) -> None:
    dataset = Dataset.load(spoken)
    with pytest.raises(InvalidArgument, match=complaint):
        cross_validate(dataset, hri.WordRecognizer, **given)
    if given.keys() <= {"seed", "noise", "snr_db"}:
        with pytest.raises(InvalidArgument, match=complaint):
            evaluate_split(dataset, dataset, hri.WordRecognizer, **given)
    if given.keys() <= {"seed", "max_folds", "num_folds"}:
        with pytest.raises(InvalidArgument, match=complaint):
            evaluate_conditions(dataset, hri.WordRecognizer, {"": AddNoise(["white"], [10.0])}, **given)


@pytest.mark.usefixtures("nothing_read")
@pytest.mark.parametrize(
    ("wrong", "complaint"), [("a", "must be a number, got 'a'"), (0.0, r"must lie in 0\.05\.\.20")]
)
def test_exposure_is_checked_first(signed: Path, wrong: Any, complaint: str) -> None:
    dataset = Dataset.load(signed)
    for run in (cross_validate, lambda *args, **rest: evaluate_split(dataset, *args, **rest)):
        with pytest.raises(InvalidArgument, match=f"^exposure {complaint}"):
            run(dataset, hri.GestureRecognizer, exposure=wrong)


@pytest.mark.usefixtures("nothing_read")
def test_data_sets_that_are_none_or_empty_are_refused(spoken: Path) -> None:
    dataset = Dataset.load(spoken)
    empty = dataset.select(labels=[])
    with pytest.raises(InvalidArgument, match=r"^dataset has no recordings"):
        cross_validate(empty, hri.WordRecognizer)
    for train, test, name in ((dataset, empty, "test"), (empty, empty, "train")):
        with pytest.raises(InvalidArgument, match=f"^{name} has no recordings"):
            evaluate_split(train, test, hri.WordRecognizer)
    for path in (spoken, str(spoken)):
        with pytest.raises(InvalidArgument, match=r"^dataset must be a Dataset, as Dataset.load reads it, got "):
            cross_validate(path, hri.WordRecognizer)  # type: ignore[arg-type]
        with pytest.raises(InvalidArgument, match=r"^dataset must be a Dataset"):
            evaluate_conditions(path, hri.WordRecognizer, {"": None})  # type: ignore[arg-type]
        with pytest.raises(InvalidArgument, match=r"^train must be a Dataset"):
            evaluate_split(path, dataset, hri.WordRecognizer)  # type: ignore[arg-type]
        with pytest.raises(InvalidArgument, match=r"^test must be a Dataset"):
            evaluate_split(dataset, path, hri.WordRecognizer)  # type: ignore[arg-type]
