// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Word recognisers that distinguish words by a speech embedding alone.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/recognition/word/speaker_adapter.hpp"
#include "hri/recognition/word/word_recognizer.hpp"
#include "recognition/word/embedding_words.hpp"

namespace hri {
namespace {

using testing_data::Clips;
using testing_data::embedding;
using testing_data::expect_error;
using testing_data::Fillers;
using testing_data::fillers;
using testing_data::kRateHz;
using testing_data::tone;
using testing_data::tone_clips;

WordRecognizerOptions embedding_alone() {
  WordRecognizerOptions options;
  options.front_end = FrontEndKind::embedding;
  return options;
}

WordRecognizer trained_alone(const WordRecognizerOptions& options = embedding_alone(),
                             bool with_fillers = true) {
  const Fillers others = fillers();
  return WordRecognizer::train(tone_clips().samples, options, {}, {},
                               with_fillers ? others.samples : std::vector<WordSample>{},
                               embedding());
}

TEST(EmbeddingAlone, ItsLogPosteriorsAreTheScores) {
  const WordRecognizer recognizer = trained_alone();
  EXPECT_TRUE(recognizer.scorer().streams().empty());
  EXPECT_EQ(recognizer.front_end().num_streams(), 0);
  EXPECT_EQ(recognizer.scorer().vectors()->weight(), 1);
  const Clips clips = tone_clips();
  for (const WordSample& s : clips.samples) {
    const StreamFrames frames = recognizer.front_end().process(s.samples, kRateHz).streams;
    ASSERT_EQ(frames.size(), 1U);
    EXPECT_EQ(frames.front().rows(), 1);
    EXPECT_EQ(recognizer.scores(s.samples, kRateHz),
              recognizer.scorer().vectors()->scores(frames.front()));
    EXPECT_EQ(recognizer.recognise(s.samples, kRateHz).nbest.front().label, s.label);
  }
}

TEST(EmbeddingAlone, DoesNotDependOnOptionsOfTheCepstra) {
  WordRecognizerOptions other = embedding_alone();
  other.model = SequenceModelKind::ptbhmm;
  other.num_states = 3;
  other.level_stream = false;
  other.num_vtlp_factors = 1;
  other.cepstra.num_filters = 20;
  const std::vector<float> clip = tone(560, 700, 77);
  const WordRecognizer one = trained_alone();
  const WordRecognizer two = trained_alone(other);
  EXPECT_EQ(one.scores(clip, kRateHz), two.scores(clip, kRateHz));
  EXPECT_EQ(one.recognise(clip, kRateHz).score, two.recognise(clip, kRateHz).score);
}

TEST(EmbeddingAlone, RejectsByItsVectors) {
  const WordRecognizer recognizer = trained_alone();
  EXPECT_EQ(WordVerifier::feature_names(recognizer.scorer()),
            (std::vector<std::string>{"rivals", "vector_rivals", "vector_fillers"}));
  EXPECT_EQ(WordVerifier::features_of_words(recognizer.scorer(), 99), std::vector<int>{2});
  EXPECT_EQ(recognizer.scorer().num_fillers(), 2);
  EXPECT_EQ(recognizer.verifier().word_weights().size(), 1);
  EXPECT_EQ(recognizer.verifier().sound_weights().size(), 3);
  // A word close to the fillers scores below each of the vocabulary.
  const float filler = recognizer.recognise(tone(2000, -2000, 60), kRateHz).score;
  const Clips clips = tone_clips();
  for (const WordSample& s : clips.samples)
    EXPECT_GT(recognizer.recognise(s.samples, kRateHz).score, filler);
  EXPECT_EQ(recognizer.recognise(tone(2000, -2000, 60), kRateHz).status, DecisionStatus::unknown);
  const WordRecognizer plain = trained_alone(embedding_alone(), false);
  EXPECT_EQ(WordVerifier::feature_names(plain.scorer()),
            (std::vector<std::string>{"rivals", "vector_rivals"}));
  EXPECT_EQ(WordVerifier::features_of_words(plain.scorer(), 99), (std::vector<int>{0, 1}));
}

TEST(EmbeddingAlone, HoldsSpeakersOutForThresholdAndConfidences) {
  const WordRecognizer recognizer = trained_alone();
  EXPECT_GT(recognizer.calibration().threshold(), -1e29);
  EXPECT_NE(recognizer.calibration().scale(), 1);
  ASSERT_FALSE(recognizer.held_out().empty());
  EXPECT_EQ(recognizer.held_out().confusion.sum(), 18);
  const Decision decision = recognizer.recognise(tone(560, 800, 92), kRateHz);
  ASSERT_EQ(decision.nbest.size(), 2U);
  EXPECT_NEAR(decision.nbest[0].probability + decision.nbest[1].probability, 1, 1e-5);
}

// Where no speaker can be held out, the score still rises with the margin of the best word.
TEST(EmbeddingAlone, WithoutAVerifierTheMarginIsTheScore) {
  const std::vector<float> rise = tone(560, 800, 1);
  const std::vector<float> fall = tone(560, -350, 2);
  const WordRecognizer recognizer =
      WordRecognizer::train({{rise, kRateHz, "rise", ""}, {fall, kRateHz, "fall", ""}},
                            embedding_alone(), {}, {}, {}, embedding());
  EXPECT_EQ(recognizer.verifier().word_weights().size(), 0);
  const VectorF scores = recognizer.scores(rise, kRateHz);
  EXPECT_FLOAT_EQ(recognizer.recognise(rise, kRateHz).score, scores[1] - scores[0]);
  EXPECT_GT(recognizer.recognise(rise, kRateHz).score, 0);
}

TEST(EmbeddingAlone, TakesShortClipsSilenceAndOtherRates) {
  const WordRecognizer recognizer = trained_alone();
  EXPECT_EQ(recognizer.recognise(std::vector<float>(16000, 0.0F), kRateHz).status,
            DecisionStatus::no_input);
  const std::vector<float> rise = tone(560, 800, 92);
  const std::vector<float> cut(rise.begin() + 5000, rise.begin() + 6000);
  EXPECT_TRUE(recognizer.scores(cut, kRateHz).allFinite());
  EXPECT_TRUE(std::isfinite(recognizer.recognise(cut, kRateHz).score));
  EXPECT_EQ(recognizer.recognise(rise, 3 * kRateHz).nbest.size(), 2U);
  EXPECT_EQ(recognizer.recognise(rise, kRateHz / 2).nbest.size(), 2U);
}

TEST(EmbeddingAlone, LoadsWhatItSavedToTheBit) {
  const WordRecognizer recognizer = trained_alone();
  const std::vector<std::uint8_t> bytes = recognizer.to_model_file().serialise();
  const WordRecognizer again = WordRecognizer::from_model_file(
      ModelFile::parse({bytes.data(), bytes.size()}, "x"), embedding());
  EXPECT_EQ(again.to_model_file().serialise(), bytes);
  const std::vector<float> clip = tone(560, 700, 77);
  EXPECT_EQ(again.scores(clip, kRateHz), recognizer.scores(clip, kRateHz));
  EXPECT_EQ(again.recognise(clip, kRateHz).score, recognizer.recognise(clip, kRateHz).score);
}

TEST(EmbeddingAlone, AdaptsWhateverTheModelOption) {
  WordRecognizerOptions options = embedding_alone();
  options.model = SequenceModelKind::ptbhmm;
  SpeakerAdapter adapter(trained_alone(options));
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    adapter.recognise(tone(700, 800, seed), kRateHz);  // without labels, too
  adapter.update();
  EXPECT_EQ(adapter.recognise(tone(700, 800, 9), kRateHz).nbest.front().label, "rise");
}

TEST(EmbeddingAlone, AFileThatDoesNotFitIsRefused) {
  const auto broken = [](const auto& change) {
    ModelFile file = trained_alone().to_model_file();
    change(file);
    const std::vector<std::uint8_t> bytes = file.serialise();
    return WordRecognizer::from_model_file(ModelFile::parse({bytes.data(), bytes.size()}, "x.hri"),
                                           embedding());
  };
  EXPECT_NO_THROW(broken([](ModelFile&) {}));
  // Cepstra have models, which are not there, and without vectors nothing is left.
  for (const char* other : {"cepstra", "both"}) {
    expect_error<FormatError>(
        [&] { broken([&](ModelFile& f) { f.set_text("front_end", other); }); }, "x.hri");
  }
  expect_error<FormatError>(
      [&] { broken([](ModelFile& f) { f.set_number("vectors.weight", 0); }); }, "x.hri");
  expect_error<FormatError>(
      [&] { broken([](ModelFile& f) { f.set_integer("embedding.num_pieces", 4); }); },
      "differ in the size of their vectors");
  expect_error<FormatError>(
      [&] {
        broken([](ModelFile& f) { f.set_matrix("vectors.means", MatrixF(MatrixF::Zero(3, 12))); });
      },
      "x.hri");
  expect_error<FormatError>([&] { broken([](ModelFile& f) { f.set_text("stream.0.x", "1"); }); },
                            "x.hri");
}

TEST(EmbeddingAlone, AScorerNeedsAStreamOrVectors) {
  EXPECT_THROW(MultiStreamScorer({}), InvalidArgument);
  const MultiStreamScorer scorer({}, trained_alone().scorer().vectors());
  EXPECT_EQ(scorer.num_classes(), 2);
  EXPECT_TRUE(scorer.adapts());
  EXPECT_THROW((void)scorer.scores({}), InvalidArgument);
}

}  // namespace
}  // namespace hri
