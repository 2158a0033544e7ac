# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Evaluation: no person is trained and tested on, conditions are exact, results repeat."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any, ClassVar

import cv2
import numpy as np
import pytest

import hri
from hri.core.errors import InvalidArgument
from hri.evaluation import (
    AddNoise,
    EvaluationResult,
    active_power,
    cross_validate,
    evaluate_conditions,
    evaluate_split,
    expose,
    make_noise,
    mix_noise,
)
from hri.evaluation.result import EvaluationItem, FoldResult
from hri.recognition import Decision, GestureRecognizer, NBest, WordRecognizer


class Words(WordRecognizer):
    """Without filler words, whose models take most of the time to train."""

    def fit(self, X, y, **rest):
        return super().fit(X, y, fillers=(), **rest)


class Spy(Words):
    """Remembers whom each fold was trained on, and with which clips."""

    trained_on: ClassVar[list[set[str]]] = []
    clips: ClassVar[list[list[np.ndarray]]] = []

    def fit(self, X, y, *, groups=None, **rest):
        Spy.trained_on.append(set(groups))
        Spy.clips.append(list(X))
        return super().fit(X, y, groups=groups, **rest)


def test_people_are_either_trained_or_tested_on(spoken: Path) -> None:
    dataset = hri.Dataset.load(spoken)
    Spy.trained_on = []
    result = cross_validate(dataset, Spy)
    assert [fold.name for fold in result.folds] == dataset.persons
    for fold, trained_on in zip(result.folds, Spy.trained_on, strict=True):
        tested = {dataset.samples[item.index].person for item in fold.items}
        assert tested == {fold.name} and tested.isdisjoint(trained_on)
    assert sorted(item.index for item in result.items) == list(range(len(dataset)))


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
    results = [cross_validate(dataset, Words, noise="white", snr_db=20.0, seed=5) for _ in range(2)]
    assert results[0] == results[1]
    assert any(item.decision.nbest for item in results[0].items)
    result = results[0]
    assert result.mean == pytest.approx(np.mean([fold.accuracy for fold in result.folds]))
    assert result.std == pytest.approx(np.std([fold.accuracy for fold in result.folds]))
    confusion = result.confusion()
    assert confusion.shape == (2, 3) and confusion.sum() == len(dataset)
    right = sum(item.best == item.truth for item in result.items)
    assert np.trace(confusion) == right
    reported = json.loads(json.dumps(result.to_dict()))
    assert reported["conditions"] | {"noise": "white", "snr_db": 20.0, "seed": 5} == reported["conditions"]
    result.plot_confusion(tmp_path / "c.png")
    assert cv2.imread(str(tmp_path / "c.png")) is not None


def test_another_seed_is_another_noise(spoken: Path) -> None:
    dataset = hri.Dataset.load(spoken)
    first, second = (cross_validate(dataset, Words, noise="white", snr_db=20.0, seed=seed) for seed in (1, 2))
    scores = [[t.decision.nbest[0].log_score for t in result.items] for result in (first, second)]
    assert all(one != other for one, other in zip(*scores, strict=True))


def test_noise_is_in_the_test_clips_and_in_training_only_when_asked(spoken: Path) -> None:
    dataset = hri.Dataset.load(spoken)
    clean = [hri.read_audio(sample.path).samples for sample in dataset.samples]
    Spy.clips = []
    plain = cross_validate(dataset, Spy)
    noisy = cross_validate(dataset, Spy, noise="pink", snr_db=5.0)
    cross_validate(dataset, Spy, noise="pink", snr_db=5.0, train_noise=True)
    assert [t.decision for t in plain.items] != [t.decision for t in noisy.items]
    for fold, (without, tested_only, both) in enumerate(zip(*(Spy.clips[i : i + 3] for i in (0, 3, 6)), strict=True)):
        persons = {s.person for s in dataset.samples} - {plain.folds[fold].name}
        expected = [c for c, s in zip(clean, dataset.samples, strict=True) if s.person in persons]
        for clips in (without, tested_only, both[: len(expected)]):
            assert all(np.array_equal(a, b) for a, b in zip(clips, expected, strict=True))
        assert len(both) == 2 * len(expected)
        for noise_too, alone in zip(both[len(expected) :], expected, strict=True):
            added = noise_too.astype("f8") - alone
            assert 10 * np.log10(active_power(alone, 16000) / np.mean(added**2)) == pytest.approx(5, abs=1e-3)


def test_training_on_one_folder_and_testing_on_another(spoken: Path) -> None:
    dataset = hri.Dataset.load(spoken)
    result = evaluate_split(dataset, dataset, Words)
    assert len(result.folds) == 1 and len(result.items) == len(dataset) and result.mean == 1.0
    assert [item.index for item in result.items] == list(range(len(dataset))), "counted in the test set"
    only_one = hri.Dataset(dataset.root, "speech", [s for s in dataset.samples if s.label == "1"])
    with pytest.raises(InvalidArgument, match="labels that train has not: 2"):
        evaluate_split(only_one, dataset, Words)


def test_gestures_get_darker_in_the_test_only(signed: Path) -> None:
    dataset = hri.Dataset.load(signed)
    bright, dark = (cross_validate(dataset, GestureRecognizer, num_folds=2, exposure=e) for e in (None, 0.5))
    assert dark.conditions["exposure"] == 0.5 and dark.mean >= 0.75
    fold = dataset.folds_by_person(2, 0)[0]
    frames = [hri.read_frames(sample.path).frames for sample in dataset.samples]
    by_hand = GestureRecognizer().fit(
        [frames[i] for i in fold.train],
        [dataset.samples[i].label for i in fold.train],
        groups=[dataset.samples[i].person for i in fold.train],
    )
    for result, factor in ((bright, 1.0), (dark, 0.5)):
        expected = [by_hand.recognise(expose(frames[i], factor)) for i in fold.test]
        found = [item.decision for item in result.folds[0].items]
        assert found == expected
        qualities = [decision.quality for decision in found]
        assert qualities == [decision.quality for decision in expected] and all(qualities)
    assert bright.items != dark.items


@pytest.mark.parametrize("options", [{}, {"num_hands": 2}])
def test_features_with_quality_are_those_without_to_the_bit(signed: Path, options: dict[str, Any]) -> None:
    signs = GestureRecognizer(**options)
    for sample in hri.Dataset.load(signed).samples:
        rows, quality = signs.features_and_quality(sample)
        np.testing.assert_array_equal(rows, signs.features(sample))
        assert quality is not None and 0 < quality <= 1


def test_modes_are_not_mixed(signed: Path) -> None:
    dataset = hri.Dataset.load(signed)
    with pytest.raises(InvalidArgument, match="is gesture, test is speech"):
        evaluate_split(dataset, hri.Dataset(dataset.root, "speech", []), GestureRecognizer)
    with pytest.raises(InvalidArgument, match="noise is for speech"):
        cross_validate(dataset, GestureRecognizer, noise="white", snr_db=3.0)


def test_confusion_counts_every_trial_at_its_place(tmp_path: Path) -> None:
    def item(index: int, truth: str, best: str | None, status: str = "recognised") -> EvaluationItem:
        nbest = () if best is None else (NBest(best, 0.9, -1.0),)
        return EvaluationItem(index, truth, Decision("speech", best or status, status, 0.9, nbest=nbest))

    items = [item(0, "a", "a"), item(1, "a", "b"), item(2, "b", "b", "unknown"), item(3, "b", None, "no_input")]
    result = EvaluationResult(["a", "b"], [FoldResult("x", tuple(items[:3])), FoldResult("y", tuple(items[3:]))])
    assert result.confusion().tolist() == [[1, 1, 0], [0, 1, 1]]
    assert (result.mean, result.std) == (pytest.approx(1 / 3), pytest.approx(1 / 3))
    assert [fold.rejected for fold in result.folds] == [pytest.approx(1 / 3), 1.0]


@pytest.mark.parametrize("name", ["white", "pink"])
@pytest.mark.parametrize("snr_db", [-10.0, 0.0, 10.0, 30.0])
def test_noise_has_the_ratio_asked_for(name: str, snr_db: float) -> None:
    rng = np.random.default_rng(0)
    speech = (0.1 * rng.normal(size=16000)).astype("f4")
    noise = make_noise(name, 16000, 16000, np.random.default_rng(1))
    added = mix_noise(speech, noise, snr_db, 16000).astype("f8") - speech
    ratio = np.mean(speech.astype("f8") ** 2) / np.mean(added**2)
    assert 10 * np.log10(ratio) == pytest.approx(snr_db, abs=1e-3)


@pytest.mark.parametrize(("below_db", "counts"), [(13.0, True), (15.5, True), (16.3, False)])
def test_what_lies_15_9_db_below_the_active_level_is_a_pause(below_db: float, counts: bool) -> None:
    """ITU-T P.56, method B. Half of it is a signal of power 1, the other half lies so far below the level of both."""
    ratio = 10 ** (-below_db / 10)
    soft = 0.5 * ratio / (1 - 0.5 * ratio)
    samples = np.sqrt(np.repeat([1.0, soft], 8000)).astype("f4")
    assert active_power(samples, 16000) == pytest.approx((1 + soft) / 2 if counts else 1.0, rel=1e-4)


def test_pauses_do_not_count_in_the_level_of_speech() -> None:
    tone = np.sin(np.arange(8000) * 0.3).astype("f4")
    pause = 1e-3 * np.random.default_rng(0).standard_normal(24000).astype("f4")
    assert active_power(np.concatenate([pause, tone]), 16000) == pytest.approx(0.5, rel=1e-3)
    assert active_power(tone, 16000) == pytest.approx(0.5, rel=1e-3)
    # Two levels of speech 10 dB apart both count.
    assert active_power(np.concatenate([tone, tone * 10**-0.5]), 16000) == pytest.approx(0.275, rel=1e-3)
    assert active_power(np.zeros(999, "f4"), 16000) == 0.0
    assert active_power(np.ones(3, "f4"), 16000) == 1.0


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
    with pytest.raises(InvalidArgument, match="'middle' of a noise is none of all, first, second"):
        make_noise(path, 10, 8000, np.random.default_rng(0), "middle")


def test_training_and_test_hear_other_halves_of_a_noise(tmp_path: Path) -> None:
    path = str(tmp_path / "steps.wav")
    hri._native.write_wav_pcm16(path, np.repeat(np.array([0.25, 0.5], "f4"), 8000), 8000)
    rng = np.random.default_rng(0)
    for part, levels in (("first", {0.25}), ("second", {0.5}), ("all", {0.25, 0.5})):
        pieces = [make_noise(path, 3000, 8000, rng, part) for _ in range(30)]
        assert all(piece.shape == (3000,) for piece in pieces)
        assert {round(float(x), 2) for piece in pieces for x in piece} == levels
    assert set(np.round(make_noise(path, 9000, 8000, rng, "first"), 2)) == {np.float32(0.25)}, "goes round when short"
    make_noise(path, 3000, 8000, rng, "first")[:] = 9.0
    assert max(make_noise(path, 3000, 8000, rng, "first")) < 1, "the kept recording is not changed"


def test_one_training_is_tested_under_every_condition(spoken: Path) -> None:
    dataset = hri.Dataset.load(spoken)
    noisy = AddNoise(["white", "pink"], [0.0, 10.0])
    halved: list[int] = []

    def front_end(samples: np.ndarray, rate: int) -> tuple[np.ndarray, int]:
        halved.append(len(samples))
        return samples[::2].copy(), rate // 2

    Spy.trained_on, Spy.clips = [], []
    results = evaluate_conditions(dataset, Spy, {"clean": None, "noisy": noisy}, train=[noisy], front_end=front_end)
    assert list(results) == ["clean", "noisy"] and len(Spy.trained_on) == 3, "trained once a fold"
    assert [len(clips) for clips in Spy.clips] == [24, 24, 24], "a noisy copy of each of 12 clips"
    assert len(halved) == 3 * (24 + 2 * 6) and set(map(len, Spy.clips[0])) == {n // 2 for n in set(halved)}
    assert results["clean"].mean > results["noisy"].mean or results["clean"].items != results["noisy"].items
    assert results["noisy"].conditions["condition"] == "noisy"
    again = evaluate_conditions(dataset, Words, {"noisy": noisy}, train=[noisy], front_end=front_end)
    assert again["noisy"].folds == results["noisy"].folds, "what a condition draws does not depend on the others"


def test_where_a_noise_is_silent_another_piece_is_drawn(tmp_path: Path) -> None:
    path, speech = str(tmp_path / "pauses.wav"), np.ones(800, "f4")
    noise = np.zeros(32000, "f4")
    noise[24000:] = 0.1 * np.random.default_rng(0).standard_normal(8000)
    hri._native.write_wav_pcm16(path, noise, 8000)
    condition = AddNoise([path], [10.0])
    silent = 0
    for seed in range(20):
        heard = condition(speech, 8000, np.random.default_rng(seed))
        assert heard.std() > 0
        rng = np.random.default_rng(seed)
        rng.integers(1), rng.integers(1)
        piece = make_noise(path, 800, 8000, rng)
        if piece.any():
            np.testing.assert_array_equal(heard, mix_noise(speech, piece, 10.0, 8000))
        silent += not piece.any()
    assert 0 < silent < 20
    with pytest.raises(InvalidArgument, match=r"noise .*pauses\.wav is silent in 20 pieces"):
        AddNoise([path], [10.0], "first")(speech, 8000, np.random.default_rng(0))


@pytest.mark.parametrize(
    ("given", "complaint"),
    [
        ({"noise": "whte", "snr_db": 10.0}, "^noise whte is neither white nor pink nor a file"),
        ({"noise": "white", "snr_db": float("nan")}, r"^snr_db must lie in -30\.\.60, got nan"),
        ({"noise": "half.wav", "snr_db": 10.0, "train_noise": True}, "^noise half.wav is silent in its second half"),
        ({"noise": "silence.wav", "snr_db": 10.0}, "^noise silence.wav is silent$"),
        ({"max_folds": 0}, "^max_folds is 0"),
        ({"max_folds": -1}, "^max_folds is -1"),
    ],
)
def test_arguments_are_refused_before_anything_is_read(
    spoken: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, given: dict[str, Any], complaint: str
) -> None:
    monkeypatch.chdir(tmp_path)
    hri._native.write_wav_pcm16("silence.wav", np.zeros(8000, "f4"), 8000)
    hri._native.write_wav_pcm16("half.wav", np.repeat(np.array([0.5, 0.0], "f4"), 4000), 8000)
    dataset, done = hri.Dataset.load(spoken), []
    with pytest.raises(InvalidArgument, match=complaint):
        cross_validate(dataset, Words, progress=lambda *args: done.append(args), **given)
    if "noise" in given:
        with pytest.raises(InvalidArgument, match=complaint):
            evaluate_split(dataset, dataset, Words, progress=lambda *args: done.append(args), **given)
    else:
        with pytest.raises(InvalidArgument, match=complaint):
            evaluate_conditions(dataset, Words, {"": None}, progress=lambda *args: done.append(args), **given)
    assert not done


def test_other_recognisers_are_refused_before_anything_is_read(spoken: Path) -> None:
    dataset = hri.Dataset.load(spoken)
    done: list[Any] = []
    for wrong, complaint in (
        (hri.SubwordRecognizer(), "make_recognizer must be .* got SubwordRecognizer"),
        (GestureRecognizer(), "the data set is for speech, the recogniser is for gesture"),
        (GestureRecognizer, "the data set is for speech, the recogniser is for gesture"),
    ):
        with pytest.raises(InvalidArgument, match=complaint):
            cross_validate(dataset, wrong, progress=lambda *args: done.append(args))
    with pytest.raises(InvalidArgument, match=r"recognizer must be a WordRecognizer .* got SubwordRecognizer"):
        hri.train(dataset, hri.SubwordRecognizer())  # type: ignore[call-overload]
    assert not done


def test_what_a_recogniser_has_is_kept_in_every_fold(signed: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[Any] = []
    fit = GestureRecognizer.fit_features

    def spy(self: GestureRecognizer, *args: Any, **rest: Any) -> GestureRecognizer:
        seen.append((self.faces, self.options.seed))
        return fit(self, *args, **rest)

    monkeypatch.setattr(GestureRecognizer, "fit_features", spy)
    recogniser = GestureRecognizer(seed=3)
    recogniser.faces, recogniser.options.seed = "never", 4
    cross_validate(hri.Dataset.load(signed), recogniser, num_folds=2)
    assert seen == [("never", 4)] * 2


def test_few_recordings_of_unknown_persons_make_fewer_folds(spoken: Path) -> None:
    known = hri.Dataset.load(spoken)
    samples = [replace(sample, person="") for sample in known.samples]
    few = [s for s in samples if s.label == "1"][:3] + [s for s in samples if s.label == "2"]
    result = cross_validate(hri.Dataset(known.root, "speech", few), Words)
    assert len(result.folds) == 3 and sum(len(fold.items) for fold in result.folds) == len(few)
    with pytest.raises(InvalidArgument, match=r"num_folds is 5, must be 2\.\.3"):
        cross_validate(hri.Dataset(known.root, "speech", few), Words, num_folds=5)
    with pytest.raises(InvalidArgument, match="label '1' has one recording: cross-validation needs two or more"):
        cross_validate(hri.Dataset(known.root, "speech", few[2:]), Words)


def test_conditions_out_of_range_are_refused(spoken: Path) -> None:
    x = np.ones(10, "f4")
    with pytest.raises(InvalidArgument, match=r"-30\.\.60"):
        mix_noise(x, x, 99.0, 8000)
    with pytest.raises(InvalidArgument, match="no power"):
        mix_noise(x, 0 * x, 10.0, 8000)
    with pytest.raises(InvalidArgument, match="shape"):
        mix_noise(x, x[:5], 10.0, 8000)
    with pytest.raises(InvalidArgument, match="exposure"):
        expose([np.zeros((2, 2, 3), np.uint8)], 0.0)
    with pytest.raises(InvalidArgument, match="go together"):
        cross_validate(hri.Dataset.load(spoken), Words, noise="white")
    with pytest.raises(InvalidArgument, match="train_noise needs"):
        cross_validate(hri.Dataset.load(spoken), Words, train_noise=True)
    with pytest.raises(InvalidArgument, match="exposure is for gestures"):
        cross_validate(hri.Dataset.load(spoken), Words, exposure=0.5)
    bright = expose([np.full((2, 2, 3), 200, np.uint8)], 2.0)
    assert bright[0].dtype == np.uint8 and (bright[0] == 255).all()
