// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "vision/still_skin.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "hri/features/hand/regions.hpp"

namespace hri::detail {
namespace {

constexpr std::size_t kFewestFrames = 4;
constexpr double kStill = 0.85;        // share of the frames in which still pixels are set
constexpr double kSame = 0.7;          // what a thing shares with its still pixels in a frame,
constexpr double kFramesSame = 0.7;    // in so many of them
constexpr double kMoving = 0.3;        // of a moving region, at most this share is still
constexpr double kMinMoving = 0.1;     // it is at least so large, against the largest that is still
constexpr double kFramesMoving = 0.3;  // and there is one in so many of the frames
constexpr int kMostRegions = 4;
constexpr int kMarginShare = 40;  // of the longer side

bool alike(const std::vector<GreyImage>& masks) {
  return std::all_of(masks.begin(), masks.end(), [&](const GreyImage& m) {
    return m.width_px == masks[0].width_px && m.height_px == masks[0].height_px;
  });
}

GreyImage still_pixels(const std::vector<GreyImage>& masks) {
  GreyImage still(masks[0].width_px, masks[0].height_px);
  const double least = kStill * static_cast<double>(masks.size());
  for (std::size_t i = 0; i < still.pixels.size(); ++i) {
    const auto set = std::count_if(masks.begin(), masks.end(),
                                   [i](const GreyImage& m) { return m.pixels[i] != 0; });
    still.pixels[i] = static_cast<double>(set) >= least ? 255 : 0;
  }
  return still;
}

std::ptrdiff_t count_both(const GreyImage& a, const GreyImage& b) {
  std::ptrdiff_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    count += (a.pixels[i] & b.pixels[i]) != 0 ? 1 : 0;
  return count;
}

// One region of a mask.
GreyImage only(RegionFinder* finder, const Region& region, const GreyImage& mask) {
  GreyImage one(mask.width_px, mask.height_px);
  finder->fill(region, &one);
  return one;
}

// The regions of a mask, each by itself.
std::vector<GreyImage> things(const GreyImage& mask, double min_area) {
  RegionFinder finder;
  std::vector<GreyImage> result;
  for (const Region& r : finder.find_largest(mask, min_area, kMostRegions))
    result.push_back(only(&finder, r, mask));
  return result;
}

double share(std::ptrdiff_t part, std::ptrdiff_t whole) {
  return static_cast<double>(part) / static_cast<double>(std::max<std::ptrdiff_t>(1, whole));
}

}  // namespace

GreyImage find_still_skin(const std::vector<GreyImage>& masks, double min_area) {
  if (masks.size() < kFewestFrames || !alike(masks)) return {};
  std::vector<std::vector<GreyImage>> frames;
  frames.reserve(masks.size());
  for (const GreyImage& m : masks) frames.push_back(things(m, min_area));
  const auto in_frames = [&](double least, auto holds) {
    const auto count = std::count_if(frames.begin(), frames.end(), [&](const auto& regions) {
      return std::any_of(regions.begin(), regions.end(), holds);
    });
    return static_cast<double>(count) >= least * static_cast<double>(frames.size());
  };
  GreyImage all(masks[0].width_px, masks[0].height_px);
  std::ptrdiff_t largest = 0;
  for (const GreyImage& still : things(still_pixels(masks), min_area)) {
    const std::ptrdiff_t area = count_both(still, still);
    const auto same = [&](const GreyImage& region) {
      const std::ptrdiff_t both = count_both(region, still);
      return share(both, count_both(region, region) + area - both) >= kSame;
    };
    if (!in_frames(kFramesSame, same)) continue;
    largest = std::max(largest, area);
    std::transform(still.pixels.begin(), still.pixels.end(), all.pixels.begin(), all.pixels.begin(),
                   [](std::uint8_t a, std::uint8_t b) { return std::max(a, b); });
  }
  const auto moving = [&](const GreyImage& region) {
    const std::ptrdiff_t area = count_both(region, region);
    return static_cast<double>(area) >= kMinMoving * static_cast<double>(largest) &&
           share(count_both(region, all), area) < kMoving;
  };
  if (largest == 0 || !in_frames(kFramesMoving, moving)) return {};
  const int margin = std::max(2, std::max(all.width_px, all.height_px) / kMarginShare);
  const cv::Mat pixels(all.height_px, all.width_px, CV_8U, all.pixels.data());
  cv::dilate(
      pixels, pixels,
      cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(2 * margin + 1, 2 * margin + 1)));
  return all;
}

}  // namespace hri::detail
