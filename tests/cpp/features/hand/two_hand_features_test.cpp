// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/two_hand_features.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri {
namespace {

constexpr float kUnseen = std::numeric_limits<float>::quiet_NaN();

// Left hand, right hand, reference.
MatrixF row(float lx, float ly, float rx, float ry, float x = 100, float y = 50) {
  MatrixF result(1, kNumTwoHandTrackColumns);
  result << lx, ly, rx, ry, x, y;
  return result;
}

MatrixF rows(const std::vector<MatrixF>& parts) {
  MatrixF result(static_cast<Eigen::Index>(parts.size()), kNumTwoHandTrackColumns);
  for (std::size_t t = 0; t < parts.size(); ++t)
    result.row(static_cast<Eigen::Index>(t)) = parts[t].row(0);
  return result;
}

TwoHandFeatureOptions everything() {
  TwoHandFeatureOptions options;
  options.use_polar = options.use_relation = true;
  options.delta_orders = 1;
  return options;
}

MatrixF random_tracks(int num_frames) {
  Random random(7);
  MatrixF tracks(num_frames, kNumTwoHandTrackColumns);
  for (Eigen::Index i = 0; i < tracks.size(); ++i)
    tracks.data()[i] = static_cast<float>(100 + 40 * random.normal());
  return tracks;
}

TEST(TwoHandFeatures, HasPlacesPolarCoordinatesAndTheRelation) {
  const TwoHandFeatureComputer computer(everything());
  ASSERT_EQ(computer.num_static(), 13);
  const MatrixF out = computer.compute(row(140, 80, 70, 90), 10);
  ASSERT_EQ(out.cols(), computer.num_features());
  VectorF expected(13);
  expected << -3, 4, 4, 3, 5, -0.6F, 0.8F, 5, 0.8F, 0.6F, -7, 1, std::sqrt(50.0F);
  EXPECT_LT((out.row(0).head(13).transpose() - expected).cwiseAbs().maxCoeff(), 1e-5F);
  EXPECT_EQ(out.row(0).tail(13).cwiseAbs().maxCoeff(), 0);  // one frame does not change
}

TEST(TwoHandFeatures, KnowsWhatDependsOnNoHandOutOfView) {
  const TwoHandFeatureComputer computer(everything());
  const auto known = [&computer](const MatrixF& tracks) { return computer.known_columns(tracks); };
  EXPECT_EQ(known(row(140, 80, 70, 90)).size(), 26U);
  EXPECT_EQ(known(rows({row(140, 80, 70, 90), row(kUnseen, kUnseen, 70, 90)})).size(), 26U);
  const std::vector<int> right{0, 1, 4, 5, 6, 13, 14, 17, 18, 19};
  EXPECT_EQ(known(row(kUnseen, kUnseen, 70, 90)), right);
  const std::vector<int> left{2, 3, 7, 8, 9, 15, 16, 20, 21, 22};
  EXPECT_EQ(known(row(140, 80, kUnseen, kUnseen)), left);
  EXPECT_THROW(known(row(kUnseen, kUnseen, kUnseen, kUnseen)), InvalidArgument);
  // What is known does not change with a hand that is elsewhere.
  const MatrixF alone = computer.compute(row(kUnseen, kUnseen, 70, 90), 10);
  const MatrixF both = computer.compute(row(140, 80, 70, 90), 10);
  for (const int c : right) EXPECT_EQ(alone(0, c), both(0, c)) << c;
  TwoHandFeatureOptions options;
  options.use_left = false;
  EXPECT_TRUE(
      TwoHandFeatureComputer(options).known_columns(row(140, 80, kUnseen, kUnseen)).empty());
}

TEST(TwoHandFeatures, DeltasAreTheSlopesOfPlaces) {
  std::vector<MatrixF> parts;
  for (int t = 0; t < 9; ++t) parts.push_back(row(100, 60, 100.0F + 20.0F * t, 50));
  TwoHandFeatureOptions options;
  const MatrixF out = TwoHandFeatureComputer(options).compute(rows(parts), 10);
  EXPECT_NEAR(out(4, 4), 2, 1e-5);  // of the right hand's x, a frame
  EXPECT_NEAR(out(4, 8), 0, 1e-5);
  EXPECT_NEAR(out(4, 6), 0, 1e-5);  // of the left hand's
}

TEST(TwoHandFeatures, DoesNotChangeWhereThePictureMovesOrGrows) {
  const TwoHandFeatureComputer computer(everything());
  const MatrixF tracks = random_tracks(30);
  const MatrixF expected = computer.compute(tracks);
  const MatrixF other = computer.compute(MatrixF(2.5F * tracks.array() + 17.0F));
  EXPECT_LT((other - expected).cwiseAbs().maxCoeff(), 1e-4F);
}

TEST(TwoHandFeatures, ScaleIsTheRootMeanSquareDistance) {
  EXPECT_DOUBLE_EQ(hand_scale_px(row(130, 90, 100, 50)), std::sqrt(2500.0 / 2));
  EXPECT_DOUBLE_EQ(hand_scale_px(row(130, 90, kUnseen, kUnseen)), 50);
}

TEST(TwoHandFeatures, PointsOutOfSightStayWhereTheyWereSeen) {
  TwoHandFeatureOptions options;
  options.delta_orders = 0;
  const MatrixF tracks = rows({row(kUnseen, kUnseen, 110, 50), row(120, 50, kUnseen, kUnseen),
                               row(130, 50, 140, 50, kUnseen, kUnseen)});
  const MatrixF out = TwoHandFeatureComputer(options).compute(tracks, 10);
  EXPECT_EQ(out.col(0), (VectorF(3) << 1, 1, 4).finished());
  EXPECT_EQ(out.col(2), (VectorF(3) << 2, 2, 3).finished());
}

TEST(TwoHandFeatures, HandNeverSeenIsAtTheReference) {
  TwoHandFeatureOptions options;
  const MatrixF tracks = rows({row(kUnseen, kUnseen, 110, 50), row(kUnseen, kUnseen, 130, 60)});
  const MatrixF out = TwoHandFeatureComputer(options).compute(tracks, 10);
  EXPECT_EQ(out.middleCols(2, 2).cwiseAbs().maxCoeff(), 0);
  options.use_left = false;
  const MatrixF right = TwoHandFeatureComputer(options).compute(tracks, 10);
  EXPECT_EQ(right.cols(), 6);
  EXPECT_EQ(right.leftCols(2), out.leftCols(2));
}

TEST(TwoHandFeatures, RefusesWhatIsNoTrack) {
  const TwoHandFeatureComputer computer{TwoHandFeatureOptions()};
  const float inf = std::numeric_limits<float>::infinity();
  EXPECT_THROW(computer.compute(MatrixF(0, 6)), InvalidArgument);
  EXPECT_THROW(computer.compute(MatrixF::Zero(3, 5)), InvalidArgument);
  EXPECT_THROW(computer.compute(row(inf, 0, 0, 0)), InvalidArgument);
  EXPECT_THROW(computer.compute(row(2e6F, 0, 0, 0)), InvalidArgument);
  EXPECT_THROW(computer.compute(row(kUnseen, 0, 0, 0)), InvalidArgument);
  EXPECT_THROW(computer.compute(row(0, 0, 0, 0, kUnseen, kUnseen)), InvalidArgument);
  EXPECT_THROW(computer.compute(row(kUnseen, kUnseen, kUnseen, kUnseen)), InvalidArgument);
  EXPECT_THROW(computer.compute(row(100, 50, 100, 50)), InvalidArgument);
  EXPECT_THROW(computer.compute(row(1, 2, 3, 4), -1), InvalidArgument);
  EXPECT_THROW(computer.compute(row(1, 2, 3, 4), std::nan("")), InvalidArgument);
  MatrixF narrow(1, 3);
  EXPECT_THROW(computer.compute(row(1, 2, 3, 4), 1, narrow), InvalidArgument);
  TwoHandFeatureOptions options;
  options.use_relation = true;
  options.use_left = false;
  EXPECT_THROW(TwoHandFeatureComputer{options}, InvalidArgument);
}

}  // namespace
}  // namespace hri
