// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Word recognisers in which a network of log mel energies votes.
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/core/threads.hpp"
#include "hri/recognition/word/speaker_adapter.hpp"
#include "hri/recognition/word/word_recognizer.hpp"
#include "recognition/tone_words.hpp"
#include "recognition/word/small_embedding.hpp"

namespace hri {
namespace {

using testing_data::kRateHz;
using testing_data::small_embedding;
using testing_data::tone;
using testing_data::tone_clips;

WordRecognizerOptions with_network(FrontEndKind front_end = FrontEndKind::cepstra) {
  WordRecognizerOptions options;
  options.front_end = front_end;
  options.max_iterations = 4;
  options.use_network = true;
  options.network.num_channels = 16;
  options.network.num_blocks = 1;
  options.network.num_epochs = 20;
  return options;
}

WordRecognizer trained_with_network(FrontEndKind front_end = FrontEndKind::cepstra) {
  std::shared_ptr<const SpeechEmbedding> embedding;
  if (has_embedding(front_end))
    embedding = std::make_shared<const SpeechEmbedding>(small_embedding({}));
  return WordRecognizer::train(tone_clips().samples, with_network(front_end), {}, {}, {},
                               embedding);
}

class NetworkRecognizer : public ::testing::TestWithParam<FrontEndKind> {};

TEST_P(NetworkRecognizer, TheNetworkVotes) {
  const WordRecognizer recognizer = trained_with_network(GetParam());
  ASSERT_NE(recognizer.scorer().network(), nullptr);
  EXPECT_GT(recognizer.scorer().network()->weight, 0);
  const testing_data::Clips clips = tone_clips();
  for (const WordSample& s : clips.samples) {
    EXPECT_EQ(recognizer.recognise(s.samples, kRateHz).nbest.front().label, s.label);
    const StreamFrames frames = recognizer.front_end().process(s.samples, kRateHz).streams;
    VectorF rest = recognizer.scorer().stream_scores(frames);
    if (has_embedding(GetParam())) rest += recognizer.scorer().vector_scores(frames);
    const VectorF network = recognizer.scorer().network_scores(frames);
    EXPECT_EQ(network[0] > network[1], s.label == "fall") << s.label;
    EXPECT_TRUE(recognizer.scores(s.samples, kRateHz).isApprox(rest + network, 1e-5F));
  }
}

TEST_P(NetworkRecognizer, LoadsWhatItSavedToTheBit) {
  const WordRecognizer recognizer = trained_with_network(GetParam());
  const std::vector<std::uint8_t> bytes = recognizer.to_model_file().serialise();
  const WordRecognizer again = WordRecognizer::from_model_file(
      ModelFile::parse({bytes.data(), bytes.size()}, "x"), recognizer.front_end().embedding());
  EXPECT_EQ(again.to_model_file().serialise(), bytes);
  const std::vector<float> clip = tone(560, 700, 77);
  EXPECT_EQ(again.scores(clip, kRateHz), recognizer.scores(clip, kRateHz));
  EXPECT_EQ(again.recognise(clip, kRateHz).score, recognizer.recognise(clip, kRateHz).score);
}

INSTANTIATE_TEST_SUITE_P(, NetworkRecognizer,
                         ::testing::Values(FrontEndKind::cepstra, FrontEndKind::both,
                                           FrontEndKind::embedding));

TEST(NetworkWords, EveryEpochIsAStepOfTraining) {
  const auto all = tone_clips();
  const auto num_samples = static_cast<int>(all.samples.size());
  const int of_a_model = 1 + num_samples / 2;
  std::vector<int> of_models;
  const auto report = [&](int done, int total) {
    // Recordings; models and half the epochs of three folds, and what is kept.
    EXPECT_EQ(total, num_samples + of_a_model * (3 * (1 + 10) + 1 + 20));
    if (done >= num_samples && (of_models.empty() || of_models.back() != done))
      of_models.push_back(done);
  };
  WordRecognizer::train(all.samples, with_network(), report);
  ASSERT_EQ(of_models.size(), 55U);
  for (int i = 0; i < 55; ++i)
    EXPECT_EQ(of_models[static_cast<std::size_t>(i)], num_samples + i * of_a_model);
}

TEST_P(NetworkRecognizer, WordsAreAddedAndRemoved) {
  const WordRecognizer recognizer = trained_with_network(GetParam());
  const std::vector<float> flat = tone(700, 0, 90);
  const WordRecognizer more = recognizer.with_word({{flat, kRateHz, "flat", ""}});
  EXPECT_EQ(more.recognise(tone(700, 0, 91), kRateHz).nbest.front().label, "flat");
  const std::vector<float> rise = tone(560, 800, 92);
  const VectorF before = recognizer.scores(rise, kRateHz);
  const VectorF after = more.scores(rise, kRateHz);
  EXPECT_EQ(after[0], before[0]);
  EXPECT_EQ(after[2], before[1]);
  EXPECT_EQ(more.without_word("flat").scores(rise, kRateHz), before);
}

TEST_P(NetworkRecognizer, TheNetworkStaysWhereTheRestAdapts) {
  const WordRecognizer recognizer = trained_with_network(GetParam());
  SpeakerAdapter adapter(recognizer);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    adapter.learn(tone(700, 800, seed), kRateHz, "rise");
    adapter.learn(tone(700, -350, seed), kRateHz, "fall");
  }
  adapter.update();
  EXPECT_EQ(adapter.recognizer().scorer().network(), recognizer.scorer().network());
  EXPECT_EQ(adapter.recognise(tone(700, 800, 9), kRateHz).nbest.front().label, "rise");
}

TEST(NetworkWords, IsTheSameFromAnyNumberOfThreads) {
  std::vector<std::vector<std::uint8_t>> files;
  for (const int threads : {1, 3}) {
    set_num_threads(threads);
    files.push_back(trained_with_network().to_model_file().serialise());
  }
  set_num_threads(0);
  EXPECT_EQ(files.front(), files.back());
}

TEST(NetworkWords, TakesShortClipsSilenceAndOtherRates) {
  const WordRecognizer recognizer = trained_with_network();
  EXPECT_EQ(recognizer.recognise(std::vector<float>(16000, 0.0F), kRateHz).status,
            DecisionStatus::no_input);
  const std::vector<float> rise = tone(560, 800, 92);
  const std::vector<float> cut(rise.begin() + 5000, rise.begin() + 9000);
  EXPECT_TRUE(recognizer.scores(cut, kRateHz).allFinite());
  EXPECT_EQ(recognizer.recognise(rise, 2 * kRateHz).nbest.size(), 2U);
}

TEST(NetworkWords, RefusesAModelWhoseNetworkIsMissingOrOfOtherClasses) {
  const auto broken = [](const auto& change) {
    ModelFile file = trained_with_network().to_model_file();
    change(file);
    const std::vector<std::uint8_t> bytes = file.serialise();
    return WordRecognizer::from_model_file(ModelFile::parse({bytes.data(), bytes.size()}, "x"));
  };
  EXPECT_THROW(broken([](ModelFile& f) { f.set_number("network.weight", -1); }), FormatError);
  EXPECT_THROW(broken([](ModelFile& f) { f.set_number("network.weight", 1e7); }), FormatError);
  EXPECT_THROW(broken([](ModelFile& f) { f.set_text("use_network", "false"); }), Error);
}

}  // namespace
}  // namespace hri
