// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// With a small network of random weights; tests/py compares with the published one.
#include "hri/recognition/word/speech_embedding.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "hri/core/error.hpp"
#include "recognition/word/small_embedding.hpp"

namespace hri {
namespace {

using testing_data::small_embedding;

// A word of two tones in the middle of near silence.
std::vector<float> word(int rate_hz, float level) {
  std::vector<float> samples(static_cast<std::size_t>(2 * rate_hz), 0.0F);
  for (int n = 0; n < rate_hz / 2; ++n) {
    const double t = static_cast<double>(n) / rate_hz;
    samples[static_cast<std::size_t>(rate_hz / 2 + n)] =
        level * static_cast<float>(std::sin(2 * 3.14159 * (n < rate_hz / 4 ? 400 : 900) * t));
  }
  return samples;
}

TEST(SpeechEmbedding, HasARowAWindow) {
  const SpeechEmbedding small = small_embedding();
  EXPECT_EQ(small.num_outputs(), 4);
  EXPECT_NEAR(small.window_s(), 0.175, 1e-9);
  EXPECT_NEAR(small.step_s(), 0.04, 1e-9);
  EXPECT_EQ(small.checksum().size(), 8U);
  const std::vector<float> samples = word(16000, 0.3F);
  const MatrixF rows = small.compute(samples, 16000);
  EXPECT_EQ(rows.rows(), static_cast<int>((2.0 - 0.175) / 0.04) + 1);
  const MatrixF whole_steps = [&] {
    SpeechEmbeddingOptions options;
    options.rows_per_step = 1;
    return small_embedding(options).compute(samples, 16000);
  }();
  for (Eigen::Index i = 0; i < whole_steps.rows(); ++i)
    EXPECT_EQ(whole_steps.row(i), rows.row(2 * i)) << i;
  EXPECT_EQ(small.compute({samples.data(), 2700}, 16000).rows(), 0);
}

TEST(SpeechEmbedding, AWordIsTheSameAtEveryLevelAndPlace) {
  const SpeechEmbedding small = small_embedding();
  const VectorF one = small.word(word(16000, 0.3F), 16000);
  ASSERT_EQ(one.size(), 6 * 4);
  const VectorF quiet = small.word(word(16000, 0.075F), 16000);
  EXPECT_LT((one - quiet).norm(), 0.1F * one.norm());
  std::vector<float> late(5000, 0.0F);
  const std::vector<float> samples = word(16000, 0.3F);
  late.insert(late.end(), samples.begin(), samples.end());
  EXPECT_LT((one - small.word(late, 16000)).norm(), 0.05F * one.norm());
  EXPECT_LT((one - small.word(word(8000, 0.3F), 8000)).norm(), 0.2F * one.norm());
  EXPECT_EQ(small.word(std::vector<float>(16000, 0.0F), 16000).size(), 0);
}

TEST(SpeechEmbedding, RefusesWhatItCannotTake) {
  SpeechEmbeddingOptions options;
  options.rows_per_step = 3;
  EXPECT_THROW((void)small_embedding(options), InvalidArgument);
  options.rows_per_step = 2;
  options.level = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)small_embedding(options), InvalidArgument);
  EXPECT_THROW((void)small_embedding({}, 31), FormatError);
  EXPECT_THROW((void)small_embedding({}, 32, 130), FormatError);
  EXPECT_THROW((void)SpeechEmbedding::load("/nowhere/w.onnx"), IoError);
  std::vector<float> samples = word(16000, 0.3F);
  samples[3] = std::numeric_limits<float>::infinity();
  EXPECT_THROW((void)small_embedding().compute(samples, 16000), InvalidArgument);
  EXPECT_THROW((void)small_embedding().word(samples, 16000), InvalidArgument);
  EXPECT_THROW((void)small_embedding().word(samples, 100), InvalidArgument);
}

}  // namespace
}  // namespace hri
