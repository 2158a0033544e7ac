// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// A stream of masks of two hands allocates nothing once they touched.
#include "hri/features/hand/hand_pair.hpp"

#include <gtest/gtest.h>

#include "allocations/allocation_counter.hpp"
#include "features/hand_testing.hpp"

namespace hri {
namespace {

GreyImage both(double left, double right) {
  GreyImage mask = hand_testing::hand(4, left, 110, 0.45);
  const GreyImage other = hand_testing::hand(2, right, 112, 0.45);
  for (std::size_t i = 0; i < mask.pixels.size(); ++i)
    if (other.pixels[i] != 0) mask.pixels[i] = 255;
  return mask;
}

TEST(HandPair, AllocatesNothingOnceHandsTouched) {
  HandPairTracker tracker({});
  std::vector<GreyImage> masks;
  for (const double x : {60.0, 75.0, 85.0, 75.0, 60.0}) masks.push_back(both(x, 200 - x));
  bool touched = false;
  for (const GreyImage& m : masks) touched = tracker.push(m.view())[0].touching || touched;
  EXPECT_TRUE(touched);
  EXPECT_EQ(testing_data::allocations_of([&] {
              for (const GreyImage& m : masks) tracker.push(m.view());
            }),
            0);
}

}  // namespace
}  // namespace hri
