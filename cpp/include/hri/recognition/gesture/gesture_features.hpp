// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The front end of GestureRecognizer: rows of features, one a frame that shows a hand.
#pragma once

#include <memory>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/image_view.hpp"
#include "hri/core/types.hpp"
#include "hri/features/hand/hand_features.hpp"
#include "hri/features/hand/hand_source.hpp"

namespace hri {

/// A frame: the grey image and the hand's mask (255 = hand), of one size. An empty mask is a frame
/// without a hand.
struct HandImage {
  ImageView grey;
  ImageView mask;
};

/// Hand features, then centre x, centre y and log area of the mask in units of the frame (0..1).
/// Immutable; const calls are safe from several threads; copies share what is precomputed.
class HRI_API GestureFeatureComputer {
 public:
  /// Observations of a quality below `min_quality` show no hand. Throws InvalidArgument naming the
  /// field that is out of range.
  GestureFeatureComputer(const HandFeatureOptions& options, double min_quality);

  [[nodiscard]] int num_features() const;

  /// The row of one frame; false, and nothing written, where it shows no hand.
  bool compute(const HandImage& frame, Span<float> row) const;
  bool compute(const HandObservation& hand, Span<float> row) const;

  /// The rows of those frames that show a hand.
  [[nodiscard]] MatrixF compute(Span<const HandImage> frames) const;
  [[nodiscard]] MatrixF compute(Span<const HandObservation> hands) const;
  /// A row for every frame, all NaN where it shows no hand.
  [[nodiscard]] MatrixF compute_every(Span<const HandObservation> hands) const;

 private:
  std::shared_ptr<const HandFeatureComputer> computer_;
  double min_quality_ = 0;
};

}  // namespace hri
