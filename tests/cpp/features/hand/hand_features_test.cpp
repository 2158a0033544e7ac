// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/hand_features.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>
#include <vector>

#include "features/hand_testing.hpp"
#include "hri/core/error.hpp"

namespace hri {
namespace {

using hand_testing::grey;
using hand_testing::hand;

VectorF features_of(const GreyImage& mask) {
  return HandFeatureComputer({}).compute(grey(mask).view(), mask.view());
}

TEST(HandFeatures, HardlyChangeWithPlaceAndSize) {
  const VectorF here = features_of(hand(3));
  const VectorF there = features_of(hand(3, 80, 130));
  const VectorF smaller = features_of(hand(3, 100, 120, 0.8));
  const VectorF other = features_of(hand(5));
  const float to_other = (here - other).norm();
  EXPECT_LT((here - there).norm(), 0.25F * to_other);
  EXPECT_LT((here - smaller).norm(), 0.6F * to_other);
  EXPECT_TRUE(here.allFinite());
}

TEST(HandFeatures, PartsCanBeTurnedOff) {
  HandFeatureOptions options;
  const int all = HandFeatureComputer(options).num_features();
  options.use_cepstrum = false;
  EXPECT_EQ(HandFeatureComputer(options).num_features(), all - 14);
  options.use_grey = options.use_silhouette = false;
  EXPECT_THROW(HandFeatureComputer{options}, InvalidArgument);
}

// The concatenated features_of of descriptors alone.
VectorF descriptors(const GreyImage& mask) {
  HandFeatureOptions options;
  options.use_grey = options.use_silhouette = options.use_cepstrum = false;
  options.use_wavelet = options.use_moments = options.use_fourier = options.use_chain_code = true;
  options.descriptor_weight = 0.5;
  const HandFeatureComputer computer(options);
  EXPECT_EQ(computer.num_features(), 136 + 7 + 32 + 8);
  return computer.compute(grey(mask).view(), mask.view());
}

TEST(HandFeatures, ScaleEveryDescriptorToOneLength) {
  const VectorF all = descriptors(hand(4));
  EXPECT_NEAR(all.head(136).norm(), 0.5, 1e-5);
  EXPECT_NEAR(all.segment(136, 7).norm(), 0.5, 1e-5);
  EXPECT_NEAR(all.segment(143, 32).norm(), 0.5, 1e-5);
  EXPECT_NEAR(all.tail(8).norm(), 0.5, 1e-5);
  HandFeatureOptions options;
  options.descriptor_weight = 0;
  EXPECT_THROW(HandFeatureComputer{options}, InvalidArgument);
}

TEST(HandFeatures, DescriptorsLeaveALongForearmOut) {
  const auto with_arm = [](int last) {
    GreyImage mask(100, 200);
    for (int y = 10; y < last; ++y) {
      for (int x = 30; x < 70; ++x) mask.pixels[static_cast<std::size_t>(y * 100 + x)] = 255;
    }
    for (int x = 30; x < 70; ++x) mask.pixels[static_cast<std::size_t>((10 + x % 7) * 100 + x)] = 0;
    return mask;
  };
  EXPECT_EQ(descriptors(with_arm(120)), descriptors(with_arm(190)));
}

TEST(HandFeatures, RefuseAnEmptyMaskAndUnequalSizes) {
  const GreyImage empty(200, 200);
  EXPECT_THROW(features_of(empty), InvalidArgument);
  const GreyImage mask = hand(2);
  EXPECT_THROW(HandFeatureComputer({}).compute(GreyImage(10, 10).view(), mask.view()),
               InvalidArgument);
}

TEST(HandFeatures, AreTheSameInEveryThread) {
  const GreyImage mask = hand(4);
  const GreyImage image = grey(mask);
  const HandFeatureComputer computer({});
  const VectorF expected = computer.compute(image.view(), mask.view());
  std::vector<VectorF> found(4);
  std::vector<std::thread> threads;
  for (VectorF& f : found)
    threads.emplace_back([&] { f = computer.compute(image.view(), mask.view()); });
  for (std::thread& t : threads) t.join();
  for (const VectorF& f : found) EXPECT_EQ(f, expected);
}

}  // namespace
}  // namespace hri
