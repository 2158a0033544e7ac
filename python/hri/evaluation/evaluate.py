# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Cross-validation by person, and training on one folder while testing on another."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from hri.core.checks import check_integer
from hri.core.errors import InvalidArgument
from hri.datasets import Dataset, Fold
from hri.evaluation.checks import check_dataset, check_not_empty
from hri.evaluation.conditions import check_exposure, expose
from hri.evaluation.noise import AddNoise, check_noises, check_snr_db
from hri.evaluation.recognizers import Recognizer, factory_of
from hri.evaluation.result import EvaluationItem, EvaluationResult, FoldResult
from hri.evaluation.speech import SpeechRunner, check_max_folds
from hri.media import read_frames
from hri.recognition import SpeechEmbedding

Progress = Callable[[str, int, int], None]
_NUM_FOLDS = 5
"""Where one person at a time would be too many, or persons are not known."""


def cross_validate(
    dataset: Dataset,
    make_recognizer: Callable[[], Recognizer] | Recognizer,
    *,
    num_folds: int | None = None,
    max_folds: int | None = None,
    train_persons: int | None = None,
    leave_out: str | None = None,
    seed: int = 0,
    noise: str | None = None,
    snr_db: float | None = None,
    train_noise: bool = False,
    exposure: float | None = None,
    embedding: SpeechEmbedding | None = None,
    progress: Progress | None = None,
) -> EvaluationResult:
    """Accuracy on people the recogniser has not met.

    Parameters
    ----------
    dataset : Dataset
    make_recognizer : callable or recogniser
        Gives a new, untrained recogniser for every fold: a class, a function, or a recogniser whose options are taken.
        One more is made at the start, to see what it is.
    num_folds : int, optional
        Folds by person; None holds out one person at a time (for gestures with more than 10 persons: 5 folds). Where
        persons are not known, folds are stratified by label, and the result says so; None then makes 5, or as many as
        the rarest label has recordings.
    max_folds : int, optional
        Run only the first folds, one or more.
    train_persons : int, optional
        Train on this many persons of each fold's training part, drawn at random; None takes all.
    leave_out : str, optional
        A condition that the data set knows of every recording, such as "background": one of its values at a time is
        held out, instead of persons.
    seed : int
        0 or more; of folds, of the persons drawn, and of noise.
    noise, snr_db : str and float, optional
        Added to the test clips: see `make_noise` and `mix_noise`.
    train_noise : bool
        Also train on a copy of each clip with such noise at the same SNR; of a recorded noise, training then takes
        the first half and the test the second.
    exposure : float, optional
        Factor on the pixels of the test pictures.
    embedding : SpeechEmbedding, optional
        For words by the front ends "both" and "embedding", as of `WordRecognizer.fit`.
    progress : callable, optional
        Called with (what, done, total).

    Raises
    ------
    InvalidArgument
        For arguments of another type, out of range or that exclude each other, a data set without recordings, a noise
        that is none or silent, or another recogniser than one of words or gestures, as the data set's kind is; before
        anything is read or trained.
    """
    check_dataset(dataset, "dataset")
    check_not_empty(dataset, "dataset")
    make = factory_of(make_recognizer, dataset.kind, embedding)
    check_max_folds(max_folds)
    for value, name in ((num_folds, "num_folds"), (train_persons, "train_persons")):
        if value is not None:
            check_integer(value, name)
    conditions = _conditions(dataset.kind, seed, noise, snr_db, train_noise, exposure)
    if leave_out is not None:
        if num_folds is not None or train_persons is not None:
            raise InvalidArgument("leave_out goes without num_folds and train_persons")
        folds = dataset.folds_by_condition(leave_out)
        conditions["folds"] = f"by {leave_out}"
    elif dataset.persons:
        if num_folds is None and dataset.kind == "gesture" and len(dataset.persons) > 10:
            num_folds = _NUM_FOLDS
        folds = dataset.folds_by_person(num_folds, seed)
        conditions["folds"] = "by person"
        if train_persons is not None:
            folds = [_with_fewer_persons(fold, dataset, train_persons, seed) for fold in folds]
            conditions["train_persons"] = train_persons
    elif train_persons is not None:
        raise InvalidArgument("train_persons needs a data set that names the person of every recording")
    else:
        folds = dataset.folds_stratified(_default_folds(dataset) if num_folds is None else num_folds, seed)
        conditions["folds"] = "stratified by label: persons are not known, so test people may have been met"
    run = _runner(dataset, make, conditions, embedding, progress)
    return EvaluationResult(dataset.labels, [run(fold) for fold in folds[:max_folds]], conditions)


def evaluate_split(
    train: Dataset,
    test: Dataset,
    make_recognizer: Callable[[], Recognizer] | Recognizer,
    *,
    seed: int = 0,
    noise: str | None = None,
    snr_db: float | None = None,
    train_noise: bool = False,
    exposure: float | None = None,
    embedding: SpeechEmbedding | None = None,
    progress: Progress | None = None,
) -> EvaluationResult:
    """Train on one data set, test on another; parameters as for `cross_validate`.

    Returns
    -------
    EvaluationResult
        Its items count from the first recording of `test`.

    Raises
    ------
    InvalidArgument
        When the kinds differ, the test set has a label that was not trained, and as `cross_validate`.
    """
    check_dataset(train, "train")
    check_dataset(test, "test")
    make = factory_of(make_recognizer, train.kind, embedding)
    if train.kind != test.kind:
        raise InvalidArgument(f"train is {train.kind}, test is {test.kind}")
    check_not_empty(train, "train")
    check_not_empty(test, "test")
    unknown = sorted(set(test.labels) - set(train.labels))
    if unknown:
        raise InvalidArgument(f"test has labels that train has not: {', '.join(unknown)}")
    conditions = _conditions(train.kind, seed, noise, snr_db, train_noise, exposure)
    both = Dataset(train.root, train.kind, [*train.samples, *test.samples])
    fold = Fold(str(test.root.name), list(range(len(train))), list(range(len(train), len(both))))
    tested = _runner(both, make, conditions, embedding, progress)(fold)
    items = tuple(replace(item, index=item.index - len(train)) for item in tested.items)
    return EvaluationResult(train.labels, [replace(tested, items=items)], conditions)


def _default_folds(dataset: Dataset) -> int:
    """For persons that are not known."""
    label, fewest = min(Counter(sample.label for sample in dataset.samples).items(), key=lambda item: item[1])
    if fewest < 2:
        raise InvalidArgument(f"label {label!r} has one recording: cross-validation needs two or more of each label")
    return min(_NUM_FOLDS, fewest)


def _with_fewer_persons(fold: Fold, dataset: Dataset, num_persons: int, seed: int) -> Fold:
    persons = sorted({dataset.samples[i].person for i in fold.train})
    if not 1 <= num_persons <= len(persons):
        raise InvalidArgument(f"train_persons is {num_persons}, must be 1..{len(persons)}")
    drawn = set(np.random.default_rng(seed).choice(persons, num_persons, replace=False))
    return replace(fold, train=[i for i in fold.train if dataset.samples[i].person in drawn])


def _conditions(
    kind: str, seed: int, noise: str | None, snr_db: float | None, train_noise: bool, exposure: float | None
) -> dict[str, Any]:
    check_integer(seed, "seed", 0)
    if (noise is None) != (snr_db is None):
        raise InvalidArgument("noise and snr_db go together")
    if train_noise and noise is None:
        raise InvalidArgument("train_noise needs noise and snr_db")
    # A condition that is not applied must not stand in the result.
    if kind == "gesture" and noise is not None:
        raise InvalidArgument("noise is for speech, the data set is gesture")
    if kind == "speech" and exposure is not None:
        raise InvalidArgument("exposure is for gestures, the data set is speech")
    if noise is not None and snr_db is not None:
        check_noises([noise], ("first", "second") if train_noise else ("all",))
        check_snr_db(snr_db)
    if exposure is not None:
        check_exposure(exposure)
    return {
        "seed": seed,
        "noise": noise,
        "snr_db": snr_db,
        "train_noise": train_noise,
        "exposure": exposure,
    }


def _runner(
    dataset: Dataset,
    make_recognizer: Callable[[], Recognizer],
    conditions: dict[str, Any],
    embedding: SpeechEmbedding | None,
    progress: Progress | None,
) -> Callable[[Fold], FoldResult]:
    say = progress or (lambda what, done, total: None)
    if dataset.kind == "gesture":
        if embedding is not None:
            raise InvalidArgument("embedding is for speech, the data set is gesture")
        return _GestureRunner(dataset, make_recognizer, conditions, say).run
    noise, snr_db, train_noise = conditions["noise"], conditions["snr_db"], conditions["train_noise"]
    test = None if noise is None else AddNoise([noise], [snr_db], "second" if train_noise else "all")
    train = [AddNoise([noise], [snr_db], "first")] if train_noise else []
    runner = SpeechRunner(dataset, make_recognizer, {"": test}, train, conditions["seed"], None, say, False, embedding)
    return lambda fold: runner.run(fold)[""]


class _GestureRunner:
    """Features and quality depend on the options alone, so every clip is read once for all folds."""

    def __init__(
        self, dataset: Dataset, make: Callable[[], Any], conditions: dict[str, Any], progress: Progress
    ) -> None:
        self._samples = dataset.samples
        self._make = make
        self._progress = progress
        recognizer = make()
        self._plain: list[tuple[Any, float | None]] = []
        self._exposed: list[tuple[Any, float | None]] = []
        for done, sample in enumerate(dataset.samples):
            frames: Sequence[Any] = read_frames(sample.path).frames
            self._plain.append(recognizer.features_and_quality(frames))
            if conditions["exposure"] is not None:
                self._exposed.append(recognizer.features_and_quality(expose(frames, conditions["exposure"])))
            progress("finding hands", done + 1, len(dataset))

    def run(self, fold: Fold) -> FoldResult:
        recognizer = self._make()
        recognizer.fit_features(
            [self._plain[i][0] for i in fold.train],
            [self._samples[i].label for i in fold.train],
            groups=[self._samples[i].person for i in fold.train],
            progress=lambda done, total: self._progress(f"training without {fold.name}", done, total),
        )
        tested = self._exposed or self._plain
        items = []
        for i in fold.test:
            rows, quality = tested[i]
            decision = replace(recognizer.recognise_features(rows), quality=quality)
            items.append(EvaluationItem(i, self._samples[i].label, decision))
        return FoldResult(fold.name, tuple(items))
