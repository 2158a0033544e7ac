// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/linear_prediction.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri {
namespace {

// A signal made by a predictor of order 2 is found out: x[n] = 1.2 x[n-1] - 0.8 x[n-2] + noise.
TEST(LinearPrediction, FindsThePredictorThatMadeTheSignal) {
  Random random(2);
  std::vector<double> x(100000);
  for (std::size_t n = 2; n < x.size(); ++n)
    x[n] = 1.2 * x[n - 1] - 0.8 * x[n - 2] + random.normal();
  std::vector<double> r(5);
  std::vector<double> a(4);
  autocorrelation(x, r);
  const double gain = levinson_durbin(r, a);
  EXPECT_NEAR(a[0], -1.2, 0.02);
  EXPECT_NEAR(a[1], 0.8, 0.02);
  EXPECT_NEAR(a[2], 0, 0.02);
  EXPECT_NEAR(a[3], 0, 0.02);
  EXPECT_NEAR(gain / static_cast<double>(x.size()), 1, 0.02);
}

TEST(LinearPrediction, CountsLagsBeyondTheEndAsZero) {
  const std::vector<double> x = {1, 2, 3};
  std::vector<double> r(5);
  autocorrelation(x, r);
  EXPECT_EQ(r, (std::vector<double>{14, 8, 3, 0, 0}));
}

TEST(LinearPrediction, OfOnePoleHasTheCepstrumOfItsPowers) {
  // -ln(1 - p z^-1) = sum of p^n z^-n / n.
  const std::vector<double> a = {-0.5};
  std::vector<double> c(6);
  lpc_cepstrum(a, std::exp(2.0), c);
  EXPECT_DOUBLE_EQ(c[0], 2);
  for (std::size_t n = 1; n < c.size(); ++n) {
    const auto power = static_cast<double>(n);
    EXPECT_NEAR(c[n], std::pow(0.5, power) / power, 1e-15);
  }
}

TEST(LinearPrediction, OfSilenceIsZero) {
  const std::vector<double> r(4);
  std::vector<double> a(3, 7.0);
  EXPECT_EQ(levinson_durbin(r, a), 0);
  EXPECT_EQ(a, std::vector<double>(3));
}

TEST(LinearPrediction, RefusesWhatDoesNotFit) {
  std::vector<double> three(3);
  EXPECT_THROW(levinson_durbin(three, three), InvalidArgument);
  EXPECT_THROW(lpc_cepstrum(three, 0, three), InvalidArgument);
}

}  // namespace
}  // namespace hri
