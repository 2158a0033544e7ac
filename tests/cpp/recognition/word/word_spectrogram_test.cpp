// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/word/word_spectrogram.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hri/core/error.hpp"
#include "recognition/tone_words.hpp"
#include "recognition/word/spectrogram_augmentation.hpp"

namespace hri {
namespace {

using testing_data::kRateHz;
using testing_data::tone;

constexpr int kMargin = WordSpectrogram::kMargin;
constexpr int kFrames = WordSpectrogram::kNumFrames;
constexpr int kBands = WordSpectrogram::kNumBands;

TEST(WordSpectrogram, HasTheWordInItsMiddle) {
  const WordSpectrogram spectrogram(kRateHz);
  std::vector<float> audio(3 * kRateHz, 0.0F);
  const std::size_t middle = 30000;
  for (std::size_t n = middle - 800; n < middle + 800; ++n)
    audio[n] = 0.5F * std::sin(0.4F * static_cast<float>(n));
  const MatrixF window = spectrogram.window(audio, middle);
  ASSERT_EQ(window.rows(), kFrames + 2 * kMargin);
  ASSERT_EQ(window.cols(), kBands);
  Eigen::Index loudest = 0;
  window.rowwise().sum().maxCoeff(&loudest);
  EXPECT_NEAR(static_cast<double>(loudest), kMargin + kFrames / 2.0, 5);
  const MatrixF input = WordSpectrogram::input(window);
  EXPECT_EQ(input.rows(), kFrames);
  EXPECT_NEAR(input.mean(), 0, 1e-4);
  EXPECT_LE(input.maxCoeff() - input.minCoeff(), 70.0F / 17 + 1e-4F);
}

TEST(WordSpectrogram, FillsWhatTheAudioDoesNotHaveByItsQuietestFrames) {
  const WordSpectrogram spectrogram(kRateHz);
  const std::vector<float> audio = tone(600, 0, 1);
  const MatrixF window = spectrogram.window(audio, 0);
  EXPECT_TRUE(window.allFinite());
  EXPECT_EQ(window.row(0), window.row(10));
  EXPECT_LT(window.row(0).maxCoeff(), window.maxCoeff() - 20);
  EXPECT_TRUE(spectrogram.window(Span<const float>(audio).subspan(0, 100), 50).isZero());
}

TEST(WordSpectrogram, KnowsTheFrequenciesOfItsBands) {
  for (const int rate : {8000, 16000}) {
    const WordSpectrogram spectrogram(rate);
    for (const Eigen::Index band : {10, 20, 30}) {
      const double hz = static_cast<double>(spectrogram.band_hz()[band]);
      std::vector<float> audio(static_cast<std::size_t>(rate));
      for (std::size_t n = 0; n < audio.size(); ++n) {
        audio[n] = static_cast<float>(std::sin(6.283185307 * hz * static_cast<double>(n) / rate));
      }
      Eigen::Index loudest = 0;
      spectrogram.window(audio, audio.size() / 2).row(60).maxCoeff(&loudest);
      EXPECT_EQ(loudest, band) << rate;
    }
  }
  EXPECT_THROW(WordSpectrogram(0), InvalidArgument);
}

TEST(SpectrogramAugmentation, AddsNoiseOfTheRatioAskedFor) {
  const WordSpectrogram spectrogram(kRateHz);
  const detail::SpectrogramAugmentation augmentation(spectrogram, 1);
  const MatrixF window = spectrogram.window(tone(600, 200, 1), kRateHz / 2);
  const MatrixF clean = WordSpectrogram::input(window);
  double before = 0;
  for (const double snr_db : {40.0, 20.0, 10.0, 0.0}) {
    Random random(3);
    const MatrixF noisy = augmentation.noisy_input(window, snr_db, &random);
    const double change = static_cast<double>((noisy - clean).cwiseAbs().mean());
    EXPECT_GT(change, before);
    before = change;
  }
}

TEST(SpectrogramAugmentation, DependsOnItsRandomNumbersAlone) {
  const WordSpectrogram spectrogram(kRateHz);
  const detail::SpectrogramAugmentation augmentation(spectrogram, 1);
  const MatrixF window = spectrogram.window(tone(600, 200, 1), kRateHz / 2);
  const auto example = [&](std::uint64_t seed) {
    Random random(seed);
    MatrixF result;
    augmentation.make_example(window, &random, &result);
    return result;
  };
  EXPECT_EQ(example(4), example(4));
  EXPECT_NE(example(4), example(5));
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const MatrixF frames = example(seed);
    EXPECT_EQ(frames.rows(), kFrames);
    EXPECT_EQ(frames.cols(), kBands);
    EXPECT_TRUE(frames.allFinite());
  }
}

}  // namespace
}  // namespace hri
