// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/gesture/gesture_features.hpp"

#include <cmath>
#include <limits>

#include "hri/core/error.hpp"
#include "hri/features/hand/hand_place.hpp"
#include "recognition/gesture/gesture_scorer.hpp"

namespace hri {
namespace {

template <class Frames>
MatrixF rows_of(const GestureFeatureComputer& computer, const Frames& frames) {
  MatrixF rows(static_cast<Eigen::Index>(frames.size()), computer.num_features());
  Eigen::Index used = 0;
  for (const auto& frame : frames) {
    float* const row = rows.data() + used * rows.cols();
    if (computer.compute(frame, {row, static_cast<std::size_t>(rows.cols())})) ++used;
  }
  return rows.topRows(used);
}

}  // namespace

GestureFeatureComputer::GestureFeatureComputer(const HandFeatureOptions& options,
                                               double min_quality)
    : computer_(std::make_shared<const HandFeatureComputer>(options)), min_quality_(min_quality) {
  require(min_quality >= 0 && min_quality <= 1, "min_quality must lie in 0..1");
}

int GestureFeatureComputer::num_features() const {
  return computer_->num_features() + detail::kNumTrackColumns;
}

bool GestureFeatureComputer::compute(const HandImage& frame, Span<float> row) const {
  if (frame.mask.empty()) return false;
  const std::optional<HandPlace> place = hand_place(frame.mask);
  if (!place) return false;
  const auto shape = static_cast<std::size_t>(computer_->num_features());
  computer_->compute(frame.grey, frame.mask, row.subspan(0, shape));
  row[shape] = static_cast<float>(place->x);
  row[shape + 1] = static_cast<float>(place->y);
  row[shape + 2] = static_cast<float>(std::log(place->area));
  return true;
}

bool GestureFeatureComputer::compute(const HandObservation& hand, Span<float> row) const {
  if (hand.quality < min_quality_) return false;
  return compute(HandImage{hand.grey.view(), hand.mask.view()}, row);
}

MatrixF GestureFeatureComputer::compute(Span<const HandImage> frames) const {
  return rows_of(*this, frames);
}

MatrixF GestureFeatureComputer::compute(Span<const HandObservation> hands) const {
  return rows_of(*this, hands);
}

MatrixF GestureFeatureComputer::compute_every(Span<const HandObservation> hands) const {
  MatrixF rows(static_cast<Eigen::Index>(hands.size()), num_features());
  for (Eigen::Index t = 0; t < rows.rows(); ++t) {
    float* const row = rows.data() + t * rows.cols();
    if (!compute(hands[static_cast<std::size_t>(t)], {row, static_cast<std::size_t>(rows.cols())}))
      rows.row(t).setConstant(std::numeric_limits<float>::quiet_NaN());
  }
  return rows;
}

}  // namespace hri
