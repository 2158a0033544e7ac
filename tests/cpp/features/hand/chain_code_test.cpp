// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/chain_code.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "features/hand_testing.hpp"
#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri {
namespace {

using Code = std::vector<std::uint8_t>;
using hand_testing::hand;

// Clockwise, pixel by pixel.
GreyImage quarter_turn(const GreyImage& mask) {
  GreyImage turned(mask.height_px, mask.width_px);
  for (int y = 0; y < turned.height_px; ++y) {
    for (int x = 0; x < turned.width_px; ++x) {
      turned.pixels[static_cast<std::size_t>(y * turned.width_px + x)] =
          mask.view().at(y, mask.height_px - 1 - x);
    }
  }
  return turned;
}

std::vector<ContourPoint> outline(const GreyImage& mask) {
  std::vector<ContourPoint> contour;
  trace_contour(mask.view(), &contour);
  return contour;
}

VectorF histogram(const GreyImage& mask, int num_parts, bool use_turns) {
  ChainCodeOptions options;
  options.num_parts = num_parts;
  options.use_turns = use_turns;
  const ChainCodeComputer computer(options);
  VectorF out(computer.num_features());
  computer.compute(mask.view(), {out.data(), static_cast<std::size_t>(out.size())});
  return out;
}

TEST(ChainCode, CountsDirectionsFromTheRightTowardsUp) {
  // A diamond, clockwise from its top.
  const std::vector<ContourPoint> diamond = {{1, 0}, {2, 1}, {1, 2}, {0, 1}};
  Code code{9};
  chain_code(diamond, &code);
  EXPECT_EQ(code, (Code{7, 5, 3, 1}));
  const std::vector<ContourPoint> square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  chain_code(square, &code);
  EXPECT_EQ(code, (Code{0, 6, 4, 2}));
  Code turns;
  turn_code(code, &turns);
  EXPECT_EQ(turns, (Code{6, 6, 6, 6}));  // to the right
}

TEST(ChainCode, OfAPointIsEmptyAndOfAGapRefused) {
  Code code{9};
  chain_code(std::vector<ContourPoint>{{3, 3}}, &code);
  EXPECT_TRUE(code.empty());
  EXPECT_THROW(chain_code(std::vector<ContourPoint>{{0, 0}, {2, 0}}, &code), InvalidArgument);
  EXPECT_THROW(chain_code(std::vector<ContourPoint>{{0, 0}, {0, 0}}, &code), InvalidArgument);
}

TEST(LeastStart, IsThatOfAllRotationsCompared) {
  Random random(5);
  for (int size = 0; size < 60; ++size) {
    Code code;
    for (int i = 0; i < size; ++i)
      code.push_back(static_cast<std::uint8_t>(random.normal() > 0 ? 1 : 0));
    Code best = code;
    Code rotated = code;
    for (int i = 1; i < size; ++i) {
      std::rotate(rotated.begin(), rotated.begin() + 1, rotated.end());
      best = std::min(best, rotated);
    }
    rotated = code;
    std::rotate(rotated.begin(), rotated.begin() + static_cast<std::ptrdiff_t>(least_start(code)),
                rotated.end());
    EXPECT_EQ(rotated, best);
  }
}

TEST(ShapeNumber, ForgetsPlaceStartAndQuarterTurns) {
  const Code expected = shape_number(outline(hand(3, 100, 100)));
  EXPECT_GT(expected.size(), 200U);
  EXPECT_EQ(shape_number(outline(hand(3, 91, 107))), expected);
  GreyImage turned = hand(3, 100, 100);
  for (int quarters = 1; quarters < 4; ++quarters) {
    turned = quarter_turn(turned);
    EXPECT_EQ(shape_number(outline(turned)), expected);
  }
  std::vector<ContourPoint> later = outline(hand(3, 100, 100));
  std::rotate(later.begin(), later.begin() + 50, later.end());
  EXPECT_EQ(shape_number(later), expected);
  EXPECT_NE(shape_number(outline(hand(2, 100, 100))), expected);
}

TEST(ChainCodeHistogram, IsTheShareOfEveryDirectionInTheLength) {
  GreyImage mask(10, 10);
  for (int y = 2; y < 5; ++y) {
    for (int x = 1; x < 8; ++x) mask.pixels[static_cast<std::size_t>(y * 10 + x)] = 255;
  }
  const VectorF all = histogram(mask, 1, false);
  const VectorF expected = (VectorF(8) << 6, 0, 2, 0, 6, 0, 2, 0).finished() / 16;
  EXPECT_LT((all - expected).norm(), 1e-6F);
  const VectorF halves = histogram(mask, 2, false);
  EXPECT_NEAR(halves[0], 0.75F, 1e-6F);
  EXPECT_NEAR(halves[8 + 4], 0.75F, 1e-6F);
}

TEST(ChainCodeHistogram, ChangesLittleWithPlaceAndSizeAndOfTurnsWithQuarterTurns) {
  for (const bool use_turns : {false, true}) {
    const VectorF here = histogram(hand(3, 100, 110), 1, use_turns);
    EXPECT_EQ(histogram(hand(3, 90, 100), 1, use_turns), here);
    const float to_other = (histogram(hand(0, 100, 110), 1, use_turns) - here).norm();
    EXPECT_LT((histogram(hand(3, 100, 110, 1.2), 1, use_turns) - here).norm(), 0.5F * to_other);
  }
  const VectorF turns = histogram(hand(3, 100, 100), 1, true);
  EXPECT_LT((histogram(quarter_turn(hand(3, 100, 100)), 1, true) - turns).norm(), 1e-5F);
  // Directions turn with the hand.
  const VectorF straight = histogram(hand(3, 100, 100), 1, false);
  const VectorF turned = histogram(quarter_turn(hand(3, 100, 100)), 1, false);
  for (int d = 0; d < 8; ++d) EXPECT_NEAR(turned[(d + 6) % 8], straight[d], 1e-5F);
}

TEST(ChainCodeHistogram, OfAPixelIsZeroAndNamesWhatDoesNotFit) {
  GreyImage dot(5, 5);
  EXPECT_THROW(histogram(dot, 1, false), InvalidArgument);
  dot.pixels[12] = 1;
  EXPECT_EQ(histogram(dot, 3, false), VectorF::Zero(24));
  EXPECT_THROW(histogram(dot, 0, false), InvalidArgument);
  EXPECT_THROW(histogram(dot, 65, false), InvalidArgument);
}

}  // namespace
}  // namespace hri
