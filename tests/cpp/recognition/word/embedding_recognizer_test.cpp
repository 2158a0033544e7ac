// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Word recognisers whose front end is cepstra and a speech embedding, or that embedding alone.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/core/threads.hpp"
#include "hri/recognition/word/speaker_adapter.hpp"
#include "hri/recognition/word/word_recognizer.hpp"
#include "recognition/word/embedding_words.hpp"

namespace hri {
namespace {

using testing_data::embedding;
using testing_data::expect_error;
using testing_data::Fillers;
using testing_data::fillers;
using testing_data::kRateHz;
using testing_data::small_embedding;
using testing_data::tone;
using testing_data::tone_clips;

WordRecognizerOptions both(SequenceModelKind kind = SequenceModelKind::hmm) {
  WordRecognizerOptions options;
  options.model = kind;
  options.front_end = FrontEndKind::both;
  options.max_iterations = 4;
  return options;
}

WordRecognizerOptions with(FrontEndKind front_end) {
  WordRecognizerOptions options = both();
  options.front_end = front_end;
  return options;
}

WordRecognizer trained(const WordRecognizerOptions& options = both()) {
  const Fillers others = fillers();
  return WordRecognizer::train(tone_clips().samples, options, {}, {}, others.samples, embedding());
}

class EmbeddingRecognizer : public ::testing::TestWithParam<SequenceModelKind> {};

TEST_P(EmbeddingRecognizer, TheEmbeddingVotes) {
  const WordRecognizer recognizer = trained(both(GetParam()));
  WordRecognizerOptions alone = both(GetParam());
  alone.front_end = FrontEndKind::cepstra;
  const Fillers others = fillers();
  const WordRecognizer cepstra =
      WordRecognizer::train(tone_clips().samples, alone, {}, {}, others.samples);
  const testing_data::Clips clips = tone_clips();
  for (const WordSample& s : clips.samples) {
    const Decision decision = recognizer.recognise(s.samples, kRateHz);
    EXPECT_EQ(decision.nbest.front().label, s.label);
    const StreamFrames frames = recognizer.front_end().process(s.samples, kRateHz).streams;
    ASSERT_EQ(frames.back().cols(), 12);
    const VectorF expected =
        cepstra.scores(s.samples, kRateHz) + recognizer.scorer().vectors()->scores(frames.back());
    EXPECT_TRUE(recognizer.scores(s.samples, kRateHz).isApprox(expected, 1e-5F));
  }
}

TEST_P(EmbeddingRecognizer, LoadsWhatItSavedToTheBit) {
  const WordRecognizer recognizer = trained(both(GetParam()));
  const std::vector<std::uint8_t> bytes = recognizer.to_model_file().serialise();
  // Another recogniser's way of making vectors does not matter.
  SpeechEmbeddingOptions options;
  options.num_pieces = 5;
  const auto other = std::make_shared<const SpeechEmbedding>(small_embedding(options));
  const WordRecognizer again =
      WordRecognizer::from_model_file(ModelFile::parse({bytes.data(), bytes.size()}, "x"), other);
  EXPECT_EQ(again.to_model_file().serialise(), bytes);
  const std::vector<float> clip = tone(560, 700, 77);
  EXPECT_EQ(again.scores(clip, kRateHz), recognizer.scores(clip, kRateHz));
  EXPECT_EQ(again.recognise(clip, kRateHz).score, recognizer.recognise(clip, kRateHz).score);
}

INSTANTIATE_TEST_SUITE_P(, EmbeddingRecognizer,
                         ::testing::Values(SequenceModelKind::hmm, SequenceModelKind::ptbhmm));

// What holds with cepstra beside the embedding and without.
class FrontEndWithEmbedding : public ::testing::TestWithParam<FrontEndKind> {};
INSTANTIATE_TEST_SUITE_P(, FrontEndWithEmbedding,
                         ::testing::Values(FrontEndKind::both, FrontEndKind::embedding));

TEST(EmbeddingWords, CopiesForTheEmbeddingLeaveTheCepstraAsTheyAre) {
  WordRecognizerOptions options = both();
  options.num_embedding_copies = 0;
  const WordRecognizer without = trained(options);
  options.num_embedding_copies = 3;
  const WordRecognizer with = trained(options);
  const std::vector<float> clip = tone(560, 800, 77);
  const StreamFrames frames = with.front_end().process(clip, kRateHz).streams;
  EXPECT_EQ(with.scorer().stream_scores(frames), without.scorer().stream_scores(frames));
  EXPECT_NE(with.scorer().vectors()->scores(frames.back()),
            without.scorer().vectors()->scores(frames.back()));
}

TEST(EmbeddingWords, TheEmbeddingReadsTheWordWithItsOwnPadding) {
  const std::vector<float> clip = tone(560, 800, 77);
  SpeechEmbeddingOptions options;
  options.activity.padding_ms = 0;
  const auto tight = std::make_shared<const SpeechEmbedding>(small_embedding(options));
  options.activity.padding_ms = 40;
  const auto wide = std::make_shared<const SpeechEmbedding>(small_embedding(options));
  WordRecognizerOptions words = both();
  words.cepstra.sample_rate_hz = kRateHz;
  const TrimmedWord one = WordFrontEnd(words, 1, tight).trim(clip, kRateHz);
  const TrimmedWord other = WordFrontEnd(words, 1, wide).trim(clip, kRateHz);
  EXPECT_EQ(one.samples, other.samples);
  EXPECT_EQ(other.wide.size(), one.wide.size() + 2 * 40 * kRateHz / 1000);
  words.trim = false;
  EXPECT_EQ(WordFrontEnd(words, 1, tight).trim(clip, kRateHz).wide, clip);
  words.front_end = FrontEndKind::cepstra;
  EXPECT_TRUE(WordFrontEnd(words).trim(clip, kRateHz).wide.empty());
}

TEST_P(FrontEndWithEmbedding, RefusesOtherWeightsAndNone) {
  const std::vector<std::uint8_t> bytes = trained(with(GetParam())).to_model_file().serialise();
  const ModelFile file = ModelFile::parse({bytes.data(), bytes.size()}, "words.hri");
  expect_error<InvalidArgument>([&] { WordRecognizer::from_model_file(file); },
                                "words.hri: was trained with a speech embedding");
  expect_error<FormatError>([&] { WordRecognizer::from_model_file(file, embedding(8)); },
                            "words.hri: was trained with a speech embedding of the weights");
  expect_error<InvalidArgument>(
      [] { WordRecognizer::train(tone_clips().samples, with(GetParam())); },
      "needs the weights of a speech embedding");
  expect_error<InvalidArgument>(
      [] { WordRecognizer::train(tone_clips().samples, {}, {}, {}, {}, embedding()); },
      "takes no speech embedding");
}

TEST(EmbeddingWords, ComparesWithMoreFillersThanHaveModels) {
  const Fillers others = fillers();
  const std::vector<float> steep = tone(900, 5000, 70);
  const std::vector<WordSample> more{{steep, kRateHz, "steep", ""}};
  const auto train = [&](const std::vector<WordSample>& embedding_fillers) {
    return WordRecognizer::train(tone_clips().samples, both(), {}, {}, others.samples, embedding(),
                                 embedding_fillers);
  };
  const WordRecognizer few = train({});  // whose fillers are remembered
  const WordRecognizer many = train(more);
  EXPECT_EQ(few.scorer().vectors()->num_fillers(), 2);
  EXPECT_EQ(many.scorer().vectors()->num_fillers(), 3);
  EXPECT_EQ(many.scorer().num_fillers(), 2);
  const std::vector<float> clip = tone(640, -900, 71);
  EXPECT_EQ(many.scores(clip, kRateHz), few.scores(clip, kRateHz));  // they serve rejection alone
  const StreamFrames frames = many.front_end().process(steep, kRateHz).streams;
  const auto nearness = [&](const WordRecognizer& recognizer) {
    return WordVerifier::evidence(recognizer.scorer(), frames, recognizer.scores(steep, kRateHz))
        .nearness_of_fillers;
  };
  EXPECT_NE(nearness(many), nearness(few));
  const std::vector<std::uint8_t> bytes = many.to_model_file().serialise();
  const ModelFile file = ModelFile::parse({bytes.data(), bytes.size()}, "words.hri");
  const WordRecognizer again = WordRecognizer::from_model_file(file, embedding());
  EXPECT_EQ(again.recognise(steep, kRateHz).score, many.recognise(steep, kRateHz).score);
}

TEST(EmbeddingWords, RefusesMoreFillersWithoutWhatComparesWithThem) {
  const Fillers others = fillers();
  WordRecognizerOptions cepstra = both();
  cepstra.front_end = FrontEndKind::cepstra;
  expect_error<InvalidArgument>(
      [&] {
        WordRecognizer::train(tone_clips().samples, cepstra, {}, {}, others.samples, nullptr,
                              others.samples);
      },
      "embedding_fillers need a speech embedding");
  expect_error<InvalidArgument>(
      [&] {
        WordRecognizer::train(tone_clips().samples, both(), {}, {}, {}, embedding(),
                              others.samples);
      },
      "embedding_fillers need a speech embedding and other fillers");
}

TEST_P(FrontEndWithEmbedding, WordsAreAddedAndRemoved) {
  const WordRecognizer recognizer = trained(with(GetParam()));
  const std::vector<float> flat = tone(700, 0, 90);
  const WordRecognizer more = recognizer.with_word({{flat, kRateHz, "flat", ""}});
  EXPECT_EQ(more.labels(), (std::vector<std::string>{"fall", "flat", "rise"}));
  if (GetParam() == FrontEndKind::both) {  // random weights alone do not separate it
    EXPECT_EQ(more.recognise(tone(700, 0, 91), kRateHz).nbest.front().label, "flat");
  }
  const std::vector<float> rise = tone(560, 800, 92);
  const VectorF before = recognizer.scores(rise, kRateHz);
  const VectorF after = more.scores(rise, kRateHz);
  EXPECT_EQ(after[0], before[0]);
  EXPECT_EQ(after[2], before[1]);
  EXPECT_EQ(more.without_word("flat").scores(rise, kRateHz), before);
}

TEST_P(FrontEndWithEmbedding, AdaptsItsMeansToASpeaker) {
  const WordRecognizer recognizer = trained(with(GetParam()));
  SpeakerAdapter adapter(recognizer);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    adapter.learn(tone(1100, 800, seed), kRateHz, "rise");
    adapter.learn(tone(1100, -350, seed), kRateHz, "fall");
  }
  adapter.update();
  const std::vector<float> clip = tone(1100, 800, 9);
  const MatrixF vector = recognizer.front_end().process(clip, kRateHz).streams.back();
  EXPECT_LT(adapter.recognizer().scorer().vectors()->squared_distances(vector)[1],
            recognizer.scorer().vectors()->squared_distances(vector)[1]);
  EXPECT_EQ(adapter.recognise(clip, kRateHz).nbest.front().label, "rise");
}

TEST_P(FrontEndWithEmbedding, IsTheSameFromAnyNumberOfThreads) {
  std::vector<std::vector<std::uint8_t>> files;
  for (const int threads : {1, 3}) {
    set_num_threads(threads);
    files.push_back(trained(with(GetParam())).to_model_file().serialise());
  }
  set_num_threads(0);
  EXPECT_EQ(files.front(), files.back());
}

TEST(VectorScorer, RefusesVectorsThatDoNotFit) {
  const MatrixF row = MatrixF::Ones(1, 3);
  EXPECT_THROW((void)VectorScorer::train({{row}, {}}, {}, {}), InvalidArgument);
  EXPECT_THROW((void)VectorScorer::train({}, {}, {}), InvalidArgument);
  EXPECT_THROW((void)VectorScorer::train({{row}, {MatrixF::Ones(1, 4)}}, {}, {}), InvalidArgument);
  EXPECT_THROW((void)VectorScorer::train({{row}, {MatrixF::Ones(2, 3)}}, {}, {}), InvalidArgument);
  EXPECT_THROW((void)VectorScorer::train({{row}, {-row}}, {}, {0, 0.5}), InvalidArgument);
}

}  // namespace
}  // namespace hri
