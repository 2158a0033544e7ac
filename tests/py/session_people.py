# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""People for sessions, synthetic and quick: tones stand for words, drawn hands for signs."""

from __future__ import annotations

import pickle
from collections.abc import Sequence
from functools import cache

import numpy as np
from numpy.typing import NDArray

import hri
from conftest import PERSONS, RATE_HZ, three_fillers, tone_word
from drawn_hands import FPS, HIDDEN, Frame, picture, stills
from hri.robot import Trajectory

SLOPES = {"flat": 800.0, "tall": -350.0, "stop": 0.0}
NOD = Trajectory(["head_joint_2"], 0.1, np.array([[0.0], [0.1], [0.2], [0.1], [0.0]]))
TURN = Trajectory(["head_joint_1"], 1.0, [[0.0], *[[0.5], [-0.5]] * 3, [0.0]])
MOTIONS = {"flat": NOD, "tall": TURN}
_RISE_FRAMES = 9


def train_words() -> hri.WordRecognizer:
    """A recogniser of the words flat, tall and stop, of its own: it is trained once and copied."""
    words: hri.WordRecognizer = pickle.loads(_trained_words())
    return words


@cache
def _trained_words() -> bytes:
    rows = [
        (tone_word(base_hz, slope, 7 * take + number), label, person)
        for number, (person, base_hz) in enumerate(PERSONS.items())
        for take in range(3)
        for label, slope in SLOPES.items()
    ]
    x, y, persons = map(list, zip(*rows, strict=True))
    words = hri.WordRecognizer(false_reject_rate=0.0)
    words.fit(x, y, sample_rate_hz=RATE_HZ, groups=persons, fillers=three_fillers())
    return pickle.dumps(words)


def train_signs() -> hri.GestureRecognizer:
    """A recogniser of the signs flat and tall, of its own."""
    signs: hri.GestureRecognizer = pickle.loads(_trained_signs())
    return signs


@cache
def _trained_signs() -> bytes:
    rows = [(stills(sign, seed), sign, f"p{seed % 3}") for seed in range(6) for sign in ("flat", "tall")]
    x, y, persons = map(list, zip(*rows, strict=True))
    return pickle.dumps(hri.GestureRecognizer(false_reject_rate=0.0).fit(x, y, groups=persons))


def speech(said: Sequence[tuple[str, float]], duration_s: float) -> NDArray[np.float32]:
    """Words that begin at these times, in a little noise."""
    stream = 0.001 * np.random.default_rng(5).standard_normal(round(duration_s * RATE_HZ)).astype("f4")
    for number, (label, begin_s) in enumerate(said):
        word = tone_word(list(PERSONS.values())[-1], SLOPES[label], 50 + number)
        at = round((begin_s - 0.25) * RATE_HZ)  # it begins with a pause
        stream[at : at + len(word)] += word
    return stream


def signing(shown: Sequence[tuple[str, float]], duration_s: float, hold_s: float = 1.0) -> list[Frame]:
    """Signs whose hand comes into view at these times, before a wall."""
    rng = np.random.default_rng(3)
    heights = np.full(round(duration_s * FPS), HIDDEN)
    labels = ["flat"] * len(heights)
    rise = np.linspace(HIDDEN, 0.5, _RISE_FRAMES)
    for label, begin_s in shown:
        course = np.concatenate((rise, np.full(round(hold_s * FPS), 0.5), rise[::-1]))
        at = round(begin_s * FPS)
        heights[at : at + len(course)] = course
        labels[at : at + len(course)] = [label] * len(course)
    shaken = heights + 0.01 * rng.standard_normal(len(heights))
    return [picture(label, height, rng) for label, height in zip(labels, shaken, strict=True)]
