// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/features/speech/cepstra.hpp"
#include "models/model_testing.hpp"

namespace hri {
namespace {

TEST(AppendDeltas, GiveTheSlopeOfARampAndHtksValuesAtItsEnds) {
  MatrixF frames = MatrixF::Zero(20, 2);
  for (int t = 0; t < 20; ++t) frames(t, 0) = 3.0F * static_cast<float>(t);
  append_deltas(frames, 0, 1, 2);
  for (int t = 2; t < 18; ++t) EXPECT_NEAR(frames(t, 1), 3, 1e-5);
  // (1 (x1 - x0) + 2 (x2 - x0)) / 10 at the first frame, (1 (x2 - x0) + 2 (x3 - x0)) / 10 next.
  EXPECT_NEAR(frames(0, 1), (3 + 2 * 6) / 10.0, 1e-5);
  EXPECT_NEAR(frames(1, 1), (6 + 2 * 9) / 10.0, 1e-5);
  EXPECT_NEAR(frames(19, 1), (3 + 2 * 6) / 10.0, 1e-5);
}

TEST(AppendDeltas, HoldTheRegressionFormulaForEveryWindow) {
  for (const int window : {1, 2, 5, 10}) {
    const MatrixF x = testing_data::noise(7, 3, 8);
    MatrixF frames(7, 8);
    frames.setConstant(9);
    frames.middleCols(1, 3) = x;
    append_deltas(frames, 1, 3, window);
    for (int t = 0; t < 7; ++t) {
      for (int c = 0; c < 3; ++c) {
        double above = 0;
        double below = 0;
        for (int k = 1; k <= window; ++k) {
          above += k * (static_cast<double>(x(std::min(t + k, 6), c)) - x(std::max(t - k, 0), c));
          below += 2.0 * k * k;
        }
        EXPECT_NEAR(frames(t, 4 + c), above / below, 1e-5) << window;
      }
    }
    // Other columns stay as they were.
    EXPECT_EQ(frames.leftCols(1), MatrixF::Constant(7, 1, 9));
    EXPECT_EQ(frames.rightCols(1), MatrixF::Constant(7, 1, 9));
    EXPECT_EQ(frames.middleCols(1, 3), x);
  }
}

TEST(AppendDeltas, AreZeroForOneFrameAndForNoFrames) {
  MatrixF one = MatrixF::Constant(1, 4, 5);
  append_deltas(one, 0, 2, 3);
  EXPECT_EQ(one.rightCols(2), MatrixF::Zero(1, 2));
  MatrixF none(0, 4);
  append_deltas(none, 0, 2, 3);
}

TEST(Normalise, CentresAndScalesTheFirstColumnsOnly) {
  const MatrixF x = testing_data::noise(50, 4, 2, 10);
  MatrixF mean = x;
  normalise(mean, 3, Normalisation::mean, 0);
  MatrixF scaled = x;
  normalise(scaled, 3, Normalisation::mean_variance, 0);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(mean.col(c).mean(), 0, 1e-5);
    EXPECT_NEAR(mean(7, c) - mean(6, c), x(7, c) - x(6, c), 1e-5);
    EXPECT_NEAR(scaled.col(c).mean(), 0, 1e-5);
    EXPECT_NEAR(scaled.col(c).squaredNorm() / 50, 1, 1e-4);
  }
  EXPECT_EQ(mean.col(3), x.col(3));
  EXPECT_EQ(scaled.col(3), x.col(3));
}

TEST(Normalise, MovesOnlyC0ForTheLevel) {
  const MatrixF x = testing_data::noise(50, 3, 2, 10);
  MatrixF level = x;
  normalise(level, 3, Normalisation::level, 1);
  EXPECT_NEAR(level.col(1).mean(), 0, 1e-5);
  EXPECT_EQ(level.col(0), x.col(0));
  EXPECT_EQ(level.col(2), x.col(2));
  for (const auto& [kind, c0] :
       {std::pair{Normalisation::level, -1}, {Normalisation::none, 0}, {Normalisation::none, -1}}) {
    MatrixF same = x;
    normalise(same, 3, kind, c0);
    EXPECT_EQ(same, x);
  }
}

TEST(Normalise, MakesConstantColumnsZero) {
  for (const Normalisation kind : {Normalisation::mean, Normalisation::mean_variance}) {
    for (const float value : {7.0F, 0.1F, -1e6F, 0.0F}) {
      MatrixF frames = MatrixF::Constant(13, 2, value);
      normalise(frames, 2, kind, 0);
      EXPECT_EQ(frames, MatrixF::Zero(13, 2)) << value;
    }
  }
}

TEST(Normalise, TakesOneFrameAndNone) {
  MatrixF one = MatrixF::Constant(1, 2, 3);
  normalise(one, 2, Normalisation::mean_variance, 0);
  EXPECT_EQ(one, MatrixF::Zero(1, 2));
}

TEST(AppendDeltas, RefuseColumnsThatAreNotThere) {
  MatrixF frames = MatrixF::Zero(5, 3);
  EXPECT_THROW(append_deltas(frames, 0, 2, 2), Error);
  EXPECT_THROW(append_deltas(frames, 2, 1, 2), Error);
  EXPECT_THROW(append_deltas(frames, -1, 1, 2), Error);
  append_deltas(frames, 1, 1, 2);
}

TEST(Normalise, RefusesColumnsAndFramesThatAreTooFew) {
  MatrixF frames = MatrixF::Zero(5, 3);
  EXPECT_THROW(normalise(frames, 4, Normalisation::mean, -1), Error);
  EXPECT_THROW(normalise(frames, 3, Normalisation::level, 3), Error);
  std::vector<float> frame(2);
  RunningNormaliser running;
  running.start(3, Normalisation::running_mean, 100);
  EXPECT_THROW(running.apply({frame.data(), frame.size()}), Error);
  RastaFilter rasta;
  rasta.start(3, 0.98);
  EXPECT_THROW(rasta.apply({frame.data(), frame.size()}), Error);
}

}  // namespace
}  // namespace hri
