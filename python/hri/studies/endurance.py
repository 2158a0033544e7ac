# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Hours of sound and of pictures through the live path, faster than they would last: memory, and the same decisions."""

from __future__ import annotations

import gc
import re
import time
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from hri.core.errors import InvalidArgument
from hri.core.optional import import_opencv
from hri.datasets import Dataset
from hri.live import ArraySource, ClipSource, Event, Listener, Watcher
from hri.live.frames import Frame, TimedFrame
from hri.live.sources import BLOCK_S
from hri.media import read_audio, read_frames
from hri.recognition import GestureRecognizer, WordRecognizer
from hri.studies.false_alarms import Samples, compose_words
from hri.studies.registry import GESTURE_SOURCES, WORD_SOURCES, Layout, Progress, Study
from hri.studies.tables import Row, statistics
from hri.studies.webcam import FOLDER, PATTERN
from hri.studies.word_features import load_words

HOURS = 8
SEED = 0
TAKES = 5
SOUND_S = 300
"""Length of what is heard again and again."""
REST_S = 3.0
"""For so long the first picture of every clip is shown before it, so that the hand rests between two gestures."""
MAX_GROWTH = 0.05
# What /proc/self/status says of a process, in kB.
LINES_OF_STATUS = re.compile(r"^(RssAnon|VmRSS|VmSwap):\s*(\d+ kB)$", re.MULTILINE)
Said = tuple[float, str, str]
"""Of a decision: when in its round, in seconds, its label and its status."""
Decided = Callable[[Event], "tuple[str, str] | None"]


class RepeatedSound(ArraySource):
    """The same samples again and again, for `num_rounds` rounds; whole blocks of `BLOCK_S`."""

    def __init__(self, samples: Samples, rate: int, num_rounds: int) -> None:
        block = round(BLOCK_S * rate)
        super().__init__(samples[: len(samples) // block * block], rate)
        self._left = num_rounds - 1

    def read(self) -> Samples | None:
        """The next 20 ms."""
        block = super().read()
        if block is None and self._left > 0:
            self._left, self._at = self._left - 1, 0
            block = super().read()
        return block


class RepeatedPictures(ClipSource):
    """The same frames again and again; time goes on."""

    def __init__(self, timed: Sequence[TimedFrame], round_s: float, num_rounds: int) -> None:
        super().__init__((), len(timed) / round_s)
        self._timed = ((frame, turn * round_s + t) for turn in range(num_rounds) for frame, t in timed)


def memory_bytes() -> int:
    """What this process holds of its own, in memory or swapped out. Raises InvalidArgument on other systems than Linux.

    Pages of files (programs, libraries) are left out: the kernel takes and returns them as it likes.
    """
    try:
        status = Path("/proc/self/status").read_text("utf-8", "replace")
    except OSError as error:
        raise InvalidArgument("the memory of a process is measured on Linux only") from error
    held = {key: int(value.split()[0]) * 1024 for key, value in LINES_OF_STATUS.findall(status)}
    return held.get("RssAnon", held.get("VmRSS", 0)) + held.get("VmSwap", 0)


def decision_of(event: Event) -> tuple[str, str] | None:
    """Label and status of a decision; None for another event."""
    if event.event != "decision" or event.decision is None:
        return None
    return event.decision.nbest[0].label if event.decision.nbest else "", event.decision.status


def rounds_of(events: Iterable[Event], round_s: float, decided: Decided = decision_of) -> Iterator[list[Said]]:
    """The decisions of every round, when it is over: each belongs to the round in which what it decides began."""
    found: defaultdict[int, list[Said]] = defaultdict(list)
    turn = 0
    for event in events:
        # What began in a round may end in the next, but not later than in the middle of it.
        while event.time >= (turn + 1.5) * round_s:
            yield found.pop(turn, [])
            turn += 1
        decision = decided(event)
        if decision is not None:
            begun = event.fields["first_s"]
            at = int(begun // round_s)
            found[at].append((round(begun - at * round_s, 2), *decision))
    for at in range(turn, max(found, default=turn - 1) + 1):
        yield found.pop(at, [])


def same(one: Sequence[Said], other: Sequence[Said]) -> bool:
    """Whether the same was decided at the same times, within a frame of 40 ms."""
    return len(one) == len(other) and all(
        a[1:] == b[1:] and abs(a[0] - b[0]) <= 0.04 for a, b in zip(one, other, strict=True)
    )


def _small(frames: Sequence[Frame]) -> list[Frame]:
    """At half size, to be done sooner."""
    cv2 = import_opencv("to make pictures smaller")
    return [cv2.resize(frame, None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA) for frame in frames]


def endure(
    listen: Callable[[int], Iterable[Event]],
    round_s: float,
    hours: int,
    progress: Callable[[int, int], None],
    decided: Decided = decision_of,
) -> dict[str, Any]:
    """Go on for so many hours: by hour, the share of rounds decided as the second one was, and the memory held.

    Two rounds are left out: the first, in which levels, colours and the floor of the noise are still learned, and one
    after the last hour, at whose end nothing follows.
    """
    rounds_an_hour = max(2, round(3600 / round_s))
    begun = time.perf_counter()
    reference: list[Said] | None = None
    shares, memory, equal = {}, [], []
    num_decisions = 0
    num_rounds = hours * rounds_an_hour
    for turn, said in zip(range(num_rounds), rounds_of(listen(num_rounds + 1), round_s, decided), strict=False):
        num_decisions += len(said)
        if turn == 1:
            reference = said
        if reference is not None:
            equal.append(same(said, reference))
        if (turn + 1) % rounds_an_hour == 0:
            hour = (turn + 1) // rounds_an_hour
            shares[f"hour {hour}"] = float(np.mean(equal))
            equal = []
            gc.collect()
            memory.append(memory_bytes())
            progress(hour, hours)
    return {
        "same": shares,
        "round_s": round_s,
        "decisions": num_decisions,
        "decisions_a_round": len(reference or ()),
        "memory_mb": [round(held / 2**20, 1) for held in memory],
        "growth": memory[-1] / memory[0] - 1,
        "times_real_time": hours * 3600 / (time.perf_counter() - begun),
    }


def words_and_stream(data_dir: Path, length_s: float = SOUND_S) -> tuple[WordRecognizer, Samples, int]:
    """A recogniser of the digits, so long a stream of these digits with pauses between them, and their rate in Hz."""
    dataset = load_words(data_dir, "fsdd", TAKES)
    audio = [read_audio(sample.path) for sample in dataset.samples]
    rate = audio[0].sample_rate_hz
    labels = [sample.label for sample in dataset.samples]
    words = WordRecognizer().fit([a.samples for a in audio], labels, sample_rate_hz=rate)
    num_samples = round(length_s * rate)
    stream, _ = compose_words([a.samples for a in audio], rate, num_samples, np.random.default_rng(SEED))
    return words, stream, rate


def _sound(data_dir: Path, hours: int, progress: Progress) -> dict[str, Any]:
    words, stream, rate = words_and_stream(data_dir)

    def listen(num_rounds: int) -> Iterable[Event]:
        return Listener(words, level_interval_s=60).listen(RepeatedSound(stream, rate, num_rounds))

    return endure(listen, float(SOUND_S), hours, lambda done, total: progress("hours heard", done, total))


def signs_and_pictures(data_dir: Path, progress: Progress) -> tuple[GestureRecognizer, list[TimedFrame], float]:
    """A recogniser of the gestures before webcams, a clip of each after a rest, and how long they last in seconds."""
    dataset = Dataset.load(data_dir / FOLDER, "gesture", PATTERN)
    labels = [sample.label for sample in dataset.samples]
    signs = GestureRecognizer()
    rows = []
    for done, sample in enumerate(dataset.samples):
        rows.append(signs.features(_small(read_frames(sample.path).frames)))
        progress("finding hands", done + 1, len(labels))
    signs.fit_features(rows, labels)
    timed: list[TimedFrame] = []
    end_s = 0.0
    for label in dict.fromkeys(labels):
        clip = read_frames(dataset.samples[labels.index(label)].path)
        frames = _small(clip.frames)
        rest = [(frames[0], end_s + i / clip.fps) for i in range(round(REST_S * clip.fps))]
        begin_s = rest[-1][1] + 1 / clip.fps
        timed += rest + [(frame, begin_s + t) for frame, t in zip(frames, clip.times_s, strict=True)]
        end_s = timed[-1][1] + 1 / clip.fps
    return signs, timed, end_s


def _pictures(data_dir: Path, hours: int, progress: Progress) -> dict[str, Any]:
    signs, timed, end_s = signs_and_pictures(data_dir, progress)

    def watch(num_rounds: int) -> Iterable[Event]:
        return Watcher(signs, hand_interval_s=60).watch(RepeatedPictures(timed, end_s, num_rounds))

    return endure(watch, end_s, hours, lambda done, total: progress("hours watched", done, total))


INPUTS = {"sound": _sound, "pictures": _pictures}


def _run(
    data_dir: Path, progress: Progress, *, input: Sequence[str] = tuple(INPUTS), folds: int | None = None
) -> dict[str, Any]:
    rows: list[Row] = []
    details = {}
    for name in input:
        details[name] = INPUTS[name](data_dir, folds or HOURS, progress)
        rows.append({"input": name, **statistics(details[name].pop("same"), "same")})
    passed = all(row["same_mean"] == 1 and details[row["input"]]["growth"] <= MAX_GROWTH for row in rows)
    return {"seed": SEED, "rows": rows, "details": details, "passed": passed}


STUDIES = (
    Study(
        "endurance",
        f"{HOURS} hours of words and of gestures, the same minutes again and again, through the live path faster than "
        "they would last",
        ("fsdd/recordings", FOLDER),
        f"memory at the end within {100 * MAX_GROWTH:.0f} % of that after the first hour, every round decided alike",
        _run,
        Layout(measure="same"),
        {"input": tuple(INPUTS)},
        sources=(*dict.fromkeys((*WORD_SOURCES, "cpp/signal/stream", *GESTURE_SOURCES)),),
        folds=True,
    ),
)
