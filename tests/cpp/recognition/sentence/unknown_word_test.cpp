// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/sentence/unknown_word.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/recognition/sentence/connected_word_recognizer.hpp"
#include "hri/recognition/sentence/connected_word_stream.hpp"
#include "recognition/tone_words.hpp"

namespace hri {
namespace {

using testing_data::kRateHz;
using testing_data::tone;

// Tones of other pitches that do not glide, as words that are none of the vocabulary.
testing_data::Clips flat_tones() {
  testing_data::Clips result;
  result.audio.reserve(12);
  std::uint64_t seed = 500;
  for (const char* person : {"one", "two", "three"}) {
    for (const double base_hz : {1500.0, 2000.0, 2500.0, 3000.0}) {
      result.audio.push_back(tone(base_hz + static_cast<double>(seed % 7), 20, seed));
      ++seed;
      result.samples.push_back(
          {result.audio.back(), kRateHz, std::to_string(static_cast<int>(base_hz)), person});
    }
  }
  return result;
}

const ConnectedWordRecognizer& with_fillers() {
  static const testing_data::Clips words = testing_data::tone_clips();
  static const testing_data::Clips fillers = flat_tones();
  ConnectedWordRecognizerOptions options;
  options.words.num_states = 5;
  options.words.num_vtlp_factors = 1;
  options.words.num_noisy_copies = 1;
  options.words.min_snr_db = 10;
  options.max_words = 4;
  options.unknown_words = true;
  options.unknown_margin = 0.3;  // tones differ by far more than words of people
  static const ConnectedWordRecognizer trained =
      ConnectedWordRecognizer::train(words.samples, options, {}, {}, fillers.samples);
  return trained;
}

void add_tone(double base_hz, double slope_hz_per_s, std::uint64_t seed,
              std::vector<float>* audio) {
  const std::vector<float> clip = tone(base_hz, slope_hz_per_s, seed);
  audio->insert(audio->end(), clip.begin() + kRateHz / 5, clip.begin() + 4 * kRateHz / 5);
}

// A rising tone, one that is no word and was no filler, and a falling one.
std::vector<float> sentence_with_other() {
  std::vector<float> audio(kRateHz / 5, 0.0F);
  add_tone(575, 800, 1000, &audio);
  add_tone(2240, 30, 1001, &audio);
  add_tone(575, -350, 1002, &audio);
  audio.insert(audio.end(), kRateHz / 5, 0.0F);
  return audio;
}

TEST(UnknownWord, ScoresTheMeanOfTheBestStatesMovedToTheUtterance) {
  // 20 states of words, one that is left out, and one of silence; then 12 of fillers.
  MatrixF models = MatrixF::Constant(2, 22, -20);
  models(0, 0) = -1;
  models(0, 1) = -6;
  models(1, 5) = -8;
  models.col(20).setZero();
  models.col(21) << -9, -2;  // the second frame is no speech
  MatrixF fillers = MatrixF::Constant(2, 12, -20);
  fillers(0, 3) = -3;
  std::vector<bool> is_of_word(22, true);
  is_of_word[20] = is_of_word[21] = false;
  const auto background = detail::unknown_background(models, is_of_word, 1, fillers, 2);
  EXPECT_FLOAT_EQ(background.means[0], -2);
  EXPECT_FLOAT_EQ(background.means[1], -14);
  EXPECT_EQ(background.num_speech, 1);
  EXPECT_DOUBLE_EQ(background.lead_sum, 1);
  // The prior counts as 40 frames: (1 + 40 * 3) / 41 - 2.5.
  const VectorF scores = background.scores(3, 2.5);
  EXPECT_NEAR(scores[0], -2 + 121.0 / 41 - 2.5, 1e-5);
  EXPECT_NEAR(scores[1] - scores[0], -12, 1e-5);
  // One state in four at most: 5 of 20.
  const auto of_few = detail::unknown_background(models, is_of_word, 1, MatrixF(2, 0), 1000);
  EXPECT_FLOAT_EQ(of_few.means[0], -13.4F);
}

TEST(UnknownWord, TakesNoLeadFromImpossibleStates) {
  MatrixF models = MatrixF::Constant(1, 33, -std::numeric_limits<float>::infinity());
  models(0, 0) = -1;
  std::vector<bool> is_of_word(33, true);
  is_of_word[32] = false;
  const auto background = detail::unknown_background(models, is_of_word, 1, MatrixF(1, 0), 2);
  EXPECT_EQ(background.num_speech, 0);
  EXPECT_FALSE(std::isnan(background.scores(1, 1)[0]));
}

TEST(UnknownWord, LastsAtMostSoLong) {
  const WordChain chain = detail::unknown_chain(8);
  ConnectedDecoderOptions options;
  options.insertion_penalty = -1;
  ConnectedDecoder decoder({chain}, WordNetwork::loop(1), options);
  const std::vector<float> frame(8, -1.0F);
  for (int t = 0; t < 16; ++t) decoder.push(frame);
  const DecodedSentence two = decoder.finish();
  ASSERT_EQ(two.words.size(), 2U);
  for (const DecodedWord& word : two.words) EXPECT_EQ(word.last_frame - word.first_frame, 8);
  for (int t = 0; t < 2; ++t) decoder.push(frame);
  EXPECT_FALSE(decoder.finish().complete);  // two frames are too few
  for (int t = 0; t < 3; ++t) decoder.push(frame);
  EXPECT_TRUE(decoder.finish().complete);
}

TEST(UnknownWord, IsFoundBetweenKnownOnesByTheSoundsOfFillers) {
  EXPECT_EQ(with_fillers().num_fillers(), 4);
  const Transcript found = with_fillers().recognise(sentence_with_other(), kRateHz);
  ASSERT_EQ(found.text(), "rise <unk> fall");
  EXPECT_TRUE(found.words[1].unknown);
  EXPECT_NEAR(found.words[1].first_s, 0.85, 0.1);
  ASSERT_TRUE(found.words[1].confidence.has_value());
  EXPECT_GT(*found.words[1].confidence, 0.5);
}

TEST(UnknownWord, IsFoundInAStreamToo) {
  ConnectedWordStream stream(with_fillers(), kRateHz);
  std::vector<float> audio = sentence_with_other();
  audio.insert(audio.end(), 2 * kRateHz, 0.0F);
  std::vector<ConnectedWordResult> results;
  const auto span = Span<const float>(audio);
  for (std::size_t at = 0; at < audio.size(); at += 320) {
    for (auto& result :
         stream.process(span.subspan(at, std::min<std::size_t>(320, audio.size() - at))))
      results.push_back(std::move(result));
  }
  ASSERT_FALSE(results.empty());
  EXPECT_TRUE(results.back().is_final);  // before the stream ends
  EXPECT_EQ(results.back().transcript.text(), "rise <unk> fall");
}

TEST(UnknownWord, KeepsItsFillersInTheFile) {
  const ModelFile file = with_fillers().to_model_file();
  const std::vector<std::uint8_t> bytes = file.serialise();
  const auto loaded = ConnectedWordRecognizer::from_model_file(ModelFile::parse(bytes, "m.hri"));
  EXPECT_EQ(loaded.to_model_file().serialise(), bytes);
  EXPECT_EQ(loaded.num_fillers(), 4);
  const std::vector<float> audio = sentence_with_other();
  EXPECT_EQ(loaded.recognise(audio, kRateHz).log_score,
            with_fillers().recognise(audio, kRateHz).log_score);
  for (const std::int64_t count : {-1, 0, 3, 5, 10001}) {
    ModelFile damaged = file;
    damaged.set_integer("num_fillers", count);
    EXPECT_THROW((void)ConnectedWordRecognizer::from_model_file(damaged), FormatError) << count;
  }
}

}  // namespace
}  // namespace hri
