# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Signed sentences live: streams of frames and of pictures, sessions, recordings of them; synthetic people."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hri
from hri.core.errors import InvalidArgument, NotFittedError
from hri.fusion import FusionOptions
from hri.language import KnowledgeBase, StoredSentence
from hri.live import ClipSource, Event, GestureRows, PersonTracks, SignWatcher
from hri.media import write_video
from hri.recognition import SentenceRecognizer, SentenceStream, SentenceStreamOptions
from hri.robot import open_robot
from hri.session import McapRecorder, Session, SessionOptions, decisions, read_recording, replay
from hri.vision.persons import Faces
from session_people import MOTIONS, NOD, speech, train_signs, train_words
from signing_people import FPS, DrawnFace, Tracks, film, signed, train_sentences

pytest.importorskip("cv2")

KNOWLEDGE = KnowledgeBase(
    [
        StoredSentence(("cat", "ball"), {"en": "The cat plays.", "hi": "बिल्ली खेलती है।"}, ("agree",)),
        StoredSentence(("ball", "ball", "ball"), {"en": "Many balls."}),
    ],
    max_distance=0.3,
)


@pytest.fixture(scope="module")
def sentences() -> hri.SentenceRecognizer:
    return train_sentences()


def shown(*parts: Sequence[str], rest_s: float = 1.2) -> Tracks:
    """Tracks of several sentences with rests between them."""
    return np.concatenate([signed(words, seed, rest_s)[0] for seed, words in enumerate(parts)])


def source(tracks: Tracks, height: int = 240) -> ClipSource:
    return ClipSource(film(tracks, height), FPS)


def of_kind(events: Sequence[Event], *kinds: str) -> list[Event]:
    return [event for event in events if event.event in kinds]


def session(signs: Any, faces: Faces | None = None, **more: Any) -> Session:
    return Session(None, signs, faces=faces or DrawnFace(), **more)


def test_a_stream_gives_the_words_of_the_file(sentences: hri.SentenceRecognizer) -> None:
    for seed, words in enumerate((["cat"], ["ball", "cat", "ball"], ["stop", "ball", "ball", "cat"])):
        tracks, _ = signed(words, 40 + seed)
        stream = SentenceStream(sentences)
        found = [stream.push(frame, t / FPS) for t, frame in enumerate(tracks)]
        last = stream.finish()
        assert last is not None and last.kind == "end" and last.reason == "ended" and last.text == " ".join(words)
        file = sentences.recognise(tracks)
        assert [(w.label, w.first_frame, w.last_frame) for w in last.words] == [
            (w.label, w.first_frame, w.last_frame) for w in file.words
        ]
        partial = [event for event in found if event is not None and event.kind == "partial"]
        assert partial and all(
            event.labels[: event.num_stable] == tuple(words)[: event.num_stable] for event in partial
        )


def test_a_stream_refuses_what_is_no_frame(sentences: hri.SentenceRecognizer) -> None:
    stream = SentenceStream(sentences)
    with pytest.raises(InvalidArgument, match="5 values, must have 6"):
        stream.push([1, 2, 3, 4, 5], 0.0)
    with pytest.raises(InvalidArgument, match="column 1 is nan"):
        stream.push([1, np.nan, 3, 4, 5, 6], 0.0)
    stream.push([1, 2, 3, 4, 5, 6], 2.0)
    with pytest.raises(InvalidArgument, match="runs backwards"):
        stream.push([1, 2, 3, 4, 5, 6], 1.0)
    with pytest.raises(InvalidArgument, match="rest_s"):
        SentenceStream(sentences, rest_s=-1.0)
    with pytest.raises(NotFittedError):
        SentenceStream(hri.SentenceRecognizer())


def test_sentences_are_found_in_pictures(sentences: hri.SentenceRecognizer) -> None:
    watcher = SignWatcher(sentences, hands=PersonTracks(DrawnFace()), model_id="m")
    events = list(watcher.watch(source(shown(["cat", "ball"], ["ball"]))))
    found = of_kind(events, "signed")
    assert [event.fields["words"] for event in found] == [["cat", "ball"], ["ball"]]
    assert found[0].fields["model"] == "m" and len(found[0].fields["times_s"]) == 2
    assert abs(found[0].fields["first_s"] - 1.2) < 0.3
    so_far = of_kind(events, "signing")
    assert so_far and any(event.fields["num_stable"] for event in so_far)
    for event in so_far:
        json.loads(event.to_json())
    starts, ends = of_kind(events, "gesture_start"), of_kind(events, "gesture_end")
    assert len(starts) == len(ends) == 2 and ends[0].fields["reason"] == "rested"


def test_hands_that_are_hidden_for_a_second_are_of_the_same_sentence(sentences: hri.SentenceRecognizer) -> None:
    first, second = signed(["cat"], 1)[0][:-8], signed(["ball"], 2, 1.2)[0][30:]
    for hidden_s, expected in ((0.8, [["cat", "ball"]]), (2.0, [["cat"], ["ball"]])):
        gap = np.repeat(first[-1:], round(hidden_s * FPS), axis=0)
        gap[:, :2] = np.nan
        watcher = SignWatcher(sentences, hands=PersonTracks(DrawnFace()))
        events = list(watcher.watch(source(np.concatenate([first, gap, second]))))
        assert [event.fields["words"] for event in of_kind(events, "signed")] == expected


def test_without_hands_or_head_there_is_no_sentence(sentences: hri.SentenceRecognizer) -> None:
    empty = np.full((160, 3, 2), np.nan, np.float32)
    events = list(SignWatcher(sentences, hands=PersonTracks(DrawnFace())).watch(source(empty, 120)))
    assert not of_kind(events, "gesture_start", "signed", "gesture_dropped")
    tracks = shown(["cat", "ball"], rest_s=3.0)
    events = list(SignWatcher(sentences, hands=PersonTracks(DrawnFace(False))).watch(source(tracks, 120)))
    assert not of_kind(events, "gesture_start", "signed")
    (dropped,) = of_kind(events, "gesture_dropped")
    assert dropped.fields["reason"] == "no_head" and dropped.time == pytest.approx(5.04, abs=0.05)


def test_pictures_of_another_size_begin_anew(sentences: hri.SentenceRecognizer) -> None:
    frames = film(signed(["cat", "ball"], 1)[0])[:40] + film(signed(["ball"], 2, 1.2)[0], 120)
    events = list(SignWatcher(sentences, hands=PersonTracks(DrawnFace())).watch(ClipSource(frames, FPS)))
    assert of_kind(events, "gesture_dropped")[0].fields["reason"] == "stalled"
    assert [event.fields["words"] for event in of_kind(events, "signed")] == [["ball"]]
    talk = list(session(sentences).run(pictures=ClipSource(frames, FPS)))
    assert [event.fields["words"] for event in of_kind(talk, "sentence")] == [["ball"]]
    assert any("240" in event.fields["message"] for event in of_kind(talk, "stall"))


def test_a_signed_sentence_is_said_and_answered(sentences: hri.SentenceRecognizer) -> None:
    said: list[str] = []
    with open_robot("kinematic") as robot:
        talk = session(sentences, robot=robot, knowledge=KNOWLEDGE, on_say=said.append, motions={"agree": NOD})
        events = list(talk.run(pictures=source(shown(["cat", "ball"], ["stop"]))))
    first = of_kind(events, "sentence")[0]
    assert first.fields["words"] == ["cat", "ball"] and first.fields["distance"] == 0
    assert said[0] == "The cat plays." and set(talk.motions) == {"agree"} and not talk.refused
    assert [event.fields["label"] for event in of_kind(events, "motion_end")] == ["agree"]


def test_stop_among_signs_does_not_wait_for_the_end(sentences: hri.SentenceRecognizer) -> None:
    events = list(session(sentences).run(pictures=source(shown(["ball", "stop", "cat", "ball", "cat"]))))
    (stop,) = of_kind(events, "stop")
    (end,) = of_kind(events, "signed")
    word = end.fields["times_s"][end.fields["words"].index("stop")]
    assert stop.fields["label"] == "stop" and stop.time < end.time - 1.5
    assert stop.time - word[1] < 1.0
    assert not of_kind(events, "sentence"), "nothing is said after STOP"
    late = SentenceStreamOptions(partial_s=100.0)
    events = list(session(sentences, segmenter=late).run(pictures=source(shown(["stop"], ["cat"]))))
    assert [event.event for event in of_kind(events, "stop", "signed", "sentence")] == ["signed", "stop", "signed"]


def test_signs_between_a_begin_and_an_end_are_a_sentence(sentences: hri.SentenceRecognizer) -> None:
    options = SessionOptions(sentence_begin_labels=("cat",), sentence_end_labels=("stop",),
                             fusion=FusionOptions(stop_labels=("halt",)))  # fmt: skip
    parts = (["ball"], ["ball", "cat", "ball"], ["ball", "stop"])
    events = list(session(sentences, options=options).run(pictures=source(shown(*parts))))
    (sentence,) = of_kind(events, "sentence")
    assert sentence.fields["words"] == ["ball", "ball"]
    assert of_kind(events, "ignored")[0].fields["reason"] == "no sentence was begun"


def test_words_beside_a_signed_sentence_do_not_wait_for_it(sentences: hri.SentenceRecognizer) -> None:
    tracks = shown(["cat", "ball", "cat"])
    sound = speech([("flat", 1.6)], len(tracks) / FPS)
    options = SessionOptions(confirm_below=0)
    talk = Session(train_words(), sentences, options=options, faces=DrawnFace())
    events = list(talk.run(hri.live.ArraySource(sound, 16000), source(tracks)))
    (fused,) = of_kind(events, "fused")
    (end,) = of_kind(events, "signed")
    assert fused.fields["final"] == "flat" and fused.time < end.fields["last_s"]
    assert of_kind(events, "sentence")[0].fields["words"] == ["cat", "ball", "cat"]


def test_a_recorded_session_is_repeated(sentences: hri.SentenceRecognizer, tmp_path: Path) -> None:
    pytest.importorskip("mcap")
    path = tmp_path / "signed.mcap"
    talk = session(sentences, knowledge=KNOWLEDGE, segmenter=SentenceStreamOptions(rest_s=0.8))
    pictures = source(shown(["cat", "ball"], ["ball"]), 120)
    before = [event.to_dict() for event in talk.run(pictures=pictures, recorder=McapRecorder(path))]
    assert len([event for event in before if event["event"] == "sentence"]) == 2
    again = replay(read_recording(path), None, sentences, knowledge=KNOWLEDGE, faces=DrawnFace())
    assert decisions([event.to_dict() for event in again]) == decisions(before)
    with pytest.raises(InvalidArgument, match="another kind of signs"):
        list(replay(read_recording(path), None, train_signs(), knowledge=KNOWLEDGE))


def test_what_does_not_fit_is_refused(sentences: hri.SentenceRecognizer, monkeypatch: pytest.MonkeyPatch) -> None:
    tracks, words = zip(*(signed(["cat", "ball"], seed) for seed in range(8)), strict=True)
    rows = hri.SentenceRecognizer(input="rows", language_order=0, choose_weights=False)
    rows.fit([one[:, 1] for one in tracks], words)
    with pytest.raises(InvalidArgument, match="does not say which"):
        Session(None, rows)
    with pytest.raises(InvalidArgument, match="6 values a frame, the model takes 2"):
        SignWatcher(rows, hands=PersonTracks(DrawnFace()))
    with pytest.raises(InvalidArgument, match="need SentenceStreamOptions"):
        session(sentences, segmenter=hri.recognition.GestureSegmenterOptions())
    with pytest.raises(InvalidArgument, match="for a SentenceRecognizer"):
        Session(None, train_signs(), segmenter=SentenceStreamOptions())
    with pytest.raises(InvalidArgument, match="'dance' is in no vocabulary"):
        session(sentences, options=SessionOptions(sentence_begin_labels=("dance",), sentence_end_labels=("cat",)))
    with pytest.raises(NotFittedError):
        session(hri.SentenceRecognizer())
    with pytest.raises(InvalidArgument, match="silhouettes of one hand"):
        GestureRows(hri.GestureRecognizer(num_hands=2))
    with pytest.raises(NotFittedError):
        GestureRows(hri.GestureRecognizer(), names=True)
    monkeypatch.setattr("hri.vision.faces.find_cascade", lambda: None)
    with pytest.raises(InvalidArgument, match="opencv-data"):
        Session(None, sentences)


def test_rows_of_gestures_are_named_by_the_whole_of_each(sentences: hri.SentenceRecognizer) -> None:
    """One hand before a wall moves to the left and to the right, without a rest between."""

    def moved(labels: Sequence[str], seed: int, rest: int = 0) -> tuple[list[Any], list[tuple[str, int, int]]]:
        places, spans = [(160.0, 120.0)] * (8 + rest), []
        for label in labels:
            first = len(places)
            way = {"left": (-60, 0), "up": (0, -60), "between": (-45, -45)}[label]
            places += [(160 + way[0] * s, 120 + way[1] * s) for s in np.sin(np.linspace(0, np.pi, 16))]
            spans.append((label, first, len(places)))
        places += [(160.0, 120.0)] * (8 + rest)
        hand = np.array(places) + 0.5 * np.random.default_rng(seed).normal(size=(len(places), 2))
        hidden = np.full((len(places), 2), np.nan)
        return film(np.stack([hidden, hand, hidden], axis=1).astype(np.float32)), spans

    gestures = hri.GestureRecognizer(use_faces=False)
    rows = GestureRows(gestures, lambda found: found[:, -3:-1], faces="never")
    made = [moved(labels, seed) for seed, labels in enumerate((["left", "up"], ["up", "left"]) * 4)]
    inputs = []
    for frames, _ in made:
        rows.reset()
        inputs.append([rows.push(frame, t / FPS, True) for t, frame in enumerate(frames)])
    signs = hri.SentenceRecognizer(input="rows", language_order=0, choose_weights=False)
    signs.fit([np.stack([r if len(r) else np.full(2, np.nan) for r in one]) for one in inputs], [w for _, w in made])
    clips = [(frames[first:last], label) for frames, words in made for label, first, last in words]
    gestures.fit([clip for clip, _ in clips], [label for _, label in clips])
    named = GestureRows(gestures, lambda found: found[:, -3:-1], names=True, faces="never")
    frames, _ = moved(["up", "left", "left"], 20, rest=30)
    for hands in (rows, named):
        talk = Session(None, signs, hands=hands)
        events = list(talk.run(pictures=ClipSource(frames, FPS)))
        assert [event.fields["words"] for event in of_kind(events, "sentence")] == [["up", "left", "left"]]
    frames, _ = moved(["up", "between", "left"], 21, rest=30)  # which no recogniser was trained on
    strict = hri.GestureRecognizer(use_faces=False, false_reject_rate=0.25)
    strict.fit([clip for clip, _ in clips], [label for _, label in clips])
    named, forced = (
        GestureRows(strict, lambda found: found[:, -3:-1], names=True, reject_unknown=reject, faces="never")
        for reject in (True, False)
    )
    found = [list(Session(None, signs, hands=hands).run(pictures=ClipSource(frames, FPS))) for hands in (named, forced)]
    rejecting, forcing = ([event.fields["words"] for event in of_kind(events, "signed")] for events in found)
    assert rejecting == [["up", "<unk>", "left"]] and forcing == [["up", "up", "left"]]
    assert of_kind(found[0], "sentence")[0].fields["words"] == ["up", "unknown", "left"]
    assert of_kind(found[0], "say")[0].fields["text"] == "up unknown left"


def test_motions_are_for_words_and_answers_alone(sentences: hri.SentenceRecognizer) -> None:
    with open_robot("kinematic") as robot:
        talk = Session(train_words(), sentences, robot=robot, motions=MOTIONS, faces=DrawnFace())
        assert set(talk.motions) == set(MOTIONS) and not set(talk.refused) & {"cat", "ball"}


def test_the_command_line_takes_a_model_of_sentences(
    hri: Any, sentences: SentenceRecognizer, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("hri.vision.persons.face_finder", lambda required: DrawnFace())
    monkeypatch.setattr("hri.cli.watch.face_finder", lambda faces, required: DrawnFace())
    model, video, stored = tmp_path / "signs.hri", tmp_path / "signs.avi", tmp_path / "stored.csv"
    sentences.save(model)
    write_video(video, film(shown(["cat", "ball"])), FPS)
    stored.write_text("signs,en\ncat ball cat,The cat plays.\n", encoding="utf-8")
    found = hri("watch", "--model", model, video)
    assert found.code == 0, found.err
    events = [json.loads(line) for line in found.out.splitlines()]
    (end,) = [event for event in events if event["event"] == "signed"]
    assert end["words"] == ["cat", "ball"] and end["model"].startswith("signs.hri:")
    options = ("--gesture-model", model, "--backend", "none", "--knowledge", stored)
    found = hri("session", *options, video)
    assert found.code == 0, found.err
    events = [json.loads(line) for line in found.out.splitlines()]
    assert [event["text"] for event in events if event["event"] == "say"] == ["The cat plays."]
    refused = hri("watch", "--model", model, "--faces", "never", video)
    assert refused.code == 2 and "the head" in refused.err
    tracks, words = zip(*(signed(["cat", "ball"], seed) for seed in range(8)), strict=True)
    rows = SentenceRecognizer(input="rows", language_order=0, choose_weights=False)
    rows.fit([one[:, 1] for one in tracks], words).save(model)
    refused = hri("session", *options, video)
    assert refused.code == 3 and "does not say which" in refused.err


def test_the_page_shows_words_of_a_sentence_and_adds_no_gesture(sentences: hri.SentenceRecognizer) -> None:
    pytest.importorskip("starlette")
    from hri.serve import Stage

    stage = Stage(None, sentences, knowledge=KNOWLEDGE, faces=DrawnFace())
    try:
        welcome = stage.welcome()
        assert welcome["gesture"] and welcome["teach"] == [] and welcome["signs"] == ["ball", "cat", "stop"]
        assert welcome["sentences"]["begin"] == [] and welcome["sentences"]["stored"][0] == "cat ball"
    finally:
        stage.close()
