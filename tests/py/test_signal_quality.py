# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""How good a signal was: of words and of masks, in files, in streams and in what a session fuses."""

from __future__ import annotations

import tracemalloc
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import hri
from conftest import PERSONS, RATE_HZ, tone_word
from drawn_hands import FPS, stills
from hri.core.errors import InvalidArgument, NotFittedError
from hri.evaluation import make_noise, mix_noise
from hri.fusion import LearnedFusion, fuse
from hri.io import write_wav_pcm16
from hri.live import ArraySource, ClipSource, Watcher
from hri.media import write_image, write_video
from hri.recognition import quality
from hri.recognition.quality import mask_quality, speech_snr_db
from hri.session import McapRecorder, Session, decisions, read_recording, replay
from session_people import signing, speech, train_signs, train_words

pytest.importorskip("cv2")


@pytest.fixture(scope="module")
def words() -> hri.WordRecognizer:
    return train_words()


@pytest.fixture(scope="module")
def signs() -> hri.GestureRecognizer:
    return train_signs()


@pytest.fixture(scope="module")
def fusion() -> LearnedFusion:
    """Of made-up scores of two classes that both recognisers know."""
    rng = np.random.default_rng(0)
    truth = rng.integers(2, size=200)
    scores = {}
    for mode in ("speech", "gesture"):
        sure = np.clip(rng.normal(0.8, 0.25, 200), 0.01, 0.99)
        scores[mode] = np.where(np.arange(2) == truth[:, None], sure[:, None], 1 - sure[:, None])
    quality = {"speech": rng.uniform(0, 40, 200), "gesture": rng.random(200)}
    return LearnedFusion("logistic").fit(scores, quality, truth)


@pytest.mark.parametrize("noise", ["white", "pink"])
@pytest.mark.parametrize("rate", [8000, 16000])
def test_more_noise_is_a_lower_ratio(noise: str, rate: int) -> None:
    rng = np.random.default_rng(0)
    times_s = np.arange(rate) / rate
    envelope = np.clip(np.sin(2 * np.pi * 2.5 * times_s), 0, 1) ** 2
    tones = sum(np.sin(2 * np.pi * hz * times_s + hz) for hz in range(120, 3900, 120))
    word = (0.02 * envelope * tones).astype(np.float32)
    found = [
        speech_snr_db(mix_noise(word, make_noise(noise, len(word), rate, rng), snr_db, rate), rate)
        for snr_db in (30, 20, 10, 0, -10)
    ]
    assert found == sorted(found, reverse=True) and found[0] - found[3] > 12
    assert found[1] == pytest.approx(20, abs=10)  # peaks count: above the ratio of the means
    alone = speech_snr_db(make_noise(noise, rate, rate, rng).astype(np.float32), rate)
    assert alone == pytest.approx(7, abs=2) and found[-1] == pytest.approx(alone, abs=2)


def test_the_ratio_does_not_depend_on_the_level() -> None:
    word = tone_word(next(iter(PERSONS.values())), 800.0, 1)
    assert speech_snr_db(0.01 * word, RATE_HZ) == pytest.approx(speech_snr_db(word, RATE_HZ), abs=1e-3)


def test_long_recordings_are_measured_in_parts_that_change_nothing() -> None:
    samples = tone_word(500.0, 800.0, 1)
    long = np.tile(samples, 60) + np.float32(0.03) * np.random.default_rng(0).standard_normal(60 * len(samples), "f4")
    tracemalloc.start()
    found = speech_snr_db(long, RATE_HZ)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    frames = np.lib.stride_tricks.sliding_window_view(long, 400)[::160] * np.hanning(400)
    power = np.square(np.abs(np.fft.rfft(frames, axis=1)))
    low, high = np.quantile(power @ quality._bands(400, RATE_HZ).T, (0.1, 0.9), axis=0)
    assert found == float((10 * np.log10(high / low)).mean()), "to the bit"
    assert peak < 1.5 * power.nbytes


@pytest.mark.parametrize(
    "samples", [np.zeros(0), np.zeros(100), np.zeros(16000), np.full(16000, np.nan), np.full(16000, np.inf)]
)
def test_what_has_no_ratio_has_none(samples: np.ndarray) -> None:
    assert speech_snr_db(samples.astype(np.float32), 16000) is None


def test_masks_that_show_no_hand_do_not_count() -> None:
    hands = [SimpleNamespace(quality=quality) for quality in (0.0, 0.6, 0.8)]
    assert mask_quality(hands) == pytest.approx(0.7)
    assert mask_quality(hands[:1]) is None and mask_quality([]) is None


def test_decisions_carry_the_quality_of_their_signal(words: Any, signs: Any) -> None:
    word = tone_word(next(iter(PERSONS.values())), 800.0, 1)
    noisy = mix_noise(word, make_noise("white", len(word), RATE_HZ, np.random.default_rng(0)), 0.0, RATE_HZ)
    clean = words.recognise(word, RATE_HZ)
    assert clean.quality == speech_snr_db(word, RATE_HZ) > words.recognise(noisy, RATE_HZ).quality
    (utterance,) = words.recognise_utterances(word, RATE_HZ)
    assert utterance.decision.quality is not None
    seen = signs.recognise(stills("flat", 3))
    assert 0.3 < seen.quality <= 1 and seen.to_dict()["quality"] == seen.quality


def test_a_stream_of_pictures_gives_the_quality_of_the_masks_it_saw(signs: Any) -> None:
    pictures = ClipSource(signing([("flat", 1.2)], 5.0), FPS)
    (event,) = [event for event in Watcher(signs).watch(pictures) if event.event == "decision"]
    assert event.decision.label == "flat" and 0.3 < event.decision.quality <= 1


def test_a_session_fuses_by_what_was_learned(words: Any, signs: Any, fusion: LearnedFusion) -> None:
    session = Session(words, signs, fusion=fusion)
    stream, frames = speech([("flat", 1.5), ("tall", 6.0)], 9.0), signing([("flat", 1.2)], 9.0)
    events = list(session.run(ArraySource(stream, RATE_HZ), ClipSource(frames, FPS)))
    both, alone = [event.fields for event in events if event.event == "fused"]
    assert both["rule"] == "learned logistic of both score vectors" and both["final"] == "flat"
    assert alone["rule"].startswith("speech alone") and alone["final"] == "tall"
    with pytest.raises(NotFittedError):
        Session(words, signs, fusion=LearnedFusion())


def test_a_recorded_session_needs_its_fusion(words: Any, signs: Any, fusion: LearnedFusion, tmp_path: Path) -> None:
    pytest.importorskip("mcap")
    stream, frames = speech([("flat", 1.5)], 5.0), signing([("flat", 1.2)], 5.0)
    session = Session(words, signs, fusion=fusion)
    recorder = McapRecorder(tmp_path / "learned.mcap")
    sources = ArraySource(stream, RATE_HZ), ClipSource(frames, FPS)
    before = [event.to_dict() for event in session.run(*sources, recorder=recorder)]
    recording = read_recording(tmp_path / "learned.mcap")
    after = [event.to_dict() for event in replay(recording, words, signs, fusion)]
    assert decisions(after) == decisions(before)
    assert any(str(row.get("rule")).startswith("learned logistic") for row in after)
    with pytest.raises(InvalidArgument, match="was recorded with a learned fusion, and needs it"):
        list(replay(recording, words, signs))


def test_the_command_line_takes_a_learned_fusion(
    hri: Any, words: Any, signs: Any, fusion: LearnedFusion, tmp_path: Path
) -> None:
    words.save(tmp_path / "words.hri")
    signs.save(tmp_path / "signs.hri")
    fusion.save(tmp_path / "fusion.hri")
    write_wav_pcm16(str(tmp_path / "said.wav"), speech([("flat", 0.5)], 2.0), RATE_HZ)
    write_image(tmp_path / "shown.png", stills("flat", 3)[0])
    models = ("--speech-model", tmp_path / "words.hri", "--gesture-model", tmp_path / "signs.hri")
    learned = ("--fusion", tmp_path / "fusion.hri")
    done = hri("recognise", *models, *learned, tmp_path / "said.wav", tmp_path / "shown.png")
    assert done.code == 0 and done.out.rstrip().endswith("learned logistic of both score vectors")
    assert done.out.startswith("flat\t")
    heard, seen = words.recognise(tmp_path / "said.wav"), signs.recognise(tmp_path / "shown.png")
    assert float(done.out.split("\t")[1]) == pytest.approx(fuse(heard, seen, rule=fusion).confidence, abs=1e-3)
    write_wav_pcm16(str(tmp_path / "scene.wav"), speech([("flat", 1.5)], 5.0), RATE_HZ)
    write_video(tmp_path / "scene.avi", signing([("flat", 1.2)], 5.0), FPS)
    scene = ("--backend", "none", "--json-lines", tmp_path / "scene.wav", tmp_path / "scene.avi")
    assert '"rule": "learned logistic' in hri("session", *models, *learned, *scene).out
    wrong = hri("recognise", *models, "--fusion", tmp_path / "words.hri", tmp_path / "said.wav", tmp_path / "shown.png")
    assert wrong.code != 0 and "the file holds 'word_recognizer', not 'learned_fusion'" in wrong.err
