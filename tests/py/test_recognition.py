# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Recognisers in Python: scikit-learn's conventions, honest answers, errors that name the place."""

from __future__ import annotations

import json
import os
import signal
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import hri
from conftest import PERSONS, RATE_HZ, tone_word
from hri.core.errors import Interrupted, InvalidArgument
from hri.signal import resample

Clips = tuple[list[np.ndarray], list[str], list[str]]


@pytest.fixture(scope="module")
def clips() -> Clips:
    """Rising and falling tones by three persons: clips, labels, persons."""
    rows = [
        (tone_word(base_hz, slope, 7 * take + number), label, person)
        for number, (person, base_hz) in enumerate(PERSONS.items())
        for take in range(3)
        for label, slope in (("rise", 800.0), ("fall", -350.0))
    ]
    return tuple(map(list, zip(*rows, strict=True)))


@pytest.fixture(scope="module")
def words(clips: Clips) -> hri.WordRecognizer:
    x, y, persons = clips
    return hri.WordRecognizer().fit(x, y, sample_rate_hz=RATE_HZ, groups=persons)


def test_words_follow_scikit_learn(words: hri.WordRecognizer, clips: Clips) -> None:
    x, y, _ = clips
    assert list(words.classes_) == ["fall", "rise"]
    assert list(words.predict(x, RATE_HZ)) == y
    assert words.score(x, y, RATE_HZ) == 1.0
    probabilities = words.predict_proba(x, RATE_HZ)
    assert probabilities.shape == (len(x), 2)
    np.testing.assert_allclose(probabilities.sum(axis=1), 1, atol=1e-6)
    assert words.scores(x[0], RATE_HZ).dtype == np.float32
    assert hri.WordRecognizer(**words.get_params(deep=False)).get_params(deep=False) == words.get_params(deep=False)


@pytest.mark.parametrize("model", ["hmm", "ptbhmm"])
def test_unseen_takes_and_persons_are_recognised(clips: Clips, model: str) -> None:
    x, y, persons = clips
    train = [i for i, person in enumerate(persons) if person != "middle"]
    words = hri.WordRecognizer(model=model).fit(
        [x[i] for i in train], [y[i] for i in train], sample_rate_hz=RATE_HZ, groups=[persons[i] for i in train]
    )
    test = [i for i in range(len(x)) if i not in train]
    assert words.score([x[i] for i in test], [y[i] for i in test], RATE_HZ) == 1.0


def test_decision_is_told_whole(words: hri.WordRecognizer, clips: Clips) -> None:
    decision = words.recognise(clips[0][-2], RATE_HZ)
    assert (decision.mode, decision.status, decision.label) == ("speech", "recognised", "rise")
    assert [entry.label for entry in decision.nbest] == ["rise", "fall"]
    assert decision.nbest[0].probability == decision.confidence >= decision.nbest[1].probability
    assert sum(entry.probability for entry in decision.nbest) == pytest.approx(1)
    assert json.loads(json.dumps(decision.to_dict()))["nbest"][0]["label"] == "rise"


@pytest.mark.parametrize("x", [np.zeros(8000), np.full(8000, 0.2), 1e-5 * np.ones(8000)])
def test_silence_is_no_input(words: hri.WordRecognizer, x: np.ndarray) -> None:
    decision = words.recognise(x.astype("f4"), RATE_HZ)
    assert (decision.status, decision.label, decision.confidence, decision.nbest) == ("no_input", "no_input", 0.0, ())


@pytest.mark.data
def test_words_that_were_not_trained_are_rejected_more_often() -> None:
    data = Path(os.environ["HRI_DATA"]) / "hindi_words"
    words = hri.train(hri.Dataset.load(data / "digits", "speech"), hri.WordRecognizer())
    assert isinstance(words, hri.WordRecognizer)

    def rejected(folder: str) -> float:
        samples = hri.Dataset.load(data / folder, "speech").samples[::4]
        return float(np.mean([words.recognise(s.path).status == "unknown" for s in samples]))

    assert rejected("words") > 0.3 > 5 * rejected("digits")


def test_another_rate_is_resampled_and_said(words: hri.WordRecognizer, clips: Clips) -> None:

    slower = resample(clips[0][0], RATE_HZ, 22050)
    decision = words.recognise(slower, 22050)
    assert decision.label == "rise"
    assert any("22050" in note and "16000" in note for note in decision.notes)


def test_bad_audio_is_refused_with_its_place(words: hri.WordRecognizer, clips: Clips) -> None:
    x, y, _ = clips
    broken = x[0].copy()
    broken[77] = np.nan
    with pytest.raises(InvalidArgument, match=r"^audio is not finite at sample 77"):
        words.recognise(broken, RATE_HZ)
    with pytest.raises(InvalidArgument, match=r"^X\[1\]: .*index 77"):
        hri.WordRecognizer().fit([x[1], broken], ["a", "b"], sample_rate_hz=RATE_HZ)
    with pytest.raises(InvalidArgument, match="too short"):
        words.recognise(x[0][:10], RATE_HZ)
    with pytest.raises(InvalidArgument, match="one-dimensional"):
        words.recognise(x[0].reshape(2, -1), RATE_HZ)
    with pytest.raises(InvalidArgument, match="X, y and groups differ in length: 2, 1, 2"):
        hri.WordRecognizer().fit(x[:2], y[:1], sample_rate_hz=RATE_HZ)
    with pytest.raises(InvalidArgument, match="not trained"):
        hri.WordRecognizer().recognise(x[0], RATE_HZ)


def test_labels_without_a_usable_recording_are_named(clips: Clips) -> None:
    x, y, _ = clips
    with pytest.raises(InvalidArgument, match="quiet"):
        hri.WordRecognizer().fit([*x, np.zeros(8000, "f4")], [*y, "quiet"], sample_rate_hz=RATE_HZ)
    with pytest.raises(InvalidArgument):
        hri.WordRecognizer().fit([], [], sample_rate_hz=RATE_HZ)


def test_one_sample_a_class_is_enough(clips: Clips) -> None:
    x, y, _ = clips
    words = hri.WordRecognizer().fit(x[:2], y[:2], sample_rate_hz=RATE_HZ)
    assert list(words.predict(x[:2], RATE_HZ)) == y[:2]


def test_ctrl_c_ends_training_and_leaves_the_recogniser_as_it_was(words: hri.WordRecognizer, clips: Clips) -> None:
    x, y, persons = clips
    before = words.scores(x[0], RATE_HZ)
    steps = []

    def interrupt(done: int, total: int) -> None:
        steps.append(done)
        if len(steps) == 1:
            signal.raise_signal(signal.SIGINT)

    with pytest.raises((Interrupted, KeyboardInterrupt)):
        words.fit(x, y, sample_rate_hz=RATE_HZ, groups=persons, progress=interrupt)
    assert len(steps) == 1
    np.testing.assert_array_equal(words.scores(x[0], RATE_HZ), before)


def test_many_threads_give_the_same_answers(words: hri.WordRecognizer, clips: Clips) -> None:
    expected = [words.recognise(x, RATE_HZ) for x in clips[0]]
    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(lambda x: words.recognise(x, RATE_HZ), clips[0] * 5))
    assert found == expected * 5


def test_other_threads_run_while_training(clips: Clips) -> None:
    """Training holds the interpreter lock only for its callbacks."""
    x, y, _ = clips
    ticks = 0
    done = threading.Event()

    def count() -> None:
        nonlocal ticks
        while not done.wait(0.001):
            ticks += 1

    counter = threading.Thread(target=count)
    counter.start()
    hri.WordRecognizer(max_iterations=30, num_states=16).fit(x, y, sample_rate_hz=RATE_HZ, fillers=())
    done.set()
    counter.join()
    assert ticks >= 5


def test_signs_of_unseen_persons_are_recognised(signed: Path) -> None:
    dataset = hri.Dataset.load(signed)
    frames = [hri.read_frames(s.path).frames for s in dataset.samples]
    labels = [s.label for s in dataset.samples]
    train = [i for i, s in enumerate(dataset.samples) if s.person != dataset.persons[0]]
    test = [i for i in range(len(labels)) if i not in train]
    signs = hri.GestureRecognizer().fit(
        [frames[i] for i in train], [labels[i] for i in train], groups=[dataset.samples[i].person for i in train]
    )
    assert signs.score([frames[i] for i in test], [labels[i] for i in test]) == 1.0
    rows = signs.features(frames[0])
    assert rows.dtype == np.float32 and rows.shape[0] == 1
    assert signs.recognise_features(rows) == signs.recognise(frames[0])


def test_picture_without_a_hand_is_no_input(signed: Path) -> None:
    signs = hri.train(hri.Dataset.load(signed), hri.GestureRecognizer())
    assert isinstance(signs, hri.GestureRecognizer)
    wall = np.full((240, 320, 3), (180, 170, 160), np.uint8)
    assert signs.recognise([wall]).status == "no_input"
    assert signs.recognise([]).status == "no_input"
    with pytest.raises(InvalidArgument):
        hri.GestureRecognizer().fit([[wall], [wall]], ["a", "b"])


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: hri.WordRecognizer(num_vtlp_factors=2), "num_vtlp_factors"),
        (lambda: hri.WordRecognizer(false_reject_rate=0.9), "false_reject_rate"),
        (lambda: hri.WordRecognizer(num_states=0), "num_states"),
    ],
)
def test_options_out_of_range_are_named(clips: Clips, make, message: str) -> None:
    x, y, _ = clips
    with pytest.raises(InvalidArgument, match=message):
        make().fit(x, y, sample_rate_hz=RATE_HZ)
    with pytest.raises(TypeError, match="no_such"):
        hri.WordRecognizer(no_such=1)
    with pytest.raises(ValueError, match="svn"):
        hri.GestureRecognizer(model="svn")


def test_options_given_as_a_dict_change_only_what_they_name() -> None:
    changed = hri.WordRecognizer(cepstra={"filter_bank": "hfcc"}).options.as_dict()["cepstra"]
    assert changed == hri.WordRecognizer().options.as_dict()["cepstra"] | {"filter_bank": "hfcc"}
