// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/hand_features.hpp"

#include <algorithm>
#include <cmath>

#include "hri/core/error.hpp"
#include "hri/features/hand/shape_moments.hpp"

namespace hri {
namespace {

// Of the box round the hand.
constexpr float kMaxAspect = 1.6F;
constexpr float kPadding = 0.08F;

}  // namespace

const char* HandFeatureOptions::conflict() const {
  if (histogram.num_cells > crop_px) return "histogram.num_cells must not exceed crop_px";
  if (!use_grey && !use_silhouette && !use_cepstrum && !use_wavelet && !use_moments &&
      !use_fourier && !use_chain_code) {
    return "use_grey, use_silhouette, use_cepstrum, use_wavelet, use_moments, use_fourier and "
           "use_chain_code must not all be off";
  }
  return nullptr;
}

HandFeatureComputer::HandFeatureComputer(const HandFeatureOptions& options)
    : options_(validated(options)),
      cepstrum_(options.cepstrum),
      fourier_(options.fourier),
      chain_code_(options.chain_code) {
  if (options.use_wavelet) wavelet_.emplace(options.wavelet);
  const int histogram = orientation_histogram_size(options.histogram);
  num_features_ = (options.use_grey ? histogram : 0) + (options.use_silhouette ? histogram : 0) +
                  (options.use_cepstrum ? cepstrum_.num_features() : 0) +
                  (wavelet_ ? wavelet_->num_features() : 0) +
                  (options.use_fourier ? fourier_.num_features() : 0) +
                  (options.use_chain_code ? chain_code_.num_features() : 0) +
                  (options.use_moments ? kNumHuMoments : 0);
}

void HandFeatureComputer::compute(ImageView grey, ImageView mask, Span<float> out) const {
  require(out.size() == static_cast<std::size_t>(num_features_),
          "out must have num_features() values");
  require(grey.channels == 1 && mask.channels == 1 && grey.width_px == mask.width_px &&
              grey.height_px == mask.height_px,
          "grey and mask must have one channel and the same size");
  const HandBox box = hand_box(mask, kMaxAspect, kPadding);
  require(box.side_px > 0, "mask is empty");
  const std::size_t used = compute_pictures(grey, mask, box, out);
  // The rows below the box without its padding are forearm.
  const float end = box.top_px + box.side_px * (1 + kPadding) / (1 + 2 * kPadding);
  ImageView hand = mask;
  hand.height_px = std::min(mask.height_px, static_cast<int>(std::lround(end)));
  compute_descriptors(hand, out.subspan(used, out.size() - used));
}

// Gives the number of values written.
std::size_t HandFeatureComputer::compute_pictures(ImageView grey, ImageView mask,
                                                  const HandBox& box, Span<float> out) const {
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
    const auto part = out.subspan(at, static_cast<std::size_t>(cepstrum_.num_features()));
    cepstrum_.compute(mask, part);
    for (float& v : part) v *= static_cast<float>(options_.cepstrum_weight);
    at += part.size();
  }
  return at;
}

void HandFeatureComputer::compute_descriptors(ImageView mask, Span<float> out) const {
  std::size_t at = 0;
  const auto add = [&](int size, const auto& compute_part) {
    const auto part = out.subspan(at, static_cast<std::size_t>(size));
    compute_part(part);
    float squares = 0;
    for (const float v : part) squares += v * v;
    const auto length = static_cast<float>(options_.descriptor_weight);
    const float scale = squares > 0 ? length / std::sqrt(squares) : 0.0F;
    for (float& v : part) v *= scale;
    at += part.size();
  };
  if (wavelet_)
    add(wavelet_->num_features(), [&](Span<float> part) { wavelet_->compute(mask, part); });
  if (options_.use_moments) add(kNumHuMoments, [&](Span<float> part) { hu_features(mask, part); });
  if (!options_.use_fourier && !options_.use_chain_code) return;
  thread_local std::vector<ContourPoint> contour;
  trace_contour(mask, &contour);
  const Span<const ContourPoint> outline = contour;
  if (options_.use_fourier)
    add(fourier_.num_features(), [&](Span<float> part) { fourier_.compute(outline, part); });
  if (options_.use_chain_code)
    add(chain_code_.num_features(), [&](Span<float> part) { chain_code_.compute(outline, part); });
}

VectorF HandFeatureComputer::compute(ImageView grey, ImageView mask) const {
  VectorF out(num_features_);
  compute(grey, mask, {out.data(), static_cast<std::size_t>(out.size())});
  return out;
}

}  // namespace hri
