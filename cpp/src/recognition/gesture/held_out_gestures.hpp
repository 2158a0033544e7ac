// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Decisions on gestures held out, by scorers that have not seen them: what verifier, calibration
// and the report of a training are made from.
#pragma once

#include <string>
#include <vector>

#include "hri/core/types.hpp"
#include "hri/models/classifiers/logistic_regression.hpp"
#include "hri/recognition/calibration.hpp"
#include "hri/recognition/held_out_report.hpp"
#include "recognition/gesture/gesture_scorer.hpp"

namespace hri::detail {

/// How a recogniser rejects, and how well it did on the gestures held out.
struct GestureJudgement {
  LogisticRegression verifier;
  Calibration calibration;
  HeldOutReport report;
};

class HeldOutGestures {
 public:
  /// The rows of a gesture of class `label`, by a scorer that knows the class.
  void add_gesture(const MatrixF& rows, int label, const GestureScorer& scorer);
  /// The rows of a gesture whose class `scorer` knows nothing of.
  void add_unknown(const MatrixF& rows, const GestureScorer& scorer);

  /// `labels`: names of the classes.
  [[nodiscard]] GestureJudgement judge(const GestureRecognizerOptions& options,
                                       const std::vector<std::string>& labels) const;

 private:
  // What the score of a gesture is made from, with a verifier and without.
  struct Evidence {
    VectorD confidence_features;
    float movement = 0;
    float unverified = 0;
  };
  static Evidence evidence(const MatrixF& rows, const VectorF& scores, const GestureScorer& scorer);
  static float score(const LogisticRegression& verifier, const Evidence& evidence);
  [[nodiscard]] LogisticRegression learn_verifier() const;

  std::vector<HeldOut> decisions_;
  std::vector<Evidence> evidence_;  // of each decision
  std::vector<Evidence> unknown_;   // of gestures whose class was left out
};

}  // namespace hri::detail
