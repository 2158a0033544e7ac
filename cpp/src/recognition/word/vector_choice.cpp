// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/word/vector_choice.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "core/parallel_for.hpp"

namespace hri::detail {
namespace {

constexpr std::array<double, 4> kShrinkages{0.8, 0.5, 0.2, 0.05};
constexpr std::array<double, 7> kWeights{10, 5, 20, 2, 50, 1, 100};  // of equals the first
constexpr double kLeastTemperature = 1;
constexpr double kTemperatureStep = 1.4;
constexpr int kNumTemperatures = 24;

// Words of one fold, scored by linear discriminants trained on the others.
struct FoldScores {
  int num_right = 0;
  double spread = 0;  // sum of the mean squares by which a discriminant misses its mean
  int count = 0;
};

FoldScores score_fold(const std::vector<LabelledVectors>& words, int num_classes, int fold,
                      const ClassSequences& fillers, double shrinkage) {
  ClassSequences classes(static_cast<std::size_t>(num_classes));
  for (const LabelledVectors& word : words) {
    if (word.fold == fold) continue;
    for (const MatrixF* vector : word.vectors)
      classes[static_cast<std::size_t>(word.label)].push_back(*vector);
  }
  const LdaScorer scorer = LdaScorer::train(classes, fillers, {shrinkage, 1});
  FoldScores result;
  for (const LabelledVectors& word : words) {
    if (word.fold != fold) continue;
    for (const MatrixF* vector : word.vectors) {
      const VectorF scores = scorer.scores(*vector);
      Eigen::Index best = 0;
      scores.maxCoeff(&best);
      result.num_right += best == word.label ? 1 : 0;
      result.spread += -2.0 * static_cast<double>(scores[word.label]) / scorer.num_components();
      result.count += 1;
    }
  }
  return result;
}

// Minus the mean log posterior of the label.
double cross_entropy(const std::vector<HeldOutScores>& words, double weight, double temperature) {
  double sum = 0;
  for (const HeldOutScores& word : words) {
    const VectorD scores =
        (word.streams.cast<double>() + weight * word.vectors.cast<double>()) / temperature;
    const double best = scores.maxCoeff();
    sum += best + std::log((scores.array() - best).exp().sum()) - scores[word.label];
  }
  return sum / static_cast<double>(words.size());
}

}  // namespace

VectorScoring choose_lda(const std::vector<LabelledVectors>& words, int num_classes,
                         const std::vector<int>& folds, const ClassSequences& fillers,
                         double shrinkage, const StopCheck& should_stop) {
  std::vector<double> shrinkages{shrinkage};
  if (shrinkage == 0) shrinkages.assign(kShrinkages.begin(), kShrinkages.end());
  const std::size_t num = shrinkages.size();
  std::vector<FoldScores> found(folds.size() * num);
  parallel_for(found.size(), should_stop, [&](std::size_t i, const StopCheck&) {
    found[i] = score_fold(words, num_classes, folds[i / num], fillers, shrinkages[i % num]);
  });
  VectorScoring result{shrinkages.front(), 1};
  int most = -1;
  for (std::size_t k = 0; k < num; ++k) {
    FoldScores sum;
    for (std::size_t i = k; i < found.size(); i += num) {
      sum.num_right += found[i].num_right;
      sum.spread += found[i].spread;
      sum.count += found[i].count;
    }
    if (sum.num_right <= most || !(sum.spread > 0)) continue;
    most = sum.num_right;
    result = {shrinkages[k], sum.count / sum.spread};
  }
  return result;
}

double choose_vector_weight(const std::vector<HeldOutScores>& words) {
  double result = kWeights.front();
  if (words.empty()) return result;
  double least = std::numeric_limits<double>::infinity();
  for (const double weight : kWeights) {
    double temperature = kLeastTemperature;
    for (int t = 0; t < kNumTemperatures; ++t, temperature *= kTemperatureStep) {
      const double entropy = cross_entropy(words, weight, temperature);
      if (entropy >= least) continue;
      least = entropy;
      result = weight;
    }
  }
  return result;
}

}  // namespace hri::detail
