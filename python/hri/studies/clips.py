# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Spoken words in memory, for studies that divide them in ways of their own."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from hri.media import read_audio
from hri.media.audio import Audio
from hri.recognition import WordRecognizer
from hri.studies.registry import Progress
from hri.studies.word_features import load_words

Clip = tuple[str, str, Audio]
"""Label, speaker, sound."""


def read_clips(data_dir: Path, name: str, progress: Progress, takes: int | None = None) -> list[Clip]:
    """Every recording of `load_words`."""
    dataset = load_words(data_dir, name, takes)
    clips = []
    for done, sample in enumerate(dataset.samples):
        clips.append((sample.label, sample.person, read_audio(sample.path)))
        progress("reading", done + 1, len(dataset))
    return clips


def fit_clips(clips: Sequence[Clip], model: Any) -> WordRecognizer:
    """A recogniser with models of the kind `model` and the defaults otherwise."""
    return WordRecognizer(model=model).fit(
        [sound.samples for _, _, sound in clips],
        [label for label, _, _ in clips],
        sample_rate_hz=[sound.sample_rate_hz for _, _, sound in clips],
        groups=[person for _, person, _ in clips],
    )
