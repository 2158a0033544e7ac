// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// How the vectors of words are scored, chosen on words of speakers held out: the shrinkage of their
// covariance, the unit of distance, and the weight beside the streams of cepstra.
#pragma once

#include <vector>

#include "hri/core/stop_check.hpp"
#include "hri/core/types.hpp"
#include "hri/models/classifiers/lda_scorer.hpp"

namespace hri::detail {

/// The vectors of one training word and its copies.
struct LabelledVectors {
  int label = 0;
  int fold = 0;
  std::vector<const MatrixF*> vectors;
};

/// The scoring under which linear discriminants alone are right most often on the folds held out:
/// how far the covariance can be trusted depends on how many people spoke. `shrinkage` 0: chosen.
/// The weight of the result makes the words held out lie 1 a discriminant off their means, in the
/// mean square. `folds`: those without which every class is left.
VectorScoring choose_lda(const std::vector<LabelledVectors>& words, int num_classes,
                         const std::vector<int>& folds, const ClassSequences& fillers,
                         double shrinkage, const StopCheck& should_stop);

/// A word held out, as streams and vectors score it.
struct HeldOutScores {
  VectorF streams;
  VectorF vectors;
  int label = 0;
};

/// The factor on the scores of vectors with which their sum with those of streams predicts the
/// label best: of least cross-entropy, at the temperature that suits it best.
double choose_vector_weight(const std::vector<HeldOutScores>& words);

}  // namespace hri::detail
