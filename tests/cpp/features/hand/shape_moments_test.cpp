// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/shape_moments.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "features/hand_testing.hpp"
#include "hri/core/error.hpp"

namespace hri {
namespace {

using hand_testing::hand;

VectorF hu_features_of(const GreyImage& mask) {
  VectorF out(kNumHuMoments);
  hu_features(mask.view(), {out.data(), kNumHuMoments});
  return out;
}

TEST(ShapeMoments, OfARectangleAreKnown) {
  GreyImage mask(20, 20);
  for (int y = 3; y < 7; ++y) {
    for (int x = 5; x < 15; ++x) mask.pixels[static_cast<std::size_t>(y * 20 + x)] = 1;
  }
  const ShapeMoments m = shape_moments(mask.view());
  EXPECT_EQ(m.m00, 40);
  EXPECT_EQ(m.m10, 40 * 9.5);
  EXPECT_EQ(m.m01, 40 * 4.5);
  EXPECT_NEAR(m.mu20, 40 * (100 - 1) / 12.0, 1e-9);
  EXPECT_NEAR(m.mu02, 40 * (16 - 1) / 12.0, 1e-9);
  EXPECT_NEAR(m.mu11, 0, 1e-9);
  EXPECT_NEAR(m.mu30, 0, 1e-8);
  EXPECT_NEAR(m.nu20, m.mu20 / 1600, 1e-15);
}

TEST(ShapeAxis, TurnsWithTheShape) {
  for (const double turn : {-1.2, -0.4, 0.0, 0.3, 1.5}) {
    GreyImage bar(101, 101);
    for (int y = 0; y < 101; ++y) {
      for (int x = 0; x < 101; ++x) {
        const double along = (x - 50) * std::cos(turn) + (y - 50) * std::sin(turn);
        const double across = (y - 50) * std::cos(turn) - (x - 50) * std::sin(turn);
        if (std::abs(along) < 40 && std::abs(across) < 4)
          bar.pixels[static_cast<std::size_t>(y * 101 + x)] = 255;
      }
    }
    const ShapeAxis axis = shape_axis(shape_moments(bar.view()));
    EXPECT_NEAR(axis.angle_rad, turn, 0.01);
    EXPECT_GT(axis.elongation, 0.95);
  }
  EXPECT_LT(shape_axis(shape_moments(hand(0, 100, 100).view())).elongation, 1e-3);
  EXPECT_EQ(shape_axis({}).elongation, 0);
}

TEST(HuFeatures, ForgetPlaceSizeAndTurn) {
  const VectorF here = hu_features_of(hand(3, 100, 100));
  const float to_other = (hu_features_of(hand(2, 100, 100)) - here).norm();
  EXPECT_LT((hu_features_of(hand(3, 80, 112)) - here).norm(), 1e-5F);
  EXPECT_LT((hu_features_of(hand(3, 100, 100, 1.25)) - here).norm(), 0.1F * to_other);
  // This hand is its own mirror image, so that h7 is near 0, where its fourth root is steep.
  for (const double turn : {0.3, 0.785, 1.4, 3.0})
    EXPECT_LT((hu_features_of(hand(3, 100, 100, 1, turn)) - here).norm(), 0.4F * to_other) << turn;
}

TEST(HuFeatures, LastChangesItsSignInAMirror) {
  const GreyImage mask = hand(2, 100, 100);
  GreyImage mirrored = mask;
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x)
      mirrored.pixels[static_cast<std::size_t>(y * 200 + x)] = mask.view().at(199 - x, y);
  }
  const VectorF here = hu_features_of(mask);
  const VectorF there = hu_features_of(mirrored);
  EXPECT_GT(std::abs(here[6]), 1e-3F);
  EXPECT_NEAR(there[6], -here[6], 1e-4F);
  EXPECT_LT((there - here).head(6).norm(), 1e-4F);
}

TEST(ShapeMoments, OfNothingAreZeroAndHaveNoFeatures) {
  EXPECT_EQ(shape_moments(ImageView{}).m00, 0);
  const GreyImage empty(10, 10);
  EXPECT_EQ(shape_moments(empty.view()).mu20, 0);
  EXPECT_THROW(hu_features_of(empty), InvalidArgument);
  EXPECT_THROW(shape_moments({empty.pixels.data(), 3, 3, 3, 9}), InvalidArgument);
}

}  // namespace
}  // namespace hri
