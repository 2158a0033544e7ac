// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Connected words that are named anew by a speech embedding.
#include "recognition/sentence/embedding_rescorer.hpp"

#include <gtest/gtest.h>

#include "hri/core/error.hpp"
#include "hri/recognition/sentence/connected_word_stream.hpp"
#include "recognition/tone_words.hpp"
#include "recognition/word/embedding_words.hpp"

namespace hri::rescoring_tests {
namespace {

using testing_data::embedding;
using testing_data::expect_error;
using testing_data::kRateHz;
using testing_data::tone;

const testing_data::Clips& clips() {
  static const testing_data::Clips made = testing_data::tone_clips();
  return made;
}

ConnectedWordRecognizerOptions small_options() {
  ConnectedWordRecognizerOptions options;
  options.words.front_end = FrontEndKind::both;
  options.words.num_states = 5;
  options.words.num_vtlp_factors = 1;
  options.words.num_noisy_copies = 1;
  options.words.num_embedding_copies = 1;
  options.words.min_snr_db = 10;
  options.max_words = 4;
  return options;
}

const ConnectedWordRecognizer& trained() {
  static const ConnectedWordRecognizer recognizer =
      ConnectedWordRecognizer::train(clips().samples, small_options(), {}, {}, {}, embedding());
  return recognizer;
}

// The models of trained(), whose embedding says the same of every word: `fall` by `margin` more.
ConnectedWordRecognizer prejudiced(float margin, double weight) {
  ConnectedWordRecognizerOptions options = trained().options();
  options.words.embedding_weight = weight;
  VectorF bias(2);
  bias << margin, 0;  // fall, rise
  const MatrixF weights = MatrixF::Zero(2, embedding()->vector_size());
  return {options,
          trained().labels(),
          trained().models(),
          trained().final_stays(),
          std::nullopt,
          {},
          EmbeddedWords{embedding(), SoftmaxRegression::of(weights, bias)}};
}

std::vector<float> sentence(const std::vector<std::string>& words) {
  std::vector<float> audio(kRateHz / 5, 0.0F);
  std::uint64_t seed = 1000;
  for (const std::string& word : words) {
    const std::vector<float> clip = tone(575, word == "rise" ? 800 : -350, seed++);
    audio.insert(audio.end(), clip.begin() + kRateHz / 8, clip.begin() + 7 * kRateHz / 8);
  }
  audio.insert(audio.end(), kRateHz / 5, 0.0F);
  return audio;
}

const std::vector<std::string> kWords{"rise", "fall", "fall", "rise"};

TEST(EmbeddingRescorer, SpreadsTheLogOddsOfASpanOverItsFrames) {
  WordChain two;
  two.log_start = VectorD::Zero(2);
  WordChain three;
  three.log_start = VectorD::Zero(3);
  WordChain one;
  one.log_start = VectorD::Zero(1);
  MatrixF scores = MatrixF::Ones(10, 6);  // of two words and of silence
  VectorF log_odds(2);
  log_odds << 0, -4;
  detail::EmbeddingRescorer::rescore({{2, 6, log_odds}}, 0.5, {two, three, one}, &scores);
  MatrixF expected = MatrixF::Ones(10, 6);
  expected.block(2, 2, 4, 3).array() -= 0.5F;  // 0.5 * 4 over four frames
  EXPECT_EQ(scores, expected);
}

TEST(EmbeddingRescorer, NamesWordsWhereCepstraFindThem) {
  const std::vector<float> audio = sentence(kWords);
  const Transcript by_cepstra = prejudiced(0, 100).recognise(audio, kRateHz);
  ASSERT_EQ(by_cepstra.text(), "rise fall fall rise");
  const Transcript by_both = prejudiced(50, 1000).recognise(audio, kRateHz);
  EXPECT_EQ(by_both.text(), "fall fall fall fall");
  ASSERT_EQ(by_both.words.size(), by_cepstra.words.size());
  for (std::size_t i = 0; i < by_both.words.size(); ++i) {
    EXPECT_NEAR(by_both.words[i].first_s, by_cepstra.words[i].first_s, 0.05);
    EXPECT_NEAR(by_both.words[i].last_s, by_cepstra.words[i].last_s, 0.05);
  }
  EXPECT_EQ(prejudiced(50, 0).recognise(audio, kRateHz).text(), by_cepstra.text());
  EXPECT_EQ(prejudiced(50, 1000).with_embedding_weight(0).recognise(audio, kRateHz).text(),
            by_cepstra.text());
}

TEST(EmbeddingRescorer, IsNotAskedInTheMiddleOfAnUtterance) {
  const std::vector<float> audio = sentence(kWords);
  ConnectedWordStream stream(prejudiced(50, 1000), kRateHz, {}, "");
  std::string partial;
  std::string final;
  const auto note = [&](const std::vector<ConnectedWordResult>& results) {
    for (const ConnectedWordResult& result : results)
      (result.is_final ? final : partial) = result.transcript.text();
  };
  for (std::size_t n = 0; n < audio.size(); n += 1600)
    note(stream.process({audio.data() + n, std::min<std::size_t>(1600, audio.size() - n)}));
  note(stream.finish());
  EXPECT_EQ(partial.substr(0, 14), "rise fall fall");
  EXPECT_EQ(final, "fall fall fall fall");
}

TEST(EmbeddingRescorer, LearnsHowTheWordsSound) {
  EXPECT_EQ(trained().recognise(sentence(kWords), kRateHz).text(), "rise fall fall rise");
  EXPECT_GT(trained().options().words.embedding_weight, 0);
  // By the embedding nearly alone.
  EXPECT_EQ(trained().with_embedding_weight(1e5).recognise(sentence(kWords), kRateHz).text(),
            "rise fall fall rise");
  // Training is the same each time, whatever chose the weight.
  const auto again =
      ConnectedWordRecognizer::train(clips().samples, small_options(), {}, {}, {}, embedding());
  EXPECT_EQ(again.to_model_file().serialise(), trained().to_model_file().serialise());
  ConnectedWordRecognizerOptions chosen = small_options();
  chosen.choose_penalty = false;
  EXPECT_GT(ConnectedWordRecognizer::train(clips().samples, chosen, {}, {}, {}, embedding())
                .options()
                .words.embedding_weight,
            0);
}

TEST(EmbeddingRescorer, CountsWhereNothingCanBeHeldOut) {
  std::vector<WordSample> once;
  for (const WordSample& sample : clips().samples) {
    if (once.empty() || (once.size() == 1 && sample.label != once.front().label))
      once.push_back({sample.samples, sample.sample_rate_hz, sample.label, ""});
  }
  ASSERT_EQ(once.size(), 2U);
  const auto of_two =
      ConnectedWordRecognizer::train(once, small_options(), {}, {}, {}, embedding());
  EXPECT_GT(of_two.options().words.embedding_weight, 0);
}

TEST(EmbeddingRescorer, LeavesUnknownWordsUnknown) {
  ConnectedWordRecognizerOptions options = small_options();
  options.unknown_words = true;
  options.unknown_margin = 0.5;
  const auto rejecting =
      ConnectedWordRecognizer::train(clips().samples, options, {}, {}, {}, embedding());
  std::vector<float> audio = sentence({"rise"});
  const std::vector<float> other = tone(2600, 30, 9);
  audio.insert(audio.end(), other.begin() + kRateHz / 4, other.begin() + 3 * kRateHz / 4);
  const std::vector<float> after = sentence({"fall"});
  audio.insert(audio.end(), after.begin(), after.end());
  EXPECT_EQ(rejecting.recognise(audio, kRateHz).text(), "rise <unk> fall");
}

TEST(EmbeddingRescorer, MayNameAWordThatIsNone) {
  ConnectedWordRecognizerOptions options = small_options();
  options.unknown_words = true;
  const testing_data::Fillers others = testing_data::fillers();
  const auto rejecting =
      ConnectedWordRecognizer::train(clips().samples, options, {}, {}, others.samples, embedding());
  const auto named = [&](float unknown) {
    ConnectedWordRecognizerOptions weighed = rejecting.options();
    weighed.words.embedding_weight = 1000;
    VectorF bias(3);
    bias << 0, 0, unknown;  // fall, rise, and none of them
    const MatrixF weights = MatrixF::Zero(3, embedding()->vector_size());
    const ConnectedWordRecognizer made(
        weighed, rejecting.labels(), rejecting.models(), rejecting.final_stays(), std::nullopt, {},
        EmbeddedWords{embedding(), SoftmaxRegression::of(weights, bias)});
    return made.recognise(sentence({"rise", "fall"}), kRateHz).text();
  };
  EXPECT_EQ(named(-50), "rise fall");
  EXPECT_EQ(named(50), "<unk> <unk>");
  // Training makes this class of the fillers.
  const std::vector<std::uint8_t> bytes = rejecting.to_model_file().serialise();
  const ModelFile file = ModelFile::parse(bytes, "m.hri");
  EXPECT_EQ(SoftmaxRegression::read(file, "embedded_words.").num_classes(), 3);
}

TEST(EmbeddingRescorer, NeedsTheWeightsItWasTrainedWith) {
  const std::vector<std::uint8_t> bytes = trained().to_model_file().serialise();
  const ModelFile file = ModelFile::parse(bytes, "m.hri");
  const auto loaded = ConnectedWordRecognizer::from_model_file(file, embedding());
  EXPECT_EQ(loaded.to_model_file().serialise(), bytes);
  EXPECT_EQ(loaded.recognise(sentence(kWords), kRateHz).log_score,
            trained().recognise(sentence(kWords), kRateHz).log_score);
  EXPECT_EQ(loaded.embedding()->checksum(), embedding()->checksum());
  expect_error<InvalidArgument>(
      [&] { (void)ConnectedWordRecognizer::from_model_file(file); },
      "m.hri: was trained with a speech embedding of the weights " + embedding()->checksum());
  expect_error<FormatError>(
      [&] { (void)ConnectedWordRecognizer::from_model_file(file, embedding(17)); },
      "these are " + embedding(17)->checksum());
}

TEST(EmbeddingRescorer, RefusesFilesWhosePartsDoNotFit) {
  const auto refused = [](const auto& change) {
    ModelFile file = trained().to_model_file();
    change(&file);
    EXPECT_THROW((void)ConnectedWordRecognizer::from_model_file(file, embedding()), FormatError);
  };
  refused([](ModelFile* file) { file->set_text("embedding.checksum", "00000000"); });
  refused([](ModelFile* file) { file->set_text("embedding.num_pieces", "4"); });
  refused([](ModelFile* file) { file->set_text("words.front_end", "cepstra"); });
  refused([](ModelFile* file) {
    file->set_matrix("embedded_words.weights", MatrixF::Zero(5, embedding()->vector_size()));
  });
}

TEST(EmbeddingRescorer, RefusesWhatDoesNotFit) {
  const auto train = [](const ConnectedWordRecognizerOptions& options,
                        const std::shared_ptr<const SpeechEmbedding>& given) {
    return
        [=] { (void)ConnectedWordRecognizer::train(clips().samples, options, {}, {}, {}, given); };
  };
  ConnectedWordRecognizerOptions options = small_options();
  expect_error<InvalidArgument>(train(options, nullptr), "exactly where words.front_end is both");
  options.words.front_end = FrontEndKind::embedding;
  expect_error<InvalidArgument>(train(options, embedding()), "words.front_end must be cepstra or");
  options.words.front_end = FrontEndKind::cepstra;
  expect_error<InvalidArgument>(train(options, embedding()), "exactly where words.front_end");
  expect_error<InvalidArgument>(train(options, nullptr),
                                "words.num_embedding_copies has no effect with front_end cepstra");
  EXPECT_THROW((void)trained().with_embedding_weight(-1), InvalidArgument);
  const SoftmaxRegression four =
      SoftmaxRegression::of(MatrixF::Zero(4, embedding()->vector_size()), VectorF::Zero(4));
  expect_error<InvalidArgument>(
      [&] {
        (void)ConnectedWordRecognizer(trained().options(), trained().labels(), trained().models(),
                                      trained().final_stays(), std::nullopt, {},
                                      EmbeddedWords{embedding(), four});
      },
      "does not fit the speech embedding and the labels");
}

}  // namespace
}  // namespace hri::rescoring_tests
