// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/motion/hybrid_feature.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "features/hand_testing.hpp"
#include "hri/core/error.hpp"

namespace hri {
namespace {

using hand_testing::hand;

// A bright bar, which leans to the right by `lean` pixels a row.
GreyImage bar(int x, int y, int width, int height, double lean = 0) {
  GreyImage mask(200, 160);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const int at = x + column + static_cast<int>(std::lround(lean * row));
      mask.pixels[static_cast<std::size_t>((y + row) * 200 + at)] = 255;
    }
  }
  return mask;
}

MatrixF hybrid(const std::vector<GreyImage>& masks, const HybridFeatureOptions& options) {
  std::vector<ImageView> views;
  for (const GreyImage& mask : masks) views.push_back(mask.view());
  return HybridFeatureComputer(options).compute(views);
}

HybridFeatureOptions only(bool HybridFeatureOptions::*part) {
  HybridFeatureOptions options;
  options.use_moments = options.use_orientation = false;
  options.use_chain_codes = options.use_speed = false;
  options.*part = true;
  return options;
}

// To the right by 4, up by 4, rest, left by 8, down by 2 pixels.
std::vector<GreyImage> a_way() {
  return {bar(60, 80, 10, 20), bar(64, 80, 10, 20), bar(64, 76, 10, 20),
          bar(64, 76, 10, 20), bar(56, 76, 10, 20), bar(56, 78, 10, 20)};
}

// A hand of fingers that turns and moves to the right.
std::vector<GreyImage> moving_hands(double x_px = 80, double y_px = 120, double scale = 0.8) {
  std::vector<GreyImage> masks;
  for (int t = 0; t < 5; ++t)
    masks.push_back(hand(3, x_px + 10 * scale * t, y_px - scale * t * t, scale, 0.1 * t));
  return masks;
}

TEST(DirectionCode, IsFreemansOfEveryDirection) {
  const int expected[8][2] = {{1, 0}, {1, -1}, {0, -1}, {-1, -1}, {-1, 0}, {-1, 1}, {0, 1}, {1, 1}};
  for (int code = 0; code < 8; ++code) {
    EXPECT_EQ(direction_code(expected[code][0], expected[code][1]), code);
    EXPECT_EQ(direction_code(0.01 * expected[code][0], 0.01 * expected[code][1]), code);
  }
  EXPECT_EQ(direction_code(0, 0), 0);
  EXPECT_EQ(direction_code(-1, -0.0), 4);
}

TEST(DirectionCode, RoundsToTheNearest) {
  const double degree = std::acos(-1.0) / 180;
  for (int angle = -22; angle < 338; ++angle) {  // anticlockwise, as it is seen
    EXPECT_EQ(direction_code(std::cos(angle * degree), -std::sin(angle * degree)),
              (angle + 22) / 45)
        << angle;
  }
}

TEST(DirectionCode, RefusesWhatIsNotFinite) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_THROW(direction_code(inf, 0), InvalidArgument);
  EXPECT_THROW(direction_code(0, std::nan("")), InvalidArgument);
}

TEST(HybridFeature, SpeedIsTheWeightedShareOfTheLargest) {
  HybridFeatureOptions options = only(&HybridFeatureOptions::use_speed);
  options.speed_weight = 0.8;
  const MatrixF rows = hybrid(a_way(), options);
  ASSERT_EQ(rows.cols(), 1);
  const VectorF expected = (VectorF(6) << 0.4F, 0.4F, 0, 0.8F, 0.2F, 0.2F).finished();
  EXPECT_LT((rows.col(0) - expected).cwiseAbs().maxCoeff(), 1e-6F);
}

TEST(HybridFeature, ChainCodesAreThoseOfTheWay) {
  const MatrixF rows = hybrid(a_way(), only(&HybridFeatureOptions::use_chain_codes));
  ASSERT_EQ(rows.cols(), 2);
  // The middle of the six places is (364 / 6, 462 / 6) pixels from the corner of the bar.
  EXPECT_EQ(8 * rows.col(0), (VectorF(6) << 6, 7, 1, 1, 4, 4).finished());
  EXPECT_EQ(8 * rows.col(1), (VectorF(6) << 0, 2, 2, 4, 6, 6).finished());
}

TEST(HybridFeature, StepsBeforeTheFirstMoveHaveItsCode) {
  std::vector<GreyImage> masks = {bar(60, 80, 10, 20), bar(60, 80, 10, 20)};
  masks.push_back(bar(50, 80, 10, 20));
  const MatrixF rows = hybrid(masks, only(&HybridFeatureOptions::use_chain_codes));
  EXPECT_EQ(8 * rows.col(1), VectorF::Constant(3, 4));
}

TEST(HybridFeature, FramesWithoutAHandHaveNoRow) {
  HybridFeatureOptions options = only(&HybridFeatureOptions::use_speed);
  options.speed_weight = 0.5;
  const GreyImage none(200, 160);
  const MatrixF rows = hybrid(
      {none, bar(60, 80, 10, 20), none, bar(68, 80, 10, 20), bar(76, 80, 10, 20), none}, options);
  EXPECT_EQ(rows, (MatrixF(3, 1) << 0.25F, 0.5F, 0.5F).finished());  // 8 pixels in two frames
  EXPECT_EQ(hybrid({none, none}, options).rows(), 0);
  EXPECT_EQ(hybrid({}, options).rows(), 0);
}

TEST(HybridFeature, HandThatRestsHasNoSpeedAndNoCode) {
  HybridFeatureOptions options;
  options.use_moments = options.use_orientation = false;
  EXPECT_EQ(hybrid({bar(60, 80, 10, 20), bar(60, 80, 10, 20)}, options), MatrixF::Zero(2, 3));
  EXPECT_EQ(hybrid({bar(60, 80, 10, 20)}, options), MatrixF::Zero(1, 3));
}

TEST(HybridFeature, OrientationIsTheDirectionAcrossTheEdges) {
  HybridFeatureOptions options = only(&HybridFeatureOptions::use_orientation);
  const auto across = [&](const GreyImage& mask) { return hybrid({mask}, options)(0, 0); };
  EXPECT_LT(std::abs(std::remainder(across(bar(90, 30, 20, 100)), 1.0)), 0.01);
  EXPECT_NEAR(across(bar(40, 70, 100, 20)), 0.5, 0.01);
  // Edges that go down to the right: across them is up to the right, 135 degrees from x to y.
  EXPECT_NEAR(across(bar(40, 30, 14, 90, 1.0)), 0.75, 0.05);
  options.angles = HybridAngles::circle;
  const MatrixF upright = hybrid({bar(90, 30, 20, 100)}, options);
  ASSERT_EQ(upright.cols(), 2);
  EXPECT_GT(upright(0, 0), 0.7F);
  EXPECT_NEAR(upright(0, 1), 0.5F, 0.02F);
  EXPECT_NEAR(hybrid({bar(60, 60, 40, 40)}, options)(0, 0), 0.5F, 0.02F);  // of a square: none
}

TEST(HybridFeature, MomentsAreDividedByTheirLargest) {
  HybridFeatureOptions options = only(&HybridFeatureOptions::use_moments);
  const std::vector<GreyImage> masks = moving_hands();
  const WaveletDescriptorComputer descriptor(options.moments);
  MatrixF expected(5, descriptor.num_features());
  for (int t = 0; t < 5; ++t) {
    descriptor.compute(
        masks[static_cast<std::size_t>(t)].view(),
        {expected.data() + t * expected.cols(), static_cast<std::size_t>(expected.cols())});
  }
  const MatrixF of_gesture = hybrid(masks, options);
  EXPECT_LT((of_gesture - expected / expected.maxCoeff()).cwiseAbs().maxCoeff(), 1e-6F);
  options.moment_scale = HybridMomentScale::column;
  const MatrixF of_column = hybrid(masks, options);
  for (Eigen::Index k = 0; k < expected.cols(); ++k)
    EXPECT_LT((of_column.col(k) - expected.col(k) / expected.col(k).maxCoeff()).norm(), 1e-5F);
}

TEST(HybridFeature, ValuesLieBetweenZeroAndOne) {
  for (const HybridAngles angles : {HybridAngles::number, HybridAngles::circle}) {
    HybridFeatureOptions options;
    options.angles = angles;
    const HybridFeatureComputer computer(options);
    const MatrixF rows = hybrid(moving_hands(), options);
    ASSERT_EQ(rows.cols(), computer.num_features());
    ASSERT_EQ(rows.cols(), computer.num_moments() + (angles == HybridAngles::number ? 4 : 7));
    EXPECT_GE(rows.minCoeff(), 0);
    EXPECT_LE(rows.maxCoeff(), 1);
    EXPECT_EQ(rows.leftCols(computer.num_moments()).maxCoeff(), 1);
    EXPECT_EQ(rows.rightCols(1).maxCoeff(), 0.5F);
  }
}

TEST(HybridFeature, StaysWhereThePictureMoves) {
  HybridFeatureOptions options;
  options.angles = HybridAngles::circle;
  const MatrixF rows = hybrid(moving_hands(), options);
  EXPECT_LT((hybrid(moving_hands(90, 110), options) - rows).cwiseAbs().maxCoeff(), 1e-4F);
}

TEST(HybridFeature, HardlyChangesWithTheSizeOfTheHand) {
  HybridFeatureOptions options;
  options.angles = HybridAngles::circle;
  const MatrixF rows = hybrid(moving_hands(60, 120, 0.5), options);
  const MatrixF larger = hybrid(moving_hands(60, 120, 1.0), options);
  EXPECT_LT((larger - rows).cwiseAbs().maxCoeff(), 0.1F);
}

TEST(HybridFeature, RefusesWhatDoesNotFit) {
  HybridFeatureOptions options;
  const HybridFeatureComputer computer(options);
  const GreyImage mask = bar(60, 80, 10, 20);
  const GreyImage small(20, 20);
  const std::vector<ImageView> mixed = {mask.view(), small.view()};
  EXPECT_THROW(computer.compute(mixed), InvalidArgument);
  ImageView colour = mask.view();
  colour.channels = 3;
  colour.width_px = 60;
  EXPECT_THROW(computer.compute(std::vector<ImageView>{colour}), InvalidArgument);
  MatrixF narrow(1, 2);
  EXPECT_THROW(computer.compute(std::vector<ImageView>{mask.view()}, narrow), InvalidArgument);
  options.speed_weight = 0;
  EXPECT_THROW(HybridFeatureComputer{options}, InvalidArgument);
  options = only(&HybridFeatureOptions::use_speed);
  options.use_speed = false;
  EXPECT_THROW(HybridFeatureComputer{options}, InvalidArgument);
  options = {};
  options.wavelet = "of nothing";
  EXPECT_THROW(HybridFeatureComputer{options}, InvalidArgument);
}

}  // namespace
}  // namespace hri
