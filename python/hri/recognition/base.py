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

from hri import _native
from hri.core.display import short_list, summary
from hri.recognition.decision import Decision

_log = logging.getLogger(__name__)

if TYPE_CHECKING:
    from typing import Self


class Recognizer:
    """Base of `WordRecognizer` and `GestureRecognizer`; holds the native recogniser once trained or loaded."""

    mode: ClassVar[str]
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
            raise _native.InvalidArgument(f"{type(self).__name__} is not trained: call fit or load first")
        return self._native

    @property
    def classes_(self) -> NDArray[np.str_]:
        """The labels in sorted order, shape (num_classes,)."""
        return np.asarray(self._trained.labels)

    def get_params(self, deep: bool = True) -> dict[str, Any]:
        """The options by name, as scikit-learn's estimators give them."""
        return dict(self.options.as_dict())

    def save(self, path: str | PathLike[str]) -> None:
        """Write the model (safetensors layout). The old file stays whole if this fails."""
        self._trained.save(fspath(path))
        _log.info("%s: written", fspath(path))

    def decide(self, X: Sequence[Any], *args: Any, **kwargs: Any) -> list[Decision]:
        """The decision for every item of `X`."""
        raise TypeError(f"{type(self).__name__} does not say how to decide")

    def predict(self, X: Sequence[Any], *args: Any, **kwargs: Any) -> NDArray[np.str_]:
        """The best label for every item, whether or not it would be rejected; "no_input" where there is none."""
        decisions = self.decide(X, *args, **kwargs)
        return np.asarray([d.nbest[0].label if d.nbest else d.label for d in decisions])

    def predict_proba(self, X: Sequence[Any], *args: Any, **kwargs: Any) -> NDArray[np.float64]:
        """Calibrated posteriors, shape (len(X), num_classes) in the order of `classes_`; uniform without input."""
        classes = list(self.classes_)
        result = np.full((len(X), len(classes)), 1.0 / len(classes))
        for row, decision in zip(result, self.decide(X, *args, **kwargs), strict=True):
            for entry in decision.nbest:
                row[classes.index(entry.label)] = entry.probability
        return result

    def score(self, X: Sequence[Any], y: Sequence[str], *args: Any, **kwargs: Any) -> float:
        """Share of items whose best label is right, 0..1."""
        return float(np.mean(self.predict(X, *args, **kwargs) == np.asarray(y)))


def _flat(options: dict[str, Any], prefix: str = "") -> dict[str, Any]:
    flat: dict[str, Any] = {}
    for name, value in options.items():
        flat |= _flat(value, f"{prefix}{name}.") if isinstance(value, dict) else {f"{prefix}{name}": value}
    return flat
