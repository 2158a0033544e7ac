// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Recordings of several words.
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/recognition/word/word_recognizer.hpp"
#include "hri/signal/activity.hpp"
#include "recognition/tone_words.hpp"

namespace hri {
namespace {

using testing_data::kRateHz;
using testing_data::tone;
using testing_data::tone_clips;

// One clip of a second for each word: half a second of tone, half a second of pause around it.
std::vector<float> joined(const std::vector<bool>& words) {
  std::vector<float> result;
  std::uint64_t seed = 40;
  for (const bool rises : words) {
    const std::vector<float> word = tone(560, rises ? 800 : -350, seed++);
    result.insert(result.end(), word.begin(), word.end());
  }
  return result;
}

bool mentions(const std::vector<std::string>& notes, const std::string& part) {
  for (const std::string& note : notes) {
    if (note.find(part) != std::string::npos) return true;
  }
  return false;
}

WordRecognizer trained_on_utterances() {
  WordRecognizerOptions options;
  options.max_iterations = 4;
  options.false_reject_rate = 0;
  return WordRecognizer::train(tone_clips().samples, options);
}

TEST(FindSpeech, CountsUtterances) {
  EXPECT_EQ(find_speech(std::vector<float>(kRateHz, 0.0F), kRateHz, {}).num_utterances, 0);
  EXPECT_EQ(find_speech(joined({true}), kRateHz, {}).num_utterances, 1);
  EXPECT_EQ(find_speech(joined({true, false}), kRateHz, {}).num_utterances, 2);
  EXPECT_EQ(find_speech(joined({true, false, true}), kRateHz, {}).num_utterances, 3);
}

TEST(FindSpeech, CountsOneUtteranceAcrossAPlosive) {
  // Silence of 200 ms within the word, less than max_gap_ms.
  std::vector<float> word = joined({true});
  for (std::size_t n = kRateHz * 2 / 5; n < kRateHz * 3 / 5; ++n) word[n] *= 0.01F;
  EXPECT_EQ(find_speech(word, kRateHz, {}).num_utterances, 1);
  // A click in the pause after a word is no utterance of its own.
  std::vector<float> click = joined({true, true});
  for (std::size_t n = kRateHz; n < click.size(); ++n) click[n] = click[n % 3200];
  for (std::size_t n = 0; n < kRateHz / 200; ++n) click[kRateHz * 3 / 2 + n] = 0.5F;
  EXPECT_EQ(find_speech(click, kRateHz, {}).num_utterances, 1);
}

TEST(WordRecognizer, NotesSeveralUtterances) {
  const WordRecognizer recognizer = trained_on_utterances();
  EXPECT_TRUE(recognizer.recognise(joined({true}), kRateHz).notes.empty());
  const Decision three = recognizer.recognise(joined({true, false, true}), kRateHz);
  EXPECT_TRUE(mentions(three.notes, "3 utterances"));
  // At another rate, too, beside the note on resampling.
  const std::vector<float> audio = joined({true, false});
  const Decision two = recognizer.recognise(audio, 22050);
  EXPECT_TRUE(mentions(two.notes, "2 utterances"));
  EXPECT_TRUE(mentions(two.notes, "resampled from 22050"));
}

TEST(WordRecognizer, RecognisesEveryUtterance) {
  const WordRecognizer recognizer = trained_on_utterances();
  const std::vector<bool> words{true, false, false, true};
  const std::vector<UtteranceDecision> found =
      recognizer.recognise_utterances(joined(words), kRateHz);
  ASSERT_EQ(found.size(), words.size());
  for (std::size_t i = 0; i < words.size(); ++i) {
    EXPECT_EQ(found[i].decision.nbest.front().label, words[i] ? "rise" : "fall") << i;
    EXPECT_TRUE(found[i].decision.notes.empty()) << i;
    const auto second = static_cast<double>(i);
    EXPECT_NEAR(found[i].first_s, second + 0.25, 0.1) << i;
    EXPECT_NEAR(found[i].last_s, second + 0.75, 0.1) << i;
  }
  EXPECT_TRUE(recognizer.recognise_utterances(std::vector<float>(kRateHz), kRateHz).empty());
  EXPECT_TRUE(recognizer.recognise_utterances({}, kRateHz).empty());
  EXPECT_THROW((void)recognizer.recognise_utterances({}, 10), InvalidArgument);
}

TEST(WordRecognizer, NamesTheArgumentThatIsWrong) {
  const WordRecognizer recognizer = trained_on_utterances();
  const auto what = [&](const std::vector<float>& audio, int rate) {
    try {
      (void)recognizer.recognise(audio, rate);
    } catch (const InvalidArgument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(what(joined({true}), 10).find("sample_rate_hz is 10"), std::string::npos);
  std::vector<float> broken = joined({true});
  broken[77] = std::numeric_limits<float>::infinity();
  // Before and after resampling the index is the caller's.
  for (const int rate : {kRateHz, 44100})
    EXPECT_NE(what(broken, rate).find("audio is not finite at sample 77"), std::string::npos);
  EXPECT_NE(what(std::vector<float>(5), kRateHz).find("audio is too short"), std::string::npos);
}

}  // namespace
}  // namespace hri
