// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand_features.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>
#include <vector>

#include "features/hand_testing.hpp"
#include "hri/core/error.hpp"
#include "hri/features/hand_crop.hpp"
#include "hri/features/orientation_histogram.hpp"

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

TEST(HandCrop, IsASquareAroundTheMask) {
  GreyImage mask(100, 100);
  for (int y = 40; y < 60; ++y) {
    for (int x = 20; x < 60; ++x) mask.pixels[static_cast<std::size_t>(y * 100 + x)] = 255;
  }
  const HandBox box = hand_box(mask.view(), 1.6F, 0.0F);
  EXPECT_NEAR(box.side_px, 40, 1.5);
  EXPECT_NEAR(box.left_px, 20, 1.5);
  EXPECT_NEAR(box.top_px + box.side_px / 2, 50, 1.5);
  EXPECT_EQ(hand_box(GreyImage(10, 10).view()).side_px, 0.0F);
  MatrixF out(16, 16);
  crop(mask.view(), box, out);
  EXPECT_GT(out(8, 8), 0.99F);
  EXPECT_LT(out(0, 0), 0.01F);
}

TEST(OrientationHistogram, PutsARampIntoOneBin) {
  OrientationHistogramOptions options;
  options.num_cells = 1;
  options.num_bins = 18;
  // Brightness that rises towards `angle_deg`, which lies in the middle of a bin.
  const auto ramp = [](double angle_deg) {
    const double angle = angle_deg * 3.14159265358979 / 180;
    MatrixF image(32, 32);
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 32; ++x) {
        image(y, x) = static_cast<float>(x * std::cos(angle) + y * std::sin(angle));
      }
    }
    return image;
  };
  const auto histogram = [&](const MatrixF& image) {
    VectorF out(orientation_histogram_size(options));
    orientation_histogram(image, options, {out.data(), static_cast<std::size_t>(out.size())});
    return out;
  };
  Eigen::Index first = 0;
  Eigen::Index second = 0;
  histogram(ramp(25)).maxCoeff(&first);
  histogram(ramp(115)).maxCoeff(&second);
  EXPECT_EQ(second - first, 9);  // 90 degrees in bins of 10
  EXPECT_LT((histogram(ramp(25)) - histogram(5.0F * ramp(25))).norm(), 1e-5F);
  EXPECT_EQ(histogram(MatrixF::Constant(32, 32, 3)), VectorF(VectorF::Zero(18)));
  options.num_cells = 64;
  EXPECT_THROW(histogram(ramp(0)), InvalidArgument);
}

TEST(OrientationHistogram, RefusesWhatHasNoDirection) {
  const OrientationHistogramOptions options;
  VectorF out(orientation_histogram_size(options));
  const Span<float> values(out.data(), static_cast<std::size_t>(out.size()));
  for (const float bad : {std::nanf(""), HUGE_VALF, -HUGE_VALF, 3e38F}) {
    MatrixF image = MatrixF::Zero(20, 20);
    image(7, 9) = bad;
    EXPECT_THROW(orientation_histogram(image, options, values), InvalidArgument) << bad;
  }
  MatrixF largest = MatrixF::Constant(20, 20, 1e6F);
  largest.leftCols(10) *= -1.0F;
  orientation_histogram(largest, options, values);
  EXPECT_TRUE(out.allFinite());
}

}  // namespace
}  // namespace hri
