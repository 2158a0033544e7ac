// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/gesture/key_frames.hpp"

#include <algorithm>
#include <vector>

#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr Eigen::Index kShortestClip = 8;
constexpr Eigen::Index kHalfWindow = 2;
constexpr float kStillness = 2.0F;  // times the change in the stillest quarter

// Change between consecutive rows, divided by its mean over the clip.
VectorF relative_change(ConstMatrixRefF columns) {
  const Eigen::Index steps = columns.rows() - 1;
  VectorF change = (columns.bottomRows(steps) - columns.topRows(steps)).rowwise().norm();
  const float mean = change.mean();
  if (mean > 0) change /= mean;
  return change;
}

VectorF smoothed(const VectorF& values) {
  VectorF result(values.size());
  for (Eigen::Index t = 0; t < values.size(); ++t) {
    const Eigen::Index first = std::max<Eigen::Index>(0, t - kHalfWindow);
    const Eigen::Index last = std::min(values.size(), t + kHalfWindow + 1);
    result[t] = values.segment(first, last - first).mean();
  }
  return result;
}

}  // namespace

FrameRange key_frames(ConstMatrixRefF features, Eigen::Index num_track_columns) {
  require(num_track_columns >= 0 && num_track_columns <= features.cols(),
          "num_track_columns must lie in 0..number of columns");
  if (features.rows() < kShortestClip) return {0, features.rows()};
  const VectorF change =
      smoothed(relative_change(features.leftCols(features.cols() - num_track_columns)) +
               relative_change(features.rightCols(num_track_columns)));
  std::vector<float> sorted(change.data(), change.data() + change.size());
  std::sort(sorted.begin(), sorted.end());
  const float limit = kStillness * sorted[sorted.size() / 4];

  // Step t lies between frames t and t + 1: a run of n still steps joins n + 1 frames.
  FrameRange best{0, 0};
  Eigen::Index first = 0;
  for (Eigen::Index t = 0; t <= change.size(); ++t) {
    if (t < change.size() && change[t] <= limit) continue;
    if (t > first && t + 1 - first > best.last - best.first) best = {first, t + 1};
    first = t + 1;
  }
  return best;
}

}  // namespace hri
