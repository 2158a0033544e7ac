// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Watching masks allocates nothing once a few have come, whatever the hand does.
#include "hri/recognition/gesture/gesture_segmenter.hpp"

#include <gtest/gtest.h>

#include "allocations/allocation_counter.hpp"
#include "features/hand_testing.hpp"

namespace hri {
namespace {

TEST(GestureSegmenter, AllocatesNothingOnceMasksOfOneSizeHaveCome) {
  std::vector<GreyImage> masks;
  for (int t = 0; t < 40; ++t) masks.push_back(hand_testing::hand(2, 60 + 2 * t, 120, 0.6));
  const GreyImage away(200, 200);
  GestureSegmenter segmenter({});
  int index = 0;
  int num_ends = 0;
  const auto push = [&](const GreyImage& mask) {
    const GestureSegment s = segmenter.push(mask.view(), 0.04 * index++);
    num_ends += s.kind == GestureSegmentKind::end ? 1 : 0;
  };
  for (const GreyImage& mask : masks) push(mask);
  EXPECT_EQ(testing_data::allocations_of([&] {
              for (int round = 0; round < 3; ++round) {
                for (int i = 0; i < 20; ++i) push(masks[39]);
                for (int i = 0; i < 12; ++i) push(away);
                for (const GreyImage& mask : masks) push(mask);
                segmenter.replace_outlines(masks[5].view());
              }
            }),
            0);
  EXPECT_GE(num_ends, 3);
}

}  // namespace
}  // namespace hri
