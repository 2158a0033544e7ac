// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Gestures of a hand that is held at another angle than in training.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/features/hand/landmarks.hpp"
#include "hri/recognition/gesture/gesture_recognizer.hpp"

namespace hri {
namespace {

// Straight fingers that spread, or close, while the wrist stays where it is.
GestureSample gesture(bool spreads, int take, float turn) {
  constexpr Eigen::Index kSpreadFrames = 16;
  MatrixF rows(kSpreadFrames, kNumLandmarkFeatures);
  for (Eigen::Index t = 0; t < kSpreadFrames; ++t) {
    const float done = static_cast<float>(t) / (kSpreadFrames - 1);
    const float spread = 0.1F + 0.3F * (spreads ? done : 1 - done);
    MatrixF points(kNumLandmarks, 2);
    points.row(0) << 300, 300;
    for (int joint = 1; joint < kNumLandmarks; ++joint) {
      const float angle = spread * static_cast<float>((joint - 1) / 4 - 2) + turn;
      const float length = 30.0F + 15.0F * static_cast<float>((joint - 1) % 4 + take % 3);
      points.row(joint) << 300 + length * std::sin(angle), 300 - length * std::cos(angle);
    }
    landmark_features(points, 640, 480, {rows.data() + t * rows.cols(), kNumLandmarkFeatures});
  }
  return {rows, spreads ? "spread" : "close", ""};
}

GestureRecognizer trained(double turn_degrees) {
  GestureRecognizerOptions options;
  options.source = GestureSource::landmarks;
  options.model = GestureModel::trajectory;
  options.turn_degrees = turn_degrees;
  std::vector<GestureSample> samples;
  for (int take = 0; take < 8; ++take) {
    samples.push_back(gesture(true, take, 0.02F * static_cast<float>(take)));
    samples.push_back(gesture(false, take, 0.02F * static_cast<float>(take)));
  }
  return GestureRecognizer::train(samples, options);
}

// By how much the true label leads, at the worst, for hands held at other angles.
float least_lead(const GestureRecognizer& recognizer) {
  float least = 10;
  for (const float turn : {-0.7F, -0.5F, 0.6F, 0.8F}) {
    for (const bool spreads : {true, false}) {
      const VectorF scores = recognizer.scores(gesture(spreads, 1, turn).features);
      least = std::min(least, spreads ? scores[1] - scores[0] : scores[0] - scores[1]);
    }
  }
  return least;
}

TEST(TurnedGestures, AreSurerWhereTrainingTurnedTheHand) {
  const float upright = least_lead(trained(0));
  EXPECT_GT(least_lead(trained(30)), upright + 0.1F);
}

TEST(TurnedGestures, AreLearnedOfTwoHandsAndNotOfOtherRows) {
  // Rows of another kind, as of hands' tracks, are learned as they are.
  GestureRecognizerOptions options;
  options.source = GestureSource::landmarks;
  options.model = GestureModel::trajectory;
  const auto scores = [&options](double degrees, int copies, Eigen::Index columns) {
    options.turn_degrees = degrees;
    std::vector<GestureSample> samples;
    for (int take = 0; take < 4; ++take) {
      for (const bool spreads : {true, false}) {
        const GestureSample one = gesture(spreads, take, 0);
        const MatrixF shape = one.features.leftCols(columns);
        MatrixF rows(shape.rows(), copies * columns + 3);
        for (int c = 0; c < copies; ++c) rows.middleCols(c * columns, columns) = shape;
        rows.rightCols(3) = one.features.rightCols(3);
        samples.push_back({rows, one.label, ""});
      }
    }
    return GestureRecognizer::train(samples, options).scores(samples.front().features);
  };
  const Eigen::Index shape = kNumLandmarkFeatures - kNumLandmarkTrackColumns;
  EXPECT_NE(scores(30, 2, shape), scores(0, 2, shape));
  EXPECT_EQ(scores(30, 1, 10), scores(0, 1, 10));
  EXPECT_THROW((void)scores(91, 1, shape), InvalidArgument);
}

}  // namespace
}  // namespace hri
