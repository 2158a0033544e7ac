// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What the features of a hand become when the hand is turned in the plane of the picture, made of
// the features alone: more training from the same recordings.
#pragma once

#include <cstddef>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/features/hand/hand_features.hpp"

namespace hri {

/// A turn of features, linear in them. Immutable; const calls are safe from several threads.
class HRI_API HandTurn {
 public:
  /// Of features as HandFeatureComputer gives them, by an angle from the x axis to the y axis of
  /// the picture, which points down: clockwise as one sees it. The blocks of an orientation
  /// histogram move about the middle of the crop, with linear interpolation, and their bins move
  /// by the angle; what leaves the crop is lost, what enters it is 0. The other features, which
  /// hardly depend on the angle, stay as they are (so do chain codes, which have no bins as fine).
  /// Throws InvalidArgument for options out of range or an angle that is not finite.
  HandTurn(const HandFeatureOptions& options, double degrees);

  /// Of the shape columns of landmark_features(), without the track: exact.
  static HandTurn of_landmarks(double degrees);

  [[nodiscard]] int num_features() const { return static_cast<int>(ends_.size()); }

  /// `shape` and `turned` have num_features() values each, and do not overlap. Throws
  /// InvalidArgument for other lengths.
  void apply(Span<const float> shape, Span<float> turned) const;

 private:
  struct Tap {
    int from = 0;
    float weight = 0;
  };

  HandTurn() = default;
  void add_histogram(const OrientationHistogramOptions& options, double degrees);
  void add_block(const OrientationHistogramOptions& options, double degrees, int y, int x,
                 int base);
  void add_unchanged(int count);
  void end_feature() { ends_.push_back(taps_.size()); }

  std::vector<Tap> taps_;          // what the features are sums of
  std::vector<std::size_t> ends_;  // of the taps of every feature
};

}  // namespace hri
