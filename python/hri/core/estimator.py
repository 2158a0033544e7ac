# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What models and recognisers share of scikit-learn's conventions, without depending on it."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from functools import lru_cache
from inspect import Parameter, signature
from typing import TYPE_CHECKING, Any, Concatenate, ParamSpec

from hri.core.errors import InvalidArgument, NotFittedError

if TYPE_CHECKING:
    from typing import Self

P = ParamSpec("P")


def keywords_of(options: Callable[P, Any]) -> Callable[[Callable[..., None]], Callable[Concatenate[Any, P], None]]:
    """Give a constructor the keywords of an options class, for type checkers and for `inspect.signature`.

    A default that is an options object of its own shows as None.
    """

    def decorate(method: Callable[..., None]) -> Callable[Concatenate[Any, P], None]:
        known = [p for p in signature(method).parameters.values() if p.kind is not Parameter.VAR_KEYWORD]
        fields = [
            Parameter(name, Parameter.KEYWORD_ONLY, default=None if isinstance(value, dict) else value)
            for name, value in options().as_dict().items()  # type: ignore[call-arg]
        ]
        method.__signature__ = signature(method).replace(parameters=[*known, *fields])  # type: ignore[attr-defined]
        return method

    return decorate


class Estimator:
    """Base of everything that is trained: parameters that are read, set, copied and saved as scikit-learn expects.

    A parameter keeps what was passed, and is read and set as an attribute too. Parameters are checked when they are
    passed, and once more by `fit`, as attributes are not checked when they are set.
    """

    _params: dict[str, Any]

    def __init__(self, **params: Any) -> None:
        known = _defaults(_class_of(self))
        for name in params:
            if name not in known:
                raise TypeError(f"{type(self).__name__} has no parameter {name!r}; it has: {', '.join(known)}")
        object.__setattr__(self, "_params", known | params)
        self._check_params()

    def _check_params(self) -> None:
        """Raise InvalidArgument or TypeError for parameters that cannot be trained with."""

    def get_params(self, deep: bool = True) -> dict[str, Any]:
        """Parameters by name.

        Parameters
        ----------
        deep : bool
            Also the fields of options within options, as ``topology__num_states``.
        """
        return self._params | (flat_params(self._full_params()) if deep else {})

    def _full_params(self) -> dict[str, Any]:
        """Parameters as plain values, with those of nested options filled in."""
        return {name: _plain(value) for name, value in self._params.items()}

    def set_params(self, **params: Any) -> Self:
        """Change parameters; a field of nested options as ``topology__num_states=5``.

        Raises
        ------
        ValueError
            For a name that there is not, or a value out of range; then nothing is changed.
        """
        changed = replaced_params(self._params, self.get_params(), params, type(self).__name__)
        before = self._params
        object.__setattr__(self, "_params", changed)
        try:
            self._check_params()
        except Exception:
            object.__setattr__(self, "_params", before)
            raise
        return self

    def __setattr__(self, name: str, value: Any) -> None:
        if name in self.__dict__.get("_params", ()):
            self._params[name] = value
        else:
            object.__setattr__(self, name, value)

    if not TYPE_CHECKING:  # a name that there is not shall be an error for type checkers

        def __getattr__(self, name: str) -> Any:
            params = self.__dict__.get("_params", {})
            if name in params:
                return params[name]
            if isinstance(found := getattr(type(self), name, None), property):
                return found.fget(self)  # it raised an AttributeError, such as NotFittedError: so that it is seen
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

    def __repr__(self) -> str:
        default = _defaults(_class_of(self))
        changed = ", ".join(f"{k}={v!r}" for k, v in self._params.items() if not _same(v, default[k]))
        return f"{type(self).__name__}({changed})"

    def __sklearn_is_fitted__(self) -> bool:
        return self._model is not None

    _model: Any = None

    @property
    def _fitted(self) -> Any:
        """The trained C++ model; raises NotFittedError."""
        if self._model is None:
            raise not_fitted(f"This {type(self).__name__} is not trained: call fit or load first")
        return self._model


def flat_params(full: Mapping[str, Any]) -> dict[str, Any]:
    """The fields of the nested options among plain parameters, as ``topology__num_states``."""
    flat: dict[str, Any] = {}
    for name, value in full.items():
        if isinstance(value, Mapping):
            inner = {**value, **flat_params(value)}
            flat |= {f"{name}__{field}": entry for field, entry in inner.items()}
    return flat


def replaced_params(
    old: Mapping[str, Any], known: Mapping[str, Any], new: Mapping[str, Any], owner: str
) -> dict[str, Any]:
    """`old` with the parameters of `new`, of which those of nested options are named as `flat_params` names them.

    Raises
    ------
    InvalidArgument
        For a name that is not in `known`.
    """
    changed = dict(old)
    for path, value in new.items():
        if path not in known:
            raise InvalidArgument(f"invalid parameter {path!r} for estimator {owner}; it has: {', '.join(known)}")
        name, *fields = path.split("__")
        changed[name] = _replaced(changed.get(name), fields, value)
    return changed


def not_fitted(message: str) -> Exception:
    """A NotFittedError, which is scikit-learn's too where scikit-learn is loaded."""
    theirs = sys.modules.get("sklearn.exceptions")
    return (NotFittedError if theirs is None else _both(theirs.NotFittedError))(message)


def _class_of(estimator: Any) -> Any:
    return type(estimator)


@lru_cache
def _both(theirs: type[Exception]) -> type[Exception]:
    return type("NotFittedError", (NotFittedError, theirs), {"__module__": "hri"})


@lru_cache
def _defaults(cls: Any) -> dict[str, Any]:
    parameters = list(signature(cls.__init__).parameters.values())[1:]
    return {p.name: p.default for p in parameters if p.kind is not Parameter.VAR_KEYWORD}


def _plain(value: Any) -> Any:
    return value.as_dict() if hasattr(value, "as_dict") else value


def _replaced(value: Any, fields: list[str], new: Any) -> Any:
    """`value` with the field at the end of the path `fields` replaced."""
    if not fields:
        return new
    old = _plain(value) or {}
    return {**old, fields[0]: _replaced(old.get(fields[0]), fields[1:], new)}


def _same(a: Any, b: Any) -> bool:
    try:
        return bool(a is b or (type(a) is type(b) and a == b))
    except ValueError:  # arrays
        return False
