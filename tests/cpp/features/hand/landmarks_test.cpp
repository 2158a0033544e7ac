// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/landmarks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hri/core/error.hpp"

namespace hri {
namespace {

// A wrist, and five straight fingers `spread` apart.
MatrixF hand_at(float x, float y, float scale, float spread) {
  MatrixF points(kNumLandmarks, 2);
  points.row(0) << x, y;
  for (int finger = 0; finger < 5; ++finger) {
    const float angle = spread * static_cast<float>(finger - 2);
    for (int joint = 0; joint < 4; ++joint) {
      const float r = scale * (30.0F + 15.0F * static_cast<float>(joint));
      points.row(1 + 4 * finger + joint) << x + r * std::sin(angle), y - r * std::cos(angle);
    }
  }
  return points;
}

std::vector<float> landmark_features_of(const MatrixF& points, int width, int height) {
  std::vector<float> out(kNumLandmarkFeatures);
  landmark_features(points, width, height, out);
  return out;
}

TEST(LandmarkFeatures, TellShapesApartButNotPlaceOrSize) {
  const auto one = landmark_features_of(hand_at(300, 300, 1, 0.2F), 640, 480);
  const auto other = landmark_features_of(hand_at(300, 400, 2, 0.2F), 1280, 960);
  const auto spread = landmark_features_of(hand_at(300, 300, 1, 0.3F), 640, 480);
  double difference = 0;
  for (std::size_t i = 0; i < kNumLandmarkFeatures - kNumLandmarkTrackColumns; ++i) {
    EXPECT_NEAR(one[i], other[i], 1e-5F) << landmark_column_names()[i];
    difference += std::abs(one[i] - spread[i]);
  }
  EXPECT_GT(difference, 1);
  EXPECT_NE(one[kNumLandmarkFeatures - 3], other[kNumLandmarkFeatures - 3]);
}

TEST(LandmarkFeatures, BonesOfStraightFingersPointOneWay) {
  const auto row = landmark_features_of(hand_at(100, 100, 1, 0), 200, 200);
  for (std::size_t i = 42; i < 82; i += 2) {
    EXPECT_FLOAT_EQ(row[i], 0) << i;
    EXPECT_FLOAT_EQ(row[i + 1], -0.5F) << i;
  }
  EXPECT_EQ(landmark_column_names().size(), static_cast<std::size_t>(kNumLandmarkFeatures));
  EXPECT_EQ(landmark_column_names()[42], "bone1_x");
}

TEST(LandmarkFeatures, HoldForPointsInOnePlaceAndRefuseWhatIsNoHand) {
  for (const float v : landmark_features_of(MatrixF::Constant(kNumLandmarks, 2, 7), 10, 10))
    EXPECT_TRUE(std::isfinite(v));
  EXPECT_THROW(landmark_features_of(MatrixF::Zero(20, 2), 10, 10), InvalidArgument);
  EXPECT_THROW(landmark_features_of(MatrixF::Zero(kNumLandmarks, 2), 0, 10), InvalidArgument);
  MatrixF broken = MatrixF::Zero(kNumLandmarks, 2);
  broken(3, 1) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(landmark_features_of(broken, 10, 10), InvalidArgument);
}

}  // namespace
}  // namespace hri
