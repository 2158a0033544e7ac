# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Which words of a model were said by synthetic voices, in a file beside the model: their clips are not kept, and are
said again where the model is trained anew."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from hri.core.errors import FormatError, InvalidArgument, IoError
from hri.core.files import MAX_MODEL_BYTES, parse_json, read_bytes, write_text
from hri.core.text import is_printable

SUFFIX = ".spoken.json"
"""Of the file, behind the name of the model."""
MAX_CLIPS = 10_000
"""Voices times words: what a file from elsewhere may have this computer say."""
_KIND, _VERSION = "spoken_words", 1
_LANGUAGE = re.compile(r"[A-Za-z][A-Za-z0-9-]{0,31}", re.ASCII)
_MAX_BYTES = 1 << 20
_MAX_LETTERS = 200
_SEEDS = 1 << 63
_FIELDS = ("kind", "version", "model", "language", "voices", "seed", "words")


@dataclass(frozen=True)
class SpokenWords:
    """Words that synthetic voices say.

    Parameters
    ----------
    language : str
        Of the voices, as espeak-ng calls it.
    texts : mapping of str to str
        What is said, by the label of the word.
    num_voices : int
    seed : int
        Of everything random in the voices.

    Raises
    ------
    InvalidArgument
        For a language that is no name of one, no word, a label or text that is empty, longer than 200 letters or has
        control characters, a seed outside 0..2^63 - 1, and more than 10000 clips, one for every word and voice.
    """

    language: str
    texts: Mapping[str, str] = field(default_factory=dict)
    num_voices: int = 24
    seed: int = 0

    def __post_init__(self) -> None:
        if not _LANGUAGE.fullmatch(self.language):
            raise InvalidArgument(f"language {self.language!r} is no name of a language of espeak-ng")
        if not self.texts:
            raise InvalidArgument("there is no word to be said")
        for label, text in self.texts.items():
            for what, value in (("label", label), ("text", text)):
                if not value.strip() or len(value) > _MAX_LETTERS or not is_printable(value):
                    raise InvalidArgument(f"a {what} has 1 to {_MAX_LETTERS} letters, got {value[:_MAX_LETTERS]!r}")
        if self.num_voices < 1 or self.num_voices * len(self.texts) > MAX_CLIPS:
            raise InvalidArgument(
                f"{self.num_voices} voices for {len(self.texts)} words: at least 1, and {MAX_CLIPS} clips at most"
            )
        if not 0 <= self.seed < _SEEDS:
            raise InvalidArgument(f"seed must lie in 0..{_SEEDS - 1}")

    def write_beside(self, model: str | PathLike[str]) -> Path:
        """Write the file of a model file, which says which model it belongs to.

        Raises
        ------
        IoError
            For a model that cannot be read, or a file that cannot be written.
        """
        path = _beside(model)
        write_text(path, self.to_json(_hash(read_bytes(model, MAX_MODEL_BYTES))))
        return path

    def to_json(self, model_hash: str) -> str:
        """The text of the file of the model whose bytes have this SHA-256."""
        values = {"kind": _KIND, "version": _VERSION, "model": model_hash, "language": self.language}
        values |= {"voices": self.num_voices, "seed": self.seed, "words": dict(self.texts)}
        return json.dumps(values, ensure_ascii=False, indent=1) + "\n"

    @classmethod
    def read_beside(cls, model: str | PathLike[str]) -> SpokenWords | None:
        """What the file beside a model file says; None where there is none.

        Raises
        ------
        FormatError
            For a file that is damaged, of another kind, or of another model; names what is wrong with it.
        IoError
            For one that cannot be read.
        """
        path = _beside(model)
        if not path.exists():
            return None
        try:
            text = read_bytes(path, _MAX_BYTES).decode("utf-8")
        except UnicodeDecodeError as error:
            raise FormatError(f"{path}: not UTF-8 at byte {error.start}") from error
        values = parse_json(text, str(path))
        _require_fields(values, path)
        if values["model"] != _hash(read_bytes(model, MAX_MODEL_BYTES)):
            raise FormatError(
                f"{path}: belongs to another model than {fspath(model)}: train it anew, or remove the file"
            )
        try:
            return cls(values["language"], values["words"], values["voices"], values["seed"])
        except InvalidArgument as error:
            raise FormatError(f"{path}: {error}") from error

    @staticmethod
    def remove_beside(model: str | PathLike[str]) -> None:
        """Remove the file of a model, if there is one: the model has no such words any more.

        Raises
        ------
        IoError
            When it cannot be removed.
        """
        path = _beside(model)
        try:
            path.unlink(missing_ok=True)
        except OSError as error:
            raise IoError(f"{path}: {error.strerror}") from error


def _beside(model: str | PathLike[str]) -> Path:
    path = Path(model)
    return path.with_name(path.name + SUFFIX)


def _hash(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


def _require_fields(values: Any, path: Path) -> None:
    """Raise a FormatError for other fields, or of other types, than `to_json` writes."""
    if not isinstance(values, dict) or values.get("kind") != _KIND:
        raise FormatError(f"{path}: is no list of spoken words")
    if values.get("version") != _VERSION:
        raise FormatError(f"{path}: version {values.get('version')!r}, and {_VERSION} is known here")
    for name in _FIELDS:
        if name not in values:
            raise FormatError(f"{path}: has no field {name!r}")
    if unknown := sorted(set(values) - set(_FIELDS)):
        raise FormatError(f"{path}: has a field {unknown[0]!r} that is not known")
    words = values["words"]
    texts = isinstance(words, dict) and all(isinstance(text, str) for text in words.values())
    numbers = all(isinstance(values[name], int) and not isinstance(values[name], bool) for name in ("voices", "seed"))
    if not texts or not numbers or not all(isinstance(values[name], str) for name in ("model", "language")):
        raise FormatError(f"{path}: model and language are texts, voices and seed numbers, words texts by label")
