// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/gesture/gesture_scorer.hpp"

#include <algorithm>
#include <limits>

#include "hri/core/error.hpp"

namespace hri::detail {
namespace {

bool has_states(GestureModel model) {
  return model == GestureModel::hmm || model == GestureModel::ptbhmm;
}

}  // namespace

double margin(const VectorF& scores, Eigen::Index best) {
  float second = -std::numeric_limits<float>::infinity();
  for (Eigen::Index c = 0; c < scores.size(); ++c) {
    if (c != best) second = std::max(second, scores[c]);
  }
  return static_cast<double>(scores[best] - second);
}

StackedRows stack_rows(const std::vector<std::vector<MatrixF>>& per_class) {
  Eigen::Index count = 0;
  for (const auto& gestures : per_class) {
    for (const MatrixF& g : gestures) count += g.rows();
  }
  StackedRows all;
  all.rows.resize(count, per_class.front().front().cols());
  Eigen::Index at = 0;
  for (std::size_t c = 0; c < per_class.size(); ++c) {
    for (const MatrixF& g : per_class[c]) {
      require(g.cols() == all.rows.cols(), "all gestures need the same number of features");
      all.rows.middleRows(at, g.rows()) = g;
      all.classes.insert(all.classes.end(), static_cast<std::size_t>(g.rows()),
                         static_cast<int>(c));
      at += g.rows();
    }
  }
  return all;
}

std::shared_ptr<const GestureScorer> train_gesture_scorer(
    const std::vector<std::vector<MatrixF>>& per_class, const GestureRecognizerOptions& options,
    const StopCheck& should_stop) {
  if (options.model == GestureModel::trajectory)
    return train_trajectory_scorer(per_class, options, should_stop);
  return has_states(options.model) ? train_sequence_gesture_scorer(per_class, options, should_stop)
                                   : train_vote_scorer(per_class, options, should_stop);
}

std::shared_ptr<const GestureScorer> extend_gesture_scorer(const GestureScorer& scorer, int index,
                                                           const std::vector<MatrixF>& gestures,
                                                           const GestureRecognizerOptions& options,
                                                           const StopCheck& should_stop) {
  if (options.model == GestureModel::trajectory)
    return extend_trajectory_scorer(scorer, index, gestures, options, should_stop);
  return has_states(options.model)
             ? extend_sequence_gesture_scorer(scorer, index, gestures, should_stop)
             : extend_vote_scorer(scorer, index, gestures, options, should_stop);
}

std::shared_ptr<const GestureScorer> read_gesture_scorer(const ModelFile& file,
                                                         const GestureRecognizerOptions& options,
                                                         int num_classes) {
  if (options.model == GestureModel::trajectory) return read_trajectory_scorer(file, num_classes);
  return has_states(options.model) ? read_sequence_gesture_scorer(file, options, num_classes)
                                   : read_vote_scorer(file, options, num_classes);
}

}  // namespace hri::detail
