# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Commands after a wake word: what counts, what does not, and that the study counts as the listener does."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from conftest import PERSONS, RATE_HZ, tone_word
from hri import _native
from hri.core.errors import InvalidArgument
from hri.live import ArraySource, Attention, Listener
from hri.live.attention import COMMAND, IGNORED, WAKE, AttentionTracker, with_threshold
from hri.recognition import WordRecognizer
from hri.recognition.decision import NO_INPUT, RECOGNISED, UNKNOWN, Decision, NBest
from hri.studies.false_alarms import Utterance, compose_words, longest_word, pair_evidence


def heard(label: str, score: float, threshold: float = 0.0) -> Decision:
    taken = score >= threshold
    status = RECOGNISED if taken else UNKNOWN
    return Decision("speech", label if taken else UNKNOWN, status, 0.9, score, (NBest(label, 0.9, -1.0),))


NOTHING = Decision("speech", NO_INPUT, NO_INPUT, 0.0)


def judged(attention: Attention, *said: tuple[float, Decision]) -> list[str]:
    tracker = AttentionTracker(attention)
    return [tracker.judge(at, at + 0.5, decision)[0] for at, decision in said]


def test_without_a_wake_word_everything_is_a_command() -> None:
    assert judged(Attention(), (0, heard("a", 1)), (5, heard("b", -1)), (9, NOTHING)) == [COMMAND] * 3


def test_a_command_follows_the_wake_word_at_once() -> None:
    wake = Attention("robot", within_s=2.0)
    robot, left, noise = heard("robot", 1), heard("left", 1), heard("left", -1)
    assert judged(wake, (0, left), (1, robot), (2, left), (3, left)) == [IGNORED, WAKE, COMMAND, IGNORED]
    assert judged(wake, (1, robot), (3.6, left)) == [WAKE, IGNORED]  # 2.1 s after its end
    assert judged(wake, (1, robot), (2, noise), (3, left)) == [WAKE, COMMAND, IGNORED]  # what is not sure ends it too
    assert judged(wake, (1, robot), (2, NOTHING), (3, left)) == [WAKE, IGNORED, COMMAND]  # without speech it does not
    assert judged(wake, (0, robot), (2, robot), (4, left)) == [WAKE, WAKE, COMMAND]
    assert judged(wake, (0, heard("robot", -1)), (1, left)) == [IGNORED, IGNORED]


def test_stop_needs_no_wake_word() -> None:
    wake = Attention("robot", within_s=2.0)
    robot, stop, left = heard("robot", 1), heard("stop", 1), heard("left", 1)
    assert judged(wake, (0, stop), (1, left), (2, robot), (3, stop)) == [COMMAND, IGNORED, WAKE, COMMAND]
    assert judged(wake, (0, heard("stop", -1))) == [IGNORED]
    assert judged(Attention("robot", always=("halt",)), (0, stop), (1, heard("halt", 1))) == [IGNORED, COMMAND]
    assert judged(Attention("stop"), (0, stop), (1, left)) == [WAKE, COMMAND]


def test_what_is_judged_early_and_is_no_command_leaves_the_end_as_it_was() -> None:
    for said, is_command, end in (("left", True, IGNORED), ("robot", False, COMMAND)):
        tracker = AttentionTracker(Attention("robot", within_s=2.0))
        assert tracker.judge(0, 0.5, heard("robot", 1))[0] == WAKE
        assert tracker.judge_early(1, 1.5, heard(said, 1)) is is_command
        assert tracker.judge(1, 2, heard("left", 1))[0] == end
    tracker = AttentionTracker(Attention("robot", within_s=2.0))
    assert not tracker.judge_early(1, 1.5, heard("robot", 1))
    assert tracker.judge(1, 2, heard("left", 1))[0] == IGNORED  # the wake word itself had not ended


def test_the_threshold_may_be_another_than_the_models() -> None:
    assert with_threshold(heard("a", 1.0), 2.0).status == UNKNOWN
    assert with_threshold(heard("a", 1.0), 2.0).label == UNKNOWN
    assert with_threshold(heard("a", -1.0), -2.0).label == "a"
    assert with_threshold(heard("a", -1.0), None).status == UNKNOWN
    assert with_threshold(NOTHING, -100.0).status == NO_INPUT
    assert judged(Attention("a", min_score=2.0), (0, heard("a", 1)), (1, heard("b", 3))) == [IGNORED, IGNORED]


def test_what_makes_no_sense_is_refused_by_name(words: WordRecognizer) -> None:
    with pytest.raises(InvalidArgument, match="within_s"):
        Attention("a", within_s=0)
    with pytest.raises(InvalidArgument, match="min_score"):
        Attention(min_score=math.nan)
    with pytest.raises(InvalidArgument, match=r"'robot'.*fall, rise"):
        Listener(words, attention=Attention("robot"))
    with pytest.raises(InvalidArgument, match=r"'haltt'.*fall, rise"):
        Listener(words, attention=Attention("rise", always=("fall", "haltt")))
    Listener(words, attention=Attention(always=("haltt",)))  # every word is a command


def test_the_study_counts_as_the_listener_does() -> None:
    rng = np.random.default_rng(0)
    at, said = 0.0, []
    for _ in range(400):
        at += float(rng.uniform(0.1, 5.0))
        said.append(Utterance(at, at + 0.4, str(rng.choice(["robot", "left", "right"])), float(rng.normal())))
        at += 0.4
    for threshold in (-10.0, 0.0, 0.7):
        tracker = AttentionTracker(Attention("robot", 2.0, min_score=threshold))
        reported = [tracker.judge(u.first_s, u.last_s, heard(u.label, u.score)) for u in said]
        commands = sum(meant == COMMAND and d.status == RECOGNISED for meant, d in reported)
        counted = sum(score >= threshold for _, _, score in pair_evidence(said, "robot", 2.0))
        assert commands == counted > 0


@pytest.fixture(scope="module")
def words() -> WordRecognizer:
    """Trained on words cut as tightly as recordings often are."""
    x, y, persons = [], [], []
    for number, (person, base_hz) in enumerate(PERSONS.items()):
        for take in range(3):
            for label, slope in (("rise", 800.0), ("fall", -350.0)):
                clip = tone_word(base_hz, slope, 7 * take + number)
                bounds = _native.find_speech(clip, RATE_HZ)
                assert bounds is not None
                x.append(clip[bounds[0] : bounds[1]])
                y.append(label)
                persons.append(person)
    return WordRecognizer(false_reject_rate=0.0).fit(x, y, sample_rate_hz=RATE_HZ, groups=persons)


def session(labels: list[str]) -> np.ndarray:
    rng = np.random.default_rng(5)
    parts: list[np.ndarray] = []
    for number, label in enumerate(labels):
        parts.append(0.001 * rng.standard_normal(RATE_HZ // 2).astype("f4"))
        parts.append(tone_word(list(PERSONS.values())[-1], 800.0 if label == "rise" else -350.0, 50 + number))
    return np.concatenate(parts)


def test_a_stream_is_listened_to_after_the_wake_word(words: WordRecognizer) -> None:
    stream = session(["fall", "rise", "fall", "fall"])
    everything = Attention("rise", min_score=-100.0)
    events = [
        e for e in Listener(words, attention=everything).listen(ArraySource(stream, RATE_HZ)) if "nbest" in e.fields
    ]
    assert [e.event for e in events] == ["ignored", "wake", "decision", "ignored"]
    assert [e.fields["final"] for e in events] == ["", "", "fall", ""]
    assert [e.decision is not None for e in events] == [False, False, True, False]


def test_the_command_line_takes_a_wake_word(words: WordRecognizer, hri: Any, tmp_path: Path) -> None:
    words.save(tmp_path / "words.hri")
    _native.write_wav_pcm16(str(tmp_path / "session.wav"), session(["rise", "fall", "fall"]), RATE_HZ)
    common = ("listen", "--model", tmp_path / "words.hri", "--json-lines", tmp_path / "session.wav")
    lines = [json.loads(line) for line in hri(*common, "--wake", "rise", "--min-score", -20).out.splitlines()]
    assert [row["event"] for row in lines if "nbest" in row] == ["wake", "decision", "ignored"]
    refused = hri(*common, "--wake", "robot")
    assert refused.code == 3 and "robot" in refused.err and "fall, rise" in refused.err
    for always in ("haltt", "stop"):
        refused = hri(*common, "--wake", "rise", "--always", "fall", "--always", always)
        assert refused.code == 3 and f"--always '{always}' is not in the vocabulary: fall, rise" in refused.err
    warning = "WARNING: no word is a command without the wake word: none is stop; choose by --always"
    assert warning in hri(*common, "--wake", "rise").err
    assert "WARNING" not in hri(*common, "--wake", "rise", "--always", "fall").err
    assert "WARNING" not in hri(*common).err


def test_composed_words_lie_where_they_are_said_to_lie() -> None:
    clips = [np.full(800, 0.5, "f4"), np.full(1600, 0.1, "f4")]
    stream, spans = compose_words(clips, 8000, 8 * 8000, np.random.default_rng(0))
    assert len(spans) >= 2 and {number for number, _, _ in spans} == {0, 1}
    inside = np.zeros(len(stream), bool)
    for number, first, last in spans:
        assert last - first == len(clips[number])
        inside[first:last] = True
    assert np.abs(stream[inside]).min() > 0.04 > 0.01 > np.abs(stream[~inside]).max()


def test_the_longest_word_is_the_one_spoken_longest() -> None:
    short, long = tone_word(150.0, 800.0, 0), tone_word(150.0, 800.0, 1)
    silence = np.zeros(len(long), "f4")
    assert longest_word(["a", "b", "c"], [short, np.concatenate([long, long[2000:]]), silence], RATE_HZ) == "b"
