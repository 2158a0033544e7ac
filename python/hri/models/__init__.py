# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Models: HMMs, possibility theory, codebooks, classifiers and projections of rows.

Estimators have scikit-learn's methods (HMMs hmmlearn's) and work in its pipelines and searches.
"""

from hri._native import (
    CodebookOptions,
    CodebookReport,
    DiscreteHmm,
    DiscreteHmmOptions,
    DiscreteHmmStream,
    FixedPointHmmSet,
    GaussianMixture,
    GaussianMixtureHmm,
    GaussianMixtureHmmOptions,
    GaussianMixtureHmmStream,
    GaussianMixtureOptions,
    MarkovChain,
    MultiStreamCodebook,
    PossibilisticGaussianHmmSet,
    PossibilisticHmmOptions,
    PossibilisticHmmSet,
    PossibilisticHmmStream,
    PossibilisticRule,
    StateChoice,
    StateChoiceOptions,
    Topology,
    TrainingReport,
    choose_num_states,
    initial_start,
    initial_transition,
)
from hri.models.classifiers import (
    Classifier,
    DistanceClassifier,
    GaussianBayes,
    KnnClassifier,
    LinearSvm,
    LogisticRegression,
    PossibilityClassifier,
    RbfClassifier,
)
from hri.models.codebook import Codebook
from hri.models.distances import bhattacharyya_gaussian, distance
from hri.models.hmm import GMMHMM, CategoricalHMM, GaussianHMM
from hri.models.possibility import PTBHMM, necessity_of, possibilities, possibility_of
from hri.models.projections import LDA, PCA

__all__ = [
    "GMMHMM",
    "LDA",
    "PCA",
    "PTBHMM",
    "CategoricalHMM",
    "Classifier",
    "Codebook",
    "CodebookOptions",
    "CodebookReport",
    "DiscreteHmm",
    "DiscreteHmmOptions",
    "DiscreteHmmStream",
    "DistanceClassifier",
    "FixedPointHmmSet",
    "GaussianBayes",
    "GaussianHMM",
    "GaussianMixture",
    "GaussianMixtureHmm",
    "GaussianMixtureHmmOptions",
    "GaussianMixtureHmmStream",
    "GaussianMixtureOptions",
    "KnnClassifier",
    "LinearSvm",
    "LogisticRegression",
    "MarkovChain",
    "MultiStreamCodebook",
    "PossibilisticGaussianHmmSet",
    "PossibilisticHmmOptions",
    "PossibilisticHmmSet",
    "PossibilisticHmmStream",
    "PossibilisticRule",
    "PossibilityClassifier",
    "RbfClassifier",
    "StateChoice",
    "StateChoiceOptions",
    "Topology",
    "TrainingReport",
    "bhattacharyya_gaussian",
    "choose_num_states",
    "distance",
    "initial_start",
    "initial_transition",
    "necessity_of",
    "possibilities",
    "possibility_of",
]
