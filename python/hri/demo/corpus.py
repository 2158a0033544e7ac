# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The demo's own recordings: synthetic voices and drawn signers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from hri.core.display import short_repr
from hri.datasets import Dataset
from hri.synthetic.signer import make_gesture_corpus
from hri.synthetic.speech import DIGIT_WORDS, make_speech_corpus

Progress = Callable[[str, int, int], None]

WORDS = {
    "en": {**DIGIT_WORDS["en"], "stop": "stop"},
    "hi": {**DIGIT_WORDS["hi"], "stop": "रुको"},
}
"""What is spoken: digits and "stop", in English and Hindi under common labels."""


@dataclass(frozen=True)
class CorpusSize:
    """How much is made.

    Many voices once each train better than few voices twice: a word of a voice never heard differs from those heard in
    throat and pitch, not from take to take.
    """

    num_speakers: int = 9
    num_signers: int = 14
    takes: int = 1


FULL = CorpusSize()
QUICK = CorpusSize(num_speakers=6, num_signers=4)
"""With fewer voices STOP of another one is not sure, and the last scene does not show that it wins."""


@dataclass(frozen=True)
@short_repr
class Corpus:
    """Spoken words and still signs, each of several made-up people."""

    spoken: Dataset
    signed: Dataset


def make_corpus(directory: Path, size: CorpusSize, seed: int, progress: Progress) -> Corpus:
    """Write both corpora below `directory`, each with a manifest that says it is synthetic."""
    return Corpus(
        make_speech_corpus(
            directory / "spoken",
            WORDS,
            num_speakers=size.num_speakers,
            takes=size.takes,
            seed=seed,
            progress=lambda done, total: progress("speaking words", done, total),
        ),
        make_gesture_corpus(
            directory / "signed",
            num_persons=size.num_signers,
            takes=1,
            seed=seed,
            progress=lambda done, total: progress("drawing signs", done, total),
        ),
    )
