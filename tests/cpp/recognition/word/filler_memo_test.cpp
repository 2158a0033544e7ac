// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/word/filler_memo.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "hri/core/error.hpp"
#include "recognition/tone_words.hpp"

namespace hri::detail {
namespace {

using testing_data::kRateHz;
using testing_data::tone;

struct Counted {
  int trainings = 0;
  std::shared_ptr<const TrainedFillers> operator()(const std::vector<WordSample>& words,
                                                   const WordRecognizerOptions& options,
                                                   const std::vector<WordSample>& more = {}) {
    return remembered_fillers(words, more, options, nullptr, [this] {
      ++trainings;
      return TrainedFillers{};
    });
  }
};

WordRecognizerOptions options_of(std::uint64_t seed) {
  WordRecognizerOptions options;
  options.cepstra.sample_rate_hz = kRateHz;
  options.seed = seed;
  return options;
}

TEST(FillerMemo, TrainsEqualWordsWithEqualOptionsOnce) {
  std::vector<float> audio = tone(500, 30, 1);
  const std::vector<WordSample> words{{audio, kRateHz, "a", ""}};
  Counted train;
  const auto first = train(words, options_of(11));
  std::vector<float> copy = audio;
  EXPECT_EQ(train({{copy, kRateHz, "a", ""}}, options_of(11)), first);
  EXPECT_EQ(train.trainings, 1);

  EXPECT_NE(train({{audio, kRateHz, "b", ""}}, options_of(11)), first);
  EXPECT_NE(train({{audio, kRateHz / 2, "a", ""}}, options_of(11)), first);
  copy[7] += 1e-6F;
  EXPECT_NE(train({{copy, kRateHz, "a", ""}}, options_of(11)), first);
  EXPECT_EQ(train.trainings, 4);
  EXPECT_NE(train(words, options_of(12)), first);
  EXPECT_EQ(train.trainings, 5);
  EXPECT_NE(train(words, options_of(11), words), first);  // more of them for the embedding
  EXPECT_NE(train({}, options_of(11), words), first);
  EXPECT_EQ(train.trainings, 7);
}

TEST(FillerMemo, KeepsTheLastFew) {
  const std::vector<float> audio = tone(500, 30, 2);
  const std::vector<WordSample> words{{audio, kRateHz, "a", ""}};
  Counted train;
  for (std::uint64_t seed = 0; seed < 4; ++seed) train(words, options_of(seed));
  train(words, options_of(0));
  EXPECT_EQ(train.trainings, 4);
  train(words, options_of(4));  // displaces the one that was used longest ago
  train(words, options_of(0));
  EXPECT_EQ(train.trainings, 5);
  train(words, options_of(1));
  EXPECT_EQ(train.trainings, 6);
}

TEST(FillerMemo, KeepsNothingOfATrainingThatFailed) {
  const std::vector<float> audio = tone(500, 30, 3);
  const std::vector<WordSample> words{{audio, kRateHz, "a", ""}};
  const auto failing = []() -> TrainedFillers { throw Interrupted("stopped"); };
  EXPECT_THROW(remembered_fillers(words, {}, options_of(21), nullptr, failing), Interrupted);
  Counted train;
  EXPECT_NE(train(words, options_of(21)), nullptr);
  EXPECT_EQ(train.trainings, 1);
}

TEST(FillerMemo, ServesSeveralThreads) {
  const std::vector<float> audio = tone(500, 30, 4);
  const std::vector<WordSample> words{{audio, kRateHz, "a", ""}};
  std::vector<std::thread> threads;
  for (std::uint64_t i = 0; i < 4; ++i) {
    threads.emplace_back([&words, i] {
      Counted train;
      for (std::uint64_t round = 0; round < 20; ++round)
        EXPECT_NE(train(words, options_of(30 + (i + round) % 6)), nullptr);
    });
  }
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace hri::detail
