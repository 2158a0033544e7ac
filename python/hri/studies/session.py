# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Digits said and signed one after the other, with other talk between them, as streams of a session and as the same
files, by people neither recogniser has met."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from hri.datasets import Dataset
from hri.fusion import fuse
from hri.live import ArraySource, ClipSource, Event
from hri.media import read_audio, read_image
from hri.recognition import GestureRecognizer, WordRecognizer
from hri.robot import Trajectory, open_robot
from hri.session import Session, SessionOptions
from hri.session.feeds import Arrival
from hri.session.logic import NoRobot, SessionLogic
from hri.session.pairing import MODES
from hri.signal import resample
from hri.studies.registry import GESTURE_SOURCES, WORD_SOURCES, Layout, Progress, Study
from hri.studies.session_judging import Decided, decided_in, judge, things_of
from hri.studies.session_turns import APART_S, CASES, FPS, PAIRED, Talk, Turn, pictures_of, plan, sound_of
from hri.studies.tables import further_statistics, statistics

SEED = 0
NUM_TURNS = 200
"""A speaker."""
TRAIN_TAKES = 15
"""Of every word by every speaker to train on: what is measured is how streams differ from files."""
OTHERS = "other_words"
NOD = Trajectory(("head_joint_2",), 0.2, [[0.0], [0.1], [0.0]])
"""What the robot answers each digit by."""
MAX_GAP, MAX_WRONG = 0.01, 0.01
ALL = "all"
MEASURES = ("joined", "apart", "missed")
FILES, STREAMS, NARROWER = "files", "streams", "streams, window of 1 s"
NARROWER_S = 1.0
"""Of that window, which has no room for ends that are found early."""


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


def _run(data_dir: Path, progress: Progress, *, folds: int | None = None) -> dict[str, Any]:
    spoken = Dataset.load(data_dir / "fsdd" / "recordings", "speech")
    signed = Dataset.load(data_dir / "sign_digits", "gesture")
    strangers = [read_audio(sample.path) for sample in Dataset.load(data_dir / OTHERS, "speech").samples]
    word_folds = spoken.folds_by_person()
    sign_folds = signed.folds_by_person(len(word_folds), SEED)
    found: dict[str, dict[str, dict[str, dict[str, float]]]] = {}
    names = ("turns", "pairs", "talk", "talk_as_digits", "spurious", "paired_wrongly", "beside_rejected")
    counts: dict[str, int] = dict.fromkeys((*names, *MEASURES), 0)
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
        decided = decided_in(events)
        judged = {
            FILES: [{"right": right} for right in as_files],
            STREAMS: _judged(turns, talk, decided),
            NARROWER: _judged(turns, talk, decided_in(_paired_anew(events, labels, NARROWER_S))),
        }
        for way, ones in judged.items():
            for case in (ALL, *CASES):
                some = [one for one, turn in zip(ones, turns, strict=True) if case in (ALL, turn.case)]
                for name in ("right", *MEASURES) if way != FILES else ("right",):
                    of = found.setdefault(way, {}).setdefault(case, {}).setdefault(name, {})
                    of[said.name] = float(np.mean([one[name] for one in some]))
        for name in (*MEASURES, "paired_wrongly", "beside_rejected"):
            counts[name] += sum(one[name] for one in judged[STREAMS])
        counts["turns"] += len(turns)
        counts["pairs"] += sum(all(turn.modes) for turn in turns)
        counts["talk"] += len(talk)
        things = [(one, {type(thing) for some in things_of(one, turns, talk) for thing in some}) for one in decided]
        counts["talk_as_digits"] += sum(one.final != "" and kinds == {Talk} for one, kinds in things)
        counts["spurious"] += sum(type(None) in kinds for _, kinds in things)
        for what, times in latencies(events).items():
            took[what] += times
        progress(f"{said.name}: played", 2 * part + 2, 2 * len(word_folds))
    rows = [_row(way, case, measured) for way, of in found.items() for case, measured in of.items()]
    gap = rows[0]["accuracy_mean"] - rows[1 + len(CASES)]["accuracy_mean"]
    wrong = counts["paired_wrongly"] / counts["turns"]
    return {
        "seed": SEED,
        "train_takes": TRAIN_TAKES,
        "rows": rows,
        **counts,
        "gap": gap,
        "paired_wrongly_share": wrong,
        "narrower_window_s": NARROWER_S,
        "motions": {what: len(times) for what, times in took.items()},
        "latency": _quantiles(took),
        "passed": bool(gap <= MAX_GAP and wrong <= MAX_WRONG),
    }


def _paired_anew(events: Sequence[Event], labels: Sequence[str], window_s: float) -> list[Event]:
    """What follows from the same events of the streams where the window of a pair is another one."""
    logic = SessionLogic(SessionOptions(confirm_below=0, window_s=window_s), NoRobot(), set(labels))
    streams = (event for event in events if event.mode in MODES)
    return [after for event in streams for after in logic.process(Arrival(event, 0.0))]


def _judged(turns: Sequence[Turn], talk: Sequence[Talk], decided: Sequence[Decided]) -> list[dict[str, Any]]:
    return [
        {**one, "right": one["label"] == turn.label, "paired_wrongly": one["joined"] or one["apart"]}
        for one, turn in zip(judge(turns, talk, decided), turns, strict=True)
    ]


def _row(way: str, case: str, measured: dict[str, dict[str, float]]) -> dict[str, Any]:
    row = {"digits": way, "turns": case, **statistics(measured["right"])}
    for name in MEASURES:
        row |= further_statistics(measured[name], name) if name in measured else {}
    return row


def _quantiles(took: dict[str, list[tuple[float, float]]]) -> dict[str, dict[str, float]]:
    """Of waiting, of computing and of both together."""
    times = {
        f"{what}_{name}": values
        for what, both in took.items()
        if both
        for name, values in zip(
            ("wait_ms", "compute_ms", "whole_ms"), (*np.transpose(both), np.sum(both, axis=1)), strict=True
        )
    }
    return {
        name: {"median": float(np.median(of)), "95 %": float(np.quantile(of, 0.95)), "most": float(np.max(of))}
        for name, of in times.items()
    }


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
        "spoken digits of unseen speakers and signed digits of unseen persons as streams of a session, up to "
        f"{APART_S:g} s apart, {100 * (1 - PAIRED):.0f} % of them alone, with other words after half of them, against "
        "the same as files",
        ("fsdd/recordings", "sign_digits", OTHERS),
        f"the streams are right as often as the files, less {100 * MAX_GAP:.0f} point; at most {100 * MAX_WRONG:.0f} % "
        "of the turns taken apart or joined wrongly",
        _run,
        Layout(),
        sources=(*dict.fromkeys((*WORD_SOURCES, "cpp/signal/stream", *GESTURE_SOURCES)),),
        folds=True,
    ),
)
