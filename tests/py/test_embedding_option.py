# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Weights of the speech embedding that a user names: on the command line, in `hri.load`, and in copies."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable
from pathlib import Path

import pytest

import hri as package
from conftest import PERSONS, RATE_HZ, CommandResult, tone_word
from hri.core.errors import FormatError, InvalidArgument
from hri.io import write_wav_pcm16
from hri.recognition import SpeechEmbedding, embedding_weights
from hri.recognition.word import embedding as module

pytestmark = pytest.mark.usefixtures("few_fillers")
SLOPES = {"1": 800.0, "2": -350.0, "3": 100.0}
Command = Callable[..., CommandResult]
FEWER = {"max_iterations": 2, "num_vtlp_factors": 1, "num_noisy_copies": 0, "num_embedding_copies": 0}
QUICK = [word for name, value in FEWER.items() for word in ("--option", f"{name}={value}")]


@pytest.fixture(scope="module", autouse=True)
def extra() -> None:
    pytest.importorskip("livekit.wakeword")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A model of three words, a recording of one, the right weights, others, and half of them."""
    place = tmp_path_factory.mktemp("embedding")
    rows = [
        (tone_word(base_hz, slope, 7 * take + number), label, person)
        for number, (person, base_hz) in enumerate(PERSONS.items())
        for take in range(2)
        for label, slope in SLOPES.items()
    ]
    x, y, persons = map(list, zip(*rows, strict=True))
    made = package.WordRecognizer(front_end="both", max_iterations=3, num_embedding_copies=1)
    made.fit(x, y, sample_rate_hz=RATE_HZ, groups=persons).save(place / "words.hri")
    plain = package.WordRecognizer(max_iterations=3)
    plain.fit(x, y, sample_rate_hz=RATE_HZ, groups=persons).save(place / "plain.hri")
    write_wav_pcm16(str(place / "one.wav"), tone_word(540.0, 700.0, 99), RATE_HZ)
    weights = bytearray(embedding_weights().read_bytes())
    (place / "right.onnx").write_bytes(weights)
    (place / "cut.onnx").write_bytes(weights[: len(weights) // 2])
    weights[len(weights) // 2] ^= 1
    (place / "other.onnx").write_bytes(weights)
    return place


@pytest.fixture
def no_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "PACKAGE", "livekit.nowhere")


USES = {
    "recognise": ("one.wav", "--speech-model", "words.hri"),
    "listen": ("one.wav", "--model", "words.hri"),
    "session": ("one.wav", "--speech-model", "words.hri", "--no-gesture", "--backend", "none"),
    "serve": ("--speech-model", "words.hri", "--no-gesture", "--backend", "none", "--port", "0"),
    "adapt": ("one.wav", "--model", "words.hri", "--label", "1", "-o", "OUT"),
    "add-word": ("one.wav", "--model", "words.hri", "--label", "new", "-o", "OUT"),
    "remove-word": ("--model", "words.hri", "--label", "3", "-o", "OUT"),
    "info": ("words.hri",),
}


def arguments_of(command: str, folder: Path, out: Path) -> list[object]:
    places = {name: folder / name for name in ("one.wav", "words.hri")} | {"OUT": out}
    return [command, *(places.get(word, word) for word in USES[command])]


@pytest.mark.parametrize("command", USES)
def test_commands_that_load_a_model_take_weights(
    hri: Command, folder: Path, tmp_path: Path, no_extra: None, monkeypatch: pytest.MonkeyPatch, command: str
) -> None:
    monkeypatch.setattr("hri.serve.server.PageServer.run", lambda self: None)
    out = tmp_path / "out.hri"
    arguments = arguments_of(command, folder, out)
    missing = hri(*arguments)
    assert (missing.code, missing.out) == (3, "") and missing.err.count("\n") == 1
    assert "libhri[embedding]" in missing.err and "--embedding FILE" in missing.err
    other = hri(*arguments, "--embedding", folder / "other.onnx")
    assert (
        other.code == 3 and "words.hri" in other.err and "trained with a speech embedding of the weights" in other.err
    )
    cut = hri(*arguments, "--embedding", folder / "cut.onnx")
    assert cut.code == 3 and "cut.onnx" in cut.err and cut.err.count("\n") == 1
    assert not out.exists()
    right = hri(*arguments, "--embedding", folder / "right.onnx")
    assert right.code == 0, right.err
    if "OUT" in USES[command]:
        assert package.load(out, embedding=SpeechEmbedding(folder / "right.onnx")).options.front_end == "both"


@pytest.mark.parametrize("command", ["train", "evaluate"])
def test_commands_that_train_take_weights(
    hri: Command, folder: Path, spoken: Path, tmp_path: Path, no_extra: None, command: str
) -> None:
    out = tmp_path / "out.hri"
    arguments: list[object] = [command, "speech", "--data", spoken, *QUICK]
    arguments += ["--out", out, "--no-fillers"] if command == "train" else []
    missing = hri(*arguments, "--option", "front_end=both")
    assert (missing.code, missing.out) == (3, "") and "libhri[embedding]" in missing.err, missing.err
    cut = hri(*arguments, "--embedding", folder / "cut.onnx")
    assert (cut.code, cut.out) == (3, "") and "cut.onnx" in cut.err, cut.err
    wrong = hri(*arguments, "--embedding", folder / "right.onnx", "--option", "front_end=cepstra")
    assert wrong.code == 2 and "--embedding" in wrong.err
    assert hri(command, "gesture", "--data", spoken, "--embedding", folder / "right.onnx").code == 2
    alone = hri(*arguments, "--embedding", folder / "right.onnx", "--option", "front_end=embedding")
    assert alone.code == 0, alone.err
    if command == "train":
        assert package.load(out, embedding=SpeechEmbedding(folder / "right.onnx")).options.front_end == "embedding"
    done = hri(*arguments, "--embedding", folder / "other.onnx")
    assert done.code == 0, done.err
    if command == "train":
        assert package.load(out, embedding=SpeechEmbedding(folder / "other.onnx")).options.front_end == "both"
        with pytest.raises(FormatError, match="trained with a speech embedding of the weights"):
            package.load(out, embedding=SpeechEmbedding(folder / "right.onnx"))


def test_weights_without_effect_are_refused(hri: Command, folder: Path) -> None:
    named = ("--embedding", folder / "right.onnx")
    plain = ("--speech-model", folder / "plain.hri")
    loaded = hri("recognise", folder / "one.wav", *plain, *named)
    assert loaded.code == 3 and "plain.hri: front_end='cepstra' takes no speech embedding" in loaded.err
    for arguments in (
        ("recognise", "--gesture", folder / "one.wav", *named),
        ("session", "--no-speech", *named),
        ("info", *named),
    ):
        refused = hri(*arguments)
        assert refused.code == 2 and "--embedding" in refused.err, arguments


def test_loaded_and_copied_models_keep_the_weights_they_were_given(folder: Path, no_extra: None) -> None:
    given = SpeechEmbedding(folder / "right.onnx")
    words = package.load(folder / "words.hri", "speech", embedding=given)
    assert isinstance(words, package.WordRecognizer)
    clip = tone_word(540.0, 700.0, 98)
    adapter = package.SpeakerAdapter(words)
    adapter.learn(clip, "1", RATE_HZ)
    adapter.update()
    for one in (words, adapter.recognizer):
        for again in (copy.copy(one), copy.deepcopy(one), pickle.loads(pickle.dumps(one))):
            assert again.recognise(clip, RATE_HZ) == one.recognise(clip, RATE_HZ)
    more = copy.copy(words).add_word("flat", [tone_word(700.0, -900.0, seed) for seed in range(2)], RATE_HZ)
    assert copy.copy(more).recognise(tone_word(700.0, -900.0, 9), RATE_HZ).nbest[0].label == "flat"
    with pytest.raises(ImportError, match=r"libhri\[embedding\]"):
        package.load(folder / "words.hri")


def test_an_embedding_where_none_is_taken_is_a_mistake(folder: Path, signed: Path, tmp_path: Path) -> None:
    given = SpeechEmbedding(folder / "right.onnx")
    for load in (package.load, package.WordRecognizer.load):
        with pytest.raises(InvalidArgument, match=r"plain\.hri: front_end='cepstra' takes no speech embedding"):
            load(folder / "plain.hri", embedding=given)
    signs = package.train(signed)
    signs.save(tmp_path / "signs.hri")
    with pytest.raises(InvalidArgument, match=r"signs\.hri takes no speech embedding"):
        package.load(tmp_path / "signs.hri", embedding=given)
    for run in (package.train, package.cross_validate):
        with pytest.raises(InvalidArgument, match="embedding is for speech"):
            run(package.Dataset.load(signed), package.GestureRecognizer(), embedding=given)
    words = package.load(folder / "words.hri")
    with pytest.raises(FormatError, match="an embedding or None"):
        words.__setstate__({**words.__getstate__(), "embedding": "right.onnx"})
