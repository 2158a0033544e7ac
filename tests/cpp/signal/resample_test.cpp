// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/resample.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri {
namespace {

constexpr double kTwoPi = 6.283185307179586;
constexpr std::pair<int, int> kRates[] = {{44100, 16000}, {48000, 16000}, {16000, 8000},
                                          {8000, 16000},  {16000, 44100}, {22050, 16000}};

std::vector<float> tone(double hz, int rate_hz, double seconds = 0.4) {
  std::vector<float> x(static_cast<std::size_t>(seconds * rate_hz));
  for (std::size_t n = 0; n < x.size(); ++n)
    x[n] = static_cast<float>(std::sin(kTwoPi * hz * static_cast<double>(n) / rate_hz));
  return x;
}

// Root mean square of the middle half, relative to a tone of full scale, in dB.
double level_db(const std::vector<float>& y) {
  double power = 0;
  const std::size_t quarter = y.size() / 4;
  for (std::size_t n = quarter; n < 3 * quarter; ++n) power += static_cast<double>(y[n]) * y[n];
  return 10 * std::log10(2 * power / static_cast<double>(2 * quarter) + 1e-30);
}

TEST(Resample, KeepsTonesOfThePassBandSampleBySample) {
  for (const auto& [from, to] : kRates) {
    const double nyquist = std::min(from, to) / 2.0;
    for (const double part : {0.02, 0.3, 0.8}) {
      const std::vector<float> y = resample(tone(part * nyquist, from), from, to);
      const std::vector<float> ideal = tone(part * nyquist, to);
      double largest = 0;
      for (std::size_t n = y.size() / 4; n < 3 * y.size() / 4; ++n)
        largest = std::max(largest, static_cast<double>(std::abs(y[n] - ideal[n])));
      EXPECT_LT(largest, 3e-4) << from << " to " << to << " at " << part;
    }
    EXPECT_NEAR(level_db(resample(tone(0.9 * nyquist, from), from, to)), 0, 0.2);
  }
}

TEST(Resample, LetsNothingFoldBack) {
  for (const auto& [from, to] : kRates) {
    if (to > from) continue;
    for (const double part : {1.02, 1.03, 1.1, 1.3}) {
      const double hz = part * to / 2.0;
      if (hz > 0.49 * from) continue;
      EXPECT_LT(level_db(resample(tone(hz, from), from, to)), -70)
          << from << " to " << to << " at " << hz << " Hz";
    }
  }
}

TEST(Resample, MakesNoImagesOnTheWayUp) {
  const std::vector<float> y = resample(tone(3000, 8000), 8000, 16000);
  double re = 0;
  double im = 0;
  const std::size_t quarter = y.size() / 4;
  for (std::size_t n = quarter; n < 3 * quarter; ++n) {
    re += y[n] * std::cos(kTwoPi * 5000 * static_cast<double>(n) / 16000);
    im += y[n] * std::sin(kTwoPi * 5000 * static_cast<double>(n) / 16000);
  }
  EXPECT_LT(20 * std::log10(std::hypot(re, im) / static_cast<double>(quarter)), -70);
}

TEST(Resample, AtOneRateChangesNothing) {
  const std::vector<float> x{0.1F, -0.7F, 0.3F, 1.0F, -1.0F};
  EXPECT_EQ(resample(x, 44100, 44100), x);
}

TEST(Resample, GivesTheLengthThatTimeAsksFor) {
  for (const auto& [from, to] : {std::pair{44100, 16000}, {8000, 16000}, {16000, 7999}}) {
    for (const std::size_t size : {0U, 1U, 2U, 99U, 1000U}) {
      const auto expected = (static_cast<std::int64_t>(size) * to + from - 1) / from;
      EXPECT_EQ(resample(std::vector<float>(size, 0.5F), from, to).size(),
                static_cast<std::size_t>(expected))
          << from << " to " << to << " " << size;
    }
  }
}

TEST(Resample, KeepsAConstantAndIsLinear) {
  for (const auto& [from, to] : kRates) {
    const std::vector<float> y = resample(std::vector<float>(4000, 0.5F), from, to);
    for (std::size_t n = y.size() / 4; n < 3 * y.size() / 4; ++n) ASSERT_NEAR(y[n], 0.5F, 2e-4);
  }
  Random random(6);
  std::vector<float> a(500);
  std::vector<float> b(500);
  std::vector<float> sum(500);
  for (std::size_t n = 0; n < a.size(); ++n) {
    a[n] = static_cast<float>(random.normal());
    b[n] = static_cast<float>(random.normal());
    sum[n] = a[n] + 2 * b[n];
  }
  const auto [of_a, of_b, of_sum] =
      std::tuple{resample(a, 16000, 11025), resample(b, 16000, 11025), resample(sum, 16000, 11025)};
  for (std::size_t n = 0; n < of_a.size(); ++n)
    EXPECT_NEAR(of_sum[n], of_a[n] + 2 * of_b[n], 2e-5) << n;
}

TEST(Resample, DoesNotDependOnWhatWasResampledBefore) {
  std::vector<float> x(500);
  Random random(6);
  for (float& v : x) v = static_cast<float>(random.normal());
  const std::vector<float> up = resample(x, 8000, 16000);
  const std::vector<float> down = resample(x, 16000, 11025);
  EXPECT_EQ(resample(x, 8000, 16000), up);
  std::thread other([&] { EXPECT_EQ(resample(x, 16000, 11025), down); });
  other.join();
  EXPECT_EQ(resample(x, 16000, 11025), down);
}

TEST(Resample, OutputsDependOnTheSamplesNearThemAlone) {
  // A long signal is filtered by many outputs at a time, a short piece of it one by one.
  std::vector<float> x(30000);
  Random random(7);
  for (float& v : x) v = static_cast<float>(random.normal());
  for (const auto& [from, to] : kRates) {
    const std::vector<float> whole = resample(x, from, to);
    const int common = std::gcd(from, to);
    const auto down = static_cast<std::size_t>(from / common);
    const auto up = static_cast<std::size_t>(to / common);
    for (const std::size_t periods : {0U, 1U, 20U}) {
      const std::size_t begin = periods * down;
      const std::vector<float> piece(x.begin() + static_cast<std::ptrdiff_t>(begin),
                                     x.begin() + static_cast<std::ptrdiff_t>(begin) + 1000);
      const std::vector<float> part = resample(piece, from, to);
      // Away from the ends of the piece by more than the filter is long.
      const std::size_t edge = from > to ? 112 : 400;
      for (std::size_t n = periods == 0 ? 0 : edge; n + edge < part.size(); ++n) {
        ASSERT_EQ(part[n], whole[periods * up + n]) << from << " to " << to << ", output " << n;
      }
    }
  }
}

TEST(Resample, RefusesRatesOutOfRangeByName) {
  const std::vector<float> x(10, 0.0F);
  for (const auto& [from, to] :
       {std::pair{999, 16000}, {16000, 999}, {0, 16000}, {16000, -1}, {384001, 16000}}) {
    try {
      resample(x, from, to);
      ADD_FAILURE() << from << " to " << to;
    } catch (const InvalidArgument& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find(std::to_string(from)), std::string::npos) << message;
      EXPECT_NE(message.find(std::to_string(to)), std::string::npos) << message;
    }
  }
}

}  // namespace
}  // namespace hri
