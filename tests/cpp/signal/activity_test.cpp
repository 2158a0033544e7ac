// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/activity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

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

TEST(FindSpeech, CoversTheWordAndLittleMore) {
  for (const double padding_ms : {0.0, 30.0, 200.0}) {
    ActivityOptions options;
    options.padding_ms = padding_ms;
    const SpeechBounds b = find_speech(burst(0.5, 0.002), kRateHz, options);
    ASSERT_TRUE(b.found);
    const auto padding = static_cast<std::size_t>(padding_ms * kRateHz / 1000);
    // A frame (400 samples) that touches the word is loud; frames begin every 160 samples.
    EXPECT_LE(b.first + padding, 8000U);
    EXPECT_GE(b.first + padding + 400, 8000U);
    EXPECT_GE(b.last, 12800U + padding);
    EXPECT_LE(b.last, 12800U + padding + 400);
  }
}

TEST(FindSpeech, DoesNotDependOnTheLevel) {
  const std::vector<float> x = burst(0.5, 0.01);
  const SpeechBounds b = find_speech(x, kRateHz, {});
  for (const float gain : {0.03125F, 0.5F, 1.5F}) {
    std::vector<float> louder = x;
    for (float& v : louder) v *= gain;
    const SpeechBounds same = find_speech(louder, kRateHz, {});
    EXPECT_EQ(same.found, b.found);
    EXPECT_EQ(same.first, b.first) << gain;
    EXPECT_EQ(same.last, b.last) << gain;
  }
}

TEST(FindSpeech, StaysWithinTheClip) {
  const std::vector<float> x = burst(0.5, 0.001);
  ActivityOptions options;
  options.padding_ms = 1000;
  const SpeechBounds wide = find_speech(x, kRateHz, options);
  EXPECT_EQ(wide.first, 0U);
  EXPECT_EQ(wide.last, x.size());
  // Two words with a pause: from the first to the last.
  std::vector<float> two = x;
  two.insert(two.end(), x.begin(), x.end());
  const SpeechBounds both = find_speech(two, kRateHz, {});
  EXPECT_LE(both.first, 8000U);
  EXPECT_GE(both.last, x.size() + 12800);
  // One frame exactly is judged: nothing stands out of it.
  EXPECT_FALSE(find_speech(Span<const float>(x).subspan(9000, 400), kRateHz, {}).found);
}

TEST(FindSpeech, RefusesOptionsOutOfRange) {
  const std::vector<float> x = burst(0.5, 0.01);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  struct Case {
    double ActivityOptions::*field;
    double low;
    double high;
    const char* name;
  };
  const Case cases[] = {{&ActivityOptions::frame_ms, 1, 1000, "frame_ms"},
                        {&ActivityOptions::shift_ms, 1, 1000, "shift_ms"},
                        {&ActivityOptions::silence_dbfs, -120, 0, "silence_dbfs"},
                        {&ActivityOptions::margin_db, 0, 60, "margin_db"},
                        {&ActivityOptions::max_depth_db, 1, 120, "max_depth_db"},
                        {&ActivityOptions::min_voicing, 0, 10, "min_voicing"},
                        {&ActivityOptions::max_gap_ms, 0, 2000, "max_gap_ms"},
                        {&ActivityOptions::padding_ms, 0, 1000, "padding_ms"}};
  for (const Case& c : cases) {
    for (const double good : {c.low, c.high}) {
      ActivityOptions options;
      options.*c.field = good;
      EXPECT_NO_THROW(find_speech(x, kRateHz, options)) << c.name << " " << good;
    }
    for (const double bad : {c.low - 0.01, c.high + 0.01, nan}) {
      ActivityOptions options;
      options.*c.field = bad;
      try {
        find_speech(x, kRateHz, options);
        ADD_FAILURE() << c.name << " " << bad;
      } catch (const InvalidArgument& error) {
        EXPECT_NE(std::string(error.what()).find(c.name), std::string::npos) << error.what();
      }
    }
  }
  for (const int rate : {999, 384001}) EXPECT_THROW(find_speech(x, rate, {}), InvalidArgument);
  EXPECT_THROW(find_speech({}, kRateHz, {}), InvalidArgument);
}

}  // namespace
}  // namespace hri
