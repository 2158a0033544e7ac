// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// From raw scores to probabilities and to rejection, learned on held-out people.
// Posterior by temperature scaling, P(c) = softmax(a s_c) (Guo et al., "On calibration of modern
// neural networks", ICML 2017); rejection by a quantile of the score of correct held-out
// decisions. Each class has an operating point of its own besides, from its false alarms and
// misses.
#pragma once

#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"
#include "hri/recognition/decision.hpp"

namespace hri {

/// One held-out decision: its scores by class, its true class, and the score for its best class.
struct HeldOut {
  VectorF scores;
  int truth = 0;
  float score = 0;
};

/// How often right decisions may be rejected.
struct RejectionRates {
  double false_reject = 0.02;  ///< share of right decisions
  /// Whether thresholds lie between scores, at the median-unbiased estimate of the quantile
  /// (Hyndman and Fan, "Sample quantiles in statistical packages", 1996, definition 8). Of few
  /// decisions, a threshold at one of them rejects more right ones than it was to.
  bool interpolate = false;
};

class HRI_API Calibration {
 public:
  /// Share of held-out samples of other classes that may be misrecognised as a class at or above
  /// its threshold, and share of its own right decisions that may lie below.
  static constexpr double kMaxFalseAlarmRate = 0.005;
  static constexpr double kMaxMissRate = 0.05;
  /// No class threshold lies below: a decision that is more likely wrong than right is not sure.
  static constexpr float kMinClassThreshold = 0.5F;

  Calibration() = default;

  /// Fits the scale to the least negative log-likelihood of `held_out`, or, where all n of these
  /// are right, to their mean confidence (n + 1) / (n + 2), Laplace's rule of succession, as the
  /// likelihood has no maximum then; and the threshold to the quantile rates.false_reject (0..0.5)
  /// of the score of its correct decisions. A class threshold is the least confidence at which the
  /// class keeps to kMaxFalseAlarmRate, or the largest that keeps to kMaxMissRate where both cannot
  /// be met, but at least kMinClassThreshold. Where `held_out` is empty or never right, nothing is
  /// fitted: see is_fitted().
  static Calibration fit(const std::vector<HeldOut>& held_out, const RejectionRates& rates);

  /// softmax(scale * scores), computed in float.
  [[nodiscard]] VectorF posterior(const VectorF& scores) const;

  /// The decision for `scores` (one per label) and `score`.
  [[nodiscard]] Decision decide(const VectorF& scores, float score,
                                const std::vector<std::string>& labels) const;

  /// Whether a decision with `score` is recognised, not unknown; never of NaN or infinity.
  [[nodiscard]] bool accepts(float score) const;

  /// Whether decisions on held-out people were there to learn from. Where none were, nothing is
  /// rejected, and probabilities are the softmax of the scores as they are: near 0 or 1 of
  /// log-likelihoods, whether right or wrong.
  [[nodiscard]] bool is_fitted() const { return threshold_ > kNoThreshold; }

  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] double threshold() const { return threshold_; }
  /// One a label (see Decision::class_threshold); empty where training found none.
  [[nodiscard]] const VectorF& class_thresholds() const { return class_thresholds_; }

  /// With one class more, which gets the number `index`; as nothing was held out of it, its
  /// threshold is the largest of the others.
  [[nodiscard]] Calibration with_class(int index) const;
  /// Without one class.
  [[nodiscard]] Calibration without_class(int index) const;

  void write(ModelFile& file) const;
  static Calibration read(const ModelFile& file);

 private:
  static constexpr double kNoThreshold = -1e30;

  double scale_ = 1.0;
  double threshold_ = kNoThreshold;
  VectorF class_thresholds_;
};

}  // namespace hri
