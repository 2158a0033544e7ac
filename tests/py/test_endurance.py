# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The study that goes on for hours: what it repeats, and what it would notice."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from hri.live import Event
from hri.recognition.decision import Decision, NBest
from hri.studies import endurance
from hri.studies.endurance import RepeatedPictures, RepeatedSound, endure, rounds_of, same


def decided(begun: float, label: str = "go") -> Event:
    decision = Decision("speech", label, "recognised", 1.0, nbest=(NBest(label, 1.0, 0.0),))
    return Event(begun + 0.5, "decision", {"first_s": begun}, decision)


def quiet(time_s: float) -> Event:
    return Event(time_s, "level")


def test_sound_and_pictures_are_repeated():
    samples = np.arange(500, dtype=np.float32)
    source = RepeatedSound(samples, 8000, 3)
    blocks = []
    while (block := source.read()) is not None:
        blocks.append(block)
    assert np.array_equal(np.concatenate(blocks), np.tile(samples[:480], 3))
    frame = np.zeros((2, 2, 3), np.uint8)
    pictures = RepeatedPictures([(frame, 0.0), (frame, 0.3)], 0.5, 2)
    assert [timed[1] for timed in iter(pictures.read, None)] == [0.0, 0.3, 0.5, 0.8]


def test_decisions_belong_to_the_round_they_began_in():
    events = [decided(1), decided(9.8, "late"), decided(11), quiet(16), decided(21), quiet(40)]
    assert [[said[:2] for said in found] for found in rounds_of(events, 10)] == [
        [(1.0, "go"), (9.8, "late")],
        [(1.0, "go")],
        [(1.0, "go")],
    ]
    assert same([(1.0, "go", "recognised")], [(1.02, "go", "recognised")])
    assert not same([(1.0, "go", "recognised")], [(1.02, "go", "unknown")])
    assert not same([(1.0, "go", "recognised")], [])


def test_what_changes_and_what_grows_is_noticed(monkeypatch: pytest.MonkeyPatch):
    held = iter([100, 110])
    monkeypatch.setattr(endurance, "memory_bytes", lambda: next(held))

    def listen(num_rounds: int) -> Iterator[Event]:
        for turn in range(num_rounds):
            yield decided(turn * 600 + 60, "go" if turn != 9 else "stop")
        yield quiet(num_rounds * 600 + 400)

    found = endure(listen, 600.0, 2, lambda *_: None)
    assert found["same"] == {"hour 1": 1.0, "hour 2": pytest.approx(5 / 6)}
    assert found["growth"] == pytest.approx(0.1)
    assert found["decisions"] == 12 and found["decisions_a_round"] == 1


# By itself, where nothing else comes or goes meanwhile.
HOLD_A_BLOCK = """
from hri.studies.endurance import memory_bytes
before = memory_bytes()
block = bytearray(b"x") * 200_000_000
print(before, memory_bytes())
"""


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="memory is measured on Linux only")
def test_memory_is_that_of_this_process():
    said = subprocess.run([sys.executable, "-c", HOLD_A_BLOCK], capture_output=True, text=True, check=True, timeout=120)
    before, with_block = map(int, said.stdout.split())
    assert 1_000_000 < before < 1_000_000_000
    assert 150_000_000 < with_block - before < 300_000_000
