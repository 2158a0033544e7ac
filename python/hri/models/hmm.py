# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Hidden Markov models: estimators with hmmlearn's methods, and the C++ models and streams under their C++ names."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hri._native import DiscreteHmm, DiscreteHmmOptions, GaussianMixtureHmm, GaussianMixtureHmmOptions, TrainingReport
from hri.core.errors import InvalidArgument
from hri.core.estimator import keywords_of
from hri.core.sklearn_tags import make_tags
from hri.models.rows import as_rows
from hri.models.saving import SavedEstimator

if TYPE_CHECKING:
    from typing import Self


class _Hmm(SavedEstimator, ABC):
    """What the HMMs share. Sequences stand one below the other in `X`; `lengths` says how long each is.

    Attributes
    ----------
    startprob_ : ndarray of float64, shape (num_states,)
    transmat_ : ndarray of float64, shape (num_states, num_states)
        Row i holds the probabilities of going from state i to each state.
    report_ : TrainingReport
        Log-likelihood before each iteration, and whether training converged; not saved.
    model_ : object
        The trained C++ model.
    """

    report_: TrainingReport

    @abstractmethod
    def _sequences(self, X: Any, lengths: Sequence[int] | None) -> list[Any]:
        """The sequences of `X`, each as the C++ model takes it."""

    @classmethod
    def from_model(cls, model: Any) -> Self:
        """An estimator of a C++ model that is there already, such as one made of a `MarkovChain` and emissions."""
        estimator = cls(topology=model.chain.topology)
        estimator._model = model
        return estimator

    def fit(self, X: ArrayLike, lengths: Sequence[int] | None = None) -> Self:
        """Baum-Welch over all sequences of `X`.

        Raises
        ------
        InvalidArgument
            For lengths that do not add up, an empty sequence, or values that the model cannot have.
        """
        sequences = self._sequences(X, lengths)
        options = self._training_options(sequences)
        report = TrainingReport()
        self._model = self._native_class.train(sequences, options, report)
        self.report_ = report
        return self

    def _training_options(self, sequences: list[Any]) -> Any:
        return self._options()

    def score(self, X: ArrayLike, lengths: Sequence[int] | None = None) -> float:
        """Log-likelihood (natural) of all sequences of `X`, added up."""
        model = self._fitted
        return float(sum(model.log_likelihood(sequence) for sequence in self._sequences(X, lengths)))

    def decode(self, X: ArrayLike, lengths: Sequence[int] | None = None) -> tuple[float, NDArray[np.int32]]:
        """The best path (Viterbi).

        Returns
        -------
        log_prob : float
            Log probability of sequences and paths together, added up.
        states : ndarray of int32, shape (num_frames,)
        """
        model = self._fitted
        found = [model.viterbi(sequence) for sequence in self._sequences(X, lengths)]
        return float(sum(score for score, _ in found)), np.concatenate([path for _, path in found])

    def predict(self, X: ArrayLike, lengths: Sequence[int] | None = None) -> NDArray[np.int32]:
        """The states of the best path, shape (num_frames,)."""
        return self.decode(X, lengths)[1]

    def predict_proba(self, X: ArrayLike, lengths: Sequence[int] | None = None) -> NDArray[np.float64]:
        """Posterior of every state for every frame, shape (num_frames, num_states).

        Raises
        ------
        InvalidArgument
            For a sequence that is impossible under the model.
        """
        model = self._fitted
        return np.concatenate([model.posterior(sequence) for sequence in self._sequences(X, lengths)])

    def score_samples(self, X: ArrayLike, lengths: Sequence[int] | None = None) -> tuple[float, NDArray[np.float64]]:
        """Log-likelihood and state posteriors by one pass of forward and backward.

        Returns
        -------
        log_prob : float
            Log-likelihood (natural) of all sequences of `X`, added up.
        posteriors : ndarray of float64, shape (num_frames, num_states)
            As `predict_proba` gives them.

        Raises
        ------
        InvalidArgument
            For a sequence that is impossible under the model: it has no posteriors.
        """
        model = self._fitted
        found = [model.state_posteriors(sequence) for sequence in self._sequences(X, lengths)]
        for i, (log_prob, _) in enumerate(found):
            if not np.isfinite(log_prob):
                raise InvalidArgument(f"sequence {i} is impossible under the model")
        return float(sum(log_prob for log_prob, _ in found)), np.concatenate([rows for _, rows in found])

    def sample(self, num_samples: int = 1, seed: int = 0) -> tuple[NDArray[Any], NDArray[np.int32]]:
        """Draw a sequence.

        Parameters
        ----------
        num_samples : int
            Its length.
        seed : int
            The same seed gives the same sequence.

        Returns
        -------
        X : ndarray, shape (num_samples, num_features)
        states : ndarray of int32, shape (num_samples,)
        """
        drawn, states = self._fitted.sample(num_samples, seed)
        return drawn.reshape(num_samples, -1), states

    @property
    def startprob_(self) -> NDArray[np.float64]:
        """Probability of each state at the start."""
        return np.asarray(self._fitted.chain.start)

    @property
    def transmat_(self) -> NDArray[np.float64]:
        """Probabilities of going from one state to another."""
        return np.asarray(self._fitted.chain.transition)

    def __sklearn_tags__(self) -> Any:
        return make_tags(None)


class CategoricalHMM(_Hmm):
    """HMM over symbols 0, 1, 2, ..., as hmmlearn's CategoricalHMM.

    Keywords are those of `DiscreteHmmOptions`; without ``num_symbols`` there are as many as the training data shows.

    Attributes
    ----------
    emissionprob_ : ndarray of float64, shape (num_states, num_symbols)

    Examples
    --------
    >>> symbols = [0, 0, 1, 1, 0, 1, 1, 1]
    >>> model = CategoricalHMM(topology={"num_states": 2}).fit(symbols, lengths=[4, 4])
    >>> model.predict(symbols, lengths=[4, 4]).tolist()
    [0, 0, 1, 1, 0, 1, 1, 1]
    """

    _native_class = DiscreteHmm
    _options_class = DiscreteHmmOptions

    @keywords_of(DiscreteHmmOptions)
    def __init__(self, **params: Any) -> None:
        super().__init__(**params)

    def _sequences(self, X: Any, lengths: Sequence[int] | None) -> list[Any]:
        symbols = np.asarray(X)
        if symbols.ndim == 2 and symbols.shape[1] == 1:
            symbols = symbols[:, 0]
        if symbols.ndim != 1 or symbols.dtype.kind not in "iu":
            raise InvalidArgument(f"X must be a vector of whole numbers, got {symbols.dtype} of shape {symbols.shape}")
        return list(_split(symbols, lengths))

    def _training_options(self, sequences: list[Any]) -> Any:
        options = self._options()
        if options.num_symbols == 0:
            options.num_symbols = 1 + max(int(s.max()) for s in sequences)
        return options

    @property
    def emissionprob_(self) -> NDArray[np.float64]:
        """Probability of each symbol in each state."""
        return np.asarray(self._fitted.emission)


class GMMHMM(_Hmm):
    """HMM over frames with a mixture of Gaussians of diagonal covariance in each state, as hmmlearn's GMMHMM.

    Keywords are those of `GaussianMixtureHmmOptions`. Frames are scored in float32.

    Attributes
    ----------
    weights_ : ndarray of float64, shape (num_states, num_mixtures)
    means_, covars_ : ndarray of float64, shape (num_states, num_mixtures, num_features)
    n_features_in_ : int
    """

    _native_class = GaussianMixtureHmm
    _options_class = GaussianMixtureHmmOptions

    @keywords_of(GaussianMixtureHmmOptions)
    def __init__(self, **params: Any) -> None:
        super().__init__(**params)

    def _sequences(self, X: Any, lengths: Sequence[int] | None) -> list[Any]:
        width = None if self._model is None else self._model.dim
        return list(_split(as_rows(X, type(self).__name__, width), lengths))

    def fit(self, X: ArrayLike, lengths: Sequence[int] | None = None) -> Self:
        """Baum-Welch over all sequences of `X`, shape (num_frames, num_features)."""
        before, self._model = self._model, None
        try:
            return super().fit(X, lengths)
        except BaseException:
            self._model = before
            raise

    @property
    def n_features_in_(self) -> int:
        """Columns of the frames."""
        return int(self._fitted.dim)

    @property
    def weights_(self) -> NDArray[np.float64]:
        """Weight of every Gaussian in its state."""
        return np.asarray(self._fitted.weights)

    @property
    def means_(self) -> NDArray[np.float64]:
        """Means of the Gaussians, by state."""
        return self._by_state(self._fitted.means)

    @property
    def covars_(self) -> NDArray[np.float64]:
        """Variances of the Gaussians, by state."""
        return self._by_state(self._fitted.variances)

    def _by_state(self, values: Any) -> NDArray[np.float64]:
        num_states, num_mixtures = self._fitted.weights.shape
        return np.asarray(values).reshape(num_states, num_mixtures, -1)


class GaussianHMM(GMMHMM):
    """HMM over frames with one Gaussian of diagonal covariance in each state, as hmmlearn's GaussianHMM.

    Keywords are those of `GaussianMixtureHmmOptions`; ``num_mixtures`` has to be 1.

    Attributes
    ----------
    means_, covars_ : ndarray of float64, shape (num_states, num_features)
    """

    @keywords_of(GaussianMixtureHmmOptions)
    def __init__(self, **params: Any) -> None:
        super().__init__(**params)

    def _options(self) -> Any:
        options = super()._options()
        if options.num_mixtures != 1:
            raise InvalidArgument(f"num_mixtures is {options.num_mixtures}, a GaussianHMM has 1: use GMMHMM")
        return options

    def _by_state(self, values: Any) -> NDArray[np.float64]:
        return np.asarray(values)


def _split(values: NDArray[Any], lengths: Sequence[int] | None) -> Iterator[NDArray[Any]]:
    if lengths is None:
        lengths = [len(values)]
    counts = [int(n) for n in lengths]
    if sum(counts) != len(values) or min(counts, default=0) < 1:
        raise InvalidArgument(f"lengths must be at least 1 each and add up to {len(values)}, got {counts}")
    ends = np.cumsum(counts)
    return (values[end - count : end] for end, count in zip(ends, counts, strict=True))
