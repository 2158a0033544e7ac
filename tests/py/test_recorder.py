# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Recording words: what is asked for is kept, nothing is overwritten, and the folder is a data set."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import hri as package
from conftest import RATE_HZ, tone_word
from hri import _native
from hri.cli.record import describe
from hri.core.errors import InvalidArgument, IoError
from hri.datasets import Dataset
from hri.live import ArraySource, WordRecorder

LABELS = ["चलो", "turn left"]
SLOPES = {"चलो": 800.0, "turn left": -350.0}


def said(labels: list[str], seed: int = 0) -> np.ndarray:
    """The words as a stream, with pauses."""
    pauses = 0.001 * np.random.default_rng(1000 + seed).standard_normal((len(labels) + 1, RATE_HZ // 2)).astype("f4")
    words = [tone_word(550.0, SLOPES[label], seed + number) for number, label in enumerate(labels)]
    return np.concatenate([*(part for pair in zip(pauses, words, strict=False) for part in pair), pauses[-1]])


def listen(recorder: WordRecorder, stream: np.ndarray) -> list[tuple[str, object]]:
    """What is reported beside levels and end points: kind and label."""
    events = list(recorder.record(ArraySource(stream, RATE_HZ)))
    return [(e.event, e.fields.get("label")) for e in events if e.event in ("prompt", "recorded", "refused")]


def test_words_are_asked_for_in_rounds_and_become_a_data_set(tmp_path: Path) -> None:
    recorder = WordRecorder(tmp_path / "words", LABELS, "asha", takes=2)
    assert recorder.num_takes == 4
    reported = listen(recorder, said(LABELS * 2))
    assert reported == [step for label in LABELS * 2 for step in (("prompt", label), ("recorded", label))]
    assert recorder.missing() == []

    dataset = Dataset.load(tmp_path / "words")
    assert (dataset.kind, dataset.synthetic, dataset.ignored) == ("speech", False, [])
    assert sorted((s.label, s.person, s.take) for s in dataset) == sorted(
        (label, "asha", take) for label in LABELS for take in ("1", "2")
    )
    for sample in dataset:
        clip = package.read_audio(sample.path)
        assert clip.sample_rate_hz == RATE_HZ and 0.8 < clip.duration_s < 1.3  # half a second, and what is around it
        bounds = _native.find_speech(clip.samples, RATE_HZ)
        assert bounds is not None and (bounds[1] - bounds[0]) / RATE_HZ == pytest.approx(0.55, abs=0.1)


def test_every_recording_is_its_piece_of_the_stream(tmp_path: Path) -> None:
    stream = said(LABELS)
    list(WordRecorder(tmp_path, LABELS, "asha", takes=1).record(ArraySource(stream, RATE_HZ)))
    for label in LABELS:
        clip = package.read_audio(tmp_path / label / "asha_1.wav").samples
        begins = np.lib.stride_tricks.sliding_window_view(stream, 200)  # in noise, which is nowhere the same
        at = int(np.argmin(np.abs(begins - clip[:200]).max(axis=1)))
        np.testing.assert_allclose(clip, stream[at : at + len(clip)], rtol=0, atol=1 / 32767)


def test_recording_goes_on_and_overwrites_nothing(tmp_path: Path) -> None:
    first = WordRecorder(tmp_path, LABELS, "asha", takes=2)
    listen(first, said(LABELS[:1]))
    kept = tmp_path / LABELS[0] / "asha_1.wav"
    before = kept.read_bytes()
    assert first.missing() == [("turn left", 1), ("चलो", 2), ("turn left", 2)]

    again = WordRecorder(tmp_path, LABELS, "asha", takes=2)
    assert listen(again, said(["turn left"], seed=5))[0] == ("prompt", "turn left")
    assert kept.read_bytes() == before and len(again.missing()) == 2
    (tmp_path / "turn left" / "asha_1.wav").unlink()  # to be said anew
    assert again.missing()[0] == ("turn left", 1)

    other = WordRecorder(tmp_path, LABELS, "ben", takes=1)
    listen(other, said(LABELS, seed=9))
    assert Dataset.load(tmp_path).persons == ["asha", "ben"] and kept.read_bytes() == before
    closed = ArraySource(said(LABELS), RATE_HZ)
    assert list(other.record(closed)) == [] and closed.read() is None


def test_a_file_that_appears_meanwhile_stays(tmp_path: Path) -> None:
    recorder = WordRecorder(tmp_path, LABELS, "asha", takes=1)
    events = recorder.record(ArraySource(said(LABELS), RATE_HZ))
    next(event for event in events if event.event == "prompt")
    theirs = tmp_path / LABELS[0] / "asha_1.wav"
    theirs.parent.mkdir()
    theirs.write_bytes(b"theirs")
    with pytest.raises(IoError, match=r"asha_1\.wav"):
        list(events)
    assert [path.name for path in theirs.parent.iterdir()] == ["asha_1.wav"] and theirs.read_bytes() == b"theirs"


def test_what_is_not_good_enough_is_asked_for_again(tmp_path: Path) -> None:
    pause = 0.001 * np.random.default_rng(1).standard_normal(RATE_HZ).astype("f4")
    loud = np.clip(8 * tone_word(550.0, 800.0, 1), -1, 1)
    endless = tone_word(550.0, 0.0, 2)[RATE_HZ // 4 : -RATE_HZ // 4]
    stream = np.concatenate([pause, loud, pause, *[endless] * 4, pause, tone_word(550.0, 800.0, 3), pause])
    options = _native.EndpointerOptions(max_utterance_ms=1400)
    recorder = WordRecorder(tmp_path, ["go"], "asha", takes=1, options=options)
    events = list(recorder.record(ArraySource(stream, RATE_HZ)))
    reasons = [e.fields["reason"] for e in events if e.event == "refused"]
    assert reasons[0].startswith("too loud") and reasons[1] == "too long for a word"
    assert [e.event for e in events].count("prompt") == len(reasons) + 1
    assert [e.fields["take"] for e in events if e.event == "recorded"] == [1]

    class Lossy(ArraySource):
        def read(self) -> np.ndarray | None:
            self.num_lost = 7
            return super().read()

    lossy = WordRecorder(tmp_path, ["go"], "ben", takes=1).record(Lossy(said(["चलो"]), RATE_HZ))
    assert [e.fields["reason"] for e in lossy if e.event == "refused"] == [
        "7 samples were lost: this computer is too busy"
    ]


def test_what_cannot_be_recorded_is_said_before(tmp_path: Path) -> None:
    for labels, person, takes, message in (
        ([], "asha", 1, "there is none to record"),
        (["go", "go"], "asha", 1, "'go' is there twice"),
        (["unknown"], "asha", 1, "reserved for decisions"),
        (["left/right"], "asha", 1, "label 'left/right' cannot be the name of a file: '/'"),
        (["go\n"], "asha", 1, "cannot be the name"),
        ([".go"], "asha", 1, "cannot be the name"),
        (["go"], "", 1, "person ''"),
        (["go"], "asha_2", 1, "'_'"),
        (["go"], "asha", 0, "takes must be at least 1"),
    ):
        with pytest.raises(InvalidArgument, match=message):
            WordRecorder(tmp_path, labels, person, takes)
    manifest = tmp_path / "dataset.toml"
    manifest.write_text('kind = "speech"\npattern = "{label}/{take}.wav"\n')
    with pytest.raises(InvalidArgument, match="another data set"):
        WordRecorder(tmp_path, ["go"], "asha")
    manifest.write_text('kind = "speech"\npattern = "{label}/{person}_{take}.wav"\nsynthetic = true\n')
    with pytest.raises(InvalidArgument, match="synthetic recordings: record people into another folder"):
        WordRecorder(tmp_path, ["go"], "asha")
    (tmp_path / "dataset.toml").write_text(
        'kind = "speech"\npattern = "{label}/{person}_{take}.wav"\nlabels = ["go"]\n'
    )
    assert WordRecorder(tmp_path, ["go"], "asha").num_takes == 5
    with pytest.raises(InvalidArgument, match="'stop' is not among the labels"):
        WordRecorder(tmp_path, ["stop"], "asha")
    (tmp_path / "file").touch()
    with pytest.raises(IoError, match="file"):
        list(WordRecorder(tmp_path / "file", ["go"], "asha").record(ArraySource(said(LABELS), RATE_HZ)))


@pytest.mark.parametrize("there", ["five/asha.jpg", "seven.wav", "go/asha_1.flac", "a/b/asha_1.wav"])
def test_a_folder_of_other_recordings_is_left_alone(hri, tmp_path: Path, there: str) -> None:
    """A manifest would hide them: of signs nothing could be trained any more."""
    _native.write_wav_pcm16(str(tmp_path / "one.wav"), said(LABELS), RATE_HZ)
    out = tmp_path / "data"
    (out / there).parent.mkdir(parents=True)
    (out / there).touch()
    refused = hri("record", "word", "go", "--person", "a", "--out", out, "--from", tmp_path / "one.wav")
    assert refused.code == 3 and f"such as {there}: record into another folder" in refused.err
    assert [path for path in out.rglob("*") if path.is_file()] == [out / there]


def test_recordings_of_the_same_pattern_and_noises_need_no_manifest(tmp_path: Path) -> None:
    for name in ("go/ben_1.wav", "_background_noise_/rain.wav", ".hidden/a.jpg", "notes.txt"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
    assert WordRecorder(tmp_path, ["go"], "ben", takes=2).missing() == [("go", 2)]


def test_the_command_records_from_a_recording_and_goes_on(hri, tmp_path: Path) -> None:
    _native.write_wav_pcm16(str(tmp_path / "one.wav"), said(LABELS), RATE_HZ)
    out = tmp_path / "words"
    command = ("record", "word", *LABELS, "--person", "asha", "--takes", "2", "--out", out)
    first = hri(*command, "--from", tmp_path / "one.wav")
    assert first.code == 3 and "2 of 4 recordings by asha" in first.err
    assert "one.wav: ended before 'चलो', take 2" in first.err
    rows = [json.loads(line) for line in first.out.splitlines()]
    assert [row["label"] for row in rows if row["event"] == "recorded"] == LABELS
    second = hri(*command, "--from", tmp_path / "one.wav")
    assert second.code == 0 and "4 of 4 recordings by asha" in second.err
    third = hri(*command)  # nothing is missing, so no microphone is needed
    assert (third.code, third.out) == (0, "")
    quick = ("--front-end", "cepstra", "--no-fillers")
    trained = hri("train", "speech", "--data", out, "--out", tmp_path / "words.hri", *quick)
    assert trained.code == 0, trained.err
    model = package.WordRecognizer.load(tmp_path / "words.hri")
    assert list(model.classes_) == sorted(LABELS)
    assert model.recognise(tone_word(550.0, 800.0, 77), RATE_HZ).nbest[0].label == "चलो"


def test_people_read_what_to_say_and_what_was_kept(tmp_path: Path) -> None:
    recorder = WordRecorder(tmp_path, LABELS, "asha", takes=1)
    lines = [describe(event) for event in recorder.record(ArraySource(said(LABELS), RATE_HZ))]
    shown = [line for line in lines if line]
    assert shown[0].startswith("listening to samples") and "1 of 2: say  चलो" in shown[1]
    assert "asha_1.wav" in shown[2] and "2 of 2: say  turn left" in shown[3] and len(shown) == 5
