// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/fourier_descriptor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "features/hand_testing.hpp"
#include "hri/core/error.hpp"

namespace hri {
namespace {

using hand_testing::hand;

std::vector<ContourPoint> boundary_of(const GreyImage& mask) {
  std::vector<ContourPoint> contour;
  trace_contour(mask.view(), &contour);
  return contour;
}

VectorF descriptor(const std::vector<ContourPoint>& contour, bool use_phase = false) {
  FourierDescriptorOptions options;
  options.use_phase = use_phase;
  const FourierDescriptorComputer computer(options);
  VectorF out(computer.num_features());
  computer.compute(Span<const ContourPoint>(contour),
                   {out.data(), static_cast<std::size_t>(out.size())});
  return out;
}

VectorF descriptor(const GreyImage& mask, bool use_phase = false) {
  return descriptor(boundary_of(mask), use_phase);
}

TEST(FourierDescriptor, OfADiscIsItsFirstHarmonic) {
  const VectorF disc = descriptor(hand(0, 100, 100));
  EXPECT_NEAR(disc[0], 1, 1e-3);
  EXPECT_LT(disc.tail(disc.size() - 1).cwiseAbs().maxCoeff(), 0.01F);
}

TEST(FourierDescriptor, ForgetsPlaceSizeTurnAndStart) {
  const VectorF here = descriptor(hand(3, 100, 100));
  const float to_other = (descriptor(hand(2, 100, 100)) - here).norm();
  EXPECT_GT(to_other, 0.1F);
  // A place to the pixel gives the same boundary_of.
  EXPECT_LT((descriptor(hand(3, 93, 110)) - here).norm(), 1e-5F);
  for (const double scale : {0.7, 1.25})
    EXPECT_LT((descriptor(hand(3, 100, 100, scale)) - here).norm(), 0.2F * to_other) << scale;
  for (const double turn : {0.3, 0.785, 1.4, 3.0})
    EXPECT_LT((descriptor(hand(3, 100, 100, 1, turn)) - here).norm(), 0.2F * to_other) << turn;
  std::vector<ContourPoint> later = boundary_of(hand(3, 100, 100));
  std::rotate(later.begin(), later.begin() + 77, later.end());
  EXPECT_LT((descriptor(later) - here).norm(), 0.02F * to_other);
}

TEST(FourierDescriptor, WithPhaseTellsHowTheShapeIsTurned) {
  const VectorF here = descriptor(hand(3, 100, 100), true);
  std::vector<ContourPoint> later = boundary_of(hand(3, 100, 100));
  std::rotate(later.begin(), later.begin() + 77, later.end());
  EXPECT_LT((descriptor(later, true) - here).norm(), 0.02F);
  EXPECT_NEAR(here[1], 0, 1e-5);  // the first harmonic is real
  // Turned by a, harmonic k turns by a (1 - k).
  const double turn = 0.785;
  const VectorF turned = descriptor(hand(3, 100, 100, 1, turn), true);
  for (int k = 1; k <= 4; ++k) {
    for (const int sign : {1, -1}) {
      const int at = 4 * (k - 1) + (sign > 0 ? 0 : 2);
      const std::complex<double> before(here[at], here[at + 1]);
      const std::complex<double> expected = before * std::polar(1.0, turn * (1 - sign * k));
      EXPECT_NEAR(turned[at], expected.real(), 0.02) << sign * k;
      EXPECT_NEAR(turned[at + 1], expected.imag(), 0.02) << sign * k;
    }
  }
}

TEST(FourierDescriptor, OfAPixelIsZeroAndNamesWhatDoesNotFit) {
  GreyImage dot(5, 5);
  EXPECT_THROW(descriptor(dot), InvalidArgument);
  dot.pixels[12] = 1;
  EXPECT_EQ(descriptor(dot), VectorF::Zero(32));
  const auto refused = [](int num_points, int num_harmonics) {
    FourierDescriptorOptions options;
    options.num_points = num_points;
    options.num_harmonics = num_harmonics;
    EXPECT_THROW(FourierDescriptorComputer{options}, InvalidArgument);
  };
  refused(15, 3);
  refused(8192, 3);
  refused(64, 0);
  refused(64, 32);
}

}  // namespace
}  // namespace hri
