// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The way of a hand through a clip: place, size, axis, speed and direction (thesis eq. 5.2, 5.11),
// and how they change (deltas).
#pragma once

#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/image_view.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"

namespace hri {

struct HandTrackOptions {
  double frames_per_second = 30;
  int delta_orders = 1;
  int delta_window = 2;

  static constexpr const char* kName = "HandTrackOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("frames_per_second", o.frames_per_second, above(0, 100000), "frame rate of the clip");
    v("delta_orders", o.delta_orders, within(0, 2), "derivatives appended");
    v("delta_window", o.delta_window, within(1, 10), "frames on each side of the regression");
  }
};

constexpr int kNumHandTrackColumns = 8;

/// Columns of a track, before deltas.
inline constexpr const char* kHandTrackColumns[kNumHandTrackColumns] = {
    "x",            // centroid, in heights of the picture
    "y",            //
    "log_area",     // of the share of the picture that the hand covers
    "axis_cosine",  // elongation times cosine and sine of twice the angle of the longer axis: a
                    // line
    "axis_sine",    // turned by 180 degrees is the same, a round hand has none
    "speed",        // of the centroid since the hand was last seen, in heights a second
    "move_cosine",  // its direction; both 0 where it stands still
    "move_sine",
};

/// Immutable; const calls are safe from several threads.
class HRI_API HandTrackComputer {
 public:
  /// Throws InvalidArgument naming the field that is out of range.
  explicit HandTrackComputer(const HandTrackOptions& options);

  [[nodiscard]] int num_features() const {
    return kNumHandTrackColumns * (1 + options_.delta_orders);
  }
  [[nodiscard]] const HandTrackOptions& options() const { return options_; }

  /// A row for every frame that shows a hand, into the upper rows of `out` (masks.size() rows,
  /// num_features() columns); gives their number. The first of them has no speed. Deltas are HTK's,
  /// over the rows. Throws InvalidArgument for masks of different sizes.
  Eigen::Index compute(Span<const ImageView> masks, MatrixRefF out) const;
  [[nodiscard]] MatrixF compute(Span<const ImageView> masks) const;

 private:
  HandTrackOptions options_;
};

}  // namespace hri
