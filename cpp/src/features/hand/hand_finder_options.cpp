// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/hand_finder_options.hpp"

#include "hri/core/error.hpp"

namespace hri {

void validate(const SilhouetteOptions& o) {
  require(o.method <= SilhouetteMethod::grey_otsu, "method must be one that there is");
  require(o.max_side_px >= 32 && o.max_side_px <= 4096, "max_side_px must lie in 32..4096");
  require(o.blur_px >= 1 && o.blur_px <= 31 && o.blur_px % 2 == 1, "blur_px must be odd, 1..31");
  require(o.min_contrast >= 0 && o.min_contrast <= o.sure_contrast && o.sure_contrast <= 255,
          "min_contrast and sure_contrast must lie in 0..255, min_contrast not above");
  require(o.min_quality >= 0 && o.min_quality <= 1, "min_quality must lie in 0..1");
  require(o.max_hands >= 1 && o.max_hands <= 2, "max_hands must lie in 1..2");
  require(o.min_area >= 0 && o.min_area <= o.max_area && o.max_area <= 1,
          "min_area and max_area must lie in 0..1, min_area not above max_area");
}

void validate(const HandColourOptions& o) {
  require(o.max_side_px >= 32 && o.max_side_px <= 4096, "max_side_px must lie in 32..4096");
  require(o.fit_side_px >= 32 && o.fit_side_px <= 4096, "fit_side_px must lie in 32..4096");
  require(o.num_fit_frames >= 1 && o.num_fit_frames <= 256, "num_fit_frames must lie in 1..256");
  require(o.num_rounds >= 1 && o.num_rounds <= 100, "num_rounds must lie in 1..100");
  require(o.min_area >= 0 && o.min_area <= o.max_area && o.max_area <= 1,
          "min_area and max_area must lie in 0..1, min_area not above max_area");
  require(o.min_quality >= 0 && o.min_quality <= 1, "min_quality must lie in 0..1");
  require(o.max_hands >= 1 && o.max_hands <= 2, "max_hands must lie in 1..2");
}

void validate(const MaskSmoothingOptions& o) {
  require(o.max_gap >= 0 && o.max_gap <= 10, "max_gap must lie in 0..10");
  require(o.min_agreement >= 0 && o.min_agreement <= 1, "min_agreement must lie in 0..1");
  require(o.max_overlap >= 0 && o.max_overlap <= 1, "max_overlap must lie in 0..1");
}

void validate(const HandFinderOptions& o) {
  require(o.learning <= ColourLearning::never, "learning must be automatic or never");
  require(o.min_frames >= 1 && o.min_frames <= 1000000, "min_frames must lie in 1..1000000");
  validate(o.silhouette);
  validate(o.colours);
  validate(o.smoothing);
}

}  // namespace hri
