// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/silhouette_cepstrum.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "features/hand_testing.hpp"
#include "hri/core/error.hpp"

namespace hri {
namespace {

using hand_testing::hand;

VectorF cepstrum(const GreyImage& mask) {
  const SilhouetteCepstrumComputer computer({});
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
