// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Features of both hands are written where the caller wants them.
#include "hri/features/hand/two_hand_features.hpp"

#include <gtest/gtest.h>

#include "allocations/allocation_counter.hpp"

namespace hri {
namespace {

using namespace testing_data;

TEST(TwoHandFeatures, AllocatesNothing) {
  MatrixF tracks(300, kNumTwoHandTrackColumns);
  for (Eigen::Index i = 0; i < tracks.size(); ++i) tracks.data()[i] = static_cast<float>(i % 97);
  const TwoHandFeatureComputer computer{TwoHandFeatureOptions()};
  MatrixF out(tracks.rows(), computer.num_features());
  EXPECT_EQ(allocations_of([&] { computer.compute(tracks, 1, out); }), 0);
}

}  // namespace
}  // namespace hri
