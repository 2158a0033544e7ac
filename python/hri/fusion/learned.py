# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Fusion that learns from held-out decisions how far to trust which mode (thesis sections 6.3 and 7.2)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hri.core.errors import FormatError, InvalidArgument, naming_model_file
from hri.core.estimator import not_fitted
from hri.core.suggest import did_you_mean
from hri.fusion import vectors
from hri.fusion.anfis import Anfis
from hri.fusion.fuse import fuse
from hri.fusion.logistic import LogisticStacking
from hri.fusion.network import Network
from hri.fusion.options import FusedDecision, FusionOptions
from hri.fusion.reliability import Reliability
from hri.fusion.tree import DecisionTree
from hri.io import ModelFile
from hri.recognition.decision import UNKNOWN, Decision

if TYPE_CHECKING:
    from typing import Self

Matrix = NDArray[np.float64]

MODES = ("speech", "gesture")
FILE_KIND = "learned_fusion"
_WEIGHED = ("product", "dempster_shafer")
_LEARNERS: dict[str, type[Any]] = {one.kind: one for one in (LogisticStacking, DecisionTree, Network, Anfis)}
KINDS = (*_WEIGHED, *_LEARNERS)
NUM_INPUTS = 4
"""Of a class: its margin in speech and in gesture, and the reliability of each."""
_FLOOR = 1e-4
_TIES = 1e-3
"""Share of the product in what a learner says: of classes that it scores alike, as a tree does, the product decides."""


class _Learner(Protocol):
    def scores(self, rows: Matrix) -> Matrix: ...
    def write(self, file: ModelFile, prefix: str) -> None: ...


class LearnedFusion:
    """Fuses the whole score vectors of both modes, as held-out decisions have shown to be right.

    The quality of each mode's signal (`Decision.quality`), and whether the mode rejected it, become a reliability: the
    probability that the mode's best class is right. "product" raises the probabilities of each mode to its reliability,
    "dempster_shafer" discounts them by it; the others learn how likely every class c is from its margin in each mode
    (log probability less that of the best other class) and the reliabilities, the same function for all classes: the
    vocabulary may grow afterwards.

    STOP, a missing mode and two rejected modes are decided as by `hri.fuse`.

    Parameters
    ----------
    kind : {"product", "dempster_shafer", "logistic", "tree", "network", "anfis"}
    seed : int
        Where "network" starts; the others have nothing random.

    Raises
    ------
    InvalidArgument
        For an unknown kind.
    """

    def __init__(self, kind: str = "logistic", seed: int = 0) -> None:
        if kind not in KINDS:
            raise InvalidArgument(f"no kind of learned fusion {kind!r}; {did_you_mean(str(kind), KINDS)}")
        self.kind = kind
        self.seed = seed
        self._reliability: dict[str, Reliability] = {}
        self._learner: _Learner | None = None

    def __repr__(self) -> str:
        return f"LearnedFusion({self.kind!r}{'' if self._reliability else ', not trained'})"

    @property
    def reliability_(self) -> dict[str, Reliability]:
        """How the quality of each mode's signal becomes a reliability."""
        if not self._reliability:
            raise not_fitted("This LearnedFusion is not trained: call fit or load first")
        return self._reliability

    def fit(
        self,
        scores: Mapping[str, ArrayLike],
        quality: Mapping[str, ArrayLike],
        labels: ArrayLike,
        rejected: Mapping[str, ArrayLike] | None = None,
    ) -> Self:
        """Train on probabilities that recognisers gave for people they were not trained on.

        Parameters
        ----------
        scores : mapping of "speech" and "gesture" to array_like, shape (num_samples, num_classes)
            Probability of every class, 0..1; what was said and shown at once in the same row.
        quality : mapping of "speech" and "gesture" to array_like, shape (num_samples,)
            `Decision.quality`; NaN where it was not measured.
        labels : array_like of int, shape (num_samples,)
            The column of the right class.
        rejected : mapping of "speech" and "gesture" to array_like of bool, shape (num_samples,), optional
            Whether the recogniser rejected what it got; by default nothing.

        Raises
        ------
        InvalidArgument
            For a mode that is missing, shapes that differ, values out of range, or fewer than two classes.
        """
        found = {mode: _matrix(scores, mode) for mode in MODES}
        shape = found["speech"].shape
        truth = np.asarray(labels)
        if found["gesture"].shape != shape or truth.shape != shape[:1]:
            raise InvalidArgument(
                f"scores and labels differ in shape: {shape}, {found['gesture'].shape}, {truth.shape}"
            )
        if truth.dtype.kind not in "iu" or not ((truth >= 0) & (truth < shape[1])).all():
            raise InvalidArgument(f"labels must be integers, 0..{shape[1] - 1}")
        nothing = {mode: np.zeros(shape[0]) for mode in MODES}
        measured = {mode: _column(quality, mode, "quality", shape[0]) for mode in MODES}
        refused = {mode: _column(rejected or nothing, mode, "rejected", shape[0]) > 0 for mode in MODES}
        reliability = {
            mode: Reliability.fit(measured[mode], refused[mode], found[mode].argmax(axis=1) == truth) for mode in MODES
        }
        if self.kind in _LEARNERS:
            trust = [reliability[mode].of(measured[mode], refused[mode]) for mode in MODES]
            rows = _rows(found["speech"], found["gesture"], *trust)
            yes = np.zeros(shape)
            yes[np.arange(shape[0]), truth] = 1.0
            self._learner = _LEARNERS[self.kind].fit(rows, yes.ravel(), shape[1], self.seed)
        self._reliability = reliability
        return self

    def fit_decisions(self, speech: Sequence[Decision], gesture: Sequence[Decision], labels: Sequence[str]) -> Self:
        """`fit` on held-out decisions.

        Parameters
        ----------
        speech, gesture : sequence of Decision
            What was decided on what was said, and shown at the same time. Pairs of which either mode had no input are
            left out.
        labels : sequence of str
            The right label of each pair.

        Raises
        ------
        InvalidArgument
            For lengths that differ, a label that neither mode knows, or no pair at all.
        """
        if not len(speech) == len(gesture) == len(labels):
            lengths = f"{len(speech)}, {len(gesture)}, {len(labels)}"
            raise InvalidArgument(f"speech, gesture and labels differ in length: {lengths}")
        both = [row for row in zip(speech, gesture, labels, strict=True) if row[0].nbest and row[1].nbest]
        if not both:
            raise InvalidArgument("no pair of decisions with input in both modes")
        classes = sorted({entry.label for pair in both for one in pair[:2] for entry in one.nbest})
        for _, _, label in both:
            if label not in classes:
                raise InvalidArgument(f"label {label!r} is known to neither mode: {', '.join(classes)}")
        columns = {label: number for number, label in enumerate(classes)}
        modes = {"speech": [row[0] for row in both], "gesture": [row[1] for row in both]}
        scores = {
            mode: [list(vectors.probabilities(one, classes).values()) for one in decisions]
            for mode, decisions in modes.items()
        }
        quality = {mode: [_quality(one) for one in decisions] for mode, decisions in modes.items()}
        rejected = {mode: [one.status == UNKNOWN for one in decisions] for mode, decisions in modes.items()}
        return self.fit(scores, quality, [columns[label] for _, _, label in both], rejected)

    def fuse(
        self, speech: Decision | None, gesture: Decision | None, options: FusionOptions | None = None
    ) -> FusedDecision:
        """Fuse two decisions; as ``hri.fuse(speech, gesture, rule=self)``, whose arguments and errors it has."""
        return fuse(speech, gesture, rule=self, options=options)

    @property
    def rule(self) -> str:
        """Its name in `FusedDecision.rule`."""
        return f"learned {self.kind.replace('_', ' ')}"

    def combine(self, speech: Decision, gesture: Decision, options: FusionOptions) -> vectors.Probabilities:
        """Fused probability of every label that either mode knows; both have input."""
        r_speech, r_gesture = (
            float(self.reliability_[mode].of(np.array([_quality(one)]), np.array([one.status == UNKNOWN]))[0])
            for mode, one in zip(MODES, (speech, gesture), strict=True)
        )
        labels = sorted({n.label for n in speech.nbest} | {n.label for n in gesture.nbest})
        p_speech, p_gesture = (vectors.probabilities(one, labels) for one in (speech, gesture))
        weighed = replace(
            options,
            weight_speech=r_speech,
            weight_gesture=r_gesture,
            reliability_speech=r_speech,
            reliability_gesture=r_gesture,
        )
        if self.kind == "dempster_shafer":
            return vectors.dempster_shafer(p_speech, p_gesture, weighed)
        product = vectors.product(p_speech, p_gesture, weighed)
        if self._learner is None or len(labels) < 2:
            return product
        given, shown = (np.array([list(p.values())]) for p in (p_speech, p_gesture))
        found = self._learner.scores(_rows(given, shown, np.array([r_speech]), np.array([r_gesture])))
        shares = found / found.sum() if found.sum() > 0 else np.full(len(labels), 1 / len(labels))
        return {c: (1 - _TIES) * float(p) + _TIES * product[c] for c, p in zip(labels, shares, strict=True)}

    def save(self, path: str | PathLike[str]) -> None:
        """Write a model file. The old file stays whole if this fails."""
        self.to_model_file().write(fspath(path))

    def to_model_file(self) -> ModelFile:
        """What `save` writes."""
        file = ModelFile()
        file.kind = FILE_KIND
        file.set_text("rule", self.kind)
        for mode, reliability in self.reliability_.items():
            reliability.write(file, f"{mode}.")
        if self._learner is not None:
            self._learner.write(file, "learner.")
        return file

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Self:
        """Read what `save` wrote.

        Raises
        ------
        FormatError
            For anything else; it names the file and the field.
        IoError
            Where it cannot be read.
        """
        with naming_model_file(path):
            return cls.from_model_file(ModelFile.read(fspath(path)))

    @classmethod
    def from_model_file(cls, file: ModelFile) -> Self:
        """The inverse of `to_model_file`. Raises FormatError that names the field."""
        if file.kind != FILE_KIND:
            raise FormatError(f"kind: the file holds '{file.kind}', not '{FILE_KIND}'")
        kind = file.text("rule")
        if kind not in KINDS:
            raise FormatError(f"rule: no kind of learned fusion {kind!r}; {did_you_mean(kind, KINDS)}")
        found = cls(kind)
        found._reliability = {mode: Reliability.read(file, f"{mode}.") for mode in MODES}
        if kind in _LEARNERS:
            found._learner = _LEARNERS[kind].read(file, "learner.", NUM_INPUTS)
        file.require_all_read()
        return found


def _quality(decision: Decision) -> float:
    return np.nan if decision.quality is None else decision.quality


def _rows(speech: Matrix, gesture: Matrix, r_speech: Matrix, r_gesture: Matrix) -> Matrix:
    """What learners get: a row of `NUM_INPUTS` for every class of every sample; margins are scaled to -1..1."""
    num_classes = speech.shape[1]
    columns = [_margins(speech), _margins(gesture), *(np.repeat(r, num_classes) for r in (r_speech, r_gesture))]
    return np.column_stack(columns)


def _margins(probabilities: Matrix) -> Matrix:
    logs = np.log(np.maximum(probabilities, _FLOOR))
    order = np.sort(logs, axis=1)
    is_best = np.arange(logs.shape[1]) == logs.argmax(axis=1)[:, None]
    best_other = np.where(is_best, order[:, -2:-1], order[:, -1:])
    return np.asarray(((logs - best_other) / -np.log(_FLOOR)).ravel())


def _matrix(scores: Mapping[str, ArrayLike], mode: str) -> Matrix:
    found = _numbers(scores, mode, "scores")
    if found.ndim != 2 or found.shape[0] < 1 or found.shape[1] < 2:
        raise InvalidArgument(f"scores of {mode} must have shape (num_samples, num_classes), got {found.shape}")
    if not ((found >= 0) & (found <= 1)).all():
        raise InvalidArgument(f"scores of {mode} must be probabilities, 0..1")
    return found


def _column(given: Mapping[str, ArrayLike], mode: str, name: str, length: int) -> Matrix:
    found = _numbers(given, mode, name)
    if found.shape != (length,) or np.isinf(found).any():
        raise InvalidArgument(f"{name} of {mode} must be {length} numbers or NaN, got shape {found.shape}")
    return found


def _numbers(given: Mapping[str, ArrayLike], mode: str, name: str) -> Matrix:
    if mode not in given:
        raise InvalidArgument(f"{name} of {mode} are missing: there are {', '.join(given) or 'none'}")
    try:
        return np.asarray(given[mode], dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InvalidArgument(f"{name} of {mode} are no numbers: {error}") from error
