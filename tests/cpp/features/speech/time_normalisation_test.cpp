// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/speech/time_normalisation.hpp"

#include <gtest/gtest.h>

#include "hri/core/error.hpp"

namespace hri {
namespace {

TEST(NormaliseTime, InterpolatesBetweenRows) {
  MatrixF frames(3, 2);
  frames << 0, 10, 2, 20, 4, 40;
  MatrixF expected(5, 2);
  expected << 0, 10, 1, 15, 2, 20, 3, 30, 4, 40;
  EXPECT_TRUE(normalise_time(frames, 5).isApprox(expected, 1e-6F));
  EXPECT_TRUE(normalise_time(expected, 3).isApprox(frames, 1e-6F));
  EXPECT_EQ(normalise_time(frames, 3), frames);
}

TEST(NormaliseTime, MeetsEdgeLengths) {
  MatrixF one(1, 2);
  one << 3, 4;
  EXPECT_EQ(normalise_time(one, 1), one);
  const MatrixF four = normalise_time(one, 4);
  for (Eigen::Index r = 0; r < 4; ++r) EXPECT_EQ(four.row(r), one.row(0));
  MatrixF two(2, 1);
  two << 1, 2;
  EXPECT_FLOAT_EQ(normalise_time(two, 1)(0, 0), 1.5F);
}

TEST(NormaliseTime, RefusesNothingToWorkOn) {
  EXPECT_THROW(normalise_time(MatrixF(0, 3), 5), InvalidArgument);
  EXPECT_THROW(normalise_time(MatrixF::Zero(3, 3), 0), InvalidArgument);
}

}  // namespace
}  // namespace hri
