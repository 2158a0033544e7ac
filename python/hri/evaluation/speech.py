# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Spoken words under several conditions: trained once a fold, tested under each."""

from __future__ import annotations

import zlib
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from hri.core.checks import check_integer
from hri.core.errors import InvalidArgument
from hri.datasets import Dataset, Fold
from hri.evaluation.checks import check_dataset
from hri.evaluation.conditions import Condition, FrontEnd, Samples
from hri.evaluation.result import EvaluationItem, EvaluationResult, FoldResult
from hri.media import naming_file, naming_files, read_audio
from hri.recognition import SpeakerAdapter, SpeechEmbedding

Progress = Callable[[str, int, int], None]
_TRAIN, _TEST, _ORDER = 0, 1, 2


def adapting(test: str) -> str:
    """The name under which `evaluate_conditions` reports a test measured while adapting."""
    return f"{test}, adapting".removeprefix(", ")


def check_max_folds(max_folds: int | None) -> None:
    """Refuse to run no fold, or folds counted from the end. Raises InvalidArgument."""
    if max_folds is not None:
        check_integer(max_folds, "max_folds", 1)


class SpeechRunner:
    """Clips are read once; what is random in a clip follows from the seed, the condition and the clip's place in the
    data set, not from the fold.

    Parameters
    ----------
    dataset : Dataset
    make_recognizer : callable
        Gives a new, untrained recogniser for every fold.
    tests : mapping of str to Condition or None
        Every test clip is heard under each; None leaves it as it is.
    train : sequence of Condition
        Training also gets a copy of every clip under each of these.
    seed : int
    front_end : FrontEnd, optional
        Done to every clip, after the condition.
    progress : callable
        Called with (what, done, total).
    adapt : bool
        Also run every test in random order with an unsupervised `SpeakerAdapter`.
    embedding : SpeechEmbedding, optional
        What `fit` takes for the front ends "both" and "embedding".
    """

    def __init__(
        self,
        dataset: Dataset,
        make_recognizer: Callable[[], Any],
        tests: Mapping[str, Condition | None],
        train: Sequence[Condition],
        seed: int,
        front_end: FrontEnd | None,
        progress: Progress,
        adapt: bool = False,
        embedding: SpeechEmbedding | None = None,
    ) -> None:
        self._samples = dataset.samples
        self._adapt = adapt
        # What has no such front end need not know the word.
        self._fit_with: dict[str, Any] = {} if embedding is None else {"embedding": embedding}
        self._make = make_recognizer
        self._tests = tests
        self._train = train
        self._seed = seed
        self._front_end = front_end
        self._progress = progress
        self._clips: list[tuple[Samples, int]] = []
        for done, sample in enumerate(dataset.samples):
            audio = read_audio(sample.path)
            self._clips.append((audio.samples, audio.sample_rate_hz))
            progress("reading", done + 1, len(dataset))

    def _heard(self, index: int, condition: Condition | None, *key: int) -> tuple[Samples, int]:
        return self._through(*self._under(index, condition, *key))

    def _under(self, index: int, condition: Condition | None, *key: int) -> tuple[Samples, int]:
        samples, rate = self._clips[index]
        if condition is not None:
            samples = condition(samples, rate, np.random.default_rng([self._seed, *key, index]))
        return samples, rate

    def _through(self, samples: Samples, rate: int) -> tuple[Samples, int]:
        return (samples, rate) if self._front_end is None else self._front_end(samples, rate)

    def run(self, fold: Fold) -> dict[str, FoldResult]:
        """Train without the held-out persons and test under every condition."""
        recognizer = self._make()
        heard = [self._heard(i, None) for i in fold.train]
        for number, added in enumerate(self._train):
            heard += [self._heard(i, added, _TRAIN, number) for i in fold.train]
        indices = fold.train * (1 + len(self._train))
        fit_with = dict(self._fit_with)
        if self._train and not any(self._samples[i].person for i in fold.train):
            fit_with["recordings"] = [str(i) for i in indices]  # a recording is held out with its copies
        with naming_files([self._samples[i].path for i in indices], "X"):
            recognizer.fit(
                [samples for samples, _ in heard],
                [self._samples[i].label for i in indices],
                sample_rate_hz=[rate for _, rate in heard],
                groups=[self._samples[i].person for i in indices],
                progress=lambda done, total: self._progress(f"training without {fold.name}", done, total),
                **fit_with,
            )
        results = {}
        for name, condition in self._tests.items():
            heard_as = (condition, zlib.crc32(name.encode()))
            results[name] = self._test(fold, name, recognizer, fold.test, *heard_as)
            if self._adapt:
                order = np.random.default_rng([self._seed, _ORDER]).permutation(fold.test).tolist()
                listener = SpeakerAdapter(recognizer)
                results[adapting(name)] = self._test(fold, adapting(name), listener, order, *heard_as)
        return results

    def _test(
        self, fold: Fold, name: str, listener: Any, order: Sequence[int], condition: Condition | None, key: int
    ) -> FoldResult:
        items = []
        for done, i in enumerate(order):
            heard = self._under(i, condition, _TEST, key)  # what fails here is the condition, not the recording
            with naming_file(self._samples[i].path):
                decision = listener.recognise(*self._through(*heard))
            items.append(EvaluationItem(i, self._samples[i].label, decision))
            self._progress(f"testing {fold.name} {name}".rstrip(), done + 1, len(order))
        return FoldResult(fold.name, tuple(items))


def evaluate_conditions(
    dataset: Dataset,
    make_recognizer: Callable[[], Any],
    tests: Mapping[str, Condition | None],
    *,
    train: Sequence[Condition] = (),
    num_folds: int | None = None,
    max_folds: int | None = None,
    seed: int = 0,
    front_end: FrontEnd | None = None,
    adapt: bool = False,
    progress: Progress | None = None,
) -> dict[str, EvaluationResult]:
    """Accuracy on speakers the recogniser has not met, under several conditions from one training.

    Parameters
    ----------
    dataset : Dataset
        Of speech, with the person of every recording.
    make_recognizer : callable
        Gives a new, untrained recogniser for every fold: `WordRecognizer`, or anything with its `fit` and `recognise`.
    tests : mapping of str to Condition or None
        Such as ``{"clean": None, "10 dB": AddNoise(["white"], [10.0])}``.
    train : sequence of Condition
        Training also gets a copy of every clip under each of these.
    num_folds : int, optional
        Folds by person; None holds out one person at a time.
    max_folds : int, optional
        Run only the first folds.
    seed : int
        Of folds and of what is random in the conditions.
    front_end : FrontEnd, optional
        Done to every clip of training and test after the condition.
    adapt : bool
        Also run each test, in random order, with an unsupervised `SpeakerAdapter`: every word is decided before it is
        learned from. Test folds have to be of one person each.
    progress : callable, optional
        Called with (what, done, total).

    Returns
    -------
    dict of str to EvaluationResult
        In the order of `tests`; what was measured while adapting has the name that `adapting` gives.

    Raises
    ------
    InvalidArgument
        For what is no data set, recordings without persons, fewer than two persons, folds or a seed that are no
        integers or out of range, or `adapt` with several persons in a fold.
    """
    check_dataset(dataset, "dataset")
    check_max_folds(max_folds)
    say = progress or (lambda what, done, total: None)
    folds = dataset.folds_by_person(num_folds, seed)[:max_folds]
    if adapt and any(len({dataset.samples[i].person for i in fold.test}) > 1 for fold in folds):
        raise InvalidArgument("adapt needs folds that hold out one person each")
    runner = SpeechRunner(dataset, make_recognizer, tests, train, seed, front_end, say, adapt)
    found = [runner.run(fold) for fold in folds]
    common = {"seed": seed, "folds": "by person"}
    return {
        name: EvaluationResult(dataset.labels, [results[name] for results in found], {**common, "condition": name})
        for name in found[0]
    }
