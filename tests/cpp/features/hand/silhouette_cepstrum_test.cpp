// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/silhouette_cepstrum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "features/hand_testing.hpp"
#include "hri/core/error.hpp"

namespace hri {
namespace {

using hand_testing::hand;

VectorF cepstrum(const GreyImage& mask, const SilhouetteCepstrumOptions& options = {}) {
  const SilhouetteCepstrumComputer computer(options);
  VectorF out(computer.num_features());
  computer.compute(mask.view(), {out.data(), static_cast<std::size_t>(out.size())});
  return out;
}

TEST(ContourSignal, IsFlatForACircleAndHasAPeakForEveryFinger) {
  const SilhouetteCepstrumComputer computer({});
  const auto spread = [](const std::vector<float>& s) {
    return *std::max_element(s.begin(), s.end()) - *std::min_element(s.begin(), s.end());
  };
  EXPECT_LT(spread(computer.contour_signal(hand(0).view())), 0.2F);
  EXPECT_GT(spread(computer.contour_signal(hand(3).view())), 0.8F);
}

TEST(SilhouetteCepstrum, TellsShapesApartAndForgetsPlace) {
  const float to_other = (cepstrum(hand(2)) - cepstrum(hand(5))).norm();
  EXPECT_LT((cepstrum(hand(2)) - cepstrum(hand(2, 90, 130))).norm(), 0.5F * to_other);
  EXPECT_TRUE(cepstrum(hand(5)).allFinite());
  EXPECT_THROW(cepstrum(GreyImage(20, 20)), InvalidArgument);
}

// Thesis section 3.1.3: 11 frames of 12 numbers.
SilhouetteCepstrumOptions as_in_thesis(int num_levels) {
  SilhouetteCepstrumOptions options;
  options.wavelet = "haar";
  options.num_levels = num_levels;
  options.signal = SilhouetteSignal::picture;
  options.num_frames = 11;
  options.average_frames = false;
  options.num_cepstra = 11;
  return options;
}

// A frame of 100 x 100 pixels around two bars, so that every such picture has the same hand box.
GreyImage bars(int left_width, int right_width) {
  GreyImage mask(200, 200);
  for (int y = 50; y < 150; ++y) {
    for (int x = 50; x < 150; ++x) {
      const bool edge = y == 50 || y == 149;
      const bool bar = x < 50 + left_width || x >= 150 - right_width;
      mask.pixels[static_cast<std::size_t>(200 * y + x)] = edge || bar ? 255 : 0;
    }
  }
  return mask;
}

TEST(PictureSignal, RunsDownTheColumnsOfTheApproximation) {
  for (const int levels : {0, 1, 3}) {
    const SilhouetteCepstrumComputer computer(as_in_thesis(levels));
    const std::vector<float> signal = computer.picture_signal(bars(30, 10).view());
    const auto side = static_cast<std::size_t>(256 >> levels);
    ASSERT_EQ(signal.size(), side * side);
    // Halfway down: 8 of 116 parts of the width are padding, then 30 of the left bar follow.
    const auto at = [&](double part) {
      return signal[static_cast<std::size_t>(part / 116 * static_cast<double>(side)) * side +
                    side / 2];
    };
    EXPECT_NEAR(at(3), 0, 1e-6) << levels;
    EXPECT_NEAR(at(20), 1, 1e-6) << levels;
    EXPECT_NEAR(at(58), 0, 1e-6) << levels;
    EXPECT_NEAR(at(104), 1, 1e-6) << levels;
  }
}

TEST(SilhouetteCepstrum, OfFramesFollowsTheColumnsOfThePicture) {
  for (const int levels : {0, 3}) {
    const SilhouetteCepstrumOptions options = as_in_thesis(levels);
    const VectorF a = cepstrum(bars(30, 10), options);
    const VectorF b = cepstrum(bars(30, 30), options);
    ASSERT_EQ(a.size(), 11 * 12);
    EXPECT_TRUE(a.allFinite());
    // A frame covers a sixth of the columns, the next one begins half of that later.
    EXPECT_EQ(a.head(5 * 12), b.head(5 * 12)) << levels;
    EXPECT_GT((a.segment(8 * 12, 12) - b.segment(8 * 12, 12)).norm(), 1) << levels;
  }
}

TEST(SilhouetteCepstrum, AveragesTheFramesItWouldJoin) {
  for (const auto signal : {SilhouetteSignal::contour, SilhouetteSignal::picture}) {
    for (const int num_frames : {1, 3, 11}) {
      SilhouetteCepstrumOptions options = as_in_thesis(2);
      options.signal = signal;
      options.num_frames = num_frames;
      const VectorF joined = cepstrum(hand(3), options);
      ASSERT_EQ(joined.size(), num_frames * 12);
      options.average_frames = true;
      VectorF mean = VectorF::Zero(12);
      for (int frame = 0; frame < num_frames; ++frame) mean += joined.segment(12 * frame, 12);
      mean /= static_cast<float>(num_frames);
      EXPECT_LT((cepstrum(hand(3), options) - mean).norm(), 1e-4F * mean.norm()) << num_frames;
    }
  }
}

TEST(SilhouetteCepstrum, RefusesFramesThatDoNotFitTheSignal) {
  const auto fault = [](auto change) {
    SilhouetteCepstrumOptions options = as_in_thesis(0);
    change(options);
    return options_fault(options);
  };
  const std::string name = "SilhouetteCepstrumOptions: ";
  EXPECT_EQ(fault([](auto& o) { o.mask_px = 1024; }),
            name + "mask_px after num_levels is too large for num_frames");
  EXPECT_EQ(fault([](auto& o) {
              o.mask_px = 64;
              o.num_levels = 4;
              o.num_frames = 32;
            }),
            name + "mask_px after num_levels is too small for num_frames");
  EXPECT_EQ(fault([](auto& o) {
              o.signal = SilhouetteSignal::contour;
              o.num_points = 64;
            }),
            name + "num_points is too few for num_frames");
  EXPECT_EQ(fault([](auto& o) { o.num_cepstra = 20; }),
            name + "num_cepstra must be less than num_filters");
  // Long filters make the approximation larger than half of the picture.
  EXPECT_EQ(fault([](auto& o) {
              o.wavelet = "db20";
              o.num_levels = 1;
              o.mask_px = 512;
              o.num_frames = 1;
            }),
            name + "mask_px after num_levels is too large for num_frames");
}

TEST(SilhouetteCepstrum, NamesTheFieldThatDoesNotFit) {
  SilhouetteCepstrumOptions options;
  options.num_levels = 9;
  EXPECT_THROW(SilhouetteCepstrumComputer{options}, InvalidArgument);
  options = {};
  options.wavelet = "db99";
  EXPECT_THROW(SilhouetteCepstrumComputer{options}, InvalidArgument);
}

}  // namespace
}  // namespace hri
