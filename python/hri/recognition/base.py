# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What recognisers of words and of gestures share, after scikit-learn's conventions."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from hri.core.display import short_list, summary
from hri.core.errors import FormatError, InvalidArgument
from hri.core.estimator import flat_params, not_fitted, replaced_params
from hri.core.labels import as_texts
from hri.core.sklearn_tags import make_tags
from hri.io import ModelFile
from hri.recognition.decision import Decision

_log = logging.getLogger(__name__)

if TYPE_CHECKING:
    from typing import Self


class Recognizer:
    """Base of `WordRecognizer` and `GestureRecognizer`; holds the native recogniser once trained or loaded.

    Options are parameters as scikit-learn has them: `clone`, searches and pipelines work, copies and pickles go
    through the model file.
    """

    mode: ClassVar[str]
    _estimator_type = "classifier"
    _native_class: ClassVar[Any]
    _options_class: ClassVar[Any]

    def __init__(self, **options: Any) -> None:
        self.options = self._options_class(**options)
        self._native: Any = None

    @classmethod
    def _wrap(cls, native: Any) -> Self:
        recognizer = cls()
        recognizer.options = native.options
        recognizer._native = native
        return recognizer

    def __repr__(self) -> str:
        defaults = _flat(self._options_class().as_dict())
        changed = [f"{k}={v!r}" for k, v in _flat(self.options.as_dict()).items() if v != defaults.get(k)]
        labels = "" if self._native is None else f"{len(self.classes_)} labels: {short_list(self.classes_)}"
        return summary(type(self).__name__, labels or "not trained", *changed)

    @property
    def _trained(self) -> Any:
        if self._native is None:
            raise not_fitted(f"This {type(self).__name__} is not trained: call fit or load first")
        return self._native

    def __sklearn_is_fitted__(self) -> bool:
        return self._native is not None

    def __sklearn_tags__(self) -> Any:
        return make_tags("classifier", rows=False, requires_y=True)

    @property
    def classes_(self) -> NDArray[np.str_]:
        """The labels in sorted order, shape (num_classes,)."""
        return np.asarray(self._trained.labels)

    def get_params(self, deep: bool = True) -> dict[str, Any]:
        """The options by name.

        Parameters
        ----------
        deep : bool
            Also the fields of options within options, as ``cepstra__num_filters``.
        """
        full = dict(self.options.as_dict())
        return full | (flat_params(full) if deep else {})

    def set_params(self, **params: Any) -> Self:
        """Change options, for the next `fit`; a field of nested options as ``cepstra__num_filters=30``.

        Raises
        ------
        ValueError
            For a name that there is not, or a value out of range; then nothing is changed.
        """
        changed = replaced_params(self.get_params(deep=False), self.get_params(), params, type(self).__name__)
        self.options = self._options_class(**changed)
        return self

    def untrained(self) -> Self:
        """Another recogniser of the same options, which is not trained."""
        return type(self)(**self.get_params(deep=False))

    def __sklearn_clone__(self) -> Self:
        return self.untrained()

    def __getstate__(self) -> dict[str, Any]:
        model = None if self._native is None else self.to_model_file().to_bytes()
        return {"params": self.options.as_dict(), "model": model}

    def __setstate__(self, state: dict[str, Any]) -> None:
        name = type(self).__name__
        if not isinstance(state, dict) or state.keys() != {"params", "model"}:
            raise FormatError(f"the state of {name} must have params and model")
        params, model = state["params"], state["model"]
        if not isinstance(params, dict) or not (model is None or isinstance(model, bytes)):
            raise FormatError(f"the state of {name} must have a dict and bytes")
        self.__init__(**params)  # type: ignore[misc]
        if model is not None:
            self._native = self._from_model_file(ModelFile.from_bytes(model, f"the state of {name}"))

    def _from_model_file(self, file: ModelFile) -> Any:
        return self._native_class.from_model_file(file)

    def to_model_file(self) -> ModelFile:
        """The model as `save` writes it."""
        file: ModelFile = self._trained.to_model_file()
        return file

    def save(self, path: str | PathLike[str]) -> None:
        """Write the model (safetensors layout). The old file stays whole if this fails."""
        self._trained.save(fspath(path))
        _log.info("%s: written", fspath(path))

    def decide(self, X: Sequence[Any]) -> list[Decision]:
        """The decision for every item of `X`."""
        raise TypeError(f"{type(self).__name__} does not say how to decide")

    def predict(self, X: Sequence[Any]) -> NDArray[np.str_]:
        """The best label for every item, whether or not it would be rejected; "no_input" where there is none."""
        return best_labels(self.decide(X))

    def predict_proba(self, X: Sequence[Any]) -> NDArray[np.float64]:
        """Calibrated posteriors, shape (len(X), num_classes) in the order of `classes_`; uniform without input."""
        return posteriors(self.decide(X), self.classes_)

    def predict_log_proba(self, X: Sequence[Any]) -> NDArray[np.float64]:
        """Natural logs of `predict_proba`."""
        with np.errstate(divide="ignore"):
            return np.log(self.predict_proba(X))

    def score(self, X: Sequence[Any], y: Sequence[str]) -> float:
        """Share of items whose best label is right, 0..1; integers count as their digits, as in `fit`."""
        return share_right(self.predict(X), y)


def _flat(options: dict[str, Any], prefix: str = "") -> dict[str, Any]:
    flat: dict[str, Any] = {}
    for name, value in options.items():
        flat |= _flat(value, f"{prefix}{name}.") if isinstance(value, dict) else {f"{prefix}{name}": value}
    return flat


def best_labels(decisions: Sequence[Decision]) -> NDArray[np.str_]:
    """The label of each decision whether or not it was rejected; "no_input" where there was none."""
    return np.asarray([d.nbest[0].label if d.nbest else d.label for d in decisions], np.str_)


def posteriors(decisions: Sequence[Decision], classes: NDArray[np.str_]) -> NDArray[np.float64]:
    """Posteriors of the decisions, a row each in the order of `classes`; uniform without input."""
    column = {label: i for i, label in enumerate(classes)}
    result = np.full((len(decisions), len(column)), 1.0 / len(column))
    for row, decision in zip(result, decisions, strict=True):
        for entry in decision.nbest:
            row[column[entry.label]] = entry.probability
    return result


def share_right(predicted: NDArray[np.str_], y: Sequence[str]) -> float:
    """Share of labels that are those of `y`, 0..1.

    Raises
    ------
    InvalidArgument
        For lengths that differ, none at all, and labels that `fit` would refuse.
    """
    truths = as_texts(y, "y")
    if len(predicted) != len(truths):
        raise InvalidArgument(f"X and y differ in length: {len(predicted)}, {len(truths)}")
    if not truths:
        raise InvalidArgument("score needs one item or more")
    return float(np.mean(predicted == np.asarray(truths)))
