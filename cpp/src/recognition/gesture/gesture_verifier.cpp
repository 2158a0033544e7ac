// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/gesture/gesture_verifier.hpp"

#include <algorithm>
#include <string>

#include "hri/core/error.hpp"

namespace hri::detail {
namespace {

constexpr const char* kPrefix = "verifier.";
constexpr std::size_t kFewest = 20;  // trials of a kind; weights from fewer are chance
constexpr float kResting = -20;      // log odds that no moving hand falls below

}  // namespace

LogisticRegression train_gesture_verifier(const std::vector<VectorD>& right,
                                          const std::vector<VectorD>& unknown) {
  if (right.size() < kFewest || unknown.size() < kFewest) return {};
  const std::size_t count = right.size() + unknown.size();
  MatrixD rows(static_cast<Eigen::Index>(count), right.front().size());
  std::vector<int> yes;
  std::vector<double> weights;  // both kinds count alike
  yes.reserve(count);
  weights.reserve(count);
  for (const std::vector<VectorD>* kind : {&unknown, &right}) {
    for (const VectorD& features : *kind) {
      rows.row(static_cast<Eigen::Index>(yes.size())) = features.transpose();
      yes.push_back(kind == &right ? 1 : 0);
      weights.push_back(static_cast<double>(count) / 2 / static_cast<double>(kind->size()));
    }
  }
  return LogisticRegression::train(rows, yes, weights, {});
}

float log_odds(const LogisticRegression& verifier, const VectorD& features, float movement) {
  if (movement < 0) return kResting + movement;
  const double odds =
      verifier.log_odds({features.data(), static_cast<std::size_t>(features.size())});
  return std::max(static_cast<float>(odds), kResting);
}

float verified_score(const LogisticRegression& verifier, const GestureScorer& scorer,
                     ConstMatrixRefF rows, const VectorF& scores) {
  const float movement = scorer.movement_score(rows);
  if (verifier.dim() == 0) return scorer.verification_score(rows, scores) + movement;
  return log_odds(verifier, scorer.confidence_features(rows, scores), movement);
}

void write_gesture_verifier(const LogisticRegression& verifier, ModelFile& file) {
  if (verifier.dim() > 0) verifier.write(file, kPrefix);
}

LogisticRegression read_gesture_verifier(const ModelFile& file,
                                         Eigen::Index num_confidence_features) {
  if (!file.has(std::string(kPrefix) + "weights")) return {};
  LogisticRegression verifier = LogisticRegression::read(file, kPrefix);
  if (verifier.dim() != num_confidence_features) {
    fail(ErrorKind::format, file.name() + ": field '" + kPrefix + "weights' has " +
                                std::to_string(verifier.dim()) + " values, expected " +
                                std::to_string(num_confidence_features));
  }
  return verifier;
}

}  // namespace hri::detail
