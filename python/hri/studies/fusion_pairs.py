# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Decisions on digits said and signed by people held out, in noise and in the dark, and pairs of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hri.datasets import Dataset
from hri.evaluation import expose, make_noise, mix_noise
from hri.media import read_audio, read_image
from hri.recognition import Decision, GestureRecognizer, WordRecognizer
from hri.recognition.quality import mask_quality
from hri.studies.registry import Progress
from hri.studies.word_features import first_takes
from hri.vision.hands import find_silhouettes

DIGITS = ("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine")
TAKES = 2
"""Of every digit by every speaker; the recogniser is trained on the first."""
TEST_NOISE = "noise/doing_the_dishes.wav"
TRAIN_NOISES = ("white", "pink")
TRAIN_SNRS_DB = (-5.0, 25.0)
TEST_EXPOSURE = 0.12
TRAIN_EXPOSURES = (0.06, 0.5)
SENSOR_NOISE = 2.0
"""Standard deviation, in grey levels, of the noise of a picture taken in the dark."""
WORST_SNR_DB, WORST_EXPOSURE = 5.0, 0.2
"""A mode that contradicts in training is noisier, or darker, than this."""
NUM_NOISY = 2
"""Noisy copies of every word to train on."""
CONTRADICTING = 0.5
"""Of the pairs to train on that can."""
PAIRS_PER_WORD = 2
"""In a test: signs of different persons beside every word."""
_TRAIN, _TEST = 1, 2


@dataclass(frozen=True)
class Planned:
    """What was decided on what was said; number and light of the sign beside it; what is meant."""

    speech: Decision
    sign: int
    light: str
    truth: str


@dataclass(frozen=True)
class Pair:
    """What was decided on what was said and on what was shown at once, and what was meant."""

    speech: Decision
    gesture: Decision
    truth: str


class Speech:
    """Spoken digits; every clip is heard clean, in noise at an SNR of its own, and in the test's noise."""

    def __init__(self, data_dir: Path, progress: Progress) -> None:
        dataset = Dataset.load(data_dir / "commands", "speech")
        digits = [replace(s, label=str(DIGITS.index(s.label))) for s in dataset.samples if s.label in DIGITS]
        self.samples = first_takes(replace(dataset, samples=digits), TAKES).samples
        self._first = {id(s) for s in first_takes(replace(dataset, samples=self.samples), 1).samples}
        self._noise = str(data_dir / TEST_NOISE)
        self.clips = []
        for done, sample in enumerate(self.samples):
            self.clips.append(read_audio(sample.path))
            progress("reading words", done + 1, len(self.samples))

    def trained(self, numbers: Sequence[int]) -> WordRecognizer:
        """A recogniser of the first takes among these."""
        few = [i for i in numbers if id(self.samples[i]) in self._first]
        return WordRecognizer().fit(
            [self.clips[i].samples for i in few],
            [self.samples[i].label for i in few],
            sample_rate_hz=[self.clips[i].sample_rate_hz for i in few],
            groups=[self.samples[i].person for i in few],
        )

    def noisy(self, words: WordRecognizer, number: int, seed: int, snr_db: float | None) -> tuple[Decision, float]:
        """The decision in the test's noise at `snr_db`, or, for None, in a noise and at an SNR of training; the SNR."""
        rng = np.random.default_rng([seed, _TRAIN if snr_db is None else _TEST, number])
        name = self._noise if snr_db is not None else str(rng.choice(TRAIN_NOISES))
        ratio_db = float(rng.uniform(*TRAIN_SNRS_DB)) if snr_db is None else snr_db
        clip = self.clips[number]
        noise = make_noise(name, len(clip.samples), clip.sample_rate_hz, rng)
        samples = mix_noise(clip.samples, noise, ratio_db, clip.sample_rate_hz)
        return words.recognise(samples, clip.sample_rate_hz), ratio_db

    def clean(self, words: WordRecognizer, number: int) -> Decision:
        """The decision on the recording as it is."""
        return words.recognise(self.clips[number])


class Signs:
    """Signed digits: features and mask quality in daylight, in darkness of a picture's own, and in the test's."""

    def __init__(self, data_dir: Path, seed: int, progress: Progress) -> None:
        self.samples = Dataset.load(data_dir / "sign_digits", "gesture").samples
        self._found: list[dict[str, tuple[NDArray[np.float32], float | None]]] = []
        self.exposures: list[float] = []
        recognizer = GestureRecognizer()
        for number, sample in enumerate(self.samples):
            picture = read_image(sample.path)
            rng = np.random.default_rng([seed, number])
            self.exposures.append(float(np.exp(rng.uniform(*np.log(TRAIN_EXPOSURES)))))
            shown = {
                "bright": picture,
                "train": _darkened(picture, self.exposures[-1], rng),
                "test": _darkened(picture, TEST_EXPOSURE, rng),
            }
            self._found.append({light: _seen(recognizer, frame) for light, frame in shown.items()})
            progress("finding hands", number + 1, len(self.samples))

    def trained(self, numbers: Sequence[int], num_persons: int | None, seed: int) -> GestureRecognizer:
        """A recogniser of these pictures in daylight, or of `num_persons` of the persons in them, drawn at random."""
        persons = sorted({self.samples[i].person for i in numbers})
        if num_persons is not None:
            persons = np.random.default_rng(seed).choice(persons, num_persons, replace=False).tolist()
        few = [i for i in numbers if self.samples[i].person in set(persons)]
        return GestureRecognizer().fit_features(
            [self._found[i]["bright"][0] for i in few],
            [self.samples[i].label for i in few],
            groups=[self.samples[i].person for i in few],
        )

    def decided(self, signs: GestureRecognizer, number: int, light: str) -> Decision:
        """The decision in "bright" light, or the darkness of "train" or "test"."""
        rows, quality = self._found[number][light]
        return replace(signs.recognise_features(rows), quality=quality)


def plan_training(
    speech: Speech, words: WordRecognizer, said: Sequence[int], signs: Signs, seen: Sequence[int], seed: int
) -> list[Planned]:
    """Every clip of `said` clean and in noise, beside a sign among `seen` in any light.

    A share of them contradict each other: one mode says or shows another digit, badly, and the other mode is right.
    """
    rng = np.random.default_rng([seed, _TRAIN])
    planned = []
    for i in said:
        label = speech.samples[i].label
        noisy = [speech.noisy(words, i, seed + 1000 * copy, None) for copy in range(NUM_NOISY)]
        for decision, ratio_db in ((speech.clean(words, i), np.inf), *noisy):
            contradicts = rng.random() < CONTRADICTING
            same, other = _signs_of(signs, seen, label, True), _signs_of(signs, seen, label, False)
            dark = [n for n in other if signs.exposures[n] < WORST_EXPOSURE]
            if contradicts and ratio_db < WORST_SNR_DB:
                number = int(rng.choice(other))
                planned.append(Planned(decision, number, "bright", signs.samples[number].label))
            elif contradicts and ratio_db == np.inf and dark:
                planned.append(Planned(decision, int(rng.choice(dark)), "train", label))
            else:
                light = "train" if rng.random() < 0.5 else "bright"
                planned.append(Planned(decision, int(rng.choice(same)), light, label))
    return planned


def plan_test(
    heard: dict[int, Decision], speech: Speech, signs: Signs, seen: Sequence[int], light: str, means: str, seed: int
) -> list[Planned]:
    """Every decision of `heard` beside `PAIRS_PER_WORD` signs among `seen`.

    `means` is "both" where both modes mean the same digit; "speech" or "gesture" where they contradict each other and
    that one is meant.
    """
    rng = np.random.default_rng([seed, _TEST])
    planned = []
    for i, decision in heard.items():
        label = speech.samples[i].label
        fitting = _signs_of(signs, seen, label, means == "both")
        for number in rng.choice(fitting, PAIRS_PER_WORD, replace=False).tolist():
            truth = signs.samples[number].label if means == "gesture" else label
            planned.append(Planned(decision, number, light, truth))
    return planned


def paired(planned: Sequence[Planned], signs: Signs, recognizer: GestureRecognizer) -> list[Pair]:
    """With what the recogniser decides on the signs."""
    return [Pair(p.speech, signs.decided(recognizer, p.sign, p.light), p.truth) for p in planned]


def _signs_of(signs: Signs, numbers: Sequence[int], label: str, same: bool) -> list[int]:
    return [n for n in numbers if (signs.samples[n].label == label) is same]


def _darkened(picture: NDArray[np.uint8], factor: float, rng: np.random.Generator) -> NDArray[np.uint8]:
    dark = expose([picture], factor)[0] + rng.normal(0, SENSOR_NOISE, picture.shape)
    return np.clip(np.round(dark), 0, 255).astype(np.uint8)


def _seen(recognizer: GestureRecognizer, picture: NDArray[np.uint8]) -> tuple[NDArray[np.float32], float | None]:
    hands = find_silhouettes([picture], faces="never")
    return recognizer.observation_features(hands), mask_quality(hands)
