# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""How long after a word or a gesture its decision stands, on the live path."""

from __future__ import annotations

import statistics
import tempfile
import time

import numpy as np

import hand_pictures
import timing
from hri import GestureRecognizer, read_audio
from hri.live import ArraySource, ClipSource, Listener, Watcher
from hri.recognition import WordRecognizer
from hri.synthetic.speech import make_speaker, make_speech_corpus, speak
from timing import Bench, Timed

WORDS = [
    *("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine"),
    *("stop", "start", "left", "right", "up", "down", "forward", "backward", "hello", "goodbye"),
    *("kitchen", "window", "table", "bottle", "robot", "follow", "carry", "open", "close", "home"),
]
SPEAKERS = 4
BUDGET_S = 0.010
BUDGET_BOTH_S = 0.030
BLOCK_S = 0.02
SIGNS = ("1", "2", "5")
SIGNERS = 4
NEW_SIGNERS = (4, 5)
GESTURE_BUDGET_S = 0.020
WAIT_FRAMES = 25


class _Clocked(ArraySource):
    """Knows when it gave its last block."""

    given_s = 0.0

    def read(self) -> np.ndarray | None:
        block = super().read()
        self.given_s = time.perf_counter()
        return block


def _heard(untrained: WordRecognizer, budget_s: float) -> Timed:
    """Train on four voices, listen to a fifth."""
    words_said, fillers = WORDS, None
    if timing.most_repeats is not None:  # where only answers are checked, ten words show as much
        words_said, fillers = WORDS[10:20], ()
    with tempfile.TemporaryDirectory() as folder:
        dataset = make_speech_corpus(folder, {"en": words_said}, num_speakers=SPEAKERS, takes=1)
        audio = [read_audio(s.path) for s in dataset.samples]
        words = untrained.fit(
            [a.samples for a in audio],
            [s.label for s in dataset.samples],
            sample_rate_hz=[a.sample_rate_hz for a in audio],
            groups=[s.person for s in dataset.samples],
            fillers=fillers,
        )
    assert len(words.classes_) == len(words_said) and len(WORDS) == 30
    listener = Listener(words, level_interval_s=0.1)
    latency_s, waited_ms, block_s, right = [], [], [], 0
    voice = make_speaker(SPEAKERS)
    for word in words_said:
        spoken = speak(word, "en", voice)
        rate = spoken.sample_rate_hz
        floor = 1e-3 * np.random.default_rng(0).standard_normal(len(spoken.samples) + rate + rate // 2)
        stream = floor.astype(np.float32)
        stream[rate // 2 : rate // 2 + len(spoken.samples)] += spoken.samples
        end_s = 0.5 + len(spoken.samples) / rate - 0.1  # the synthesiser's margin
        source = _Clocked(stream, rate)
        before = time.perf_counter()
        for event in listener.listen(source):
            if event.decision is None:
                continue
            latency_s.append(time.perf_counter() - source.given_s)
            waited_ms.append(1000 * (event.time - end_s))
            right += event.decision.nbest[0].label == word
        block_s.append((time.perf_counter() - before - sum(latency_s[-1:])) / (len(stream) / rate / BLOCK_S))
    assert len(latency_s) == len(words_said), "a word was not heard, or heard twice"
    assert right > len(words_said) // 2, "the models understand nothing"
    details = {
        "slowest_ms": 1000 * max(latency_s),
        "waited_ms": statistics.median(waited_ms),
        "block_of_20_ms_takes_ms": 1000 * statistics.median(block_s),
        f"right_of_{len(words_said)}": float(right),
    }
    return statistics.median(latency_s), budget_s, details


def word_latency() -> Timed:
    """From the block of sound in which a word is found to have ended to its decision; 30 synthetic words, 4 voices.

    The peer is the budget of 10 ms. The detector waits for silence before it calls a word ended: "waited_ms" is that
    wait, from the word's last sample, and comes on top.
    """
    return _heard(WordRecognizer(), BUDGET_S)


def word_latency_both() -> Timed:
    """The same by cepstra and the pretrained speech embedding (extra embedding); the peer is the budget of 30 ms."""
    timing.need_embedding()
    return _heard(WordRecognizer(front_end="both"), BUDGET_BOTH_S)


class _ClockedFrames(ClipSource):
    """Knows when it gave its last picture."""

    given_s = 0.0

    def read(self) -> tuple[np.ndarray, float] | None:
        timed = super().read()
        self.given_s = time.perf_counter()
        return timed


def _new_signers() -> tuple[int, ...]:
    """Where only answers are checked, one shows as much as two."""
    return NEW_SIGNERS if timing.most_repeats is None else NEW_SIGNERS[:1]


def _watched(signs: GestureRecognizer, streams: dict[str, list[tuple[list[np.ndarray], int]]]) -> Timed:
    """Watch streams of one gesture each."""
    latency_s, waited_ms, frame_ms, right, total = [], [], [], 0, 0
    for label, several in streams.items():
        for frames, end in several:
            source = _ClockedFrames(frames, hand_pictures.FPS)
            total += 1
            before = time.perf_counter()
            for event in Watcher(signs).watch(source):
                if event.decision is None or event.event != "decision":
                    continue
                latency_s.append(time.perf_counter() - source.given_s)
                waited_ms.append(1000 * (event.time - end / hand_pictures.FPS))
                right += event.decision.nbest[0].label == label
            frame_ms.append(1000 * (time.perf_counter() - before) / len(frames))
    assert len(latency_s) == total, "a gesture was not seen, or seen twice"
    assert right > total // 2, "the models understand nothing"
    details = {
        "slowest_ms": 1000 * max(latency_s),
        "waited_ms": statistics.median(waited_ms),
        "frame_takes_ms": statistics.median(frame_ms),
        f"right_of_{total}": float(right),
    }
    return statistics.median(latency_s), GESTURE_BUDGET_S, details


def gesture_latency() -> Timed:
    """From the picture in which a movement of the hand is found to have ended to its decision; 2 new signers.

    As `word_latency`: the peer is the budget, and "waited_ms" is the wait for the hand to rest, from the end of its
    movement, which comes on top. Hands are found by colours learned from the stream.
    """
    named = [(name, person) for name in hand_pictures.MOVEMENTS for person in range(SIGNERS)]
    signs = GestureRecognizer(model="trajectory").fit(
        [hand_pictures.hand_clip(name, person) for name, person in named],
        [name for name, _ in named],
        groups=[str(person) for _, person in named],
    )
    return _watched(
        signs,
        {
            name: [hand_pictures.movement_stream(name, person, 1, WAIT_FRAMES) for person in _new_signers()]
            for name in hand_pictures.MOVEMENTS
        },
    )


def sign_latency() -> Timed:
    """The same for held signs; the hand is found in every picture by itself."""
    named = [(sign, person, take) for sign in SIGNS for person in range(SIGNERS) for take in range(2)]
    signs = GestureRecognizer(model="svm").fit(
        [[hand_pictures.sign_picture(*one)] for one in named],
        [sign for sign, _, _ in named],
        groups=[str(person) for _, person, _ in named],
    )
    return _watched(
        signs,
        {
            sign: [hand_pictures.sign_stream(sign, person, 3, WAIT_FRAMES) for person in _new_signers()]
            for sign in SIGNS
        },
    )


BENCHES = [
    Bench("word_latency", word_latency, "10 ms budget"),
    Bench("word_latency_both", word_latency_both, "30 ms budget"),
    Bench("gesture_latency", gesture_latency, "20 ms budget"),
    Bench("sign_latency", sign_latency, "20 ms budget"),
]
