// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/vision/mask_smoothing.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "features/hand_testing.hpp"
#include "hri/core/error.hpp"

namespace hri {
namespace {

using hand_testing::hand;

HandObservation seen(const GreyImage& mask, double quality) {
  HandObservation s;
  s.grey = GreyImage(mask.width_px, mask.height_px);
  s.mask = mask;
  s.quality = quality;
  return s;
}

// A hand that goes right, well seen.
std::vector<HandObservation> clip(int num_frames = 8) {
  std::vector<HandObservation> frames;
  for (int t = 0; t < num_frames; ++t) frames.push_back(seen(hand(4, 80 + t, 120, 0.8), 0.9));
  return frames;
}

GreyImage elsewhere() { return hand(1, 30, 40, 0.6); }

double overlap(const GreyImage& a, const GreyImage& b) {
  double both = 0;
  double either = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    both += a.pixels[i] != 0 && b.pixels[i] != 0 ? 1 : 0;
    either += a.pixels[i] != 0 || b.pixels[i] != 0 ? 1 : 0;
  }
  return both / either;
}

TEST(SmoothMasks, MasksThatJumpAreRepaired) {
  for (const int length : {1, 2}) {
    std::vector<HandObservation> frames = clip();
    std::vector<int> expected;
    for (int i = 3; i < 3 + length; ++i) {
      frames[static_cast<std::size_t>(i)] = seen(elsewhere(), 0.4);
      expected.push_back(i);
    }
    EXPECT_EQ(smooth_masks({}, &frames), expected);
    for (const int i : expected) {
      const HandObservation& s = frames[static_cast<std::size_t>(i)];
      EXPECT_GT(overlap(s.mask, hand(4, 80 + i, 120, 0.8)), 0.75);
      EXPECT_DOUBLE_EQ(s.quality, 0.45);
      EXPECT_TRUE(s.repaired);
    }
    EXPECT_FALSE(frames[2].repaired);
    EXPECT_TRUE(smooth_masks({}, &frames).empty()) << "once is enough";
  }
}

TEST(SmoothMasks, FramesThatMissTheHandAreRepaired) {
  std::vector<HandObservation> frames = clip();
  frames[4] = seen(GreyImage(200, 200), 0);
  EXPECT_EQ(smooth_masks({}, &frames), std::vector<int>{4});
  EXPECT_GT(overlap(frames[4].mask, hand(4, 84, 120, 0.8)), 0.75);
}

TEST(SmoothMasks, WhatIsNoJumpStaysAsItIs) {
  const std::vector<HandObservation> before = clip();
  const auto untouched = [&](auto change) {
    std::vector<HandObservation> frames = before;
    change(&frames);
    const std::vector<HandObservation> changed = frames;
    EXPECT_TRUE(smooth_masks({}, &frames).empty());
    for (std::size_t i = 0; i < frames.size(); ++i)
      EXPECT_EQ(frames[i].mask.pixels, changed[i].mask.pixels);
  };
  untouched([](auto*) {});
  // As well seen as the frames around it: a fast movement, perhaps.
  untouched([](auto* f) { (*f)[3] = seen(elsewhere(), 0.9); });
  // Longer than two frames: the hand was there.
  untouched([](auto* f) {
    for (std::size_t i = 2; i < 5; ++i) (*f)[i] = seen(elsewhere(), 0.4);
  });
  // At the ends there is nothing to repair by.
  untouched([](auto* f) { (*f)[0] = (*f)[7] = seen(elsewhere(), 0.4); });
  // A hand that leaves comes into view elsewhere.
  untouched([](auto* f) {
    (*f)[3] = seen(GreyImage(200, 200), 0);
    for (std::size_t i = 4; i < 8; ++i) (*f)[i] = seen(elsewhere(), 0.9);
  });
  // Another size.
  untouched([](auto* f) { (*f)[3] = seen(GreyImage(100, 100), 0); });
}

TEST(SmoothMasks, OptionsSayWhatIsRepaired) {
  std::vector<HandObservation> frames = clip();
  frames[3] = seen(elsewhere(), 0.4);
  MaskSmoothingOptions none;
  none.max_gap = 0;
  EXPECT_TRUE(smooth_masks(none, &frames).empty());
  MaskSmoothingOptions strict;
  strict.min_agreement = 0.99;
  EXPECT_TRUE(smooth_masks(strict, &frames).empty());
  std::vector<HandObservation> shorter(frames.begin(), frames.begin() + 2);
  EXPECT_TRUE(smooth_masks({}, &shorter).empty());
  const auto refused = [&](auto change) {
    MaskSmoothingOptions options;
    change(options);
    EXPECT_THROW(smooth_masks(options, &frames), InvalidArgument);
  };
  refused([](auto& o) { o.max_gap = 11; });
  refused([](auto& o) { o.min_agreement = -1; });
  refused([](auto& o) { o.max_overlap = 2; });
}

}  // namespace
}  // namespace hri
