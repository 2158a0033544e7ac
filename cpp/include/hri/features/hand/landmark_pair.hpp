// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Both hands of a stream of landmarks, kept apart from frame to frame: what HandPairTracker is for
// masks.
#pragma once

#include <array>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/features/hand/landmarks.hpp"

namespace hri {

struct LandmarkPairOptions {
  double min_apart = 0.35;
  int num_kept_frames = 10;

  static constexpr const char* kName = "LandmarkPairOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("min_apart", o.min_apart, within(0, 10),
      "joints that lie closer to those of another hand are of the same hand, found twice; root "
      "mean square, in sizes of the hand");
    v("num_kept_frames", o.num_kept_frames, within(0, 1000),
      "frames for which the place of a hand out of sight is kept");
  }
};

/// The left hand of the picture, then the right one, as they were when both were first seen: labels
/// go with the hands when these cross. Until then, a single hand is the left one in the left half
/// of the picture. Not to be shared by threads.
class HRI_API LandmarkPairTracker {
 public:
  /// Throws InvalidArgument naming the field that is out of range.
  explicit LandmarkPairTracker(const LandmarkPairOptions& options = {});

  /// Which of the hands found in the next picture is the left one, which the right one; -1: it is
  /// not seen. Hands are kNumLandmarks rows of x and y in pixels, the surest first: of more than
  /// two the first two apart count. Throws InvalidArgument for another shape, values that are not
  /// finite, or a width below 1.
  std::array<int, 2> push(Span<const MatrixF> hands_px, int width_px);

  /// Forgets both hands.
  void reset();

 private:
  struct Track {
    bool known = false;
    int num_unseen = 0;
    MatrixF joints;        // when last seen, and moved on since
    float dx = 0, dy = 0;  // way of the centre in a frame
  };

  void see(std::size_t side, const MatrixF& joints);
  void miss(std::size_t side);
  [[nodiscard]] double far(std::size_t side, const MatrixF& joints) const;

  LandmarkPairOptions options_;
  bool paired_ = false;  // both were seen at once
  std::array<Track, 2> tracks_;
};

}  // namespace hri
