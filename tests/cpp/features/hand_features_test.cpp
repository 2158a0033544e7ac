// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand_features.hpp"

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

VectorF features(const GreyImage& mask) {
  return HandFeatureComputer({}).compute(grey(mask).view(), mask.view());
}

TEST(HandFeatures, HardlyChangeWithPlaceAndSize) {
  const VectorF here = features(hand(3));
  const VectorF there = features(hand(3, 80, 130));
  const VectorF smaller = features(hand(3, 100, 120, 0.8));
  const VectorF other = features(hand(5));
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

TEST(HandFeatures, RefuseAnEmptyMaskAndUnequalSizes) {
  const GreyImage empty(200, 200);
  EXPECT_THROW(features(empty), InvalidArgument);
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
