// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/activity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"
#include "hri/signal/resample.hpp"

namespace hri {
namespace {

constexpr int kRateHz = 16000;

// A tone of `level` from 0.5 s to 0.8 s in noise; 1.3 s in all.
std::vector<float> burst(double level, double noise) {
  Random random(1);
  std::vector<float> x(20800);
  for (std::size_t n = 0; n < x.size(); ++n) {
    const bool sounds = n >= 8000 && n < 12800;
    x[n] = static_cast<float>(noise * random.normal() +
                              (sounds ? level * std::sin(0.17 * static_cast<double>(n)) : 0.0));
  }
  return x;
}

TEST(FindSpeech, FindsTheWordAtAnyLevel) {
  for (const double level : {0.9, 0.1, 0.02}) {
    for (const double ratio : {1e6, 10.0}) {
      const SpeechBounds b = find_speech(burst(level, level / ratio), kRateHz, {});
      ASSERT_TRUE(b.found) << level << " over " << ratio;
      EXPECT_NEAR(static_cast<double>(b.first), 8000, 1200);
      EXPECT_NEAR(static_cast<double>(b.last), 12800, 1200);
    }
  }
}

TEST(FindSpeech, FindsNothingInSilenceOrSteadyNoise) {
  EXPECT_FALSE(find_speech(std::vector<float>(16000, 0.0F), kRateHz, {}).found);
  EXPECT_FALSE(find_speech(std::vector<float>(16000, 0.5F), kRateHz, {}).found);
  EXPECT_FALSE(find_speech(burst(0, 0.1), kRateHz, {}).found);
  EXPECT_FALSE(find_speech(burst(1e-4, 1e-6), kRateHz, {}).found);  // below silence_dbfs
}

TEST(FindSpeech, RefusesWhatItCannotJudge) {
  std::vector<float> x = burst(0.5, 0.01);
  EXPECT_THROW(find_speech(Span<const float>(x).subspan(0, 100), kRateHz, {}), InvalidArgument);
  x[77] = std::numeric_limits<float>::quiet_NaN();
  try {
    find_speech(x, kRateHz, {});
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_NE(std::string(error.what()).find("sample 77"), std::string::npos);
  }
  ActivityOptions options;
  options.max_depth_db = 0;
  EXPECT_THROW(find_speech(burst(0.5, 0.01), kRateHz, options), InvalidArgument);
}

TEST(Resample, KeepsATone) {
  std::vector<float> x(44100);
  for (std::size_t n = 0; n < x.size(); ++n) {
    x[n] =
        static_cast<float>(std::sin(2 * 3.14159265358979 * 440 * static_cast<double>(n) / 44100));
  }
  const std::vector<float> y = resample(x, 44100, kRateHz);
  ASSERT_EQ(y.size(), 16000U);
  for (std::size_t n = 800; n < 15200; ++n) {
    EXPECT_NEAR(y[n], std::sin(2 * 3.14159265358979 * 440 * static_cast<double>(n) / kRateHz),
                2e-3);
  }
  EXPECT_TRUE(resample({}, 8000, 16000).empty());
  EXPECT_EQ(resample(std::vector<float>{1.0F}, 8000, 16000).size(), 2U);
}

}  // namespace
}  // namespace hri
