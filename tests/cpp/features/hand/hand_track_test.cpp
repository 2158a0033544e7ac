// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/hand_track.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "features/hand_testing.hpp"
#include "hri/core/error.hpp"

namespace hri {
namespace {

using hand_testing::hand;

MatrixF track(const std::vector<GreyImage>& masks, const HandTrackOptions& options = {}) {
  std::vector<ImageView> views;
  views.reserve(masks.size());
  for (const GreyImage& mask : masks) views.push_back(mask.view());
  return HandTrackComputer(options).compute(views);
}

TEST(HandTrack, TellsPlaceSizeAndSpeed) {
  const MatrixF rows = track({hand(0, 60, 100), hand(0, 66, 108), hand(0, 66, 108)});
  ASSERT_EQ(rows.rows(), 3);
  ASSERT_EQ(rows.cols(), 16);
  EXPECT_NEAR(rows(0, 0), 60.5 / 200, 1e-5);
  EXPECT_NEAR(rows(0, 1), 100.5 / 200, 1e-5);
  EXPECT_NEAR(rows(0, 2), std::log(3.14159 * 900 / 40000), 0.02);
  EXPECT_EQ(rows(0, 5), 0);
  EXPECT_NEAR(rows(1, 5), 30 * 10 / 200.0, 1e-4);
  EXPECT_NEAR(rows(1, 6), 0.6, 1e-4);
  EXPECT_NEAR(rows(1, 7), 0.8, 1e-4);
  EXPECT_EQ(rows(2, 5), 0);
  EXPECT_EQ(rows(2, 6), 0);
}

TEST(HandTrack, CountsTheFramesInWhichNoHandWasSeen) {
  const MatrixF rows =
      track({GreyImage(200, 200), hand(3, 80, 100), GreyImage(200, 200), hand(3, 100, 100)});
  ASSERT_EQ(rows.rows(), 2);
  EXPECT_NEAR(rows(1, 5), 15 * 20 / 200.0, 1e-4);
  EXPECT_EQ(track({GreyImage(200, 200)}).rows(), 0);
  EXPECT_EQ(track({}).rows(), 0);
}

TEST(HandTrack, TellsTheAxisOfAFinger) {
  HandTrackOptions options;
  options.delta_orders = 0;
  const MatrixF rows =
      track({hand(1, 100, 100, 1, 0.9), hand(1, 100, 100, 1, 0.9 + 0.785)}, options);
  ASSERT_EQ(rows.cols(), kNumHandTrackColumns);
  // The one finger points up and, turned by 45 degrees, up to the right.
  EXPECT_LT(rows(0, 3), -0.2F);
  EXPECT_NEAR(rows(0, 4), 0, 0.02);
  EXPECT_NEAR(rows(1, 3), 0, 0.02);
  EXPECT_LT(rows(1, 4), -0.2F);
}

TEST(HandTrack, DeltasAreSlopes) {
  std::vector<GreyImage> masks;
  for (int i = 0; i < 9; ++i) masks.push_back(hand(2, 60 + 4.0 * i, 100));
  HandTrackOptions options;
  options.delta_orders = 2;
  const MatrixF rows = track(masks, options);
  ASSERT_EQ(rows.cols(), 24);
  EXPECT_NEAR(rows(4, 8), 4 / 200.0, 1e-5);
  EXPECT_NEAR(rows(4, 16), 0, 1e-4);
}

TEST(HandTrack, NamesWhatDoesNotFit) {
  HandTrackOptions options;
  options.frames_per_second = 0;
  EXPECT_THROW(HandTrackComputer{options}, InvalidArgument);
  options = {};
  options.delta_orders = 3;
  EXPECT_THROW(HandTrackComputer{options}, InvalidArgument);
  options = {};
  options.delta_window = 11;
  EXPECT_THROW(HandTrackComputer{options}, InvalidArgument);
  EXPECT_THROW(track({GreyImage(20, 20), GreyImage(20, 30)}), InvalidArgument);
}

}  // namespace
}  // namespace hri
