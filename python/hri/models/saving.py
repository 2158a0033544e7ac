# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Estimators as model files (safetensors layout), which pickle and deepcopy go through as well."""

from __future__ import annotations

import json
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from hri.core.errors import FormatError, InvalidArgument, naming_model_file
from hri.core.estimator import Estimator
from hri.core.files import parse_json
from hri.io import ModelFile

if TYPE_CHECKING:
    from typing import Self


class SavedEstimator(Estimator):
    """An estimator of one C++ model that is written to a model file and read strictly."""

    _native_class: ClassVar[Any]
    _options_class: ClassVar[Any]
    classes_: Any

    def _check_params(self) -> None:
        self._options()

    def _options(self) -> Any:
        """The parameters as options of the C++ model; None stands for nested options that are left as they are."""
        return self._options_class(**{name: value for name, value in self._params.items() if value is not None})

    @property
    def model_(self) -> Any:
        """The trained C++ model."""
        return self._fitted

    def to_model_file(self) -> ModelFile:
        """Parameters and, once trained, the model; what `save` writes."""
        file = ModelFile()
        file.kind = f"estimator.{type(self).__name__}"
        try:
            file.set_text("params", json.dumps(self._full_params(), default=_number))
        except TypeError as error:
            raise InvalidArgument(f"{type(self).__name__} cannot be saved: {error}") from None
        if self._model is not None:
            self._model.write(file, "model.")
        if "classes_" in self.__dict__:
            file.set_text("classes", _labels_to_text(self.classes_))
        return file

    @classmethod
    def from_model_file(cls, file: ModelFile) -> Self:
        """The inverse of `to_model_file`. Raises FormatError that names the field."""
        estimator = cls.__new__(cls)
        estimator._read(file)
        return estimator

    def _read(self, file: ModelFile) -> None:
        kind = f"estimator.{type(self).__name__}"
        if file.kind != kind:
            raise FormatError(f"the file holds '{file.kind}', not '{kind}'")
        params = parse_json(file.text("params"), "params", finite=False)
        try:
            if not isinstance(params, dict):
                raise ValueError("not a list of names and values")
            type(self).__init__(self, **params)
        except (ValueError, TypeError) as error:
            raise FormatError(f"params: {error}") from None
        if any(name.startswith("model.") for name in [*file.tensor_shapes(), *file.metadata()]):
            object.__setattr__(self, "_model", self._native_class.read(file, "model."))
        if file.has("classes"):
            self.classes_ = _labels_from_text(file.text("classes"))
            if self._model is None or len(self.classes_) != self._model.num_classes:
                raise FormatError(f"classes: {len(self.classes_)} labels do not fit the model")
        file.require_all_read()

    def save(self, path: str | PathLike[str]) -> None:
        """Write parameters and model. The old file stays whole if this fails."""
        self.to_model_file().write(fspath(path))

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Self:
        """Read what `save` wrote. Raises FormatError for anything else."""
        with naming_model_file(path):
            return cls.from_model_file(ModelFile.read(fspath(path)))

    def __getstate__(self) -> bytes:
        return self.to_model_file().to_bytes()

    def __setstate__(self, state: bytes) -> None:
        if not isinstance(state, bytes):
            raise FormatError(f"the state of {type(self).__name__} must be bytes, got {type(state).__name__}")
        self._read(ModelFile.from_bytes(state, f"the state of {type(self).__name__}"))


class RowEstimator(SavedEstimator):
    """One that is trained on rows of numbers."""

    @property
    def n_features_in_(self) -> int:
        """Columns of the rows it was trained on."""
        return int(self._fitted.dim)


_LABEL_TYPES = {"str", "int", "float", "bool"}


def _labels_to_text(labels: Any) -> str:
    values = labels.tolist()
    names = {type(value).__name__ for value in values}
    if len(names) != 1 or not names <= _LABEL_TYPES:
        raise InvalidArgument(
            f"labels must be all of one type of {', '.join(sorted(_LABEL_TYPES))} to be saved, got {names}"
        )
    return json.dumps({"type": names.pop(), "dtype": labels.dtype.str, "labels": values})


def _labels_from_text(text: str) -> Any:
    held = parse_json(text, "classes", finite=False)
    try:
        name, labels = held["type"], held["labels"]
        if not isinstance(labels, list):
            raise ValueError("not a list of labels")
        if any(type(label).__name__ != name for label in labels) or len(set(labels)) != len(labels):
            raise ValueError("labels of another type, or twice the same")
        dtype = np.dtype({"O": object}.get(held["dtype"][1:2], held["dtype"] if name != "str" else np.str_))
        if not labels or dtype.kind not in {"str": "UO", "int": "iuO", "float": "fO", "bool": "bO"}[name]:
            raise ValueError("no labels, or of another type")
        return np.asarray(labels, dtype=dtype)
    except (ValueError, TypeError, KeyError, OverflowError) as error:
        raise FormatError(f"classes: {error}") from None


def _number(value: Any) -> Any:
    """NumPy's numbers as Python's; options as dicts."""
    if isinstance(value, np.generic):
        return value.item()
    if hasattr(value, "as_dict"):
        return value.as_dict()
    raise TypeError(f"a parameter of type {type(value).__name__} has no place in a model file")
