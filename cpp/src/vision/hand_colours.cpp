// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/vision/hand_colours.hpp"

#include <algorithm>
#include <string>

#include "hri/core/error.hpp"
#include "hri/features/hand/regions.hpp"
#include "vision/colour_fit.hpp"
#include "vision/mask_quality.hpp"
#include "vision/pixels.hpp"
#include "vision/still_skin.hpp"

namespace hri {
namespace {

constexpr int kRadius_px = 1;  // of the pixels whose majority counts

// Frames spread evenly over the clip.
std::vector<ImageView> frames_to_fit(const std::vector<ImageView>& frames,
                                     const HandColourOptions& options) {
  const std::size_t count =
      std::min(frames.size(), static_cast<std::size_t>(options.num_fit_frames));
  std::vector<ImageView> chosen(count);
  for (std::size_t i = 0; i < count; ++i)
    chosen[i] = frames[count == 1 ? frames.size() / 2 : i * (frames.size() - 1) / (count - 1)];
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

Workspace& workspace() {
  thread_local Workspace w;
  return w;
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
  const std::vector<ImageView> chosen = frames_to_fit(frames, options);
  std::vector<detail::ColourImage> small(chosen.size());
  detail::Shrinker shrinker;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    shrinker.shrink(chosen[i], options.fit_side_px, &small[i]);
  const auto fit = detail::fit_colours(small, options);
  if (!fit) return std::nullopt;
  HandColours result;
  result.options_ = options;
  result.threshold_ = fit->threshold;
  result.quality_ = fit->quality;
  result.scores_ = detail::score_tables(fit->weights);
  if (options.remove_still) {
    std::vector<GreyImage> masks(chosen.size());
    HandObservation found;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      result.find_skin(chosen[i], &found);
      masks[i] = found.mask;
    }
    result.still_ = detail::find_still_skin(masks, options.min_area);
  }
  return result;
}

HandObservation HandColours::extract(ImageView bgr) const {
  HandObservation result;
  extract(bgr, &result);
  return result;
}

// Fills the workspace's small picture, and the mask with all that has the hand's colours.
void HandColours::find_skin(ImageView bgr, HandObservation* out) const {
  Workspace& w = workspace();
  w.shrinker.shrink(bgr, options_.max_side_px, &w.small);
  detail::to_grey(w.small, &out->grey);
  detail::resize(&w.raw, w.small.width_px, w.small.height_px);
  const std::uint8_t* pixel = w.small.pixels.data();
  for (std::uint8_t& in : w.raw.pixels) {
    in = score_of(pixel) > threshold_ ? 255 : 0;
    pixel += 3;
  }
  detail::majority(w.raw, kRadius_px, &w.counts, &out->mask);
}

void HandColours::extract(ImageView bgr, HandObservation* out) const {
  require(!bgr.empty() && bgr.channels == 3,
          "picture must have three channels and at least one pixel");
  find_skin(bgr, out);
  out->repaired = false;
  Workspace& w = workspace();
  if (still_.width_px == out->mask.width_px && still_.height_px == out->mask.height_px) {
    std::transform(out->mask.pixels.begin(), out->mask.pixels.end(), still_.pixels.begin(),
                   out->mask.pixels.begin(), [](std::uint8_t skin, std::uint8_t still) {
                     return still != 0 ? std::uint8_t{0} : skin;
                   });
  }
  w.regions.keep_largest(&out->mask, options_.min_area, options_.max_hands);
  const std::uint8_t* const pixels = w.small.pixels.data();
  out->quality = detail::mask_quality(out->mask, options_.max_hands,
                                      [&](std::size_t i) { return score_of(pixels + 3 * i); });
}

}  // namespace hri
