// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/word/word_folds.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "hri/recognition/training.hpp"

namespace hri::detail {
namespace {

constexpr int kNumFolds = 4;

TEST(WordFolds, AreThoseOfRecordingsWhereEachIsItsOwn) {
  std::vector<WordOrigin> words;
  std::vector<int> labels;
  std::vector<std::string> groups;
  for (int i = 0; i < 22; ++i) {
    words.push_back({i % 3, "", i % 2 == 0 ? "" : std::to_string(i)});
    labels.push_back(i % 3);
    groups.emplace_back();
  }
  EXPECT_EQ(word_folds(words, kNumFolds), held_out_folds(labels, groups, kNumFolds));
}

TEST(WordFolds, HoldTheCopiesOfARecordingOutWithIt) {
  std::vector<WordOrigin> words;  // five recordings of either label, then a copy of each
  for (int i = 0; i < 20; ++i) words.push_back({i % 2, "", std::to_string(i % 10)});
  const std::vector<int> folds = word_folds(words, kNumFolds);
  ASSERT_EQ(folds.size(), words.size());
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(folds[i], folds[i + 10]) << i;
  EXPECT_EQ(std::vector<int>(folds.begin(), folds.begin() + 10),
            (std::vector<int>{0, 0, 1, 1, 2, 2, 3, 3, 0, 0}));
}

TEST(WordFolds, KeepSpeakersApart) {
  std::vector<WordOrigin> words;
  for (int i = 0; i < 12; ++i)
    words.push_back({i % 2, i % 6 < 3 ? "asha" : "ravi", std::to_string(i % 6)});
  const std::vector<int> folds = word_folds(words, kNumFolds);
  for (std::size_t i = 0; i < words.size(); ++i)
    EXPECT_EQ(folds[i], words[i].group == "asha" ? 0 : 1);
  EXPECT_TRUE(word_folds({}, kNumFolds).empty());
}

TEST(WordFolds, AreOfRecordingsWhereEachSpeakerAloneSaidSomeWord) {
  std::vector<WordOrigin> words;  // word 0 by both, word 1 by one, word 2 by the other; two copies
  for (int i = 0; i < 16; ++i) {
    const bool asha = i % 2 == 0;
    words.push_back(
        {i % 4 < 2 ? 0 : (asha ? 1 : 2), asha ? "asha" : "ravi", std::to_string(i % 8)});
  }
  const std::vector<int> folds = word_folds(words, kNumFolds);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(folds[i], folds[i + 8]) << i;
  EXPECT_EQ(std::vector<int>(folds.begin(), folds.begin() + 8),
            (std::vector<int>{0, 1, 0, 0, 2, 3, 1, 1}));
  // Recordings of which each has every word are held out by their speakers.
  const std::vector<WordOrigin> mixed{
      {0, "asha", "a"}, {1, "asha", "a"}, {1, "ravi", "b"}, {0, "ravi", "b"}};
  EXPECT_EQ(word_folds(mixed, kNumFolds), (std::vector<int>{0, 0, 1, 1}));
}

}  // namespace
}  // namespace hri::detail
