// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/wavelet_descriptor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "core/numbers.hpp"
#include "features/hand_testing.hpp"
#include "hri/core/error.hpp"

namespace hri {
namespace {

using detail::kPi;

using hand_testing::hand;

VectorF descriptor(const GreyImage& mask, WaveletDescriptorSource source) {
  WaveletDescriptorOptions options;
  options.source = source;
  const WaveletDescriptorComputer computer(options);
  VectorF out(computer.num_features());
  computer.compute(mask.view(), {out.data(), static_cast<std::size_t>(out.size())});
  return out;
}

TEST(WaveletDescriptor, HasThePairsOfThePaper) {
  const WaveletDescriptorComputer computer({});
  EXPECT_EQ(computer.num_features(), 4 * (3 + 5 + 9 + 17));
}

TEST(BSplineWavelet, IsSymmetricAboutAHalfWithANegativeSide) {
  // 4 a^4 / sqrt(8 pi) sigma
  EXPECT_NEAR(b_spline_wavelet(0.5), 0.141115, 1e-6);
  EXPECT_NEAR(b_spline_wavelet(0.2), b_spline_wavelet(0.8), 1e-12);
  EXPECT_LT(b_spline_wavelet(1.1), 0);
}

// Of a disc, b = 0 is 2 pi times the integral of psi(r) r, and nothing else is left. The radius of
// 90 pixels is known to half a pixel, which moves the shortest wavelets at the rim by 0.01.
TEST(WaveletDescriptor, OfADiscIsTheIntegralAlongTheRadius) {
  const VectorF disc = descriptor(hand(0, 100, 100, 3), WaveletDescriptorSource::silhouette);
  int pair = 0;
  for (int m = 0; m < 4; ++m) {
    for (int n = 0; n <= 1 << (m + 1); ++n, ++pair) {
      double sum = 0;
      constexpr int kSteps = 2000;
      for (int i = 0; i < kSteps; ++i) {
        const double r = (i + 0.5) / kSteps;
        sum += std::pow(2.0, m / 2.0) * b_spline_wavelet(std::pow(2.0, m) * r - n / 2.0) * r;
      }
      EXPECT_NEAR(disc[pair], std::abs(2 * kPi * sum / kSteps), 0.011) << m << " " << n;
    }
  }
  EXPECT_LT(disc.tail(3 * 34).maxCoeff(), 0.003F);
}

TEST(WaveletDescriptor, ForgetsPlaceSizeAndTurn) {
  for (const auto source :
       {WaveletDescriptorSource::silhouette, WaveletDescriptorSource::contour}) {
    const VectorF here = descriptor(hand(3, 100, 100), source);
    const float to_other = (descriptor(hand(2, 100, 100), source) - here).norm();
    // The outline of a finger 11 pixels wide changes by a tenth where it takes a pixel more.
    const float share = source == WaveletDescriptorSource::silhouette ? 0.25F : 0.35F;
    EXPECT_GT(to_other, 0.1F * here.norm());
    EXPECT_LT((descriptor(hand(3, 88, 109), source) - here).norm(), 1e-4F * here.norm());
    for (const double scale : {0.7, 1.25}) {
      EXPECT_LT((descriptor(hand(3, 100, 100, scale), source) - here).norm(), share * to_other)
          << scale;
    }
    for (const double turn : {0.3, 0.785, 1.4, 3.0}) {
      EXPECT_LT((descriptor(hand(3, 100, 100, 1, turn), source) - here).norm(), share * to_other)
          << turn;
    }
  }
}

TEST(WaveletDescriptor, NamesWhatDoesNotFit) {
  EXPECT_THROW(descriptor(GreyImage(9, 9), WaveletDescriptorSource::silhouette), InvalidArgument);
  EXPECT_THROW(descriptor(GreyImage(9, 9), WaveletDescriptorSource::contour), InvalidArgument);
  GreyImage dot(5, 5);
  dot.pixels[12] = 1;
  EXPECT_TRUE(descriptor(dot, WaveletDescriptorSource::silhouette).allFinite());
  EXPECT_TRUE(descriptor(dot, WaveletDescriptorSource::contour).allFinite());
  WaveletDescriptorOptions options;
  options.num_scales = 7;
  EXPECT_THROW(WaveletDescriptorComputer{options}, InvalidArgument);
  options = {};
  options.num_frequencies = 0;
  EXPECT_THROW(WaveletDescriptorComputer{options}, InvalidArgument);
}

}  // namespace
}  // namespace hri
