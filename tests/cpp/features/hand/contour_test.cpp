// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/contour.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "features/hand_testing.hpp"
#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri {
namespace {

// A mask of lines of text: '#' is the hand.
GreyImage drawn(const std::vector<std::string>& lines) {
  GreyImage mask(static_cast<int>(lines[0].size()), static_cast<int>(lines.size()));
  for (std::size_t y = 0; y < lines.size(); ++y) {
    for (std::size_t x = 0; x < lines[y].size(); ++x)
      mask.pixels[y * lines[y].size() + x] = lines[y][x] == '#' ? 255 : 0;
  }
  return mask;
}

std::vector<ContourPoint> outline_of(const GreyImage& mask) {
  std::vector<ContourPoint> contour{{7, 7}};  // is written over
  trace_contour(mask.view(), &contour);
  return contour;
}

std::vector<ContourPoint> points(std::initializer_list<ContourPoint> list) { return list; }

TEST(Contour, GoesOnceRoundARectangleClockwise) {
  EXPECT_EQ(outline_of(drawn({"....", ".##.", ".##.", ".##."})),
            points({{1, 1}, {2, 1}, {2, 2}, {2, 3}, {1, 3}, {1, 2}}));
}

TEST(Contour, ComesBackOverALineAndStaysOnAPixel) {
  EXPECT_EQ(outline_of(drawn({"###"})), points({{0, 0}, {1, 0}, {2, 0}, {1, 0}}));
  EXPECT_EQ(outline_of(drawn({"...", ".#."})), points({{1, 1}}));
  EXPECT_TRUE(outline_of(drawn({"...", "..."})).empty());
  std::vector<ContourPoint> contour{{1, 1}};
  trace_contour(ImageView{}, &contour);
  EXPECT_TRUE(contour.empty());
}

TEST(Contour, PassesItsStartWhereTwoLegsMeet) {
  EXPECT_EQ(outline_of(drawn({"..#..", ".#.#.", "#...#"})),
            points({{2, 0}, {3, 1}, {4, 2}, {3, 1}, {2, 0}, {1, 1}, {0, 2}, {1, 1}}));
}

TEST(Contour, TakesTheLargestRegionAndLeavesHolesOut) {
  const GreyImage mask = drawn({"##.......", "##.#####.", "...#...#.", "...#.#.#.", "...#####."});
  const auto contour = outline_of(mask);
  EXPECT_EQ(contour.size(), 14U);
  EXPECT_EQ(contour.front(), (ContourPoint{3, 1}));
  EXPECT_EQ(std::count(contour.begin(), contour.end(), ContourPoint{5, 3}), 0);
}

TEST(Contour, OfEqualRegionsTakesTheFirst) {
  EXPECT_EQ(outline_of(drawn({"...##", "##..."})).front(), (ContourPoint{3, 0}));
}

TEST(Contour, JoinsRegionsThatMeetBelow) {
  const auto contour = outline_of(drawn({"#.#.#...#", "#.#.#...#", "#####...#", "........#"}));
  EXPECT_EQ(contour.front(), (ContourPoint{0, 0}));
}

TEST(Contour, OfValuesIsThatOfTheMaskAboveTheThreshold) {
  Random random(3);
  GreyImage mask(61, 47);
  MatrixF values(47, 61);
  for (int y = 0; y < 47; ++y) {
    for (int x = 0; x < 61; ++x) {
      values(y, x) = static_cast<float>(random.normal());
      mask.pixels[static_cast<std::size_t>(y * 61 + x)] = values(y, x) > 0.1F ? 1 : 0;
    }
  }
  std::vector<ContourPoint> contour;
  trace_contour(values, 0.1F, &contour);
  EXPECT_EQ(contour, outline_of(mask));
  EXPECT_GT(contour.size(), 100U);
}

TEST(Contour, IsThatOfAPartOfALargerPicture) {
  const GreyImage large = hand_testing::hand(3);
  const ImageView part{large.view().row(40) + 50, 100, 90, 1, 200};
  GreyImage copy(100, 90);
  for (int y = 0; y < 90; ++y)
    std::copy_n(part.row(y), 100, copy.pixels.begin() + static_cast<std::ptrdiff_t>(y) * 100);
  std::vector<ContourPoint> contour;
  trace_contour(part, &contour);
  EXPECT_EQ(contour, outline_of(copy));
  EXPECT_THROW(trace_contour({large.pixels.data(), 20, 20, 3, 60}, &contour), InvalidArgument);
}

TEST(ResampledContour, OfADiscLiesOnACircleAtEqualDistances) {
  const auto contour = outline_of(hand_testing::hand(0, 100, 100));
  std::vector<float> x(64);
  std::vector<float> y(64);
  resample_contour(contour, x, y);
  for (std::size_t i = 0; i < 64; ++i) {
    EXPECT_NEAR(std::hypot(x[i] - 100, y[i] - 100), 29.5, 0.6);
    const std::size_t next = (i + 1) % 64;
    EXPECT_NEAR(std::hypot(x[next] - x[i], y[next] - y[i]), 2 * 3.14159 * 29.5 / 64, 0.25);
  }
}

TEST(ResampledContour, NeedsAPoint) {
  std::vector<float> x(4);
  std::vector<float> y(4);
  resample_contour(points({{5, 9}}), x, y);
  EXPECT_EQ(x, std::vector<float>(4, 5.0F));
  EXPECT_EQ(y, std::vector<float>(4, 9.0F));
  EXPECT_THROW(resample_contour({}, x, y), InvalidArgument);
  EXPECT_THROW(resample_contour(points({{5, 9}}), x, Span<float>(y.data(), 3)), InvalidArgument);
}

}  // namespace
}  // namespace hri
