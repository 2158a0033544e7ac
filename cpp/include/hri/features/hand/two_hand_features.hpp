// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Features of both hands in every frame, from where they are: places relative to the head in
// lengths of the signer, polar coordinates, one hand to the other, and how all of it changes.
#pragma once

#include <array>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"

namespace hri {

/// Columns of tracks of two hands, in pixels from the upper left corner; NaN where there is none.
/// The reference is a point of the head, such as the nose.
constexpr int kNumTwoHandTrackColumns = 6;
inline constexpr std::array<const char*, kNumTwoHandTrackColumns> kTwoHandTrackColumns{
    "left_x", "left_y", "right_x", "right_y", "reference_x", "reference_y"};

struct HRI_API TwoHandFeatureOptions {
  bool use_left = true;
  bool use_polar = false;
  bool use_relation = false;
  int delta_orders = 2;
  int delta_window = 2;

  static constexpr const char* kName = "TwoHandFeatureOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("use_left", o.use_left, any_value, "the left hand beside the right one");
    v("use_polar", o.use_polar, any_value,
      "distance from the reference, cosine and sine of the direction, of each hand");
    v("use_relation", o.use_relation, any_value,
      "from the left hand to the right one: x, y and distance");
    v("delta_orders", o.delta_orders, within(0, 2), "derivatives appended");
    v("delta_window", o.delta_window, within(1, 10), "frames on each side of the regression");
  }
  /// nullptr, or which fields do not go together.
  [[nodiscard]] const char* conflict() const;
};

/// The length that places are divided by: the root mean square distance of the hands from the
/// reference, over the frames that show both points. Throws InvalidArgument as
/// TwoHandFeatureComputer::compute() does.
HRI_API double hand_scale_px(ConstMatrixRefF tracks);

/// Immutable; const calls are safe from several threads.
class HRI_API TwoHandFeatureComputer {
 public:
  /// Throws InvalidArgument naming the field that is out of range.
  explicit TwoHandFeatureComputer(const TwoHandFeatureOptions& options);

  [[nodiscard]] int num_static() const;
  [[nodiscard]] int num_features() const { return num_static() * (1 + options_.delta_orders); }
  [[nodiscard]] const TwoHandFeatureOptions& options() const { return options_; }

  /// Numbers of the features, rising, that do not depend on a hand which no frame of `tracks`
  /// shows. Throws InvalidArgument as compute() does.
  [[nodiscard]] std::vector<int> known_columns(ConstMatrixRefF tracks) const;

  /// Of `tracks` (num_frames, kNumTwoHandTrackColumns) into `out` (num_frames, num_features()): x
  /// and y of the right and of the left hand from the reference, by `scale_px`; polar coordinates,
  /// the relation; then HTK's deltas of these. A point out of sight stays where it was last seen,
  /// before that where it is first seen; a hand never seen is at the reference (see
  /// known_columns()). Allocates nothing. Throws InvalidArgument for other shapes, values that are
  /// infinite or beyond 1e6, half a point, no hand or no reference in any frame, hands that never
  /// leave the reference, and a scale that is not above 0.
  void compute(ConstMatrixRefF tracks, double scale_px, MatrixRefF out) const;
  [[nodiscard]] MatrixF compute(ConstMatrixRefF tracks, double scale_px) const;
  /// With the scale of the tracks themselves.
  [[nodiscard]] MatrixF compute(ConstMatrixRefF tracks) const;

 private:
  TwoHandFeatureOptions options_;
};

}  // namespace hri
