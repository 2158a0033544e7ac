// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand_features.hpp"

#include "hri/core/error.hpp"
#include "hri/features/hand_crop.hpp"

namespace hri {

HandFeatureComputer::HandFeatureComputer(const HandFeatureOptions& options)
    : options_(options), cepstrum_(options.cepstrum) {
  require(options.crop_px >= 16 && options.crop_px <= 256, "crop_px must lie in 16..256");
  require(options.histogram.num_cells <= options.crop_px,
          "histogram.num_cells must not exceed crop_px");
  require(options.cepstrum_weight > 0, "cepstrum_weight must be positive");
  const int histogram = orientation_histogram_size(options.histogram);
  num_features_ = (options.use_grey ? histogram : 0) + (options.use_silhouette ? histogram : 0) +
                  (options.use_cepstrum ? cepstrum_.num_features() : 0);
  require(num_features_ > 0, "use_grey, use_silhouette and use_cepstrum must not all be off");
}

void HandFeatureComputer::compute(ImageView grey, ImageView mask, Span<float> out) const {
  require(out.size() == static_cast<std::size_t>(num_features_),
          "out must have num_features() values");
  require(grey.channels == 1 && mask.channels == 1 && grey.width_px == mask.width_px &&
              grey.height_px == mask.height_px,
          "grey and mask must have one channel and the same size");
  const HandBox box = hand_box(mask);
  require(box.side_px > 0, "mask is empty");
  thread_local MatrixF square;
  square.resize(options_.crop_px, options_.crop_px);
  const auto histogram = static_cast<std::size_t>(orientation_histogram_size(options_.histogram));
  std::size_t at = 0;
  if (options_.use_grey) {
    crop(grey, box, square);
    square = square.cwiseSqrt();
    orientation_histogram(square, options_.histogram, out.subspan(at, histogram));
    at += histogram;
  }
  if (options_.use_silhouette) {
    crop(mask, box, square);
    orientation_histogram(square, options_.histogram, out.subspan(at, histogram));
    at += histogram;
  }
  if (options_.use_cepstrum) {
    const auto rest = out.subspan(at, out.size() - at);
    cepstrum_.compute(mask, rest);
    for (float& v : rest) v *= static_cast<float>(options_.cepstrum_weight);
  }
}

VectorF HandFeatureComputer::compute(ImageView grey, ImageView mask) const {
  VectorF out(num_features_);
  compute(grey, mask, {out.data(), static_cast<std::size_t>(out.size())});
  return out;
}

}  // namespace hri
