# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Recognised words, models and states as labels, as HVite's ``-o``, ``-m`` and ``-f`` want them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import click

from hri.htk import AlignedModel, AlignedState, Label, RecognisedSentence, RecognisedWord

LETTERS = "NSTWMX"
_Timed = RecognisedWord | AlignedModel | AlignedState


@dataclass(frozen=True)
class _Times:
    """Of frames, in 100 ns."""

    begin: int
    period: int

    def of(self, frame: int) -> int:
        return self.begin + frame * self.period


@dataclass(frozen=True)
class LabelFormat:
    """What labels hold.

    Attributes
    ----------
    letters : str
        HTK's: N scores a frame, S no scores, T no times, W no words, M no models, X models without their contexts.
    models, states : bool
        Whether there is a label for every model, or for every state.
    """

    letters: str
    models: bool
    states: bool

    def __post_init__(self) -> None:
        if set(self.letters) - set(LETTERS):
            raise click.UsageError(f"-o takes letters of {LETTERS}, not C: times are those of the edges of frames")

    @property
    def is_aligned(self) -> bool:
        """Whether the alignment of words is needed."""
        return self.models or self.states

    def labels(
        self,
        sentence: RecognisedSentence,
        aligned: Sequence[Sequence[AlignedModel]],
        names: Sequence[Sequence[str]],
        period: int,
        begin: int = 0,
    ) -> list[Label]:
        """Labels of a sentence.

        Parameters
        ----------
        sentence : RecognisedSentence
        aligned : list of list of AlignedModel
            Of every word, where labels of models or states are wanted.
        names : list of list of str
            Of these models, as the dictionary has them.
        period : int
            Of frames, in 100 ns.
        begin : int
            Of the first frame, in 100 ns.
        """
        times = _Times(begin, period)
        if not self.is_aligned:
            return [self._label(word.output, word, times) for word in sentence.words if word.output]
        made: list[Label] = []
        for word, models, of_models in zip(sentence.words, aligned, names, strict=True):
            others = [] if "W" in self.letters else [(word.word, self._score(word))]
            for model, name in zip(models, of_models, strict=True):
                made += self._of_model(model, strip_contexts(name) if "X" in self.letters else name, others, times)
                # The word stands beside its first model.
                others = [] if made else others
        return made

    def _of_model(
        self, model: AlignedModel, name: str, others: list[tuple[str, float | None]], times: _Times
    ) -> list[Label]:
        if not self.states:
            return [self._label(name, model, times, others)]
        made = []
        with_name = self.models and "M" not in self.letters
        for state in model.states:
            above = [(name, self._score(model))] if with_name and state is model.states[0] else []
            text = f"s{state.state}" if self.models else f"{name}[{state.state}]"
            made.append(self._label(text, state, times, [*above, *others]))
            others = []
        return made

    def _score(self, one: _Timed) -> float | None:
        if "S" in self.letters:
            return None
        frames = one.last_frame - one.first_frame
        return round(one.log_score / frames if "N" in self.letters and frames else one.log_score, 6)

    def _label(
        self, name: str, one: _Timed, times: _Times, others: list[tuple[str, float | None]] | None = None
    ) -> Label:
        timed = "T" not in self.letters
        first = times.of(one.first_frame) if timed else None
        last = times.of(one.last_frame) if timed else None
        return Label(name, first, last, self._score(one), others or [])


def strip_contexts(name: str) -> str:
    """A model without its contexts: a-b+c is b."""
    return name.rpartition("-")[2].partition("+")[0] or name
