// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Models of signs for SentenceRecognizer: an HMM of every word, by Viterbi training (segmental
// k-means: Juang and Rabiner, IEEE Trans. ASSP 38(9), 1990) with the variances of all words as the
// prior of each, and variants of it, one a recording.
#pragma once

#include <utility>
#include <vector>

#include "hri/core/stop_check.hpp"
#include "hri/models/sequence_scorer.hpp"
#include "hri/recognition/sentence/sentence_recognizer.hpp"

namespace hri::detail {

/// Frames of a variant, and transitions between the frames of all variants, at most.
inline constexpr Eigen::Index kLongestVariant = 1000;
inline constexpr Eigen::Index kMostTransitions = Eigen::Index{1} << 24;

struct SignModels {
  std::vector<GaussianMixtureHmm> hmms;  ///< of every word, left-right
  VectorD final_stays;                   ///< of every word, to stay in the last state
  std::vector<SignVariant> variants;     ///< in the order of the words
};

/// Of the recordings of every word, each of at least one frame.
SignModels train_sign_models(const ClassSequences& words, const SentenceRecognizerOptions& options,
                             const StopCheck& should_stop);

/// The Gaussians of a variant, a state a frame: the mean lies between that of the word's state and
/// the frame, by variant_weight; the variance is that of the state by variant_variance.
GaussianMixtureHmm variant_model(const SignVariant& variant, const GaussianMixtureHmm& word,
                                 const SentenceRecognizerOptions& options);

/// How a recording is followed: a frame of it may last, and one may be left out, the first and the
/// last among them.
WordChain variant_chain(int num_states);

}  // namespace hri::detail
