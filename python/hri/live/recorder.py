# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Recording of a data set of words: prompts for one word after the other and keeps each utterance."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import closing

import numpy as np

from hri.io import write_wav_pcm16
from hri.live import events
from hri.live.events import Event
from hri.live.sources import AudioSource
from hri.live.takes import Takes
from hri.live.utterances import Samples, UtteranceFinder
from hri.recognition import WordRecognizerOptions
from hri.signal import EndpointerOptions

PATTERN = "{label}/{person}_{take}.wav"
CLIPPED = 0.999
"""Share of full scale from which a sample counts as clipped."""
MAX_CLIPPED = 3
"""Clipped samples that an utterance may have."""


class WordRecorder:
    """Records words, label by label, into a data set that `hri.Dataset.load` reads.

    Prompts go through all labels once per take, since repetitions in a row sound alike. Existing recordings are kept
    and not prompted for: a recorder of the same folder, person and labels resumes where the last one stopped, and
    records deleted files anew.

    Parameters
    ----------
    folder, labels, person, takes
        Where to, which words by whom, and how many recordings of each; errors as of `Takes`.
    options : EndpointerOptions, optional
        When a word begins and ends; by default as `Listener` has it for a recogniser's default options.
    level_interval_s : float
        Interval between level events.
    """

    def __init__(
        self,
        folder: str | os.PathLike[str],
        labels: Sequence[str],
        person: str,
        takes: int = 5,
        options: EndpointerOptions | None = None,
        *,
        level_interval_s: float = 0.1,
    ) -> None:
        self._takes = Takes(folder, labels, person, takes, "speech", PATTERN)
        chosen = options or EndpointerOptions(activity=WordRecognizerOptions().activity)
        self._finder = UtteranceFinder(chosen, level_interval_s)

    @property
    def num_takes(self) -> int:
        """Recordings wanted in all."""
        return len(self._takes)

    def missing(self) -> list[tuple[str, int]]:
        """Label and take of every missing recording, in the order of the prompts."""
        return self._takes.missing()

    def record(self, source: AudioSource) -> Iterator[Event]:
        """Ask, listen and keep until nothing is missing or the source ends, which is closed then.

        Beside the events of a listener, "prompt" names the next word, "recorded" the file it was written to, and
        "refused" the reason why it was not; then the prompt comes again.

        Raises
        ------
        Stalled
            When the source gives no more samples.
        IoError
            When a recording cannot be written, or the file exists by then.
        """
        missing = self.missing()
        if not missing:
            source.close()
            return
        self._takes.begin()
        num_lost = source.num_lost
        with closing(self._finder.process(source, folder=str(self._takes.folder))) as results:
            for event, utterance in results:
                yield event
                if event.event == events.LISTENING:
                    yield self._takes.prompt(0.0, missing)
                if utterance is None:
                    continue
                lost, num_lost = source.num_lost - num_lost, source.num_lost
                reason = _fault(utterance, bool(event.fields["cut"]), lost)
                metadata = {"label": missing[0][0], "take": missing[0][1]}
                if reason:
                    yield Event(event.time, events.REFUSED, {**metadata, "reason": reason})
                else:
                    path = self._takes.keep(
                        *missing.pop(0),
                        lambda part, samples=utterance: write_wav_pcm16(  # type: ignore[misc]
                            str(part), samples, source.sample_rate_hz
                        ),
                    )
                    measured = {
                        "duration_s": round(len(utterance) / source.sample_rate_hz, 4),
                        "peak_db": round(20 * float(np.log10(max(1e-6, np.abs(utterance).max()))), 1),
                    }
                    yield Event(event.time, events.RECORDED, {**metadata, "path": str(path), **measured})
                if not missing:
                    return
                yield self._takes.prompt(event.time, missing)


def _fault(utterance: Samples, cut: bool, num_lost: int) -> str:
    """Why a recording is refused; "" if it is not."""
    if cut:
        return "too long for a word"
    if num_lost:
        return f"{num_lost} samples were lost: this computer is too busy"
    if int((np.abs(utterance) >= CLIPPED).sum()) > MAX_CLIPPED:
        return "too loud: speak farther away or turn the microphone down"
    return ""
