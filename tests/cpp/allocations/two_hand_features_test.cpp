// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Features of both hands are written where the caller wants them.
#include "hri/features/hand/two_hand_features.hpp"

#include <gtest/gtest.h>

#include "allocations/allocation_counter.hpp"

namespace hri {
namespace {

TEST(TwoHandFeatures, AllocatesNothing) {
  const MatrixF tracks = MatrixF::Random(300, kNumTwoHandTrackColumns);
  const TwoHandFeatureComputer computer{TwoHandFeatureOptions()};
  MatrixF out(tracks.rows(), computer.num_features());
  EXPECT_EQ(allocations_of([&] { computer.compute(tracks, 1, out); }), 0);
}

}  // namespace
}  // namespace hri
