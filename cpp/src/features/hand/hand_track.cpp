// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/hand_track.hpp"

#include <cmath>
#include <string>

#include "hri/core/error.hpp"
#include "hri/features/hand/shape_moments.hpp"
#include "hri/features/speech/dynamics.hpp"

namespace hri {
namespace {

// Where the hand is; false for an empty mask.
bool place(ImageView mask, float* row) {
  const ShapeMoments m = shape_moments(mask);
  if (!(m.m00 > 0)) return false;
  const double height = mask.height_px;
  const ShapeAxis axis = shape_axis(m);
  row[0] = static_cast<float>((m.m10 / m.m00 + 0.5) / height);
  row[1] = static_cast<float>((m.m01 / m.m00 + 0.5) / height);
  row[2] = static_cast<float>(std::log(m.m00 / (height * mask.width_px)));
  row[3] = static_cast<float>(axis.elongation * std::cos(2 * axis.angle_rad));
  row[4] = static_cast<float>(axis.elongation * std::sin(2 * axis.angle_rad));
  return true;
}

}  // namespace

HandTrackComputer::HandTrackComputer(const HandTrackOptions& options)
    : options_(validated(options)) {}

Eigen::Index HandTrackComputer::compute(Span<const ImageView> masks, MatrixRefF out) const {
  require(out.rows() == static_cast<Eigen::Index>(masks.size()) && out.cols() == num_features(),
          "out must have a row for every mask and num_features() columns");
  Eigen::Index used = 0;
  std::size_t last_frame = 0;
  for (std::size_t i = 0; i < masks.size(); ++i) {
    const ImageView& mask = masks[i];
    if (mask.width_px != masks[0].width_px || mask.height_px != masks[0].height_px) {
      fail(ErrorKind::invalid_argument,
           "masks: " + std::to_string(i) + " has another size than the first");
    }
    float* row = out.data() + used * out.outerStride();
    if (mask.empty() || !place(mask, row)) continue;
    row[5] = row[6] = row[7] = 0;
    if (used > 0) {
      const float* before = row - out.outerStride();
      const float dx = row[0] - before[0];
      const float dy = row[1] - before[1];
      const float way = std::hypot(dx, dy);
      const auto frames = static_cast<double>(i - last_frame);
      row[5] = static_cast<float>(way * options_.frames_per_second / frames);
      if (way > 0) {
        row[6] = dx / way;
        row[7] = dy / way;
      }
    }
    last_frame = i;
    ++used;
  }
  for (int order = 0; order < options_.delta_orders; ++order) {
    append_deltas(out.topRows(used), order * kNumHandTrackColumns, kNumHandTrackColumns,
                  options_.delta_window);
  }
  return used;
}

MatrixF HandTrackComputer::compute(Span<const ImageView> masks) const {
  MatrixF out(static_cast<Eigen::Index>(masks.size()), num_features());
  const Eigen::Index used = compute(masks, out);
  return out.topRows(used);
}

}  // namespace hri
