// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/gesture/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "recognition/gesture/gesture_scorer.hpp"

namespace hri::detail {
namespace {

constexpr Eigen::Index kMaxRows = 32;       // more frames than that only add noise to the steps
constexpr double kStillQuantile = 0.25;     // the stillest steps give the noise of the shapes
constexpr float kNoiseMargin = 1.5F;        // times that, which does not count as change
constexpr float kTimeShare = 0.5F;          // weight of even spacing in time beside change
constexpr float kStepTrackScale = 4.0F;     // of the hand's place beside its shape, in a step
constexpr float kVectorTrackScale = 0.85F;  // and in the vector
constexpr double kPauseShare = 0.08;        // of a gesture's frames that a pause takes at least
constexpr float kPauseChange = 0.05F;       // share of all change that may lie in a pause
constexpr float kStrokeChange = 0.15F;      // and that makes a stroke
constexpr float kReturned = 0.5F;  // of the way out: a hand that ends closer to its start came back
constexpr float kChangeWeight = 1.41F;  // of what changes in a shape, beside what stays
constexpr float kVectorLength = 3.0F;   // of an average vector, to suit a cost of 1
constexpr float kTrackUnits[kNumTrackColumns] = {1.0F, 0.75F, 0.25F};  // x, y, log area

MatrixF thinned(ConstMatrixRefF rows) {
  if (rows.rows() <= kMaxRows) return rows;
  MatrixF result(kMaxRows, rows.cols());
  for (Eigen::Index i = 0; i < kMaxRows; ++i) {
    const auto at = static_cast<double>(i * (rows.rows() - 1)) / (kMaxRows - 1);
    result.row(i) = rows.row(static_cast<Eigen::Index>(std::lround(at)));
  }
  return result;
}

// Mean of every row and its neighbours; the ends repeat.
MatrixF smoothed(const MatrixF& rows) {
  MatrixF result(rows.rows(), rows.cols());
  const Eigen::Index last = rows.rows() - 1;
  for (Eigen::Index t = 0; t <= last; ++t) {
    result.row(t) = (rows.row(std::max<Eigen::Index>(t - 1, 0)) + rows.row(t) +
                     rows.row(std::min(t + 1, last))) /
                    3.0F;
  }
  return result;
}

// Which share of all change lies before every row, 0 to 1; all 0 where nothing changes.
std::vector<float> change_before(const MatrixF& rows) {
  const Eigen::Index num_steps = rows.rows() - 1;
  const MatrixF smooth = smoothed(rows);
  std::vector<float> steps(static_cast<std::size_t>(num_steps));
  for (Eigen::Index t = 0; t < num_steps; ++t)
    steps[static_cast<std::size_t>(t)] = (smooth.row(t + 1) - smooth.row(t)).norm();
  std::vector<float> sorted = steps;
  const auto still = sorted.begin() + static_cast<std::ptrdiff_t>(
                                          kStillQuantile * static_cast<double>(num_steps - 1));
  std::nth_element(sorted.begin(), still, sorted.end());
  std::vector<float> result{0};
  for (const float s : steps)
    result.push_back(result.back() + std::max(s - kNoiseMargin * *still, 0.0F));
  const float sum = result.back();
  if (sum > 0) {
    for (float& c : result) c /= sum;
  }
  return result;
}

// How far along the trajectory every row lies, from 0 to 1.
std::vector<float> positions(const MatrixF& rows) {
  std::vector<float> result = change_before(rows);
  const float step = kTimeShare / static_cast<float>(rows.rows() - 1);
  for (std::size_t t = 0; t < result.size(); ++t) result[t] += step * static_cast<float>(t);
  const float length = result.back();
  for (float& p : result) p /= length;
  return result;
}

// kNumPoints rows, evenly spaced along `at`, between which rows are interpolated.
MatrixF resampled(const MatrixF& rows, const std::vector<float>& at) {
  MatrixF result(kNumPoints, rows.cols());
  std::size_t next = 1;
  for (Eigen::Index i = 0; i < kNumPoints; ++i) {
    const float wanted = static_cast<float>(i) / (kNumPoints - 1);
    while (next + 1 < at.size() && at[next] < wanted) ++next;
    const float width = at[next] - at[next - 1];
    const float share = width > 0 ? std::clamp((wanted - at[next - 1]) / width, 0.0F, 1.0F) : 0.0F;
    const auto right = static_cast<Eigen::Index>(next);
    result.row(i) = (1 - share) * rows.row(right - 1) + share * rows.row(right);
  }
  return result;
}

// Shapes brought to unit length by `shape_scale`, beside the track in units of its own.
MatrixF scaled(MatrixF rows, float shape_scale) {
  constexpr Eigen::Index kTrack = kNumTrackColumns;
  const Eigen::Index num_shapes = rows.cols() - kTrack;
  rows.leftCols(num_shapes) *= shape_scale;
  for (Eigen::Index c = 0; c < kTrack; ++c)
    rows.col(num_shapes + c) *= kStepTrackScale * kTrackUnits[c];
  return rows;
}

}  // namespace

VectorF trajectory_vector(ConstMatrixRefF gesture, float shape_scale) {
  constexpr Eigen::Index kTrack = kNumTrackColumns;
  const MatrixF rows = scaled(thinned(gesture), shape_scale);
  MatrixF points(kNumPoints, rows.cols());
  if (rows.rows() == 1) {
    points.rowwise() = rows.row(0);
  } else {
    points = resampled(rows, positions(rows));
  }
  const Eigen::Index num_shapes = rows.cols() - kTrack;
  const VectorF stays = points.leftCols(num_shapes).colwise().mean();
  points.leftCols(num_shapes) = kChangeWeight * points.leftCols(num_shapes);
  points.leftCols(num_shapes).rowwise() += (1 - kChangeWeight) * stays.transpose();
  MatrixF track = points.rightCols(kTrack);
  track.rowwise() -= points.rightCols(kTrack).row(0);
  points.rightCols(kTrack) = kVectorTrackScale / kStepTrackScale * track;
  points *= kVectorLength / std::sqrt(static_cast<float>(kNumPoints));
  return Eigen::Map<const VectorF>(points.data(), points.size());
}

Rests find_rests(ConstMatrixRefF gesture, float shape_scale) {
  if (gesture.rows() < kFewRows) return {};
  const MatrixF rows = scaled(gesture, shape_scale);
  const std::vector<float> before = change_before(rows);
  const auto pause = std::max<std::size_t>(
      2, static_cast<std::size_t>(kPauseShare * static_cast<double>(before.size())));
  Rests found;
  if (before.back() <= 0 || before[pause] > kPauseChange) return found;
  found.first_stroke =
      std::upper_bound(before.begin(), before.end(), kPauseChange) - before.begin();
  const VectorF away =
      (smoothed(rows).rowwise() - rows.topRows(3).colwise().mean()).rowwise().norm();
  if (away[away.size() - 1] < kReturned * away.maxCoeff()) return found;
  for (std::size_t t = before.size() - 1; t >= pause; --t) {
    if (1 - before[t] < kStrokeChange || before[t] - before[t - pause] > kPauseChange) continue;
    // A pause before which nothing moved is the rest at the start.
    if (before[t] >= kStrokeChange) found.final_stroke = static_cast<Eigen::Index>(t);
    break;
  }
  return found;
}

double max_displacement(const VectorF& trajectory) {
  constexpr float kLeast = 0.05F;  // at which noise alone decides
  const Eigen::Map<const MatrixF> points(trajectory.data(), kNumPoints,
                                         trajectory.size() / kNumPoints);
  const float most = (points.rowwise() - points.row(0)).rowwise().norm().maxCoeff();
  return std::log(static_cast<double>(most + kLeast));
}

}  // namespace hri::detail
