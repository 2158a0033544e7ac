# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Turns of words and signs, with other talk after them, as sound and pictures."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hri.evaluation import make_noise
from hri.live.frames import Frame

PAIRED = 0.6
"""Of the turns; of the others, half are said and half are signed alone."""
OVERLAPPING = 0.25
"""Of the pairs; of the others, half begin with the word and half with the sign."""
APART_S = 1.0
"""At most, from the end of the first of a pair to the beginning of the second."""
CASES = ("word alone", "sign alone", "word first", "sign first", "overlapping")
PAUSE_S = (2.5, 4.0)
"""From the end of a turn, or of the talk after it, to the beginning of the next."""
TALK = 0.5
"""Of the turns: after these come other words, which are no digits, by strangers."""
TALK_WORDS = 3
"""At most, one after the other."""
TALK_AFTER_S, TALK_GAP_S = (0.0, 2.0), (0.4, 1.0)
"""From the end of a turn to the first of them, which may fall into the window of a pair, and from one to the next."""
FPS = 15.0
SLIDE_S, HOLD_S = 0.4, 1.2
"""A still is slid into view, held and slid away: no signer was filmed."""
SIGN_S = 2 * SLIDE_S + HOLD_S
FLOOR_DB = -60.0
PEAK_DB = (-12.0, -3.0)

Span = tuple[float, float]


@dataclass(frozen=True)
class Turn:
    """What is said, shown or both: numbers of samples (-1 for none) and when each begins and ends."""

    label: str
    word: int
    sign: int
    word_s: Span
    sign_s: Span

    @property
    def span_s(self) -> Span:
        """From the first to the last of it."""
        spans = [span for span, number in ((self.word_s, self.word), (self.sign_s, self.sign)) if number >= 0]
        return min(first for first, _ in spans), max(last for _, last in spans)

    @property
    def modes(self) -> tuple[bool, bool]:
        """Whether something is said, and shown."""
        return self.word >= 0, self.sign >= 0

    @property
    def case(self) -> str:
        """Which of `CASES` it is."""
        if not all(self.modes):
            return CASES[0] if self.word >= 0 else CASES[1]
        if self.word_s[1] <= self.sign_s[0]:
            return CASES[2]
        return CASES[3] if self.sign_s[1] <= self.word_s[0] else CASES[4]


@dataclass(frozen=True)
class Talk:
    """Another word: the number of its recording, and when it begins and ends."""

    word: int
    span_s: Span


def plan(
    words: Sequence[tuple[str, float]], signs: Sequence[str], num_turns: int, seed: int, others_s: Sequence[float] = ()
) -> tuple[list[Turn], list[Talk]]:
    """Turns of words (label, seconds) and signs (label) of the same digit.

    Of a pair the second begins up to a second after the end of the first, or both overlap.

    Between them come other words, of `others_s` seconds each; none where there are none.
    """
    rng = np.random.default_rng(seed)
    turns, talk, at_s = [], [], 1.0
    for _ in range(num_turns):
        case = CASES[int(rng.choice(len(CASES), p=_SHARES))]
        word = int(rng.integers(len(words)))
        label, length_s = words[word]
        sign = int(rng.choice([i for i, other in enumerate(signs) if other == label]))
        after_s = _word_after_sign_s(case, length_s, rng)
        word_at, sign_at = at_s + max(0.0, after_s), at_s + max(0.0, -after_s)
        word_s, sign_s = (word_at, word_at + length_s), (sign_at, sign_at + SIGN_S)
        turn = Turn(label, -1 if case == "sign alone" else word, -1 if case == "word alone" else sign, word_s, sign_s)
        turns.append(turn)
        at_s = turn.span_s[1]
        if others_s and rng.random() < TALK:
            begin_s = at_s + float(rng.uniform(*TALK_AFTER_S))
            for other in rng.integers(len(others_s), size=int(rng.integers(1, TALK_WORDS + 1))):
                at_s = begin_s + others_s[int(other)]
                talk.append(Talk(int(other), (begin_s, at_s)))
                begin_s = at_s + float(rng.uniform(*TALK_GAP_S))
        at_s += float(rng.uniform(*PAUSE_S))
    return turns, talk


_SHARES = (*((1 - PAIRED) / 2,) * 2, *(PAIRED * (1 - OVERLAPPING) / 2,) * 2, PAIRED * OVERLAPPING)


def _word_after_sign_s(case: str, length_s: float, rng: np.random.Generator) -> float:
    """From the beginning of the sign to that of the word, which is so long; below 0 where the word begins first."""
    if case == "overlapping":
        return float(rng.uniform(-length_s, SIGN_S))
    gap_s = float(rng.uniform(0.0, APART_S))
    return {"word first": -length_s - gap_s, "sign first": SIGN_S + gap_s}.get(case, 0.0)


def sound_of(
    turns: Sequence[Turn],
    clips: Sequence[Any],
    rate: int,
    seed: int,
    talk: Sequence[Talk] = (),
    others: Sequence[Any] = (),
) -> Any:
    """The words at their times, at levels of their own over a faint noise, and the others between them."""
    rng = np.random.default_rng(seed)
    last_s = max(one.span_s[1] for some in (turns, talk) for one in some)
    stream = make_noise("pink", round((last_s + 3.0) * rate), rate, rng)
    stream *= np.float32(10 ** (FLOOR_DB / 20) / np.std(stream))
    said = [(clips[turn.word], turn.word_s[0]) for turn in turns if turn.word >= 0]
    for clip, begin_s in (*said, *((others[one.word], one.span_s[0]) for one in talk)):
        at = round(begin_s * rate)
        stream[at : at + len(clip)] += 10 ** (rng.uniform(*PEAK_DB) / 20) / np.abs(clip).max() * clip
    return np.clip(stream, -1, 1).astype(np.float32)


def pictures_of(turns: Sequence[Turn], stills: Sequence[Frame], seed: int) -> Iterator[Frame]:
    """The signs at their times, slid into view from below, before a wall of the colour of the next still's border."""
    rng = np.random.default_rng(seed)
    shown = [turn for turn in turns if turn.sign >= 0]
    number = 0
    for index in range(round((turns[-1].span_s[1] + 3.0) * FPS)):
        time_s = index / FPS
        while number < len(shown) - 1 and time_s > shown[number].sign_s[1] + 0.5:
            number += 1
        still = stills[shown[number].sign]
        first_s, last_s = shown[number].sign_s
        height = len(still)
        hidden = max(first_s + SLIDE_S - time_s, time_s - (last_s - SLIDE_S), 0.0) / SLIDE_S
        down = min(height, round(height * hidden))
        frame = np.empty_like(still)
        frame[:] = np.median(still[:4].reshape(-1, 3), axis=0)
        frame[down:] = still[: height - down]
        noisy = frame + rng.normal(0, 1.5, frame.shape)
        yield noisy.clip(0, 255).astype(np.uint8)
