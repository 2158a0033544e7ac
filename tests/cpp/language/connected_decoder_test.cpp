// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/language/connected_decoder.hpp"

#include <gtest/gtest.h>

#include "hri/core/error.hpp"
#include "language/decoding_testing.hpp"

namespace hri {
namespace {

using namespace testing_data;

constexpr int kNumStates = 5;  // of the three models below
constexpr int kSilence = 2;

ConnectedDecoderOptions without_beam() {
  ConnectedDecoderOptions options;
  options.beam = 1e12;
  return options;
}

DecodedSentence decode(ConnectedDecoder* decoder, const MatrixF& scores) {
  for (Eigen::Index t = 0; t < scores.rows(); ++t) decoder->push(row_span(scores, t));
  return decoder->finish();
}

void expect_same_words(const std::vector<DecodedWord>& found,
                       const std::vector<DecodedWord>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].model, expected[i].model);
    EXPECT_EQ(found[i].first_frame, expected[i].first_frame);
    EXPECT_EQ(found[i].last_frame, expected[i].last_frame);
  }
}

TEST(ConnectedDecoder, FindsTheBestOfAllSegmentations) {
  ConnectedDecoderOptions options = without_beam();
  int num_words = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    options.insertion_penalty = -2.0 + static_cast<double>(seed % 3);
    options.language_scale = 0.5 + static_cast<double>(seed % 2);
    const auto chains = two_words_and_silence(10 * seed);
    const MatrixF scores = random_scores(6, kNumStates, seed);
    for (const WordNetwork& network : networks_of_two_words()) {
      const PlainDecoder plain(chains, network, options, scores);
      ConnectedDecoder decoder(chains, network, options);
      const DecodedSentence found = decode(&decoder, scores);
      ASSERT_TRUE(found.complete);
      EXPECT_NEAR(found.log_score, plain.log_score(), 1e-9);
      expect_same_words(found.words, plain.words());
      double sum = 0;
      for (const DecodedWord& word : found.words) sum += word.log_score;
      // Weights behind the last word are in the sentence's score alone.
      EXPECT_LE(found.log_score, sum + 1e-9);
      num_words += static_cast<int>(found.words.size());
    }
  }
  EXPECT_GT(num_words, 100);
}

TEST(ConnectedDecoder, HasNoWordsBeforeTheFirstFrame) {
  ConnectedDecoder decoder(two_words_and_silence(1), WordNetwork::loop(2, kSilence));
  EXPECT_TRUE(decoder.alive());
  EXPECT_TRUE(decoder.partial().words.empty());
  const DecodedSentence empty = decoder.finish();
  EXPECT_TRUE(empty.complete);
  EXPECT_TRUE(empty.words.empty());
  EXPECT_EQ(empty.log_score, 0);
}

TEST(ConnectedDecoder, SaysWhereFramesAreTooFewForTheSentence) {
  ConnectedDecoder decoder(two_words_and_silence(1), WordNetwork::sequence(2, 3));
  const DecodedSentence cut = decode(&decoder, random_scores(2, kNumStates, 1));
  EXPECT_FALSE(cut.complete);
  EXPECT_FALSE(cut.words.empty());
}

TEST(ConnectedDecoder, CoversEveryFrameOnce) {
  ConnectedDecoder decoder(two_words_and_silence(3), WordNetwork::loop(2, kSilence));
  const DecodedSentence found = decode(&decoder, random_scores(500, kNumStates, 3));
  std::int64_t frame = 0;
  for (const DecodedWord& word : found.words) {
    EXPECT_EQ(word.first_frame, frame);
    EXPECT_GT(word.last_frame, frame);
    frame = word.last_frame;
  }
  EXPECT_EQ(frame, 500);
}

TEST(ConnectedDecoder, TakesWordsThatNoLaterFrameChanges) {
  const auto chains = two_words_and_silence(4);
  const MatrixF scores = random_scores(400, kNumStates, 4);
  ConnectedDecoder whole(chains, WordNetwork::loop(2, kSilence), without_beam());
  const DecodedSentence expected = decode(&whole, scores);
  ConnectedDecoder stream(chains, WordNetwork::loop(2, kSilence), without_beam());
  std::vector<DecodedWord> words;
  const auto add = [&words](const std::vector<DecodedWord>& more) {
    words.insert(words.end(), more.begin(), more.end());
  };
  std::size_t before_the_end = 0;
  for (Eigen::Index t = 0; t < scores.rows(); ++t) {
    stream.push(row_span(scores, t));
    add(stream.take_decided());
    if (t == 300) before_the_end = words.size();
    const DecodedSentence partial = stream.partial();
    ASSERT_FALSE(partial.words.empty());
    EXPECT_EQ(partial.words.back().last_frame, t + 1);
    if (!words.empty()) {
      EXPECT_EQ(partial.words.front().first_frame, words.back().last_frame);
    }
  }
  EXPECT_GT(before_the_end, 30U);
  add(stream.finish().words);
  expect_same_words(words, expected.words);
}

TEST(ConnectedDecoder, KeepsToItsMemoryByDecidingForTheBest) {
  // Two words of one state each that score alike: hypotheses differ for ever.
  const std::vector<WordChain> chains{random_chain(1, 1), random_chain(1, 1)};
  ConnectedDecoderOptions options = without_beam();
  options.max_open_words = 64;
  ConnectedDecoder decoder(
      chains, WordNetwork::bigram(NGramModel::train({{"a"}, {"b"}}), {"a", "b"}), options);
  std::int64_t frame = 0;
  const std::vector<float> scores{1, 1};
  for (int t = 0; t < 5000; ++t) {
    decoder.push(scores);
    for (const DecodedWord& word : decoder.take_decided()) {
      EXPECT_EQ(word.first_frame, frame);
      frame = word.last_frame;
    }
  }
  EXPECT_TRUE(decoder.alive());
  const DecodedSentence rest = decoder.finish();
  EXPECT_TRUE(rest.complete);
  EXPECT_LE(rest.words.size(), 5000U);
}

TEST(ConnectedDecoder, LosesNothingByAWideBeamAndStatesByANarrowOne) {
  const auto chains = two_words_and_silence(5);
  const MatrixF scores = random_scores(200, kNumStates, 5);
  const auto with_beam = [&](double beam, int* num_active) {
    ConnectedDecoderOptions options;
    options.beam = beam;
    ConnectedDecoder decoder(chains, WordNetwork::loop(2, kSilence), options);
    for (Eigen::Index t = 0; t < scores.rows(); ++t) {
      decoder.push(row_span(scores, t));
      *num_active += decoder.num_active();
    }
    return decoder.finish().log_score;
  };
  int all = 0;
  int wide = 0;
  int narrow = 0;
  const double exact = with_beam(1e12, &all);
  EXPECT_EQ(with_beam(100, &wide), exact);
  EXPECT_LE(with_beam(2, &narrow), exact);
  EXPECT_LT(narrow, all / 2);
}

TEST(ConnectedDecoder, IsTheSameAgainAfterReset) {
  ConnectedDecoder decoder(two_words_and_silence(6), WordNetwork::loop(2, kSilence));
  const MatrixF scores = random_scores(50, kNumStates, 6);
  const DecodedSentence first = decode(&decoder, scores);
  decoder.push(row_span(scores, 7));
  decoder.reset();
  const DecodedSentence second = decode(&decoder, scores);
  EXPECT_EQ(first.log_score, second.log_score);
  expect_same_words(second.words, first.words);
}

TEST(ConnectedDecoder, DiesOfImpossibleFramesAndSaysSo) {
  ConnectedDecoder decoder(two_words_and_silence(7), WordNetwork::loop(2, kSilence));
  decoder.push(std::vector<float>(kNumStates, -std::numeric_limits<float>::infinity()));
  EXPECT_FALSE(decoder.alive());
  EXPECT_FALSE(decoder.finish().complete);
  EXPECT_TRUE(decoder.alive());
}

TEST(ConnectedDecoder, RefusesFramesAndStaysAsItWas) {
  ConnectedDecoder decoder(two_words_and_silence(8), WordNetwork::loop(2, kSilence));
  std::vector<float> frame(kNumStates, 0);
  EXPECT_THROW(decoder.push(std::vector<float>(kNumStates + 1, 0)), InvalidArgument);
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    frame[2] = bad;
    EXPECT_THROW(decoder.push(frame), InvalidArgument);
  }
  EXPECT_EQ(decoder.num_frames(), 0);
}

TEST(ConnectedDecoder, RefusesChainsAndNetworksThatDoNotFit) {
  auto chains = two_words_and_silence(9);
  EXPECT_THROW(ConnectedDecoder(chains, WordNetwork::loop(4)), InvalidArgument);
  chains[1].log_exit[0] = 0.5;
  EXPECT_THROW(ConnectedDecoder(chains, WordNetwork::loop(2)), InvalidArgument);
  chains[1].log_exit = VectorD::Zero(3);
  EXPECT_THROW(ConnectedDecoder(chains, WordNetwork::loop(2)), InvalidArgument);
  const MarkovChain ergodic = MarkovChain::initial({Topology::Kind::ergodic, 3, 1});
  EXPECT_THROW(WordChain::of(ergodic, 0.5), InvalidArgument);
  const MarkovChain left_right = MarkovChain::initial({Topology::Kind::left_right, 3, 1});
  EXPECT_THROW(WordChain::of(left_right, 1), InvalidArgument);
}

TEST(WordNetwork, RefusesWhatIsNoNetwork) {
  constexpr int null = WordNetwork::kNull;
  EXPECT_NO_THROW(WordNetwork({null, 0, null}, {{0, 1}, {1, 2}}, 0, 2));
  EXPECT_THROW(WordNetwork({null, 0, null}, {{0, 1}}, 0, 2), InvalidArgument);
  EXPECT_THROW(WordNetwork({null, 0}, {{0, 1}}, 0, 1), InvalidArgument);
  EXPECT_THROW(WordNetwork({null, 0, null}, {{0, 1}, {1, 3}}, 0, 2), InvalidArgument);
  EXPECT_THROW(WordNetwork({null, -2, null}, {{0, 1}, {1, 2}}, 0, 2), InvalidArgument);
  EXPECT_THROW(WordNetwork({null, null}, {{0, 1}, {1, 0}}, 0, 1), InvalidArgument);
  EXPECT_THROW(WordNetwork({null}, {{0, 0}}, 0, 0), InvalidArgument);
  EXPECT_THROW(WordNetwork({null, null}, {{0, 1, std::nan("")}}, 0, 1), InvalidArgument);
  EXPECT_THROW(WordNetwork::loop(0), InvalidArgument);
  EXPECT_THROW(WordNetwork::sequence(2, 1001), InvalidArgument);
  EXPECT_THROW(WordNetwork::transcript({}), InvalidArgument);
  EXPECT_THROW(WordNetwork::transcript({-1}), InvalidArgument);
  const NGramModel trigram = NGramModel::train({{"a", "b"}}, {3});
  EXPECT_THROW(WordNetwork::bigram(trigram, {"a"}), InvalidArgument);
  EXPECT_THROW(WordNetwork::bigram(NGramModel::train({{"a"}}), {"b"}), InvalidArgument);
}

TEST(WordNetwork, PassesNullNodesInTheirOrder) {
  // Given backwards: 0 -> 3 -> 2 -> 1 -> word 4 -> 5.
  constexpr int null = WordNetwork::kNull;
  const WordNetwork network({null, null, null, null, 0, null},
                            {{4, 5}, {1, 4, -1}, {2, 1, -1}, {3, 2, -1}, {0, 3, -1}}, 0, 5);
  const std::vector<WordChain> chains{random_chain(1, 1)};
  ConnectedDecoder decoder(chains, network);
  decoder.push(std::vector<float>{0});
  const DecodedSentence found = decoder.finish();
  EXPECT_TRUE(found.complete);
  EXPECT_NEAR(found.log_score, -4 + chains[0].log_exit[0], 1e-12);
}

}  // namespace
}  // namespace hri
