// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/vision/hand_colours.hpp"

#include <algorithm>
#include <string>

#include "colour_fit.hpp"
#include "hri/core/error.hpp"
#include "hri/features/regions.hpp"
#include "mask_quality.hpp"
#include "pixels.hpp"

namespace hri {
namespace {

constexpr int kRadius_px = 1;  // of the pixels whose majority counts

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

// Frames spread evenly over the clip, scaled down.
std::vector<detail::ColourImage> frames_to_fit(const std::vector<ImageView>& frames,
                                               const HandColourOptions& options) {
  const std::size_t count =
      std::min(frames.size(), static_cast<std::size_t>(options.num_fit_frames));
  std::vector<detail::ColourImage> chosen(count);
  detail::Shrinker shrinker;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = count == 1 ? frames.size() / 2 : i * (frames.size() - 1) / (count - 1);
    shrinker.shrink(frames[at], options.fit_side_px, &chosen[i]);
  }
  return chosen;
}

// Working memory of one thread.
struct Workspace {
  detail::Shrinker shrinker;
  detail::ColourImage small;
  GreyImage raw;
  std::vector<std::uint16_t> counts;
  RegionFinder regions;
};

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
  const auto fit = detail::fit_colours(frames_to_fit(frames, options), options);
  if (!fit) return std::nullopt;
  HandColours result;
  result.options_ = options;
  result.threshold_ = fit->threshold;
  result.quality_ = fit->quality;
  result.scores_ = detail::score_tables(fit->weights);
  return result;
}

Silhouette HandColours::extract(ImageView bgr) const {
  Silhouette result;
  extract(bgr, &result);
  return result;
}

void HandColours::extract(ImageView bgr, Silhouette* out) const {
  require(!bgr.empty() && bgr.channels == 3,
          "picture must have three channels and at least one pixel");
  thread_local Workspace w;
  w.shrinker.shrink(bgr, options_.max_side_px, &w.small);
  detail::to_grey(w.small, &out->grey);
  out->mended = false;
  detail::resize(&w.raw, w.small.width_px, w.small.height_px);
  const auto score_of = [&](const std::uint8_t* pixel) {
    return scores_[0][pixel[0]] + scores_[1][pixel[1]] + scores_[2][pixel[2]];
  };
  const std::uint8_t* pixel = w.small.pixels.data();
  for (std::uint8_t& in : w.raw.pixels) {
    in = score_of(pixel) > threshold_ ? 255 : 0;
    pixel += 3;
  }
  detail::majority(w.raw, kRadius_px, &w.counts, &out->mask);
  w.regions.keep_largest(&out->mask, options_.min_area, options_.max_hands);
  const std::uint8_t* const pixels = w.small.pixels.data();
  out->quality = detail::mask_quality(out->mask, options_.max_hands,
                                      [&](std::size_t i) { return score_of(pixels + 3 * i); });
}

}  // namespace hri
