// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/recognition/word/word_recognizer.hpp"
#include "recognition/tone_words.hpp"

namespace hri {
namespace {

using testing_data::kRateHz;
using testing_data::tone_clips;

// A rising tone with pauses before and after it, over noise of this standard deviation.
std::vector<float> rising_tone(std::size_t pause, double floor, std::uint64_t seed) {
  Random random(seed);
  std::vector<float> result(2 * pause + kRateHz / 2);
  for (float& x : result) x = static_cast<float>(floor * random.normal());
  for (std::size_t n = 0; n < kRateHz / 2; ++n) {
    const double t = static_cast<double>(n) / kRateHz;
    result[pause + n] +=
        static_cast<float>(0.3 * std::sin(6.283185307 * (555 * t + 0.5 * 800 * t * t)));
  }
  return result;
}

WordRecognizer trained_with_cut(const WordRecognizerOptions& options = {}) {
  return WordRecognizer::train(tone_clips().samples, options);
}

double margin(const WordRecognizer& r, const std::vector<float>& clip) {
  const VectorF s = r.scores(clip, kRateHz);  // labels: fall, rise
  return static_cast<double>(s[1] - s[0]);
}

TEST(WordTrimming, PausesDoNotMatter) {
  const WordRecognizer recognizer = trained_with_cut();
  const double tight =
      margin(recognizer, rising_tone(kRateHz / 20, 0, 1));  // shorter than the padding
  ASSERT_GT(tight, 0);
  for (const double floor : {0.0, 1e-6, 1e-4, 5e-4})  // digital silence to 52 dB below the tone
    EXPECT_NEAR(margin(recognizer, rising_tone(kRateHz / 2, floor, 2)), tight, 0.2 * tight)
        << floor;
}

TEST(WordTrimming, NoiseFloorMasksWhatLiesBelowIt) {
  WordRecognizerOptions low;
  low.noise_floor_db = 120;
  const WordRecognizer open = trained_with_cut(low);
  const WordRecognizer closed = trained_with_cut();
  const auto difference = [](const WordRecognizer& r) {
    const VectorF faint = r.scores(rising_tone(kRateHz / 2, 1e-6, 3), kRateHz);
    const VectorF silent = r.scores(rising_tone(kRateHz / 2, 0, 3), kRateHz);
    return (faint - silent).cwiseAbs().maxCoeff() / silent.cwiseAbs().maxCoeff();
  };
  EXPECT_LT(10 * difference(closed), difference(open));
}

TEST(WordTrimming, GivesTheSameEveryTimeAndAtEveryLevel) {
  const WordRecognizer recognizer = trained_with_cut();
  std::vector<float> clip = rising_tone(kRateHz / 2, 0, 4);
  const VectorF once = recognizer.scores(clip, kRateHz);
  EXPECT_EQ(recognizer.scores(clip, kRateHz), once);
  for (float& x : clip) x *= 0.25F;
  EXPECT_TRUE(recognizer.scores(clip, kRateHz).isApprox(once, 0.03F));
}

TEST(WordTrimming, RefusesANoiseFloorOutOfRange) {
  for (const double floor : {19.0, 121.0, std::nan("")}) {
    WordRecognizerOptions options;
    options.noise_floor_db = floor;
    EXPECT_THROW(trained_with_cut(options), InvalidArgument) << floor;
  }
}

}  // namespace
}  // namespace hri
