# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Connected words from a stream, with what is found so far on the way."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from hri import _native
from hri.recognition.sentence.transcript import Transcript, transcript_of

if TYPE_CHECKING:
    from hri.recognition.sentence.recognizer import ConnectedWordRecognizer


@dataclass(frozen=True)
class UtteranceResult:
    """What was found in an utterance, so far or in the end.

    Attributes
    ----------
    transcript : Transcript
        Times from the beginning of the stream; before the end without confidences.
    num_stable : int
        So many of the first words are on every path of the search, and were so the last time: they are kept until the
        end, where the whole utterance may still correct them.
    is_final : bool
        Whether the utterance has ended.
    first_s, last_s : float
        Where it lies in the stream, so far.
    """

    transcript: Transcript
    num_stable: int
    is_final: bool
    first_s: float
    last_s: float


class ConnectedWordStream:
    """Recognise a stream utterance by utterance; memory is bounded by the longest utterance.

    Parameters
    ----------
    recognizer : ConnectedWordRecognizer
        Fitted.
    sample_rate_hz : int
    wake_word : str
        A label: only what is said behind it in an utterance counts. Empty: everything does.
    **options
        Fields of ``hri.ConnectedWordStreamOptions``.

    Raises
    ------
    InvalidArgument
        For options and a rate out of range, and a wake word that is no label.
    """

    def __init__(
        self, recognizer: ConnectedWordRecognizer, sample_rate_hz: int, *, wake_word: str = "", **options: Any
    ) -> None:
        self.options = _native.ConnectedWordStreamOptions(**options)
        self._native = _native.ConnectedWordStream(recognizer._trained, sample_rate_hz, self.options, wake_word)

    def process(self, samples: NDArray[np.float32]) -> list[UtteranceResult]:
        """Results up to the end of `samples`, in their order; blocks may have any size.

        Raises InvalidArgument for a sample that is not finite, by its number in the stream.
        """
        return [_result_of(found) for found in self._native.process(samples)]

    def finish(self) -> list[UtteranceResult]:
        """The stream has ended: what is left. Then the next one may begin."""
        return [_result_of(found) for found in self._native.finish()]


def _result_of(found: _native.ConnectedWordResult) -> UtteranceResult:
    return UtteranceResult(
        transcript_of(found.transcript), found.num_stable, found.is_final, found.first_s, found.last_s
    )
