# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What recognisers share whose front end may read a pretrained speech embedding."""

from __future__ import annotations

from os import PathLike, fspath
from typing import TYPE_CHECKING, Any, ClassVar

from hri.core.errors import FormatError, InvalidArgument
from hri.io import ModelFile
from hri.recognition.base import Recognizer
from hri.recognition.loading import load_native
from hri.recognition.word.embedding import SpeechEmbedding

if TYPE_CHECKING:
    from typing import Self


class RecognizerWithEmbedding(Recognizer):
    """Base of `WordRecognizer` and `ConnectedWordRecognizer`; copies keep the embedding that `fit` or `load` was given.

    The model file names the weights it was trained with and holds none of them.
    """

    mode = "speech"
    _kind: ClassVar[str]
    """Of the model file."""
    _front_end_field: ClassVar[str]
    """Of the model file and, attribute by attribute, of the options."""
    _embedding: SpeechEmbedding | None = None

    @property
    def embedding(self) -> SpeechEmbedding | None:
        """What was given to `fit` or `load`; None: the weights that the extra installs, or no embedding at all."""
        return self._embedding

    @classmethod
    def load(cls, path: str | PathLike[str], *, embedding: SpeechEmbedding | None = None) -> Self:
        """Read a model that `save` wrote, in Python or C++.

        Parameters
        ----------
        path : path
        embedding : SpeechEmbedding, optional
            For a model whose front end reads one: of the weights that it was trained with, by default those that the
            extra `embedding` installs.

        Raises
        ------
        FormatError
            For anything else, and for other weights than those of training.
        InvalidArgument
            For an embedding where the front end is "cepstra".
        ImportError
            For a front end that reads an embedding, without weights; names the extra.
        """
        recognizer = cls._wrap(load_native(lambda file: cls._native_of(file, embedding), path, cls._kind))
        if embedding is not None:
            try:
                recognizer._native_embedding(embedding)
            except InvalidArgument as error:
                raise InvalidArgument(f"{fspath(path)}: {error}") from None
        recognizer._embedding = embedding
        return recognizer

    def _native_embedding(self, given: SpeechEmbedding | None) -> Any:
        """What the native training takes: `given`, or the installed one where the front end reads one, or else None.

        Raises
        ------
        InvalidArgument
            For an embedding where the front end is "cepstra".
        ImportError
            As `load`.
        """
        front_end = self.options
        for name in self._front_end_field.split("."):
            front_end = getattr(front_end, name)
        if given is not None and not _reads_embedding(front_end):
            raise InvalidArgument(f"front_end={front_end!r} takes no speech embedding")
        return _native_for(front_end, given)

    @classmethod
    def _native_of(cls, file: ModelFile, embedding: SpeechEmbedding | None) -> Any:
        front_end = file.metadata().get(cls._front_end_field, "cepstra") if file.kind == cls._kind else "cepstra"
        return cls._native_class.from_model_file(file, _native_for(front_end, embedding))

    def _from_model_file(self, file: ModelFile) -> Any:
        return self._native_of(file, self._embedding)

    def __getstate__(self) -> dict[str, Any]:
        return {**super().__getstate__(), "embedding": self._embedding}

    def __setstate__(self, state: dict[str, Any]) -> None:
        rest = dict(state) if isinstance(state, dict) else {}
        embedding = rest.pop("embedding", None)
        if not isinstance(embedding, SpeechEmbedding | None):
            raise FormatError(f"the state of {type(self).__name__} must have an embedding or None")
        self._embedding = embedding
        super().__setstate__(rest)


def _reads_embedding(front_end: str) -> bool:
    return front_end in ("both", "embedding")


def _native_for(front_end: str, given: SpeechEmbedding | None) -> Any:
    if not _reads_embedding(front_end):
        return None
    return (SpeechEmbedding() if given is None else given)._native
