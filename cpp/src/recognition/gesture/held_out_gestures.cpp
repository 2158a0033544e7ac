// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/gesture/held_out_gestures.hpp"

#include "recognition/gesture/gesture_verifier.hpp"

namespace hri::detail {

void HeldOutGestures::add_gesture(const MatrixF& rows, int label, const GestureScorer& scorer) {
  const VectorF scores = scorer.scores(rows);
  decisions_.push_back({scores, label, 0});
  evidence_.push_back(evidence(rows, scores, scorer));
}

void HeldOutGestures::add_unknown(const MatrixF& rows, const GestureScorer& scorer) {
  unknown_.push_back(evidence(rows, scorer.scores(rows), scorer));
}

GestureJudgement HeldOutGestures::judge(const GestureRecognizerOptions& options,
                                        const std::vector<std::string>& labels) const {
  GestureJudgement result;
  result.verifier = learn_verifier();
  std::vector<HeldOut> decisions = decisions_;
  for (std::size_t i = 0; i < decisions.size(); ++i)
    decisions[i].score = score(result.verifier, evidence_[i]);
  std::vector<float> others;
  others.reserve(unknown_.size());
  for (const Evidence& other : unknown_) others.push_back(score(result.verifier, other));
  RejectionRates rates;
  rates.false_reject = options.false_reject_rate;
  rates.interpolate = true;
  result.calibration = Calibration::fit(decisions, rates);
  result.report = HeldOutReport::from_decisions(labels, decisions, others, result.calibration);
  return result;
}

HeldOutGestures::Evidence HeldOutGestures::evidence(const MatrixF& rows, const VectorF& scores,
                                                    const GestureScorer& scorer) {
  return {scorer.confidence_features(rows, scores), scorer.movement_score(rows),
          verified_score({}, scorer, rows, scores)};
}

float HeldOutGestures::score(const LogisticRegression& verifier, const Evidence& evidence) {
  if (verifier.dim() == 0) return evidence.unverified;
  return log_odds(verifier, evidence.confidence_features, evidence.movement);
}

// Weighs what speaks for right decisions.
LogisticRegression HeldOutGestures::learn_verifier() const {
  std::vector<VectorD> right;
  for (std::size_t i = 0; i < decisions_.size(); ++i) {
    Eigen::Index best = 0;
    decisions_[i].scores.maxCoeff(&best);
    if (best == decisions_[i].truth) right.push_back(evidence_[i].confidence_features);
  }
  std::vector<VectorD> unknown;
  unknown.reserve(unknown_.size());
  for (const Evidence& other : unknown_) unknown.push_back(other.confidence_features);
  return train_gesture_verifier(right, unknown);
}

}  // namespace hri::detail
