// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/vision/hand_colours.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "colour_fit.hpp"
#include "hri/core/error.hpp"
#include "pictures.hpp"

namespace hri {
namespace {

constexpr int kMedian_px = 3;

void validate(const HandColourOptions& o) {
  require(o.max_side_px >= 32 && o.max_side_px <= 4096, "max_side_px must lie in 32..4096");
  require(o.fit_side_px >= 32 && o.fit_side_px <= 4096, "fit_side_px must lie in 32..4096");
  require(o.num_fit_frames >= 1 && o.num_fit_frames <= 256, "num_fit_frames must lie in 1..256");
  require(o.num_rounds >= 1 && o.num_rounds <= 100, "num_rounds must lie in 1..100");
  require(o.min_area >= 0 && o.min_area <= o.max_area && o.max_area <= 1,
          "min_area and max_area must lie in 0..1, min_area not above max_area");
  require(o.min_quality >= 0 && o.min_quality <= 1, "min_quality must lie in 0..1");
}

// Frames spread evenly over the clip, scaled down and below each other.
detail::FitPixels fit_pixels(const std::vector<ImageView>& frames,
                             const HandColourOptions& options) {
  const std::size_t count =
      std::min(frames.size(), static_cast<std::size_t>(options.num_fit_frames));
  detail::FitPixels pixels;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = count == 1 ? frames.size() / 2 : i * (frames.size() - 1) / (count - 1);
    pixels.frames.push_back(
        detail::scaled_down(detail::as_mat(frames[at]), options.fit_side_px).clone());
  }
  return pixels;
}

}  // namespace

std::optional<HandColours> HandColours::learn(const std::vector<ImageView>& frames,
                                              const HandColourOptions& options) {
  validate(options);
  require(!frames.empty(), "frames must hold at least one picture");
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].empty() || frames[i].channels != 3) {
      fail(ErrorKind::invalid_argument,
           "frame " + std::to_string(i) + " must have three channels and at least one pixel");
    }
  }
  const auto fit = detail::fit_colours(fit_pixels(frames, options), options);
  if (!fit) return std::nullopt;
  HandColours result;
  result.options_ = options;
  result.threshold_ = fit->threshold;
  result.quality_ = fit->quality;
  for (std::size_t c = 0; c < 3; ++c) {
    for (int v = 0; v < 256; ++v) {
      result.scores_[c][static_cast<std::size_t>(v)] =
          fit->weights[c] * detail::log_level(v) + fit->weights[c + 3] * detail::level(v);
    }
  }
  return result;
}

Silhouette HandColours::extract(ImageView bgr) const {
  require(!bgr.empty() && bgr.channels == 3,
          "picture must have three channels and at least one pixel");
  const cv::Mat small = detail::scaled_down(detail::as_mat(bgr), options_.max_side_px);
  cv::Mat grey;
  cv::cvtColor(small, grey, cv::COLOR_BGR2GRAY);
  cv::Mat mask(small.size(), CV_8U);
  for (int y = 0; y < small.rows; ++y) {
    const auto* pixel = small.ptr<uchar>(y);
    auto* out = mask.ptr<uchar>(y);
    for (int x = 0; x < small.cols; ++x, pixel += 3) {
      const float score = scores_[0][pixel[0]] + scores_[1][pixel[1]] + scores_[2][pixel[2]];
      out[x] = score > threshold_ ? 255 : 0;
    }
  }
  cv::medianBlur(mask, mask, kMedian_px);
  Silhouette result;
  result.grey = detail::copy_of(grey);
  if (detail::keep_largest(mask, options_.min_area)) result.quality = quality_;
  result.mask = detail::copy_of(mask);
  return result;
}

}  // namespace hri
