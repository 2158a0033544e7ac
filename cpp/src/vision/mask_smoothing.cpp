// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/vision/mask_smoothing.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/simd.hpp"
#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr double kRepairedQuality = 0.5;

struct Counts {
  int both = 0, either = 0;
};

HRI_SIMD_CLONES void count_set(const std::uint8_t* a, const std::uint8_t* b, std::size_t count,
                               Counts* out) {
  int both = 0;
  int either = 0;
  for (std::size_t i = 0; i < count; ++i) {
    both += (a[i] & b[i]) != 0 ? 1 : 0;
    either += (a[i] | b[i]) != 0 ? 1 : 0;
  }
  out->both = both;
  out->either = either;
}

HRI_SIMD_CLONES void take_majority(const std::uint8_t* before, const std::uint8_t* after,
                                   std::uint8_t* mask, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    mask[i] =
        static_cast<std::uint8_t>((before[i] & after[i]) | (mask[i] & (before[i] | after[i])));
  }
}

// What two masks share, of what either covers; 0 for two empty ones.
double overlap(const GreyImage& a, const GreyImage& b) {
  Counts counts;
  count_set(a.pixels.data(), b.pixels.data(), a.pixels.size(), &counts);
  return counts.either > 0 ? counts.both / static_cast<double>(counts.either) : 0;
}

bool same_size(const HandObservation& a, const HandObservation& b) {
  return a.mask.width_px == b.mask.width_px && a.mask.height_px == b.mask.height_px;
}

// Whether all frames between two that agree jump.
bool all_jump(const MaskSmoothingOptions& options, const std::vector<HandObservation>& clip,
              std::size_t before, std::size_t after) {
  const double least = std::min(clip[before].quality, clip[after].quality);
  const auto worse = [&](const HandObservation& s) {
    return s.quality < least && same_size(s, clip[before]);
  };
  const auto first = clip.begin() + static_cast<std::ptrdiff_t>(before) + 1;
  const auto last = clip.begin() + static_cast<std::ptrdiff_t>(after);
  if (!same_size(clip[before], clip[after]) || !std::all_of(first, last, worse)) return false;
  const double agreement = overlap(clip[before].mask, clip[after].mask);
  if (agreement < options.min_agreement) return false;
  return std::all_of(first, last, [&](const HandObservation& s) {
    const double most = options.max_overlap * agreement;
    return overlap(s.mask, clip[before].mask) < most && overlap(s.mask, clip[after].mask) < most;
  });
}

}  // namespace

std::vector<int> smooth_masks(const MaskSmoothingOptions& options,
                              std::vector<HandObservation>* clip) {
  validate(options);
  std::vector<int> repaired;
  std::vector<HandObservation>& frames = *clip;
  for (std::size_t before = 0; before + 2 < frames.size(); ++before) {
    for (int gap = 1; gap <= options.max_gap; ++gap) {
      const std::size_t after = before + static_cast<std::size_t>(gap) + 1;
      if (after >= frames.size()) break;
      if (!all_jump(options, frames, before, after)) continue;
      for (std::size_t i = before + 1; i < after; ++i) {
        GreyImage& mask = frames[i].mask;
        take_majority(frames[before].mask.pixels.data(), frames[after].mask.pixels.data(),
                      mask.pixels.data(), mask.pixels.size());
        frames[i].quality =
            kRepairedQuality * std::min(frames[before].quality, frames[after].quality);
        frames[i].repaired = true;
        repaired.push_back(static_cast<int>(i));
      }
      before = after - 1;
      break;
    }
  }
  return repaired;
}

}  // namespace hri
