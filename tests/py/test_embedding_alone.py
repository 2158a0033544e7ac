# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Words of synthetic voices, distinguished by the speech embedding alone."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import hri
from hri.core.errors import InvalidArgument
from hri.recognition import SpeechEmbedding
from hri.synthetic.speech import make_speaker, speak

pytestmark = pytest.mark.usefixtures("few_fillers")
WORDS = ["go", "left", "right", "stop"]
VOICES = range(1, 5)
STRANGERS = range(30, 34)


@pytest.fixture(scope="module", autouse=True)
def extra() -> None:
    pytest.importorskip("livekit.wakeword")


@pytest.fixture(scope="module")
def words() -> hri.WordRecognizer:
    said = [(speak(word, "en", make_speaker(voice)), word, str(voice)) for voice in VOICES for word in WORDS]
    x, y, speakers = map(list, zip(*said, strict=True))
    return hri.WordRecognizer(front_end="embedding").fit(x, y, groups=speakers)


def test_strangers_are_understood(words: hri.WordRecognizer) -> None:
    said = [(speak(word, "en", make_speaker(voice)), word) for voice in STRANGERS for word in WORDS]
    x, y = map(list, zip(*said, strict=True))
    assert words.score(x, y) >= 15 / 16
    decisions = words.decide(x)
    assert sum(decision.label == word for decision, word in zip(decisions, y, strict=True)) >= 12
    assert np.allclose(words.predict_proba(x).sum(axis=1), 1)
    held_out = words.held_out
    assert held_out is not None and list(held_out.labels) == WORDS


def test_most_words_outside_the_vocabulary_are_unknown(words: hri.WordRecognizer) -> None:
    others = [speak(word, "en", make_speaker(voice)) for voice in STRANGERS for word in ("seven", "window", "table")]
    decisions = words.decide(others)
    assert sum(decision.status == "unknown" for decision in decisions) >= 9
    noise = 0.05 * np.random.default_rng(3).standard_normal(16000)
    assert words.recognise(noise.astype(np.float32), 16000).status in ("unknown", "no_input")


def test_a_model_file_without_cepstra_has_no_streams(words: hri.WordRecognizer, tmp_path: Path) -> None:
    words.save(tmp_path / "words.hri")
    file = hri.io.ModelFile.read(str(tmp_path / "words.hri"))
    assert file.has("vectors.means")
    assert not any(name.startswith("stream.") for name in file.metadata())
    assert hri.load(tmp_path / "words.hri", "speech", embedding=SpeechEmbedding()).options.front_end == "embedding"


def test_other_recognisers_want_cepstra() -> None:
    with pytest.raises(InvalidArgument, match=r"words\.front_end must be cepstra"):
        hri.ConnectedWordRecognizer(words={"front_end": "embedding"}).fit([], [])
