# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Frames to sentences and their labels, and the files that these go to, for recordings and live sound alike."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

import click
import numpy as np
from numpy.typing import NDArray

from hri.cli.htk.data import DataFile
from hri.cli.htk.formatting import LabelFormat
from hri.cli.htk.vocabulary import Vocabulary
from hri.core.files import make_folder
from hri.htk import MasterLabelFile, RecognisedSentence, Recognizer, Transcription, WordLattice
from hri.language import LatticeOptions

LATTICE_BEAMS = (1000.0, 4000.0, 16000.0, 64000.0)
"""The next one where sentences are too few."""
UNITS_PER_S = 10_000_000
"""Of times in HTK's files."""


@dataclass(frozen=True)
class Found:
    """What was recognised.

    Attributes
    ----------
    sentences : list of RecognisedSentence
        The best first, one at least.
    num_frames : int
    transcription : Transcription
        Their labels.
    """

    sentences: list[RecognisedSentence]
    num_frames: int
    transcription: Transcription

    @property
    def words(self) -> list[str]:
        """What is printed of the best sentence."""
        return [word.output for word in self.sentences[0].words if word.output]

    @property
    def log_score(self) -> float:
        """Of the best sentence, a frame."""
        return self.sentences[0].log_score / self.num_frames

    @property
    def line(self) -> str:
        """As HVite prints it."""
        return f"{' '.join(self.words)}  ==  [{self.num_frames} frames] {self.log_score:.4f}"


class ResultFiles:
    """Label files or one master label file, and where lattices go.

    Parameters
    ----------
    folder : str or None
        None: where the recording is.
    suffix : str
        Of label files.
    master : str or None
        The master label file, which is written at the end; None: label files.
    lattice_suffix : str or None
    """

    def __init__(self, folder: str | None, suffix: str, master: str | None, lattice_suffix: str | None) -> None:
        self._folder = folder
        self._suffix = suffix
        self._master = master
        self._lattice_suffix = lattice_suffix
        self._entries: list[tuple[str, Transcription]] = []

    def require_apart(self, recordings: Iterable[DataFile]) -> None:
        """Refuse results that would be written over a recording, or over those of another one.

        Raises
        ------
        click.UsageError
        """
        recordings = list(recordings)
        read = {os.path.realpath(file.path) for file in recordings}
        written: dict[str, str] = {}
        for file in recordings:
            labels = self._label_path(file.name) if self._master is None else None
            for path in (labels, self.lattice_path(file.name)):
                if path is None:
                    continue
                place = os.path.realpath(path)
                if place in read:
                    raise click.UsageError(f"{path} is a recording, and would be written over by results")
                if place in written:
                    raise click.UsageError(f"{path} would hold results of {written[place]}, and then of {file.name}")
                written[place] = file.name

    def lattice_path(self, recording: str) -> Path | None:
        """Of the lattice of a recording, where there is one to write."""
        if self._lattice_suffix is None:
            return None
        return self._label_path(recording).with_suffix(f".{self._lattice_suffix}")

    def add(self, recording: str, transcription: Transcription) -> None:
        """Write the label file of a recording, or keep its labels for the master label file."""
        target = self._label_path(recording)
        if self._master is None:
            make_folder(target.parent)
            transcription.write(target)
        else:
            self._entries.append((str(target), transcription))

    def finish(self) -> None:
        """Write the master label file."""
        if self._master is not None:
            make_folder(Path(self._master).parent)
            MasterLabelFile(self._entries).write(self._master)

    def _label_path(self, recording: str) -> Path:
        path = Path(recording).with_suffix(f".{self._suffix}")
        return path if self._folder is None else Path(self._folder, path.name)


@dataclass(frozen=True)
class SentenceFinder:
    """The best sentences for frames, and their labels.

    Attributes
    ----------
    vocabulary : Vocabulary
        Of which the dictionary of the recognisers was selected.
    form : LabelFormat
    num_sentences : int
        0: the best one, without a lattice.
    """

    vocabulary: Vocabulary
    form: LabelFormat
    num_sentences: int

    def find(
        self,
        recognizers: Iterable[Recognizer],
        frames: NDArray[np.float32],
        period: int,
        lattice_path: Path | None = None,
        begin: int = 0,
    ) -> Found | None:
        """Sentences by the first of the recognisers, whose beams grow, that finds any; None where none does.

        Parameters
        ----------
        recognizers : iterable of Recognizer
            One at least.
        frames : float32 array, shape (num_frames, num_columns)
        period : int
            Of frames, in 100 ns.
        lattice_path : path or None
            Where the lattice goes.
        begin : int
            Of the first frame, in 100 ns: times of labels and lattices count from there.
        """
        sentences: list[RecognisedSentence] = []
        for recognizer in recognizers:
            sentences = self._recognised(recognizer, frames, period, lattice_path, begin)
            if sentences:
                break
        if not sentences:
            return None
        all_labels = []
        for one in sentences:
            aligned = recognizer.align(frames, one) if self.form.is_aligned else []
            names = [self.vocabulary.logical(word.pronunciation) for word in one.words]
            all_labels.append(self.form.labels(one, aligned, names, period, begin))
        first, *others = all_labels
        return Found(sentences, len(frames), Transcription(first, others))

    def _recognised(
        self,
        recognizer: Recognizer,
        frames: NDArray[np.float32],
        period: int,
        lattice_path: Path | None,
        begin: int,
    ) -> list[RecognisedSentence]:
        """The best sentences; none where none is complete."""
        if self.num_sentences == 0:
            sentence = recognizer.recognise(frames)
            return [sentence] if sentence.complete else []
        for beam in LATTICE_BEAMS:
            lattice = recognizer.lattice(frames, LatticeOptions(beam=beam))
            found = recognizer.n_best(lattice, self.num_sentences)
            if len(found) >= self.num_sentences:
                break
        if lattice_path is not None and not lattice.empty:
            make_folder(lattice_path.parent)
            weighed = (recognizer.options.language_scale, recognizer.options.insertion_penalty)
            times = (begin / UNITS_PER_S, period / UNITS_PER_S)
            WordLattice.of_lattice(lattice, recognizer.words, *times, *weighed).write(lattice_path)
        return found


Find = Callable[[NDArray[np.float32], int, Path | None, int], Found | None]
"""`SentenceFinder.find` by the recognisers of one network."""
