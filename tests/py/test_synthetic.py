# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Synthetic speech and drawn signers: what they show, and that equal seeds give equal data."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from hri.core.errors import InvalidArgument, IoError
from hri.datasets import Dataset
from hri.media import read_audio, read_frames
from hri.synthetic import speech
from hri.synthetic.drawing.hand_pose import DIGIT_POSES, HandShape, make_skeleton, rotation
from hri.synthetic.drawing.height_field import HeightField
from hri.synthetic.signer import (
    SIGNS,
    draw_clip,
    draw_still,
    make_gesture_corpus,
    make_signer,
)
from hri.synthetic.speech import DIGIT_WORDS, make_speaker, make_speech_corpus, speak

cv2 = pytest.importorskip("cv2")
needs_espeak = pytest.mark.skipif(shutil.which("espeak-ng") is None, reason="no espeak-ng")


@needs_espeak
@pytest.mark.parametrize("language", DIGIT_WORDS)
def test_every_digit_is_spoken_with_quiet_margins(language: str) -> None:
    for text in DIGIT_WORDS[language].values():
        audio = speak(text, language, make_speaker(1))
        assert 0.3 < audio.duration_s < 1.6
        assert np.isfinite(audio.samples).all()
        assert 0.2 < np.abs(audio.samples).max() <= 1.0
        margin = audio.samples[: int(0.08 * audio.sample_rate_hz)]
        assert 0 < np.abs(margin).max() < 0.1 * np.abs(audio.samples).max()


@needs_espeak
def test_speech_depends_on_its_arguments_alone() -> None:
    first = speak("three", "en", make_speaker(2), take=1, seed=5)
    np.testing.assert_array_equal(first.samples, speak("three", "en", make_speaker(2), 1, 5).samples)
    for other in (
        speak("four", "en", make_speaker(2), 1, 5),
        speak("three", "en", make_speaker(3), 1, 5),
        speak("three", "en", make_speaker(2), 2, 5),
        speak("three", "en", make_speaker(2), 1, 6),
    ):
        assert not np.array_equal(first.samples, other.samples)


@needs_espeak
def test_a_shorter_vocal_tract_moves_resonances_up_and_not_the_pace() -> None:
    centres, lengths = [], []
    for tract in (0.85, 1.0, 1.2):
        audio = speak("three", "en", replace(make_speaker(0), tract=tract))
        power = np.abs(np.fft.rfft(audio.samples)) ** 2
        hz = np.fft.rfftfreq(len(audio.samples), 1 / audio.sample_rate_hz)
        voiced = (hz > 1200) & (hz < 4000)
        centres.append(float((hz * power)[voiced].sum() / power[voiced].sum()))
        lengths.append(audio.duration_s)
    assert centres[0] < centres[1] < centres[2]
    assert max(lengths) < 1.15 * min(lengths)


@needs_espeak
def test_voices_of_many_speakers_differ() -> None:
    speakers = [make_speaker(index) for index in range(48)]
    assert len({speaker.variant for speaker in speakers}) == 48
    spoken = [speak("one", "en", speaker).samples for speaker in speakers[::6]]
    assert len({len(samples) for samples in spoken}) == len(spoken)
    assert {speaker.tract for speaker in speakers[:12]} == {1.0}
    assert all(0.88 <= speaker.tract <= 1.14 for speaker in speakers)


@needs_espeak
def test_the_command_makes_a_corpus_of_any_words(hri, tmp_path: Path) -> None:
    out = tmp_path / "words"
    result = hri("corpus", "speech", "go=चलो", "stop=रुको", "--language", "hi", "--out", out, "--speakers", 2)
    assert result.code == 0 and "8 synthetic recordings of 2 words by 2 voices" in result.out
    dataset = Dataset.load(out)
    assert dataset.synthetic and dataset.labels == ["go", "stop"] and len(dataset) == 8
    assert hri("corpus", "speech", "--language", "de", "--out", out).code == 2
    assert hri("corpus", "speech", "go", "go=walk", "--out", out).code == 2


@needs_espeak
def test_speech_corpus_says_that_it_is_synthetic(tmp_path: Path) -> None:
    calls = []
    words = {"en": ["go", "stop"], "hi": {"go": "चलो"}}
    dataset = make_speech_corpus(tmp_path / "new", words, 2, 2, progress=lambda *done: calls.append(done))
    assert dataset == Dataset.load(tmp_path / "new")
    assert dataset.synthetic
    assert dataset.kind == "speech"
    assert dataset.labels == ["go", "stop"]
    assert dataset.persons == ["voice01", "voice02"]
    assert len(dataset) == 12
    assert calls == [(i + 1, 12) for i in range(12)]
    assert {sample.take for sample in dataset} == {"en1", "en2", "hi1", "hi2"}
    assert read_audio(dataset.samples[0].path).samples.size > 4000


@needs_espeak
def test_default_speech_is_ten_digits_in_two_languages(tmp_path: Path) -> None:
    dataset = make_speech_corpus(tmp_path, num_speakers=1, takes=1)
    assert dataset.labels == list("0123456789")
    assert len(dataset) == 20


@needs_espeak
def test_words_that_cannot_be_spoken_are_refused(tmp_path: Path) -> None:
    for arguments, message in (
        (({"xx": ["go"]},), "xx"),
        (({"en": {"go": "..."}},), "no sound"),
        (({"en": {"go": "a\0b"}},), r"text 'a\\x00b' cannot be spoken"),
        (({},), "words is empty"),
        (({"en": ["a/b"]},), "label 'a/b'"),
        (({"en": ["go"]}, 0), "num_speakers is 0"),
        (({"en": ["go"]}, 1, 0), "takes 0"),
    ):
        with pytest.raises(InvalidArgument, match=message):
            make_speech_corpus(tmp_path / "out", *arguments)
    assert not (tmp_path / "out" / "dataset.toml").exists()


def test_missing_espeak_names_the_package(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(IoError, match="install the package espeak-ng"):
        speak("go")


def test_synthesiser_that_hangs_is_stopped(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    program = tmp_path / "espeak-ng"
    program.write_text("#!/bin/sh\nexec /bin/sleep 30\n")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(speech, "_TIMEOUT_S", 0.2)
    with pytest.raises(IoError, match="did not finish"):
        speak("go")


def extended_fingers(label: str) -> list[bool]:
    """Index to little finger: does it stand up from its knuckle?"""
    joints = make_skeleton(DIGIT_POSES[label], HandShape()).fingers
    return [bool(finger[3, 1] - finger[0, 1] > 0.25) for finger in joints]


@pytest.mark.parametrize(
    ("label", "fingers"),
    [
        *(("0", "...."), ("1", "|..."), ("2", "||.."), ("3", "||.."), ("4", "||||")),
        *(("5", "||||"), ("6", "|||."), ("7", "||.|"), ("8", "|.||"), ("9", ".|||")),
    ],
)
def test_signs_raise_the_right_fingers(label: str, fingers: str) -> None:
    assert extended_fingers(label) == [mark == "|" for mark in fingers]


@pytest.mark.parametrize(("label", "finger"), [("0", 0), ("6", 3), ("7", 2), ("8", 1), ("9", 0)])
def test_thumb_touches_the_right_finger(label: str, finger: int) -> None:
    skeleton = make_skeleton(DIGIT_POSES[label], HandShape())
    distances = np.linalg.norm(skeleton.fingers[:, 3] - skeleton.thumb[3], axis=1)
    assert int(np.argmin(distances)) == finger
    assert distances[finger] < 0.08


def test_rotation_keeps_lengths() -> None:
    matrix = rotation(20, -30, 40)
    np.testing.assert_allclose(matrix @ matrix.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(matrix) == pytest.approx(1.0)


def test_limb_along_the_view_is_a_disc_and_across_it_a_strip() -> None:
    for end, area in (((30.4, 30.3, 25), np.pi * 100), ((50.4, 30.3, 0), np.pi * 100 + 20 * 20)):
        field = HeightField(60, 80)
        field.add_limb(np.array([30.4, 30.3, 0]), np.array(end), 10, 10, (1, 2, 3), 4)
        assert np.count_nonzero(field.part == 4) == pytest.approx(area, rel=0.03)
        assert field.depth.max() == pytest.approx(end[2] + 10, abs=0.05)
        drawn = field.part > 0
        np.testing.assert_allclose(np.linalg.norm(field.normal[drawn], axis=1), 1, atol=1e-4)


def test_nearer_shape_hides_the_farther_one_in_any_order() -> None:
    near, far = (np.array([20.0, 20, 30]), 1), (np.array([22.0, 20, 0]), 2)
    fields = []
    for order in ((near, far), (far, near)):
        field = HeightField(40, 40)
        for centre, part in order:
            field.add_ellipsoid(centre, np.array([8.0, 8, 8]), (9, 9, 9), part)
        fields.append(field)
    assert fields[0].part[20, 20] == 1
    np.testing.assert_array_equal(fields[0].part, fields[1].part)


def test_shape_outside_the_picture_draws_nothing() -> None:
    field = HeightField(20, 20)
    field.add_limb(np.array([-90.0, 5, 0]), np.array([-50.0, 5, 0]), 5, 5, (1, 1, 1), 1)
    with field.merged(cv2, 2.0) as layer:
        layer.add_ellipsoid(np.array([99.0, 99, 0]), np.array([5.0, 5, 5]), (1, 1, 1), 1)
    assert not field.part.any()


def test_stills_depend_on_their_arguments_alone() -> None:
    signer = make_signer(3, seed=1)
    first = draw_still(signer, "7", take=2, seed=1)
    assert first.shape == (200, 200, 3)
    assert first.dtype == np.uint8
    np.testing.assert_array_equal(first, draw_still(make_signer(3, seed=1), "7", take=2, seed=1))
    for other in (
        draw_still(signer, "8", 2, 1),
        draw_still(signer, "7", 3, 1),
        draw_still(signer, "7", 2, 2),
        draw_still(make_signer(4, seed=1), "7", 2, 1),
    ):
        assert np.abs(first.astype(int) - other).mean() > 1


def skin_mask(frame: np.ndarray) -> np.ndarray:
    """A common rule for skin, independent of how the signer was coloured."""
    y, cr, cb = cv2.split(cv2.cvtColor(frame, cv2.COLOR_BGR2YCrCb))
    mask = ((y > 30) & (cr > 134) & (cr < 180) & (cb > 75) & (cb < 127)).astype(np.uint8)
    return cv2.morphologyEx(mask, cv2.MORPH_OPEN, np.ones((3, 3), np.uint8))


@pytest.mark.parametrize("index", range(8))
def test_skin_in_a_still_is_one_hand(index: int) -> None:
    for label in SIGNS:
        mask = skin_mask(draw_still(make_signer(index), label))
        count, _, stats, _ = cv2.connectedComponentsWithStats(mask)
        areas = np.sort(stats[1:, cv2.CC_STAT_AREA])[::-1]
        assert count >= 2
        assert 0.06 * mask.size < areas[0] < 0.40 * mask.size
        assert areas[1:].sum() < 0.12 * areas[0]


@pytest.mark.parametrize("index", range(8))
def test_clip_shows_face_and_a_smaller_hand_apart_from_it(index: int) -> None:
    label = SIGNS[(5 + index) % 10]
    frames = draw_clip(make_signer(index), label, num_frames=9)
    assert {frame.shape for frame in frames} == {(240, 320, 3)}
    _count, _, stats, centres = cv2.connectedComponentsWithStats(skin_mask(frames[4]))
    order = 1 + np.argsort(stats[1:, cv2.CC_STAT_AREA])[::-1]
    face, hand = order[:2]
    assert 800 < stats[hand, cv2.CC_STAT_AREA] < stats[face, cv2.CC_STAT_AREA]
    assert centres[hand, 0] < centres[face, 0] - 50
    others = [stats[part, cv2.CC_STAT_AREA] for part in order[2:]]
    assert sum(others) < 0.15 * stats[hand, cv2.CC_STAT_AREA]


def test_arm_is_down_at_both_ends_of_a_clip() -> None:
    frames = draw_clip(make_signer(0), "5", num_frames=9)
    hand_area = [int(skin_mask(frame)[:, :120].sum()) for frame in frames]
    assert hand_area[0] < 50 > hand_area[-1]
    assert min(hand_area[3:6]) > 1000


def test_clip_size_is_the_callers() -> None:
    assert draw_clip(make_signer(0), "1", size_px=(640, 480), num_frames=3)[1].shape == (
        480,
        640,
        3,
    )
    with pytest.raises(InvalidArgument, match="size_px is"):
        draw_clip(make_signer(0), "1", size_px=(20, 20))
    with pytest.raises(InvalidArgument, match="num_frames 2"):
        draw_clip(make_signer(0), "1", num_frames=2)


@pytest.mark.parametrize(("kind", "suffix", "num_persons"), [("still", ".jpg", 2), ("clip", ".mp4", 1)])
def test_gesture_corpus_says_that_it_is_synthetic(tmp_path: Path, kind: str, suffix: str, num_persons: int) -> None:
    calls = []
    dataset = make_gesture_corpus(tmp_path, ["3", "0"], num_persons, 1, kind, progress=lambda *done: calls.append(done))
    assert dataset == Dataset.load(tmp_path)
    assert dataset.synthetic
    assert dataset.kind == "gesture"
    assert dataset.labels == ["0", "3"]
    assert dataset.persons == ["signer01", "signer02"][:num_persons]
    assert calls == [(i + 1, 2 * num_persons) for i in range(2 * num_persons)]
    for sample in dataset:
        assert sample.path.suffix == suffix
        assert len(read_frames(sample.path).frames) == (1 if kind == "still" else 36)


def contents(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_a_second_corpus_takes_the_place_of_its_own_kind_only_when_asked(tmp_path: Path) -> None:
    made = make_gesture_corpus(tmp_path, ["1", "2"], num_persons=2)
    before = contents(tmp_path)
    assert make_gesture_corpus(tmp_path, ["1", "2"], num_persons=2) == made and contents(tmp_path) == before
    with pytest.raises(InvalidArgument, match=r"made with other options: .*--replace"):
        make_gesture_corpus(tmp_path, ["1"], num_persons=1)
    assert contents(tmp_path) == before
    assert len(make_gesture_corpus(tmp_path, ["1"], num_persons=1, replace=True)) == 1
    assert sorted(contents(tmp_path)) == ["1/signer01_still1.jpg", "dataset.toml"] and not (tmp_path / "2").exists()


@pytest.mark.parametrize("replace", [(), ("--replace",)])
def test_a_corpus_never_takes_the_place_of_what_people_recorded(hri, tmp_path: Path, replace: tuple[str, ...]) -> None:
    def refused(folder: Path, reason: str) -> bool:
        before = contents(folder)
        found = hri("corpus", "gesture", "1", "--persons", 1, "--out", folder, *replace)
        return found.code == 3 and reason in found.err and contents(folder) == before

    recorded = tmp_path / "recorded"
    (recorded / "1").mkdir(parents=True)
    (recorded / "1" / "asha_1.jpg").touch()
    assert refused(recorded, "not empty, there is 1/asha_1.jpg")
    (recorded / "dataset.toml").write_text('kind = "gesture"\npattern = "{label}/{person}_{take}.jpg"\n')
    assert refused(recorded, "hri.synthetic.signer did not make")
    mixed = tmp_path / "mixed"
    make_gesture_corpus(mixed, ["1"], num_persons=1)
    (mixed / "1" / "asha_1.jpg").touch()
    assert refused(mixed, "more than synthetic data, 1/asha_1.jpg")
    with (mixed / "dataset.toml").open("a") as file:
        file.write('\n[[samples]]\npath = "1/asha_1.jpg"\nlabel = "1"\nperson = "asha"\n')
    assert refused(mixed, "recordings by 'asha'")


def test_a_corpus_that_is_interrupted_leaves_what_was_there(tmp_path: Path) -> None:
    def stop(done: int, total: int) -> None:
        raise KeyboardInterrupt

    make_gesture_corpus(tmp_path / "old", ["1"], num_persons=1)
    before = contents(tmp_path)
    for folder in ("old", "new"):
        with pytest.raises(KeyboardInterrupt):
            make_gesture_corpus(tmp_path / folder, ["1", "2"], num_persons=1, progress=stop, replace=True)
    assert contents(tmp_path) == before and not (tmp_path / "new").exists()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"labels": ["wave"]}, "label 'wave' cannot be drawn"),
        ({"labels": []}, "labels is \\[\\]"),
        ({"num_persons": 0}, "num_persons 0"),
        ({"takes": 0}, "takes 0"),
        ({"kind": "film"}, "kind is 'film'"),
    ],
)
def test_corpus_that_cannot_be_drawn_is_refused(tmp_path: Path, options: dict, message: str) -> None:
    with pytest.raises(InvalidArgument, match=message):
        make_gesture_corpus(tmp_path, **options)
    assert list(tmp_path.iterdir()) == []


def test_folder_that_cannot_be_made_is_an_os_error(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(IoError, match="file"):
        make_gesture_corpus(tmp_path / "file", ["1"], 1)
