// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/hand_turn.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/numbers.hpp"
#include "features/hand_testing.hpp"
#include "hri/core/error.hpp"
#include "hri/core/random.hpp"
#include "hri/features/hand/landmarks.hpp"

namespace hri {
namespace {

using detail::kPi;

// Three fingers, turned clockwise.
GreyImage turned_hand(double degrees) {
  return hand_testing::hand(3, 100, 120, 1.0, degrees * kPi / 180);
}

VectorF features(const GreyImage& mask, const HandFeatureOptions& options) {
  return HandFeatureComputer(options).compute(hand_testing::grey(mask).view(), mask.view());
}

VectorF turned(const HandTurn& turn, const VectorF& shape) {
  VectorF result(shape.size());
  const auto size = static_cast<std::size_t>(shape.size());
  turn.apply({shape.data(), size}, {result.data(), size});
  return result;
}

TEST(HandTurn, BringsFeaturesCloserToThoseOfAHandThatIsTurned) {
  const HandFeatureOptions options;
  const VectorF upright = features(turned_hand(0), options);
  for (const double degrees : {-30.0, -15.0, 15.0, 30.0}) {
    const VectorF seen = features(turned_hand(degrees), options);
    const float before = (seen - upright).norm();
    EXPECT_LT((seen - turned(HandTurn(options, degrees), upright)).norm(), 0.8F * before);
    EXPECT_GT((seen - turned(HandTurn(options, -degrees), upright)).norm(), before);
  }
}

TEST(HandTurn, ByNothingChangesNothing) {
  HandFeatureOptions options;
  options.use_moments = true;
  const VectorF shape = features(turned_hand(0), options);
  const HandTurn turn(options, 0);
  EXPECT_EQ(turn.num_features(), shape.size());
  EXPECT_EQ(turned(turn, shape), shape);
}

TEST(HandTurn, MovesTheBinsOfASingleHistogram) {
  HandFeatureOptions options;
  options.histogram.num_cells = 1;
  options.use_silhouette = options.use_cepstrum = false;
  const VectorF shape = VectorF::LinSpaced(9, 1, 9);
  const VectorF moved = turned(HandTurn(options, 20), shape);  // by one bin of 180 / 9 degrees
  EXPECT_NEAR(moved[0], 9, 1e-5);
  for (Eigen::Index bin = 1; bin < 9; ++bin) EXPECT_NEAR(moved[bin], shape[bin - 1], 1e-5);
}

TEST(HandTurn, OfLandmarksIsExact) {
  Random random(5);
  MatrixF points(kNumLandmarks, 2);
  for (Eigen::Index i = 0; i < points.size(); ++i)
    points.data()[i] = 200 + 50 * static_cast<float>(random.normal());
  const float angle = 0.4F;
  MatrixF by_hand(kNumLandmarks, 2);
  by_hand.col(0) = std::cos(angle) * points.col(0) - std::sin(angle) * points.col(1);
  by_hand.col(1) = std::sin(angle) * points.col(0) + std::cos(angle) * points.col(1);
  VectorF before(kNumLandmarkFeatures);
  VectorF after(kNumLandmarkFeatures);
  landmark_features(points, 640, 480, {before.data(), kNumLandmarkFeatures});
  landmark_features(by_hand, 640, 480, {after.data(), kNumLandmarkFeatures});
  const Eigen::Index shape = kNumLandmarkFeatures - kNumLandmarkTrackColumns;
  const HandTurn turn = HandTurn::of_landmarks(static_cast<double>(angle) * 180 / kPi);
  ASSERT_EQ(turn.num_features(), shape);
  EXPECT_LT((turned(turn, before.head(shape)) - after.head(shape)).norm(), 1e-4F);
}

TEST(HandTurn, RefusesWhatIsNoAngleOrShape) {
  EXPECT_THROW(HandTurn({}, std::numeric_limits<double>::quiet_NaN()), InvalidArgument);
  EXPECT_THROW(HandTurn::of_landmarks(std::numeric_limits<double>::infinity()), InvalidArgument);
  const HandTurn turn({}, 10);
  VectorF shape = VectorF::Zero(turn.num_features());
  VectorF out = shape;
  const auto size = static_cast<std::size_t>(shape.size());
  EXPECT_THROW(turn.apply({shape.data(), size - 1}, {out.data(), size}), InvalidArgument);
  EXPECT_THROW(turn.apply({shape.data(), size}, {out.data(), size - 1}), InvalidArgument);
}

}  // namespace
}  // namespace hri
