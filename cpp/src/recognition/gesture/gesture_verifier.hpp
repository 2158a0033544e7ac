// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Was that one of the gestures at all? A logistic regression weighs the confidence features that a
// scorer gives. It is learned from gestures held out: those decided upon rightly, against those
// whose class the scorer had never seen.
#pragma once

#include <vector>

#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"
#include "hri/models/classifiers/logistic_regression.hpp"
#include "recognition/gesture/gesture_scorer.hpp"

namespace hri::detail {

/// Empty where there are too few of either kind to learn from.
LogisticRegression train_gesture_verifier(const std::vector<VectorD>& right,
                                          const std::vector<VectorD>& unknown);

/// Log odds that it was one of the gestures, by what a scorer gives of it: its
/// confidence_features(), and its movement_score(). A hand that rather rests than moves is none,
/// whatever else speaks for it: it gets less than any that moves.
float log_odds(const LogisticRegression& verifier, const VectorD& features, float movement);

/// How sure it is that the rows of a gesture are one of those trained on, larger is surer: log
/// odds, or the score of the scorer where nothing was learned. `scores` are those of the scorer.
float verified_score(const LogisticRegression& verifier, const GestureScorer& scorer,
                     ConstMatrixRefF rows, const VectorF& scores);

void write_gesture_verifier(const LogisticRegression& verifier, ModelFile& file);
/// Throws FormatError where the weights do not fit `num_confidence_features`. A file without a
/// verifier gives an empty one.
LogisticRegression read_gesture_verifier(const ModelFile& file,
                                         Eigen::Index num_confidence_features);

}  // namespace hri::detail
