// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// A stream of pictures allocates nothing once the first one was segmented, in either way.
#include "hri/vision/silhouette.hpp"

#include <gtest/gtest.h>

#include "allocations/allocation_counter.hpp"
#include "features/hand_testing.hpp"
#include "hri/vision/hand_colours.hpp"

namespace hri {
namespace {

// A hand before a wall, `factor` times as large as the working size.
std::vector<std::uint8_t> picture(int factor) {
  const GreyImage mask = hand_testing::hand(4);
  std::vector<std::uint8_t> bgr;
  for (int y = 0; y < factor * mask.height_px; ++y) {
    for (int x = 0; x < factor * mask.width_px; ++x) {
      const bool inside = mask.view().at(x / factor, y / factor) != 0;
      for (const int v : {inside ? 110 : 165, inside ? 135 : 160, inside ? 195 : 150})
        bgr.push_back(static_cast<std::uint8_t>(v + (x * 7 + y * 3) % 5));
    }
  }
  return bgr;
}

TEST(HandColours, AllocateNothingFromTheSecondPictureOn) {
  HandColourOptions options;
  options.max_side_px = 200;
  for (const int factor : {1, 2, 3, 4}) {
    const std::vector<std::uint8_t> pixels = picture(factor);
    const int side = 200 * factor;
    const ImageView view{pixels.data(), side, side, 3, std::ptrdiff_t{3} * side};
    const auto colours = HandColours::learn({view}, options);
    ASSERT_TRUE(colours.has_value());
    HandObservation found;
    colours->extract(view, &found);
    EXPECT_GT(found.quality, 0.5);
    EXPECT_EQ(testing_data::allocations_of([&] { colours->extract(view, &found); }), 0) << factor;
  }
}

TEST(Silhouette, AllocatesNothingFromTheSecondPictureOn) {
  SilhouetteOptions options;
  options.max_side_px = 200;
  const SilhouetteExtractor extractor(options);
  for (const int factor : {1, 2, 3, 4}) {
    const std::vector<std::uint8_t> pixels = picture(factor);
    const int side = 200 * factor;
    const ImageView view{pixels.data(), side, side, 3, std::ptrdiff_t{3} * side};
    HandObservation found;
    extractor.extract(view, &found);
    EXPECT_GT(found.quality, 0.5);
    EXPECT_EQ(testing_data::allocations_of([&] { extractor.extract(view, &found); }), 0) << factor;
  }
}

}  // namespace
}  // namespace hri
