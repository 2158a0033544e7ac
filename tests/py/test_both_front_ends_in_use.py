# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Words by a speech embedding in use, beside cepstra and alone: streams, speakers, new words, silence, rates, files."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import hri
from conftest import PERSONS, RATE_HZ, tone_word
from hri.core.errors import FormatError, InvalidArgument
from hri.live import ArraySource, Listener
from hri.recognition import SpeechEmbedding, embedding_weights
from hri.signal import resample

pytestmark = pytest.mark.usefixtures("few_fillers")
SLOPES = {"1": 800.0, "2": -350.0}
SILENCE = np.zeros(RATE_HZ, np.float32)
OTHER_RATES_HZ = [8000, 48000]


@pytest.fixture(scope="module", autouse=True)
def extra() -> None:
    pytest.importorskip("livekit.wakeword")


@pytest.fixture(scope="module", params=["both", "embedding"])
def words(request: pytest.FixtureRequest) -> hri.WordRecognizer:
    rows = [
        (tone_word(base_hz, slope, 7 * take + number), label, person)
        for number, (person, base_hz) in enumerate(PERSONS.items())
        for take in range(3)
        for label, slope in SLOPES.items()
    ]
    x, y, persons = map(list, zip(*rows, strict=True))
    made = hri.WordRecognizer(front_end=request.param, max_iterations=4, embedding_false_accept_rate=1.0)
    return made.fit(x, y, sample_rate_hz=RATE_HZ, groups=persons)


def at_rate(clip: NDArray[np.float32], rate_hz: int) -> NDArray[np.float32]:
    return np.asarray(resample(clip, RATE_HZ, rate_hz))


@pytest.mark.parametrize("rate_hz", [RATE_HZ, *OTHER_RATES_HZ])
def test_a_stream_gives_the_decisions_of_its_words(words: hri.WordRecognizer, rate_hz: int) -> None:
    labels = ["1", "2", "2", "1"]
    rng = np.random.default_rng(5)
    parts = []
    for number, label in enumerate(labels):
        parts += [0.001 * rng.standard_normal(RATE_HZ // 2).astype("f4"), tone_word(600.0, SLOPES[label], 50 + number)]
    stream = at_rate(np.concatenate(parts), rate_hz)
    events = list(Listener(words).listen(ArraySource(stream, rate_hz)))
    decided = [event.decision for event in events if event.decision is not None]
    assert [decision.nbest[0].label for decision in decided] == labels
    whole = words.recognise_utterances(stream, rate_hz)
    assert [utterance.decision for utterance in whole] == decided, "a file is decided on as a stream is"


def test_a_stream_of_digital_silence_has_no_word(words: hri.WordRecognizer) -> None:
    events = list(Listener(words).listen(ArraySource(np.zeros(3 * RATE_HZ, np.float32), RATE_HZ)))
    assert [event for event in events if event.decision is not None] == []


def adapter_of(words: hri.WordRecognizer, rate_hz: int) -> hri.SpeakerAdapter:
    """After three words each of a speaker of a higher voice, at another rate."""
    adapter = hri.SpeakerAdapter(words, words_per_label=0)
    for seed in range(3):
        for label, slope in SLOPES.items():
            adapter.learn(at_rate(tone_word(1100.0, slope, seed), rate_hz), label, rate_hz)
    adapter.update()
    return adapter


@pytest.mark.parametrize("rate_hz", OTHER_RATES_HZ)
def test_a_speaker_is_adapted_to_at_other_rates(words: hri.WordRecognizer, rate_hz: int) -> None:
    adapter = adapter_of(words, rate_hz)
    assert adapter.num_learned == 6
    margins = []  # before and after, of either word
    for label, slope in SLOPES.items():
        heard = at_rate(tone_word(1100.0, slope, 9), rate_hz)
        right, wrong = (0, 1) if label == "1" else (1, 0)
        margins.append([s[right] - s[wrong] for s in (r.scores(heard, rate_hz) for r in (words, adapter.recognizer))])
        if words.options.front_end == "both":
            assert adapter.recognise(heard, rate_hz).nbest[0].label == label
            assert margins[-1][1] > margins[-1][0]
    # Vectors all move alike: what one word wins the other gives, and tones so high are far from those of training.
    least_before, least_after = np.min(margins, axis=0)
    assert least_after > least_before


def test_silence_is_not_learned_from(words: hri.WordRecognizer) -> None:
    adapter = hri.SpeakerAdapter(words)
    with pytest.raises(InvalidArgument, match="no speech"):
        adapter.learn(SILENCE, "1", RATE_HZ)
    assert adapter.recognise(SILENCE, RATE_HZ).status == "no_input"
    assert adapter.num_words == 0 and not adapter.update_due
    clip = tone_word(540.0, 700.0, 99)
    assert adapter.recognise(clip, RATE_HZ, update=False) == words.recognise(clip, RATE_HZ)


@pytest.mark.parametrize("rate_hz", OTHER_RATES_HZ)
def test_a_word_is_added_from_clips_of_other_rates(words: hri.WordRecognizer, rate_hz: int) -> None:
    more = pickle.loads(pickle.dumps(words))
    clips = [at_rate(tone_word(700.0, 0.0, seed), rate_hz) for seed in range(3)]
    more.add_word("flat", clips, rate_hz)
    for heard_hz in (RATE_HZ, *OTHER_RATES_HZ):
        heard = at_rate(tone_word(700.0, 0.0, 9), heard_hz)
        assert more.recognise(heard, heard_hz).nbest[0].label == "flat"


def test_silence_makes_no_word(words: hri.WordRecognizer) -> None:
    more = pickle.loads(pickle.dumps(words))
    with pytest.raises(InvalidArgument, match=r"clips\[1\]: audio has no speech"):
        more.add_word("flat", [tone_word(700.0, 0.0, 0), SILENCE], RATE_HZ)
    assert list(more.classes_) == list(SLOPES)
    clip = tone_word(540.0, 700.0, 99)
    assert more.recognise(clip, RATE_HZ) == words.recognise(clip, RATE_HZ)


def test_truncated_files_are_refused_by_name(words: hri.WordRecognizer, tmp_path: Path) -> None:
    model, weights = tmp_path / "words.hri", embedding_weights().read_bytes()
    words.save(model)
    for share in (0.0, 0.1, 0.5, 0.99):
        path = tmp_path / "cut.onnx"
        path.write_bytes(weights[: int(share * len(weights))])
        with pytest.raises(FormatError, match=r"cut\.onnx"):
            hri.WordRecognizer.load(model, embedding=SpeechEmbedding(path))
    whole = model.read_bytes()
    for share in (0.0, 0.1, 0.5, 0.99):
        model.write_bytes(whole[: int(share * len(whole))])
        with pytest.raises(FormatError, match=r"words\.hri"):
            hri.WordRecognizer.load(model, embedding=SpeechEmbedding())
