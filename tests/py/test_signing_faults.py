# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Signed sentences where something is wrong: a start without a stop, signs that no model knows, a stream that lasts."""

from __future__ import annotations

import json
import tracemalloc
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hri
from hri.fusion import FusionOptions
from hri.live import ClipSource, Event, PersonTracks, SignWatcher
from hri.live.frames import TimedFrame
from hri.session import Session, SessionOptions
from signing_people import FPS, SIGNS, DrawnFace, Tracks, film, signed, train_sentences

pytest.importorskip("cv2")

STROKES = {
    "far": [[(60, 95), (-90, -40)], [(100, -40), (-90, -40)]],
    "like cat": [[(60, 95), (-55, -5)], [(60, 95), (-95, -5)]],
}
"""Signs that no model is trained on."""


@pytest.fixture(scope="module")
def sentences() -> hri.SentenceRecognizer:
    return train_sentences()


@pytest.fixture(autouse=True)
def untrained(sentences: hri.SentenceRecognizer, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("signing_people.SIGNS", {**SIGNS, **STROKES})


def of_kind(events: Sequence[Event], kind: str) -> list[Event]:
    return [event for event in events if event.event == kind]


def test_a_sign_that_was_not_trained_is_nothing_or_the_sign_it_is_like(sentences: hri.SentenceRecognizer) -> None:
    for seed in range(3):
        for words, found in (
            (["cat", "far", "ball"], "cat ball"),
            (["far"], ""),
            (["far", "far"], ""),
            (["ball", "like cat", "ball"], "ball cat ball"),
        ):
            assert sentences.recognise(signed(words, seed)[0]).text == found, words
    trained = sentences.recognise(signed(["ball", "cat", "ball"], 1)[0]).words[1]
    forced = sentences.recognise(signed(["ball", "like cat", "ball"], 1)[0]).words[1]
    scores = [word.log_score / (word.last_frame - word.first_frame) for word in (trained, forced)]
    assert scores[1] < 0.75 * scores[0], "only its score says that it is another"


def test_a_start_without_a_stop_is_dropped_after_a_while(sentences: hri.SentenceRecognizer) -> None:
    options = SessionOptions(sentence_begin_labels=("cat",), sentence_end_labels=("stop",), sentence_s=4.0,
                             fusion=FusionOptions(stop_labels=("halt",)))  # fmt: skip
    begun = np.concatenate([signed(["cat"], 1, 1.2)[0], signed(["ball", "ball"], 2, 1.2)[0]])
    wait = np.repeat(begun[-1:], round(5 * FPS), axis=0)
    talk = Session(None, sentences, options=options, faces=DrawnFace())

    def run(*parts: Tracks) -> list[Event]:
        return list(talk.run(pictures=ClipSource(film(np.concatenate(parts), 120), FPS)))

    events = run(begun, wait)
    assert [event.fields["text"] for event in of_kind(events, "say")] == ["The sentence has no end: I do nothing."]
    assert of_kind(events, "state")[-1].fields["state"] == "idle"
    assert [event.fields["words"] for event in of_kind(events, "signed")] == [["cat"], ["ball", "ball"]]
    assert not of_kind(events, "sentence"), "nothing is said of what has no end"
    events = run(begun)
    assert not of_kind(events, "sentence") and not of_kind(events, "say"), "the stream ends before"
    events = run(begun, wait, signed(["cat"], 3, 1.2)[0], signed(["ball"], 4, 1.2)[0], signed(["stop"], 5, 1.2)[0])
    (sentence,) = of_kind(events, "sentence")
    assert sentence.fields["words"] == ["ball"], "words of the dropped one are forgotten"


def test_a_table_of_tracks_without_rows_is_refused(hri: Any, sentences: hri.SentenceRecognizer, tmp_path: Path) -> None:
    sentences.save(tmp_path / "signs.hri")
    for text in (
        "left-x,left-y,right-x,right-y,nose-x,nose-y\n",
        "video,frame,left-x,left-y,right-x,right-y,nose-x,nose-y\n\n\n",
    ):
        (tmp_path / "hands.csv").write_text(text)
        found = hri("read-sentences", tmp_path / "hands.csv", "--model", tmp_path / "signs.hri", "--json", "-")
        assert found.code == 3 and "hands.csv: no rows" in found.err, found.err
        (read,) = json.loads(found.out).values()
        assert list(read) == ["error"] and "hands.csv: no rows" in read["error"]


class Again:
    """The same pictures again and again, for so many seconds; notes the memory in use after each of `marks_s`."""

    name, fps, num_lost = "again", FPS, 0

    def __init__(self, frames: Sequence[Any], duration_s: float, marks_s: Sequence[float]) -> None:
        self._frames, self._end = frames, round(duration_s * FPS)
        self._marks = {round(mark * FPS) for mark in marks_s}
        self._next = 0
        self.traced: list[int] = []
        self.resident: list[int] = []

    def read(self) -> TimedFrame | None:
        if self._next in self._marks:
            self.traced.append(tracemalloc.get_traced_memory()[0])
            self.resident.append(4096 * int(Path("/proc/self/statm").read_text().split()[1]))
        if self._next >= self._end:
            return None
        self._next += 1
        return self._frames[self._next % len(self._frames)], self._next / FPS

    def reconnect(self) -> bool:
        return False

    def close(self) -> None: ...


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="memory is read from /proc")
@pytest.mark.parametrize("rest_s", [1.2, 0.04], ids=["with rests", "without a rest"])
def test_memory_is_flat_over_ten_minutes_of_signing(sentences: hri.SentenceRecognizer, rest_s: float) -> None:
    tracks = [signed(["cat", "ball", "cat", "ball"], seed, rest_s)[0] for seed in range(3)]
    source = Again(film(np.concatenate(tracks), 120), 600.0, (120.0, 599.0))
    num_partial = num_sentences = 0
    tracemalloc.start()
    try:
        for event in SignWatcher(sentences, hands=PersonTracks(DrawnFace())).watch(source):
            num_partial += event.event == "signing"
            num_sentences += event.event == "signed"
    finally:
        tracemalloc.stop()
    assert num_partial > 200 and num_sentences > 10
    assert source.traced[1] - source.traced[0] < 300_000
    assert source.resident[1] - source.resident[0] < 8_000_000
