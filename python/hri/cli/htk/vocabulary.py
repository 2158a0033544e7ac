# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The words that a recogniser needs: their pronunciations, and models, found before anything is decoded."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

from hri.cli.htk.options import ModelFiles, References
from hri.core.errors import FormatError
from hri.htk import Dictionary, Label, Pronunciation


class Vocabulary:
    """Pronunciations of the words that are needed, by physical models.

    Parameters
    ----------
    path : str
        Of the dictionary.
    names : mapping of str to str
        Physical models by logical ones.
    list_path : str
        Of the list that these come from.
    scale : float
        Factor on the log probabilities of pronunciations.

    Attributes
    ----------
    path : str
    dictionary : Dictionary
        As it is in the file.
    """

    def __init__(self, path: str, names: Mapping[str, str], list_path: str, scale: float = 1.0) -> None:
        self.path = path
        self._names = names
        self._list_path = list_path
        self._scale = scale
        self._by_word: dict[str, list[Pronunciation]] = {}
        self.dictionary = Dictionary.read(path)
        for entry in self.dictionary.entries:
            self._by_word.setdefault(entry.word, []).append(entry)
        self._entries: list[Pronunciation] = []

    def has(self, word: str) -> bool:
        """Whether the dictionary has a word."""
        return word in self._by_word

    def select(self, words: Iterable[str], sources: ModelFiles, folder: str | None, suffix: str | None) -> Dictionary:
        """The pronunciations of these words, which the dictionary has; models that are missing are read from `folder`.

        Raises
        ------
        FormatError
            For a model that the list has not, or that is defined nowhere; names the line of the dictionary.
        """
        self._entries = [entry for word in dict.fromkeys(words) for entry in self._by_word[word]]
        made = []
        for entry in self._entries:
            for model in entry.models:
                self._require_model(entry, model, sources, folder, suffix)
            physical = [self._names[model] for model in entry.models]
            made.append(Pronunciation(entry.word, physical, entry.output, max(entry.probability**self._scale, 1e-300)))
        return Dictionary(made)

    def logical(self, pronunciation: int) -> list[str]:
        """Models of an entry of what `select` gave, as the dictionary names them."""
        return list(self._entries[pronunciation].models)

    def _require_model(
        self, entry: Pronunciation, model: str, sources: ModelFiles, folder: str | None, suffix: str | None
    ) -> None:
        where = f"{self.path}: line {entry.line}"
        if model not in self._names:
            raise FormatError(
                f"{where}: the list of models {self._list_path} does not have {model!r}, of the word {entry.word!r}"
            )
        physical = self._names[model]
        if sources.has(physical):
            return
        path = Path(folder or ".", physical if suffix is None else f"{physical}.{suffix}")
        if path.is_file():
            sources.read(str(path))
        if not sources.has(physical):
            raise FormatError(
                f"{where}: there is no model {physical!r}, of the word {entry.word!r}: "
                f"neither a -H nor a file {path} defines it"
            )


def transcripts_of(names: Iterable[str], references: References, vocabulary: Vocabulary) -> dict[str, list[Label]]:
    """What was said in each recording.

    Raises
    ------
    FormatError
        For a word that the dictionary has not: names file and line of the label.
    """
    found = {}
    for name in names:
        transcription, source = references.locate(name)
        for label in transcription.labels:
            if not vocabulary.has(label.name):
                where = f"{source}: line {label.line}"
                raise FormatError(f"{where}: the dictionary {vocabulary.path} does not have the word {label.name!r}")
        found[name] = list(transcription.labels)
    return found
