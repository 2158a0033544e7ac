// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The colours that separate a hand from what is behind it, learned from the clip itself. In poor,
// strong or coloured light no fixed bounds hold, but within one clip hand and background keep their
// colours; and logarithms of a channel turn exposure, colour cast and gamma into shifts and scales,
// to which a discriminant adapts.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/image_view.hpp"
#include "hri/features/hand/hand_finder_options.hpp"
#include "hri/features/hand/hand_source.hpp"

namespace hri {

/// One score a pixel, the sum of a function of each channel; above a threshold the pixel is hand.
/// Immutable once learned; const calls are safe from several threads.
class HRI_API HandColours {
 public:
  /// Starts from Otsu's thresholds on brightness and on several measures of redness, improves each
  /// by Fisher's discriminant over the channels and their logarithms, and keeps the one whose hand
  /// has the sharpest outline, in one piece, away from the upper and side borders. Nothing where no
  /// start leads to a hand. `frames` are BGR, of any sizes. Throws InvalidArgument for no frames, a
  /// frame that is not a picture of three channels (names its index), or an option out of range.
  static std::optional<HandColours> learn(const std::vector<ImageView>& frames,
                                          const HandColourOptions& options);

  /// The largest regions of hand colours. Throws InvalidArgument for another layout or an empty
  /// picture.
  [[nodiscard]] HandObservation extract(ImageView bgr) const;

  /// The same into a silhouette whose memory is used again: pictures of one size allocate nothing
  /// from the second on, where their sides are whole multiples of the working ones.
  void extract(ImageView bgr, HandObservation* out) const;

  /// How well the pixels on both sides of the outline separate (share of their variance), 0..1.
  [[nodiscard]] double quality() const { return quality_; }

 private:
  HandColours() = default;

  void find_skin(ImageView bgr, HandObservation* out) const;
  [[nodiscard]] float score_of(const std::uint8_t* bgr) const {
    return scores_[0][bgr[0]] + scores_[1][bgr[1]] + scores_[2][bgr[2]];
  }

  HandColourOptions options_;
  GreyImage still_;                                 // what is no hand; empty if nothing
  std::array<std::array<float, 256>, 3> scores_{};  // of the values of blue, green and red
  float threshold_ = 0;
  double quality_ = 0;
};

}  // namespace hri
