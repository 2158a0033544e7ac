# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Digits said and signed one after the other, with other talk between them, as streams of a session and as the same
files, by people neither recogniser has met."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from hri.datasets import Dataset
from hri.evaluation import make_noise
from hri.fusion import fuse
from hri.live import ArraySource, ClipSource, Event
from hri.live.frames import Frame
from hri.media import read_audio, read_image
from hri.recognition import GestureRecognizer, WordRecognizer
from hri.robot import Trajectory, open_robot
from hri.session import Session, SessionOptions
from hri.signal import resample
from hri.studies.registry import GESTURE_SOURCES, WORD_SOURCES, Layout, Progress, Study
from hri.studies.tables import statistics

SEED = 0
NUM_TURNS = 200
"""A speaker."""
TRAIN_TAKES = 15
"""Of every word by every speaker to train on: what is measured is how streams differ from files."""
PAIRED = 0.6
"""Of the turns; of the others, half are said and half are signed alone."""
APART_S = 1.0
PAUSE_S = (2.5, 4.0)
"""From the end of a turn, or of the talk after it, to the beginning of the next."""
OTHERS = "other_words"
TALK = 0.5
"""Of the turns: after these come other words, which are no digits, by strangers."""
TALK_WORDS = 3
"""At most, one after the other."""
TALK_AFTER_S, TALK_GAP_S = (1.0, 2.0), (0.4, 1.0)
"""From the end of a turn to the first of them, and from one to the next."""
NOD = Trajectory(("head_joint_2",), 0.2, [[0.0], [0.1], [0.0]])
"""What the robot answers each digit by."""
FPS = 15.0
SLIDE_S, HOLD_S = 0.4, 1.2
"""A still is slid into view, held and slid away: no signer was filmed."""
FLOOR_DB = -60.0
PEAK_DB = (-12.0, -3.0)
MAX_GAP, MAX_WRONG = 0.01, 0.01


@dataclass(frozen=True)
class Turn:
    """What is said, shown or both: numbers of samples (-1 for none) and when each begins and ends."""

    label: str
    word: int
    sign: int
    word_s: tuple[float, float]
    sign_s: tuple[float, float]

    @property
    def span_s(self) -> tuple[float, float]:
        """From the first to the last of it."""
        spans = [span for span, number in ((self.word_s, self.word), (self.sign_s, self.sign)) if number >= 0]
        return min(first for first, _ in spans), max(last for _, last in spans)

    @property
    def modes(self) -> tuple[bool, bool]:
        """Whether something is said, and shown."""
        return self.word >= 0, self.sign >= 0


@dataclass(frozen=True)
class Talk:
    """Another word: the number of its recording, and when it begins and ends."""

    word: int
    span_s: tuple[float, float]


def plan(
    words: Sequence[tuple[str, float]], signs: Sequence[str], num_turns: int, seed: int, others_s: Sequence[float] = ()
) -> tuple[list[Turn], list[Talk]]:
    """Turns of words (label, seconds) and signs (label) of the same digit; they begin up to a second apart.

    Between them come other words, of `others_s` seconds each; none where there are none.
    """
    rng = np.random.default_rng(seed)
    turns, talk, at_s = [], [], 1.0
    for _ in range(num_turns):
        kind = rng.choice(3, p=(PAIRED, (1 - PAIRED) / 2, (1 - PAIRED) / 2))
        word = int(rng.integers(len(words)))
        label, length_s = words[word]
        sign = int(rng.choice([i for i, other in enumerate(signs) if other == label]))
        apart_s = rng.uniform(-APART_S, APART_S) if kind == 0 else 0.0
        word_at, sign_at = at_s + max(0.0, -apart_s), at_s + max(0.0, apart_s)
        word_s, sign_s = (word_at, word_at + length_s), (sign_at, sign_at + 2 * SLIDE_S + HOLD_S)
        turn = Turn(label, -1 if kind == 2 else word, -1 if kind == 1 else sign, word_s, sign_s)
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


def judge(turns: Sequence[Turn], fused: Sequence[Event]) -> list[dict[str, Any]]:
    """For every turn: what was decided ("" for nothing), and whether it came whole, taken apart or joined wrongly."""
    found: list[dict[str, Any]] = []
    heard = [event for event in fused if event.fields["status"] != "no_input"]
    overlapping = [
        [turn for turn in turns if e.fields["first_s"] < turn.span_s[1] and e.fields["last_s"] > turn.span_s[0]]
        for e in heard
    ]
    for turn in turns:
        own = [e for e, of in zip(heard, overlapping, strict=True) if turn in of]
        modes = [(e.fields["speech"] is not None, e.fields["gesture"] is not None) for e in own]
        joined = any(
            len(of) > 1 or (is_both and sum(turn.modes) == 1)
            for of, e in zip(overlapping, heard, strict=True)
            if turn in of
            for is_both in [e.fields["speech"] is not None and e.fields["gesture"] is not None]
        )
        apart = sum(turn.modes) == 2 and any(m[0] for m in modes) and any(m[1] for m in modes) and len(own) > 1
        missed = any(wanted and not any(m[i] for m in modes) for i, wanted in enumerate(turn.modes))
        label = next((e.fields["final"] for e in own if e.fields["final"]), "")
        found.append({"label": label, "joined": joined, "apart": apart, "missed": missed, "events": len(own)})
    return found


def latencies(events: Sequence[Event]) -> dict[str, list[tuple[float, float]]]:
    """From the end of a word, of a sign or of the later of both to the first joint command: waiting, and computing.

    In ms, by what led to the motion.
    """
    found: dict[str, list[tuple[float, float]]] = {"word": [], "sign": [], "both": []}
    decided: Event | None = None
    for event in events:
        if event.event == "fused":
            decided = event
        elif event.event == "motion_start" and decided is not None and decided.fields["final"] == event.fields["label"]:
            said, shown = (decided.fields[mode] is not None for mode in ("speech", "gesture"))
            what = "both" if said and shown else "word" if said else "sign"
            found[what].append((event.fields["wait_ms"], event.fields["compute_ms"]))
    return found


def meets(event: Event, spans_s: Sequence[tuple[float, float]]) -> bool:
    """Whether a decision is on something of one of these times."""
    return any(event.fields["first_s"] < last_s and event.fields["last_s"] > first_s for first_s, last_s in spans_s)


def _run(data_dir: Path, progress: Progress, *, folds: int | None = None) -> dict[str, Any]:
    spoken = Dataset.load(data_dir / "fsdd" / "recordings", "speech")
    signed = Dataset.load(data_dir / "sign_digits", "gesture")
    strangers = [read_audio(sample.path) for sample in Dataset.load(data_dir / OTHERS, "speech").samples]
    word_folds = spoken.folds_by_person()
    sign_folds = signed.folds_by_person(len(word_folds), SEED)
    shares: dict[str, dict[str, float]] = {"files": {}, "streams": {}}
    names = ("turns", "pairs", "joined", "apart", "missed", "talk", "talk_as_digits", "spurious")
    counts: dict[str, int] = dict.fromkeys(names, 0)
    took: dict[str, list[tuple[float, float]]] = {"word": [], "sign": [], "both": []}
    for part, (said, shown) in enumerate(zip(word_folds, sign_folds, strict=True)):
        if folds is not None and part >= folds:
            break
        few = _few(spoken, said.train)
        words, signs = _trained(spoken, few, WordRecognizer), _trained(signed, shown.train, GestureRecognizer)
        progress(f"{said.name}: trained", 2 * part + 1, 2 * len(word_folds))
        test_words = [spoken.samples[i] for i in said.test]
        test_signs = [signed.samples[i] for i in shown.test]
        audio = [read_audio(sample.path) for sample in test_words]
        rate = audio[0].sample_rate_hz
        clips, stills = [a.samples for a in audio], [read_image(sample.path) for sample in test_signs]
        others = [np.asarray(resample(a.samples, a.sample_rate_hz, rate)) for a in strangers]
        lengths = [(s.label, len(c) / rate) for s, c in zip(test_words, clips, strict=True)]
        labels = [s.label for s in test_signs]
        turns, talk = plan(lengths, labels, NUM_TURNS, SEED + part, [len(other) / rate for other in others])
        as_files = []
        for turn in turns:
            heard = words.recognise(clips[turn.word], rate) if turn.word >= 0 else None
            seen = signs.recognise([stills[turn.sign]]) if turn.sign >= 0 else None
            as_files.append(fuse(heard, seen).label == turn.label)
        sound = ArraySource(sound_of(turns, clips, rate, SEED + part, talk, others), rate)
        with open_robot("kinematic") as robot:
            session = Session(
                words, signs, robot, SessionOptions(confirm_below=0), motions=dict.fromkeys(set(labels), NOD)
            )
            pictures = ClipSource(pictures_of(turns, stills, SEED + part), FPS)
            events = list(session.run(sound, pictures))
        fused = [event for event in events if event.event == "fused"]
        judged = judge(turns, fused)
        shares["files"][said.name] = float(np.mean(as_files))
        shares["streams"][said.name] = float(
            np.mean([j["label"] == t.label for j, t in zip(judged, turns, strict=True)])
        )
        for name in ("joined", "apart", "missed"):
            counts[name] += sum(j[name] for j in judged)
        counts["turns"] += len(turns)
        counts["pairs"] += sum(all(turn.modes) for turn in turns)
        counts["talk"] += len(talk)
        beside = [event for event in fused if not meets(event, [turn.span_s for turn in turns])]
        of_talk = [event for event in beside if meets(event, [one.span_s for one in talk])]
        counts["talk_as_digits"] += sum(event.fields["final"] != "" for event in of_talk)
        counts["spurious"] += len(beside) - len(of_talk)
        for what, times in latencies(events).items():
            took[what] += times
        progress(f"{said.name}: played", 2 * part + 2, 2 * len(word_folds))
    rows = [{"digits": how, **statistics(values)} for how, values in shares.items()]
    gap = rows[0]["accuracy_mean"] - rows[1]["accuracy_mean"]
    wrong = (counts["joined"] + counts["apart"]) / counts["turns"]
    return {
        "seed": SEED,
        "train_takes": TRAIN_TAKES,
        "rows": rows,
        **counts,
        "gap": gap,
        "paired_wrongly": wrong,
        "latency": {what: _medians(times) for what, times in took.items() if times},
        "passed": bool(gap <= MAX_GAP and wrong <= MAX_WRONG),
    }


def _medians(times: Sequence[tuple[float, float]]) -> dict[str, float]:
    wait_ms, compute_ms = np.median(times, axis=0)
    return {"motions": len(times), "wait_ms": float(wait_ms), "compute_ms": float(compute_ms)}


def _few(dataset: Dataset, numbers: Sequence[int]) -> list[int]:
    """The first takes of every word by every speaker."""
    taken: dict[tuple[str, str], list[int]] = {}
    for i in numbers:
        taken.setdefault((dataset.samples[i].person, dataset.samples[i].label), []).append(i)
    return sorted(i for of in taken.values() for i in of[:TRAIN_TAKES])


def _trained(dataset: Dataset, numbers: Sequence[int], kind: type[Any]) -> Any:
    samples = [dataset.samples[i] for i in numbers]
    columns = [s.path for s in samples], [s.label for s in samples]
    return kind().fit(*columns, groups=[s.person for s in samples])


STUDIES = (
    Study(
        "session-digits",
        "spoken digits of unseen speakers and signed digits of unseen persons as streams of a session, begun up to "
        f"{APART_S:g} s apart, {100 * (1 - PAIRED):.0f} % of them alone, with other words between them, against the "
        "same as files",
        ("fsdd/recordings", "sign_digits", OTHERS),
        f"the streams are right as often as the files, less {100 * MAX_GAP:.0f} point; at most {100 * MAX_WRONG:.0f} % "
        "of the turns taken apart or joined wrongly",
        _run,
        Layout(),
        sources=(*dict.fromkeys((*WORD_SOURCES, *GESTURE_SOURCES)),),
        folds=True,
    ),
)
