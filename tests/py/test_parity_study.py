# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The study of PTBHMM against HMM: its splits and scores, and the whole of it on a small made-up data folder."""

from __future__ import annotations

import json
import os
from pathlib import Path

import numpy as np
import pytest

from conftest import RATE_HZ, tone_word
from hri import studies
from hri.core.errors import InvalidArgument
from hri.datasets.asl_sentences import SignedSentence
from hri.io import write_wav_pcm16
from hri.models import DiscreteHmm, DiscreteHmmOptions, PossibilisticHmmSet, Topology
from hri.studies import parity
from hri.studies.sequences import DELTA_WEIGHT, Example, hand_features, splits_by_person

FORMS = {"a": 600.0, "b": -300.0}
"""Slopes in Hz per second of the tones that stand for words."""


def write_tones(folder: Path, pattern: str, labels: dict[str, str], base_hz: float) -> None:
    """Three speakers say each word three times; `labels` maps a word to its form."""
    for number, speaker in enumerate(("speaker1", "speaker2", "speaker3")):
        for take in range(3):
            for label, form in labels.items():
                path = folder / pattern.format(label=label, person=speaker, take=take)
                path.parent.mkdir(parents=True, exist_ok=True)
                tone = tone_word(base_hz + 40.0 * number, FORMS[form], 10 * number + take)
                write_wav_pcm16(str(path), tone, RATE_HZ)


def write_signs(folder: Path) -> None:
    """Three signers; each video holds UP (the right hand rises), then OVER (it goes aside); one video a rare word."""
    folder.mkdir()
    rng = np.random.default_rng(0)
    hands = ["video,frame,left-x,left-y,right-x,right-y,nose-x,nose-y"]
    words, signers = ["video,speaker,word,startframe,endframe"], ["video,speaker"]
    for video in range(9):
        signer, size = f"signer-{video % 3}", 1.0 + 0.2 * (video % 3)
        signers.append(f"{video},{signer}")
        words += [f"{video},{signer},UP,0,9", f"{video},{signer},OVER,10,19"]
        for frame in range(20):
            up, over = min(frame, 10), max(frame - 10, 0)
            right = np.array([150 + 6 * size * over, 180 - 9 * size * up]) + rng.normal(0, 1, 2)
            hands.append(f"{video},{frame},200,180,{right[0]:.0f},{right[1]:.0f},170,60")
    words.append("0,signer-0,SELDOM,3,7")
    for name, rows in (("hands", hands), ("words", words), ("signers", signers)):
        (folder / f"{name}.csv").write_text("\n".join(rows) + "\n")


@pytest.fixture(scope="module")
def data_dir(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("data")
    write_tones(folder / "fsdd" / "recordings", "{label}_{person}_{take}.wav", {"0": "a", "1": "b"}, 500.0)
    for part, labels, base_hz in (
        ("digits", {"1": "a", "2": "b"}, 500.0),
        ("words", {"ghar": "a", "jeet": "b"}, 1500.0),
    ):
        write_tones(folder / "hindi_words" / part, "{label}/{label}_{person}_{take}.wav", labels, base_hz)
    write_signs(folder / "asl_sentences")
    return folder


def test_the_whole_study_on_made_up_words(data_dir: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(parity, "SEEDS", (0, 1))
    reported: list[tuple[str, int, int]] = []
    study = studies.get_study("ptbhmm-parity")
    result = studies.run_study(study, data_dir, lambda *progress: reported.append(progress))
    assert json.loads(json.dumps(result)) == result
    assert result["seeds"] == [0, 1] and set(result["data_sets"]) == set(parity.SETTINGS)
    num_classes, num_test = 2, 18
    for name, found in result["data_sets"].items():
        assert found["num_test"] == num_test and len(found["folds"]) == 3
        assert {fold["num_classes"] for fold in found["folds"]} == {num_classes}, (
            "a word that one video has is no class"
        )
        methods = found["methods"]
        assert list(methods) == list(parity.METHODS)
        for method in (
            "hmm_forward",
            "hmm_viterbi",
            "product",
            "product_16_bit",
            "product_best_path",
            "min_conditioned",
        ):
            assert methods[method]["accuracy_mean"] >= 0.9, (name, method)
        for method, values in methods.items():
            assert values["accuracy_mean"] == pytest.approx(np.mean(list(values["per_fold"].values())))
            assert values["accuracy_std"] == pytest.approx(np.std(list(values["per_fold"].values())))
            gained = (values["words_gained"] - values["words_lost"]) / num_test
            assert values["difference_to_hmm"] == pytest.approx(gained), method  # folds are of one size here
        # The literal recursions saturate: every class scores alike, so that the true one is a guess.
        assert methods["max_literal"]["accuracy_mean"] == pytest.approx(1 / num_classes)
        assert found["passed"] == all(
            methods[method]["difference_to_hmm"] >= -most for method, most in parity.MOST_LOST.items()
        )
        assert (name, 6, 6) in reported
    assert result["passed"] == all(found["passed"] for found in result["data_sets"].values())


def test_the_command_tells_every_difference(hri, data_dir: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(parity, "SEEDS", (0,))
    monkeypatch.setattr(parity, "SETTINGS", {"asl-words": parity.SETTINGS["asl-words"]})
    result = hri("study", "ptbhmm-parity", "--data", data_dir)
    lines = [line.strip() for line in result.out.splitlines()]
    assert result.code in (0, 1) and lines.count("difference\t+0.00 points to the HMM") >= 1
    place = lines.index("max_literal")
    assert lines[place + 1] == "accuracy\t50.0 % ± 0.0"
    assert lines[place + 2].startswith("difference\t-")


def test_the_study_repeats(data_dir: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(parity, "SEEDS", (3,))
    monkeypatch.setattr(parity, "SETTINGS", {"asl-words": parity.SETTINGS["asl-words"]})
    study = studies.get_study("ptbhmm-parity")
    first, second = (studies.run_study(study, data_dir, lambda *progress: None) for _ in range(2))
    assert first == second


def test_a_person_is_either_trained_or_tested_and_has_no_say_in_the_classes() -> None:
    frames = np.zeros((2, 1), np.float32)
    said = {"ann": "xxyz", "bob": "xyw", "cem": "xxyww"}
    examples = [Example(label, person, frames) for person, labels in said.items() for label in labels]
    splits = {split.person: split for split in splits_by_person(examples, 2)}
    assert {person: split.labels for person, split in splits.items()} == {
        "ann": ["w", "x", "y"],  # z has no example by others
        "bob": ["w", "x", "y"],
        "cem": ["x", "y"],  # of w, bob alone has one example
    }
    for person, split in splits.items():
        assert all(examples[i].person != person for i in split.pool)
        assert [[examples[i].label for i in part] for part in split.train] == [
            [examples[i].label for i in split.pool if examples[i].label == label] for label in split.labels
        ]
        tested = [(examples[i].person, examples[i].label) for i in split.test]
        assert tested == [(person, label) for label in said[person] if label in split.labels]
        assert sorted(split.pool + [i for i, e in enumerate(examples) if e.person == person]) == list(range(12))


def test_hand_features_forget_place_and_size_but_not_motion() -> None:
    rng = np.random.default_rng(1)
    positions = rng.normal(100, 20, (30, 3, 2)).astype("f4")
    features = hand_features(SignedSentence("1", "ann", positions, ()))
    assert features.shape == (30, 8) and features.dtype == np.float32
    np.testing.assert_allclose(features[:, :4].mean(axis=0), 0, atol=1e-5)
    assert np.mean(features[:, :4].astype("f8") ** 2) == pytest.approx(1, rel=1e-5)
    larger = hand_features(SignedSentence("1", "ann", 2 * positions + np.float32(50), ()))
    np.testing.assert_allclose(features, larger, atol=1e-4)
    # A hand that moves by one unit a frame has that velocity wherever the window is whole.
    positions[:] = 0
    positions[:, 1, 0] = np.arange(30)
    features = hand_features(SignedSentence("1", "ann", positions, ()))
    step = features[1, 0] - features[0, 0]
    np.testing.assert_allclose(features[3:-3, 4], DELTA_WEIGHT * step, rtol=1e-5)
    assert not features[:, [1, 2, 3, 5, 6, 7]].any()
    assert not hand_features(SignedSentence("1", "ann", np.full((4, 3, 2), 7, np.float32), ())).any()


def test_a_shared_highest_score_is_a_guess() -> None:
    scores = np.array([[1.0, 2.0, 0.0], [2.0, 2.0, 1.0], [5.0, 5.0, 5.0], [0.0, 1.0, 2.0], [-np.inf] * 3])
    found = parity.shares_right(scores, np.array([1, 0, 2, 0, 1]))
    np.testing.assert_allclose(found, [1, 1 / 2, 1 / 3, 0, 1 / 3])


def test_scores_of_rows_are_those_of_every_path() -> None:
    rng = np.random.default_rng(2)
    setting = parity.Setting(num_states=3, num_codewords=5)
    train = [[rng.integers(0, 5, 12).astype("i4") for _ in range(6)] for _ in range(2)]
    test = [rng.integers(0, 5, length).astype("i4") for length in (1, 2, 6)]
    models = [
        DiscreteHmm.train(
            part,
            DiscreteHmmOptions(
                topology=Topology(kind="left_right", num_states=3, max_jump=1),
                num_symbols=5,
                emission_floor=setting.floor / 5,
                max_iterations=setting.max_iterations,
            ),
        )
        for part in train
    ]
    found = PossibilisticHmmSet(models)
    scores = parity.score_all(train, test, setting)["product_rows"]
    for symbols, row in zip(test, scores, strict=True):
        for c, model in enumerate(models):
            emission = model.emission / model.emission.max(axis=1, keepdims=True)
            best = 0.0
            for moves in range(2 ** (len(symbols) - 1)):
                path = np.cumsum([0] + [moves >> t & 1 for t in range(len(symbols) - 1)])
                if path[-1] < 3:
                    along = found.transition(c)[path[:-1], path[1:]].prod() * emission[path, symbols].prod()
                    best = max(best, float(along))
            assert row[c] == pytest.approx(np.log(best))


def test_too_few_persons_or_words_are_refused(tmp_path: Path) -> None:
    write_tones(tmp_path / "fsdd" / "recordings", "{label}_{person}_{take}.wav", {"0": "a", "1": "b"}, 500.0)
    for path in (tmp_path / "fsdd" / "recordings").glob("*_speaker[23]_*"):
        path.unlink()
    for folder in ("hindi_words/digits", "hindi_words/words", "asl_sentences"):
        (tmp_path / folder).mkdir(parents=True)
    with pytest.raises(InvalidArgument, match="english-digits: needs two persons or more"):
        studies.run_study(studies.get_study("ptbhmm-parity"), tmp_path, lambda *progress: None)


@pytest.mark.slow
@pytest.mark.data
def test_parity_on_real_recordings() -> None:
    result = studies.run_study(
        studies.get_study("ptbhmm-parity"), os.environ["HRI_DATA"], lambda what, done, total: None
    )
    for name, found in result["data_sets"].items():
        differences = {method: found["methods"][method]["difference_to_hmm"] for method in parity.MOST_LOST}
        assert found["passed"], (name, differences)
