// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Gesture segments in a stream of pictures: a hand stream and a segmenter, which inform
// each other.
#pragma once

#include <memory>
#include <optional>

#include "hri/core/export.hpp"
#include "hri/features/hand/hand_place.hpp"
#include "hri/features/hand/hand_source.hpp"
#include "hri/recognition/gesture/gesture_segmenter.hpp"

namespace hri {

/// One stream. Keeps no pictures. Not to be shared by threads.
class HRI_API GestureSpotter {
 public:
  /// Throws InvalidArgument for no stream of hands and options out of range.
  GestureSpotter(std::unique_ptr<HandStream> hands, const GestureSegmenterOptions& options);

  /// The next picture (BGR) and its time. Throws InvalidArgument for another layout, and a time
  /// that is not finite or runs backwards.
  GestureSegment push(ImageView bgr, double time_s);

  /// The stream has ended, and with it any segment.
  GestureSegment finish();

  /// The stream was interrupted: what had begun is dropped, as its end is not known.
  GestureSegment interrupt();

  [[nodiscard]] const HandObservation& hand() const;  ///< in the last picture
  [[nodiscard]] const std::optional<HandPlace>& place() const { return place_; }
  [[nodiscard]] const GestureSegmenter& segmenter() const { return segmenter_; }
  /// Pictures from this time on may belong to a gesture, or are its context; older ones never will.
  [[nodiscard]] double kept_since_s() const;

 private:
  std::unique_ptr<HandStream> hands_;
  GestureSegmenter segmenter_;
  const HandObservation* hand_ = nullptr;
  HandObservation none_;
  std::optional<HandPlace> place_;
  double time_s_ = 0;
};

}  // namespace hri
