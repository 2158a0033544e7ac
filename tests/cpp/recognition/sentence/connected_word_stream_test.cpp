// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/sentence/connected_word_stream.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "hri/core/error.hpp"
#include "recognition/tone_words.hpp"

namespace hri {
namespace {

using testing_data::kRateHz;
using testing_data::tone;

const ConnectedWordRecognizer& trained_by_digits() {
  static const testing_data::Clips clips = testing_data::tone_clips();
  static const ConnectedWordRecognizer recognizer = [] {
    ConnectedWordRecognizerOptions options;
    options.words.num_states = 5;
    options.words.num_vtlp_factors = 1;
    options.words.num_noisy_copies = 1;
    options.words.min_snr_db = 10;
    options.max_words = 4;
    options.choose_penalty = false;
    return ConnectedWordRecognizer::train(clips.samples, options);
  }();
  return recognizer;
}

void add_silence(double seconds, std::uint64_t seed, std::vector<float>* audio) {
  Random random(seed);
  for (int n = 0; n < static_cast<int>(seconds * kRateHz); ++n)
    audio->push_back(static_cast<float>(0.001 * random.normal()));
}

// Words with 0.1 s between, and silence around.
std::vector<float> utterance(const std::vector<std::string>& words, std::uint64_t seed) {
  std::vector<float> audio;
  add_silence(1.5, seed, &audio);
  for (const std::string& word : words) {
    const std::vector<float> clip = tone(575, word == "rise" ? 800 : -350, ++seed);
    audio.insert(audio.end(), clip.begin() + kRateHz / 4, clip.begin() + 3 * kRateHz / 4);
    add_silence(0.1, seed, &audio);
  }
  add_silence(1.5, seed + 100, &audio);
  return audio;
}

std::vector<std::string> labels_in(const Transcript& transcript) {
  std::vector<std::string> labels;
  for (const TranscribedWord& word : transcript.words) labels.push_back(word.label);
  return labels;
}

std::vector<ConnectedWordResult> results_of(ConnectedWordStream* stream,
                                            const std::vector<float>& audio, std::size_t block) {
  std::vector<ConnectedWordResult> all;
  const auto add = [&all](const std::vector<ConnectedWordResult>& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  for (std::size_t at = 0; at < audio.size(); at += block)
    add(stream->process(Span<const float>(audio).subspan(at, std::min(block, audio.size() - at))));
  add(stream->finish());
  return all;
}

const std::vector<std::string> kFirst{"rise", "fall", "fall", "rise"};
const std::vector<std::string> kSecond{"fall", "rise"};

std::vector<float> two_utterances() {
  std::vector<float> audio = utterance(kFirst, 1);
  const std::vector<float> second = utterance(kSecond, 50);
  audio.insert(audio.end(), second.begin(), second.end());
  return audio;
}

TEST(ConnectedWordStream, EndsUtterancesAsTheirRecordingsAreRecognised) {
  const std::vector<float> audio = two_utterances();
  ConnectedWordStream stream(trained_by_digits(), kRateHz);
  std::vector<ConnectedWordResult> final;
  for (const ConnectedWordResult& result : results_of(&stream, audio, 1600)) {
    if (result.is_final) final.push_back(result);
  }
  ASSERT_EQ(final.size(), 2U);
  EXPECT_EQ(labels_in(final[0].transcript), kFirst);
  EXPECT_EQ(labels_in(final[1].transcript), kSecond);
  const std::size_t half = utterance(kFirst, 1).size();
  const Transcript file =
      trained_by_digits().recognise(Span<const float>(audio).subspan(0, half), kRateHz);
  ASSERT_EQ(labels_in(file), kFirst);
  for (std::size_t i = 0; i < kFirst.size(); ++i) {
    EXPECT_NEAR(final[0].transcript.words[i].first_s, file.words[i].first_s, 0.02);
    EXPECT_NEAR(final[0].transcript.words[i].last_s, file.words[i].last_s, 0.02);
    EXPECT_TRUE(final[0].transcript.words[i].confidence.has_value());
  }
  const double half_s = static_cast<double>(half) / kRateHz;
  EXPECT_NEAR(final[1].transcript.words[0].first_s, half_s + 1.5, 0.05);
  EXPECT_LE(final[1].first_s, final[1].transcript.words[0].first_s + 0.05);
}

TEST(ConnectedWordStream, FindsFirstFricativesAndEndsThatHissAsFilesDo) {
  std::vector<float> audio = utterance({"rise", "fall"}, 20);
  Random random(3);
  const auto hiss = [&](double first_s, double last_s) {
    for (auto n = static_cast<std::size_t>(first_s * kRateHz); n < last_s * kRateHz; ++n)
      audio[n] += static_cast<float>(0.02 * random.normal());
  };
  hiss(1.38, 1.5);
  hiss(2.6, 2.7);
  const Transcript file = trained_by_digits().recognise(audio, kRateHz);
  ConnectedWordStream stream(trained_by_digits(), kRateHz);
  const std::vector<ConnectedWordResult> results = results_of(&stream, audio, 1600);
  ASSERT_FALSE(results.empty());
  const std::vector<TranscribedWord>& last = results.back().transcript.words;
  ASSERT_EQ(last.size(), 2U);
  ASSERT_EQ(file.words.size(), 2U);
  EXPECT_NEAR(last[0].first_s, 1.38, 0.03);
  EXPECT_NEAR(last[1].last_s, 2.7, 0.03);
  EXPECT_NEAR(last[0].first_s, file.words[0].first_s, 0.02);
  EXPECT_NEAR(last[1].last_s, file.words[1].last_s, 0.02);
  bool is_placed_before = false;  // a partial result has the beginning, too
  for (const ConnectedWordResult& result : results) {
    is_placed_before = is_placed_before || (!result.is_final && !result.transcript.words.empty() &&
                                            result.transcript.words[0].first_s < 1.41);
  }
  EXPECT_TRUE(is_placed_before);
}

TEST(ConnectedWordStream, SaysWhatItHasSoFarAndKeepsWhatIsStable) {
  ConnectedWordStream stream(trained_by_digits(), kRateHz);
  std::vector<std::string> stable;
  int num_partial = 0;
  for (const ConnectedWordResult& result : results_of(&stream, utterance(kFirst, 1), 400)) {
    const std::vector<std::string> labels = labels_in(result.transcript);
    ASSERT_LE(static_cast<std::size_t>(result.num_stable), labels.size());
    ASSERT_GE(static_cast<std::size_t>(result.num_stable), stable.size());
    EXPECT_TRUE(std::equal(stable.begin(), stable.end(), labels.begin()));
    stable.assign(labels.begin(), labels.begin() + result.num_stable);
    num_partial += result.is_final ? 0 : 1;
  }
  EXPECT_GE(num_partial, 4);
  EXPECT_EQ(stable, kFirst);
}

TEST(ConnectedWordStream, AlternativesBeginBehindTheWakeWordToo) {
  ConnectedWordStreamOptions options;
  options.num_alternatives = 20;
  ConnectedWordStream stream(trained_by_digits(), kRateHz, options, "fall");
  const std::vector<ConnectedWordResult> results =
      results_of(&stream, utterance({"rise", "fall", "rise", "rise"}, 1), 1600);
  ASSERT_FALSE(results.empty());
  const Transcript& found = results.back().transcript;
  EXPECT_EQ(labels_in(found), (std::vector<std::string>{"rise", "rise"}));
  std::vector<std::vector<std::string>> all;
  for (const TranscriptAlternative& alternative : found.alternatives) {
    Transcript other;
    other.words = alternative.words;
    all.push_back(labels_in(other));
    EXPECT_FALSE(all.back().empty());
  }
  ASSERT_GE(all.size(), 2U);
  EXPECT_EQ(all.front(), labels_in(found));
  std::sort(all.begin(), all.end());
  EXPECT_EQ(std::adjacent_find(all.begin(), all.end()), all.end());
}

TEST(ConnectedWordStream, DoesNotDependOnBlocks) {
  const std::vector<float> audio = two_utterances();
  ConnectedWordStream stream(trained_by_digits(), kRateHz);
  const auto expected = results_of(&stream, audio, audio.size());
  const auto found = results_of(&stream, audio, 333);  // the same stream anew
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].is_final, expected[i].is_final);
    EXPECT_EQ(found[i].num_stable, expected[i].num_stable);
    EXPECT_EQ(found[i].last_s, expected[i].last_s);
    EXPECT_EQ(found[i].transcript.log_score, expected[i].transcript.log_score);
    ASSERT_EQ(labels_in(found[i].transcript), labels_in(expected[i].transcript));
    for (std::size_t w = 0; w < found[i].transcript.words.size(); ++w) {
      EXPECT_EQ(found[i].transcript.words[w].first_s, expected[i].transcript.words[w].first_s);
      EXPECT_EQ(found[i].transcript.words[w].last_s, expected[i].transcript.words[w].last_s);
    }
  }
}

TEST(ConnectedWordStream, GoesOnThroughPauses) {
  const std::vector<float> audio = two_utterances();
  ConnectedWordStream plain(trained_by_digits(), kRateHz);
  const auto expected = results_of(&plain, audio, 1600);
  ConnectedWordStreamOptions options;
  options.endpointer.pause_ms = 50;
  ConnectedWordStream stream(trained_by_digits(), kRateHz, options);
  const auto found = results_of(&stream, audio, 1600);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].is_final, expected[i].is_final);
    EXPECT_EQ(found[i].last_s, expected[i].last_s);
    EXPECT_EQ(labels_in(found[i].transcript), labels_in(expected[i].transcript));
  }
}

TEST(ConnectedWordStream, CountsWhatIsSaidBehindTheWakeWord) {
  ConnectedWordStream stream(trained_by_digits(), kRateHz, {}, "rise");
  std::vector<std::vector<std::string>> final;
  std::vector<float> audio = two_utterances();
  const std::vector<float> asleep = utterance({"fall", "fall"}, 90);
  audio.insert(audio.end(), asleep.begin(), asleep.end());
  for (const ConnectedWordResult& result : results_of(&stream, audio, 1600)) {
    EXPECT_LE(static_cast<std::size_t>(result.num_stable), result.transcript.words.size());
    if (result.is_final) final.push_back(labels_in(result.transcript));
  }
  EXPECT_EQ(final, (std::vector<std::vector<std::string>>{{"fall", "fall", "rise"}}));
  EXPECT_THROW(ConnectedWordStream(trained_by_digits(), kRateHz, {}, "stop"), InvalidArgument);
}

TEST(ConnectedWordStream, KeepsItsMemoryForTenMinutes) {
  ConnectedWordStreamOptions options;
  options.endpointer.max_utterance_ms = 4000;
  ConnectedWordStream stream(trained_by_digits(), kRateHz, options);
  const std::vector<float> audio = utterance({"rise", "fall"}, 7);
  const double seconds = static_cast<double>(audio.size()) / kRateHz;
  std::size_t most_early = 0;
  std::size_t most_late = 0;
  int num_final = 0;
  const auto num_rounds = static_cast<int>(600 / seconds);
  for (int round = 0; round < num_rounds; ++round) {
    // Most of it is silence, so that the test is short.
    const bool speaks = round % 10 == 0;
    std::vector<float> quiet;
    if (!speaks) add_silence(seconds, static_cast<std::uint64_t>(round), &quiet);
    for (const ConnectedWordResult& result : stream.process(speaks ? audio : quiet))
      num_final += result.is_final ? 1 : 0;
    std::size_t& most = round < num_rounds / 4 ? most_early : most_late;
    most = std::max(most, stream.num_kept());
  }
  EXPECT_EQ(num_final, (num_rounds + 9) / 10);
  EXPECT_LE(most_late, most_early);
  EXPECT_LT(most_late, 25U * kRateHz);
}

TEST(ConnectedWordStream, TakesNothingOfABlockThatItRefuses) {
  std::vector<float> audio = two_utterances();
  ConnectedWordStream untroubled(trained_by_digits(), kRateHz);
  const std::vector<ConnectedWordResult> expected = results_of(&untroubled, audio, audio.size());
  ConnectedWordStream stream(trained_by_digits(), kRateHz);
  std::vector<float> damaged = audio;
  damaged.back() = std::numeric_limits<float>::infinity();
  EXPECT_THROW(stream.process(damaged), InvalidArgument);
  const std::vector<ConnectedWordResult> results = results_of(&stream, audio, audio.size());
  ASSERT_EQ(results.size(), expected.size());
  for (std::size_t i = 0; i < results.size(); ++i) {
    EXPECT_EQ(results[i].last_s, expected[i].last_s);
    EXPECT_EQ(labels_in(results[i].transcript), labels_in(expected[i].transcript));
  }
}

TEST(ConnectedWordStream, RefusesSamplesAndOptions) {
  ConnectedWordStream stream(trained_by_digits(), kRateHz);
  EXPECT_THROW(stream.process(std::vector<float>{0, std::nanf("")}), InvalidArgument);
  EXPECT_THROW(ConnectedWordStream(trained_by_digits(), 10), InvalidArgument);
  ConnectedWordStreamOptions options;
  options.partial_ms = 1;
  EXPECT_THROW(ConnectedWordStream(trained_by_digits(), kRateHz, options), InvalidArgument);
}

}  // namespace
}  // namespace hri
