// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/pair_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hri/core/error.hpp"
#include "hri/features/hand/two_hand_features.hpp"

namespace hri {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr Eigen::Index kShapes = 4, kColumns = kShapes + kNumPlaceColumns;

// A rows_of_hand of one shape that goes from x by `step` a frame, of a tenth of the picture.
MatrixF rows_of_hand(float shape, float x, float step, Eigen::Index num_frames) {
  MatrixF rows(num_frames, kColumns);
  for (Eigen::Index t = 0; t < num_frames; ++t)
    rows.row(t) << shape, 2, 0, 0, x + step * static_cast<float>(t), 0.5F, std::log(0.1F);
  return rows;
}

TEST(PairRows, HoldBothShapesTheWayBetweenAndTheMiddle) {
  const MatrixF rows = pair_rows(rows_of_hand(1, 0.2F, 0.1F, 3), rows_of_hand(5, 0.8F, 0, 3), 2);
  ASSERT_EQ(rows.rows(), 3);
  ASSERT_EQ(rows.cols(), num_pair_features(kColumns));
  EXPECT_NEAR(rows(0, 0), 5 / std::sqrt(29.0), 1e-6);  // the right rows_of_hand comes first
  EXPECT_NEAR(rows.row(1).segment(kShapes, kShapes).norm(), 1, 1e-6);
  EXPECT_NEAR(rows(0, 2 * kShapes), 2 * 0.6, 1e-6);  // from left to right, weighed
  EXPECT_NEAR(rows(2, 2 * kShapes), 2 * 0.4, 1e-6);
  EXPECT_NEAR(rows(2, 2 * kShapes + 2), 2 * 0.4, 1e-6);
  EXPECT_NEAR(rows(2, rows.cols() - 3), 0.6, 1e-6);
  EXPECT_NEAR(rows(2, rows.cols() - 1), std::log(0.2), 1e-6);
}

TEST(PairRows, AHandOutOfSightStaysWhereItWasSeen) {
  MatrixF left = rows_of_hand(1, 0.2F, 0.1F, 5);
  const MatrixF right = rows_of_hand(5, 0.8F, 0, 5);
  left.row(0).setConstant(kNone);
  left.row(3).setConstant(kNone);
  MatrixF held = left;
  held.row(0) = left.row(1);
  held.row(3) = left.row(2);
  EXPECT_EQ(pair_rows(left, right, 1), pair_rows(held, right, 1));
  MatrixF none = right;
  none.row(3).setConstant(kNone);
  EXPECT_EQ(pair_rows(left, none, 1).rows(), 4);  // a frame without either rows_of_hand has no row
  EXPECT_EQ(
      pair_rows(MatrixF::Constant(2, kColumns, kNone), MatrixF::Constant(2, kColumns, kNone), 1)
          .rows(),
      0);
}

TEST(PairRows, OneHandAloneIsTheSameOnEitherSide) {
  const MatrixF one = rows_of_hand(3, 0.3F, 0.05F, 10);
  MatrixF none = MatrixF::Constant(10, kColumns, kNone);
  const MatrixF rows = pair_rows(one, none, 1);
  EXPECT_EQ(rows, pair_rows(none, one, 1));
  EXPECT_TRUE((rows.middleCols(kShapes, kShapes + kNumRelationColumns).array() == 0).all());
  EXPECT_EQ(rows.rightCols(kNumPlaceColumns), one.rightCols(kNumPlaceColumns));
  none.row(4) = one.row(0);  // seen by mistake
  EXPECT_EQ(rows, pair_rows(one, none, 1));
}

TEST(PairRows, RefuseRowsThatDoNotFit) {
  const MatrixF one = rows_of_hand(3, 0.3F, 0.05F, 4);
  MatrixF broken = one;
  broken(2, 1) = kNone;
  EXPECT_THROW(pair_rows(broken, one, 1), InvalidArgument);
  EXPECT_THROW(pair_rows(one, broken, 1), InvalidArgument);
  broken(2, 1) = std::numeric_limits<float>::infinity();
  EXPECT_THROW(pair_rows(one, broken, 1), InvalidArgument);
  EXPECT_THROW(pair_rows(one, one.topRows(3), 1), InvalidArgument);
  EXPECT_THROW(pair_rows(one.rightCols(3), one.rightCols(3), 1), InvalidArgument);
  EXPECT_THROW(pair_rows(one, one, -1), InvalidArgument);
  EXPECT_THROW(pair_rows(one, one, std::nan("")), InvalidArgument);
}

TEST(TrackRows, AreTheFeaturesOfBothHandsAndTheirMiddle) {
  MatrixF tracks(2, kNumTwoHandTrackColumns);
  tracks << 90, 150, 110, 150, 100, 100, kNone, kNone, 110, 130, 100, 100;
  TwoHandFeatureOptions options;
  options.delta_orders = 0;
  const MatrixF both = track_rows(tracks, 50, 2);
  EXPECT_EQ(both.leftCols(4), TwoHandFeatureComputer(options).compute(tracks, 50));
  ASSERT_EQ(both.cols(), 4 + kNumPlaceColumns);
  EXPECT_NEAR(both(1, 4), 0, 1e-6);  // the left rows_of_hand stays
  EXPECT_NEAR(both(1, 5), 0.8, 1e-6);
  const MatrixF one = track_rows(tracks, 0, 1);
  ASSERT_EQ(one.cols(), 2 + kNumPlaceColumns);
  EXPECT_EQ(one.leftCols(2), one.middleCols(2, 2));
  EXPECT_THROW(track_rows(tracks, 50, 3), InvalidArgument);
  EXPECT_THROW(track_rows(tracks.leftCols(4), 50, 2), InvalidArgument);
}

}  // namespace
}  // namespace hri
