// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The hand's silhouette in a colour picture (thesis sections 4.6.2 and 5.1.1), by fixed HSV bounds
// as in the thesis or, by default, by a chroma threshold that adapts to each picture's light.
#pragma once

#include <cstdint>
#include <memory>

#include "hri/core/export.hpp"
#include "hri/core/image_view.hpp"

namespace hri {

enum class SilhouetteMethod : std::uint8_t {
  chroma_otsu,  ///< Otsu's threshold on Cr - Cb: skin is redder than what is behind it, in any
                ///< light that has colour
  hsv,        ///< the thesis's fixed bounds of hue and saturation; fails in coloured or poor light
  grey_otsu,  ///< Otsu's threshold on grey, for a dark hand before a plain bright background
};

struct SilhouetteOptions {
  SilhouetteMethod method = SilhouetteMethod::chroma_otsu;
  int max_side_px = 320;  ///< larger pictures are scaled down to this first, 32..4096
  int blur_px = 5;        ///< Gaussian blur before and median after the threshold, odd, 1..31
  double min_contrast =
      1.5;                   ///< least difference of the two classes' means, in grey levels, 0..255
  double sure_contrast = 5;  ///< below this, as in poor light, the classes must also be well apart:
  double min_quality = 0.7;  ///< quality at least this, 0..1; camera noise alone gives 0.64
  double min_area = 0.005;   ///< smallest share of the picture a hand covers, 0..1
  double max_area = 0.8;     ///< largest, 0..1
  bool remove_face =
      true;           ///< of more skin regions than hands the one most like an ellipse is a face
  int max_hands = 1;  ///< regions that masks hold, the largest, 1..2; HandPairTracker tells which
                      ///< is which
};

/// What was found in one picture, at the working scale. `mask` has the size of `grey`; without a
/// hand it is all 0.
///
/// The quality is a product of four shares. Separation: the between-class share of the variance of
/// the values by which the hand was found (scores of colours, redness or grey), of pixels one pixel
/// off the outline on both sides. Size: 1 where the mask covers 3 to 35 % of the picture, down to 0
/// at 0.2 % (by logarithms) and 80 %. Border: 1 where it covers up to 20 % of the upper and side
/// borders, down to 0 at 50 %: there hands rarely are, and walls always. Outline: less than 1 where
/// rows cross it more often than an open hand, as in noise.
struct Silhouette {
  GreyImage grey;
  GreyImage mask;
  double quality = 0;     ///< 0 (no hand) .. 1: how far the mask can be trusted
  bool repaired = false;  ///< by the frames around it, see smooth_masks()
};

/// Immutable; const calls are safe from several threads.
class HRI_API SilhouetteExtractor {
 public:
  /// Throws InvalidArgument naming the field that is out of range.
  explicit SilhouetteExtractor(const SilhouetteOptions& options);

  /// With a picture of the background alone, by the same camera in the same place: what looks like
  /// skin in one of the two pictures but not in the other is the person (thesis section 5.1.1,
  /// exclusive or of the two masks). Throws InvalidArgument for a background that has not three
  /// channels and at least one pixel; extract() for a picture of another size.
  SilhouetteExtractor(const SilhouetteOptions& options, ImageView background);

  /// `bgr` has 3 channels (blue, green, red). Throws InvalidArgument for another layout or an empty
  /// picture.
  [[nodiscard]] Silhouette extract(ImageView bgr) const;

  /// The same into a silhouette whose memory is used again. With the default method and blur,
  /// pictures of one size allocate nothing from the second on where their sides are whole multiples
  /// of the working ones and there is but one region of skin.
  void extract(ImageView bgr, Silhouette* out) const;

 private:
  struct Background;
  SilhouetteOptions options_;
  std::shared_ptr<const Background> background_;  // empty without one
};

}  // namespace hri
