// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/pair_rows.hpp"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/features/hand/two_hand_features.hpp"

namespace hri {
namespace {

using Eigen::Index;

constexpr double kLeastShare = 0.2;  // of the frames, for a hand that takes part
enum Side : std::size_t { kLeftHand, kRightHand };

bool seen(ConstMatrixRefF rows, Index t) { return !std::isnan(rows(t, 0)); }

void check(ConstMatrixRefF rows, const char* name) {
  for (Index t = 0; t < rows.rows(); ++t) {
    const bool whole = rows.row(t).allFinite();
    if (whole || rows.row(t).array().isNaN().all()) continue;
    fail(ErrorKind::invalid_argument,
         std::string(name) + ": row " + std::to_string(t) + " is NaN in part, or infinite");
  }
}

// For every frame of `frames` the row that the hand has there: its own, that of the last frame
// before that shows it, or that of the first one.
std::vector<Index> rows_that_stay(ConstMatrixRefF rows, const std::vector<Index>& frames) {
  Index now = 0;
  while (!seen(rows, now)) ++now;
  std::vector<Index> result;
  for (const Index t : frames) {
    if (t > now && seen(rows, t)) now = t;
    result.push_back(now);
  }
  return result;
}

void write_shape(ConstMatrixRefF rows, Index t, MatrixRefF out, Index row, Index column) {
  const auto shape = rows.row(t).head(rows.cols() - kNumPlaceColumns);
  const float length = shape.norm();
  if (length > 0) out.row(row).segment(column, shape.size()) = shape / length;
}

}  // namespace

MatrixF pair_rows(ConstMatrixRefF left, ConstMatrixRefF right, double relation_weight) {
  require(left.rows() == right.rows() && left.cols() == right.cols(),
          "rows of the left and of the right hand differ in number or columns");
  require(left.cols() > kNumPlaceColumns, "rows of a hand need columns besides its place");
  require(std::isfinite(relation_weight) && relation_weight >= 0,
          "relation_weight must be finite and at least 0");
  check(left, "left");
  check(right, "right");
  std::vector<Index> frames;
  std::array<double, 2> count{};
  for (Index t = 0; t < left.rows(); ++t) {
    const bool l = seen(left, t);
    const bool r = seen(right, t);
    if (l || r) frames.push_back(t);
    count[kLeftHand] += l ? 1 : 0;
    count[kRightHand] += r ? 1 : 0;
  }
  const auto num_frames = static_cast<Index>(frames.size());
  const Index num_shapes = left.cols() - kNumPlaceColumns;
  MatrixF out = MatrixF::Zero(num_frames, num_pair_features(static_cast<int>(left.cols())));
  if (num_frames == 0) return out;
  const double least = kLeastShare * static_cast<double>(num_frames);
  const bool alone = count[kLeftHand] < least || count[kRightHand] < least;
  const bool left_alone = alone && count[kLeftHand] > count[kRightHand];
  const ConstMatrixRefF& first = left_alone ? left : right;
  const std::vector<Index> of_first = rows_that_stay(first, frames);
  for (Index i = 0; i < num_frames; ++i) {
    const Index t = of_first[static_cast<std::size_t>(i)];
    write_shape(first, t, out, i, 0);
    out.row(i).tail(kNumPlaceColumns) = first.row(t).tail(kNumPlaceColumns);
  }
  if (alone) return out;
  const std::vector<Index> of_left = rows_that_stay(left, frames);
  MatrixF tracks = MatrixF::Zero(num_frames, kNumTwoHandTrackColumns);
  for (Index i = 0; i < num_frames; ++i) {
    const Index l = of_left[static_cast<std::size_t>(i)];
    write_shape(left, l, out, i, num_shapes);
    const auto place = out.row(i).tail(kNumPlaceColumns);
    const auto other = left.row(l).tail(kNumPlaceColumns);
    tracks.row(i).segment(0, 2) = other.head(2);
    tracks.row(i).segment(2, 2) = place.head(2);
    const float area = std::log(std::exp(place[2]) + std::exp(other[2]));
    out.row(i).tail(kNumPlaceColumns) = 0.5F * (place + other);
    out(i, out.cols() - 1) = area;
  }
  TwoHandFeatureOptions options;
  options.use_relation = true;
  options.delta_orders = 0;
  out.middleCols(2 * num_shapes, kNumRelationColumns) =
      static_cast<float>(relation_weight) *
      TwoHandFeatureComputer(options).compute(tracks, 1.0).rightCols(kNumRelationColumns);
  return out;
}

MatrixF track_rows(ConstMatrixRefF tracks, double scale_px, int num_hands) {
  require(num_hands == 1 || num_hands == 2, "num_hands must be 1 or 2");
  TwoHandFeatureOptions options;
  options.use_left = num_hands == 2;
  options.delta_orders = 0;
  const TwoHandFeatureComputer computer(options);
  const double scale = scale_px == 0 ? hand_scale_px(tracks) : scale_px;
  MatrixF out = MatrixF::Zero(tracks.rows(), computer.num_features() + kNumPlaceColumns);
  const MatrixF places = computer.compute(tracks, scale);
  out.leftCols(places.cols()) = places;
  for (int hand = 0; hand < num_hands; ++hand)
    out.middleCols(places.cols(), 2) +=
        places.middleCols(2 * hand, 2) / static_cast<float>(num_hands);
  return out;
}

}  // namespace hri
