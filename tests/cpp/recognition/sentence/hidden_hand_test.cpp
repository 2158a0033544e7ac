// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Sentences in which one hand is never in view.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hri/core/error.hpp"
#include "hri/recognition/sentence/sentence_recognizer.hpp"
#include "recognition/sentence/signing.hpp"

namespace hri {
namespace {

using testing_data::signed_sentence;

const std::vector<SignedSample>& sentences_of_both() {
  static const std::vector<SignedSample> made = testing_data::signed_sentences(24, 1);
  return made;
}

const SentenceRecognizer& trained_on_both() {
  static const SentenceRecognizer recognizer =
      SentenceRecognizer::train(sentences_of_both(), SentenceRecognizerOptions());
  return recognizer;
}

SentenceRecognizerOptions short_options() {
  SentenceRecognizerOptions options;
  options.frames_per_state = 4;
  options.choose_weights = false;
  return options;
}

// The points whose first column this is, in no frame.
SignedSample without(SignedSample sample, Eigen::Index column) {
  sample.tracks.middleCols(column, 2).setConstant(std::numeric_limits<float>::quiet_NaN());
  return sample;
}

TEST(HiddenHand, DecidesNothing) {
  for (const auto model : {SequenceModelKind::hmm, SequenceModelKind::ptbhmm}) {
    SentenceRecognizerOptions options = short_options();
    options.model = model;
    const SentenceRecognizer recognizer = SentenceRecognizer::train(sentences_of_both(), options);
    const SignedSample whole = signed_sentence({"dog", "cat", "dog", "ball"}, 92, 1.7);
    const SignedSample right = without(whole, 0);
    EXPECT_EQ(recognizer.recognise(right.tracks).text(), "dog cat dog ball");
    EXPECT_EQ(recognizer.recognise_spans(right.tracks, right.words, 0, false).text(),
              "dog cat dog ball");
    // Cat and dog differ in the right hand alone.
    EXPECT_EQ(
        recognizer.recognise_spans(without(whole, 2).tracks, {whole.words[3]}, 0, false).text(),
        "ball");
  }
}

TEST(HiddenHand, LeavesTheScaleThatBothHave) {
  const SignedSample whole = signed_sentence({"dog", "cat"}, 92);
  const SignedSample right = without(whole, 0);
  const double both_px = hand_scale_px(whole.tracks);
  EXPECT_LT(hand_scale_px(right.tracks), 0.9 * both_px);
  const auto score = [](const SentenceRecognizer& r, const SignedSample& sample, double scale_px) {
    return r.recognise_spans(sample.tracks, sample.words, scale_px, false).log_score;
  };
  const double at_both = score(trained_on_both(), right, both_px);
  EXPECT_GT(at_both, score(trained_on_both(), right, hand_scale_px(right.tracks)) + 10);
  EXPECT_NEAR(score(trained_on_both(), right, 0), at_both, 0.2 * std::abs(at_both));
}

TEST(HiddenHand, IsReplacedByHowFarTheOtherReaches) {
  const HandReaches& reaches = trained_on_both().reaches();
  EXPECT_GT(reaches.left, 1);  // it rests most of the time
  EXPECT_GT(reaches.right, 0.5);
  ModelFile file = trained_on_both().to_model_file();
  const SignedSample right = without(signed_sentence({"dog", "cat"}, 92), 0);
  EXPECT_EQ(SentenceRecognizer::from_model_file(file).recognise(right.tracks).log_score,
            trained_on_both().recognise(right.tracks).log_score);
  file.set_vector("reaches", VectorD(VectorD::Constant(3, 1)));
  EXPECT_THROW(SentenceRecognizer::from_model_file(file), FormatError);
  file.set_vector("reaches", VectorD(VectorD::Constant(2, -1)));
  EXPECT_THROW(SentenceRecognizer::from_model_file(file), FormatError);
}

TEST(HiddenHand, MayBeHiddenInTraining) {
  std::vector<SignedSample> some = sentences_of_both();
  for (std::size_t i = 0; i < some.size(); i += 3) some[i] = without(some[i], 0);
  const SentenceRecognizer mixed = SentenceRecognizer::train(some, short_options());
  EXPECT_TRUE(mixed.options().features.use_left);
  for (const std::uint64_t seed : {91U, 90U}) {
    const SignedSample whole = signed_sentence({"dog", "cat", "ball"}, seed);
    EXPECT_EQ(mixed.recognise(whole.tracks).text(), "dog cat ball");
    EXPECT_EQ(mixed.recognise(without(whole, 0).tracks).text(), "dog cat ball");
  }
  // Nothing is known of a hand that was never seen: where it is later does not matter.
  for (SignedSample& sample : some) sample = without(sample, 0);
  const SentenceRecognizer alone = SentenceRecognizer::train(some, short_options());
  EXPECT_FALSE(alone.options().features.use_left);
  const SignedSample whole = signed_sentence({"dog", "cat", "ball"}, 89);
  EXPECT_EQ(alone.recognise(whole.tracks).text(), "dog cat ball");
  EXPECT_EQ(alone.recognise(whole.tracks).log_score,
            alone.recognise(without(whole, 0).tracks).log_score);
  EXPECT_THROW(alone.recognise(without(whole, 2).tracks), InvalidArgument);
  EXPECT_THROW(alone.recognise(without(whole, 2).tracks, 100), InvalidArgument);
  for (SignedSample& sample : some) sample = without(signed_sentence({"dog", "cat"}, 88), 2);
  EXPECT_THROW(SentenceRecognizer::train(some, short_options()), InvalidArgument);
}

}  // namespace
}  // namespace hri
