# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Evaluation: nobody is trained and tested on, conditions are exact, results repeat."""

from __future__ import annotations

import json
from pathlib import Path
from typing import ClassVar

import cv2
import numpy as np
import pytest

import hri
from hri.errors import InvalidArgument
from hri.evaluation import cross_validate, evaluate_split, expose, make_noise, mix_noise
from hri.recognition import GestureRecognizer, WordRecognizer


class Spy(WordRecognizer):
    """Remembers whom each fold was trained on."""

    trained_on: ClassVar[list[set[str]]] = []

    def fit(self, X, y, *, groups=None, **rest):
        Spy.trained_on.append(set(groups))
        return super().fit(X, y, groups=groups, **rest)


def test_people_are_either_trained_or_tested_on(spoken: Path) -> None:
    dataset = hri.Dataset.load(spoken)
    Spy.trained_on = []
    result = cross_validate(dataset, Spy)
    assert [fold.name for fold in result.folds] == dataset.persons
    for fold, trained_on in zip(result.folds, Spy.trained_on, strict=True):
        tested = {dataset.samples[trial.index].person for trial in fold.trials}
        assert tested == {fold.name} and tested.isdisjoint(trained_on)
    assert sorted(trial.index for trial in result.trials) == list(range(len(dataset)))


def test_fewer_people_can_be_trained_on(spoken: Path) -> None:
    dataset = hri.Dataset.load(spoken)
    Spy.trained_on = []
    result = cross_validate(dataset, Spy, train_persons=1)
    assert [len(persons) for persons in Spy.trained_on] == [1, 1, 1]
    assert result.conditions["train_persons"] == 1
    with pytest.raises(InvalidArgument, match=r"must be 1\.\.2"):
        cross_validate(dataset, Spy, train_persons=3)


def test_results_repeat_and_add_up(spoken: Path, tmp_path: Path) -> None:
    dataset = hri.Dataset.load(spoken)
    results = [cross_validate(dataset, WordRecognizer, noise="white", snr_db=0.0, seed=5) for _ in range(2)]
    assert results[0] == results[1]
    result = results[0]
    assert result.mean == pytest.approx(np.mean([fold.accuracy for fold in result.folds]))
    assert result.std == pytest.approx(np.std([fold.accuracy for fold in result.folds]))
    confusion = result.confusion()
    assert confusion.shape == (2, 3) and confusion.sum() == len(dataset)
    right = sum(trial.best == trial.truth for trial in result.trials)
    assert np.trace(confusion) == right
    told = json.loads(json.dumps(result.to_dict()))
    assert told["conditions"] | {"noise": "white", "snr_db": 0.0, "seed": 5} == told["conditions"]
    result.plot_confusion(tmp_path / "c.png")
    assert cv2.imread(str(tmp_path / "c.png")) is not None


def test_training_on_one_folder_and_testing_on_another(spoken: Path) -> None:
    dataset = hri.Dataset.load(spoken)
    result = evaluate_split(dataset, dataset, WordRecognizer)
    assert len(result.folds) == 1 and len(result.trials) == len(dataset) and result.mean == 1.0
    only_one = hri.Dataset(dataset.root, "speech", [s for s in dataset.samples if s.label == "1"])
    with pytest.raises(InvalidArgument, match="labels that train has not: 2"):
        evaluate_split(only_one, dataset, WordRecognizer)


def test_gestures_get_darker_in_the_test_only(signed: Path) -> None:
    dataset = hri.Dataset.load(signed)
    result = cross_validate(dataset, GestureRecognizer, num_folds=2, exposure=0.5)
    assert result.conditions["exposure"] == 0.5 and result.mean >= 0.75
    with pytest.raises(InvalidArgument, match="is gesture, test is speech"):
        evaluate_split(dataset, hri.Dataset(dataset.root, "speech", []), GestureRecognizer)


@pytest.mark.parametrize("name", ["white", "pink"])
@pytest.mark.parametrize("snr_db", [-10.0, 0.0, 10.0, 30.0])
def test_noise_has_the_ratio_asked_for(name: str, snr_db: float) -> None:
    rng = np.random.default_rng(0)
    speech = (0.1 * rng.normal(size=16000)).astype("f4")
    noise = make_noise(name, 16000, 16000, np.random.default_rng(1))
    added = mix_noise(speech, noise, snr_db).astype("f8") - speech
    ratio = np.mean(speech.astype("f8") ** 2) / np.mean(added**2)
    assert 10 * np.log10(ratio) == pytest.approx(snr_db, abs=1e-3)


def test_pink_noise_falls_by_3_db_an_octave() -> None:
    power = np.abs(np.fft.rfft(make_noise("pink", 1 << 16, 16000, np.random.default_rng(0)))) ** 2
    low, high = power[1024:2048].mean(), power[8192:16384].mean()
    assert 10 * np.log10(low / high) == pytest.approx(9.03, abs=0.7)


def test_noise_from_a_recording_is_cut_and_resampled(spoken: Path) -> None:
    path = str(sorted(spoken.glob("*.wav"))[0])
    noise = make_noise(path, 50000, 8000, np.random.default_rng(0))
    assert noise.shape == (50000,) and noise.dtype == np.float32 and noise.std() > 0
    with pytest.raises(InvalidArgument, match="neither white nor pink nor a file"):
        make_noise("violet", 10, 8000, np.random.default_rng(0))


def test_conditions_out_of_range_are_refused(spoken: Path) -> None:
    x = np.ones(10, "f4")
    with pytest.raises(InvalidArgument, match=r"-30\.\.60"):
        mix_noise(x, x, 99.0)
    with pytest.raises(InvalidArgument, match="no power"):
        mix_noise(x, 0 * x, 10.0)
    with pytest.raises(InvalidArgument, match="shape"):
        mix_noise(x, x[:5], 10.0)
    with pytest.raises(InvalidArgument, match="exposure"):
        expose([np.zeros((2, 2, 3), np.uint8)], 0.0)
    with pytest.raises(InvalidArgument, match="go together"):
        cross_validate(hri.Dataset.load(spoken), WordRecognizer, noise="white")
    bright = expose([np.full((2, 2, 3), 200, np.uint8)], 2.0)
    assert bright[0].dtype == np.uint8 and (bright[0] == 255).all()
