// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/sentence/sentence_recognizer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "hri/core/error.hpp"
#include "recognition/sentence/signing.hpp"

namespace hri {
namespace {

using testing_data::signed_sentence;
using testing_data::signed_sentences;

const std::vector<SignedSample>& samples() {
  static const std::vector<SignedSample> made = signed_sentences(24, 1);
  return made;
}

const SentenceRecognizer& trained_by_signs() {
  static const SentenceRecognizer recognizer =
      SentenceRecognizer::train(samples(), SentenceRecognizerOptions());
  return recognizer;
}

SentenceRecognizerOptions quick_options() {
  SentenceRecognizerOptions options;
  options.frames_per_state = 4;
  options.choose_weights = false;
  return options;
}

TEST(SentenceRecognizer, FindsWordsAndTheirFrames) {
  const SignedSample sample = signed_sentence({"dog", "cat", "cat", "ball"}, 99);
  const RecognisedSentence found = trained_by_signs().recognise(sample.tracks);
  ASSERT_EQ(found.text(), "dog cat cat ball");
  double sum = 0;
  for (std::size_t i = 0; i < sample.words.size(); ++i) {
    EXPECT_NEAR(found.words[i].first_frame, sample.words[i].first_frame, 3);
    EXPECT_NEAR(found.words[i].last_frame, sample.words[i].last_frame, 3);
    sum += found.words[i].log_score;
  }
  EXPECT_NE(sum, 0);
}

TEST(SentenceRecognizer, DoesNotDependOnThePictureOfTheSigner) {
  for (const double size : {0.5, 3.0}) {
    const SignedSample sample = signed_sentence({"ball", "dog", "cat"}, 7, size);
    EXPECT_EQ(trained_by_signs().recognise(sample.tracks).text(), "ball dog cat");
    EXPECT_EQ(trained_by_signs().recognise(sample.tracks, hand_scale_px(sample.tracks)).text(),
              "ball dog cat");
  }
}

TEST(SentenceRecognizer, FindsNoWordInRest) {
  const SignedSample rest = signed_sentence({}, 5);
  const double scale_px = hand_scale_px(samples().front().tracks);
  EXPECT_TRUE(trained_by_signs().recognise(rest.tracks, scale_px).words.empty());
}

TEST(SentenceRecognizer, ChoosesWhatIsToBeChosen) {
  SentenceRecognizerOptions chosen;
  chosen.frames_per_state = 0;
  const SentenceRecognizerOptions options = SentenceRecognizer::train(samples(), chosen).options();
  EXPECT_GE(options.frames_per_state, 2);
  EXPECT_LE(options.frames_per_state, 4);
  const SentenceRecognizer as_given = SentenceRecognizer::train(samples(), quick_options());
  EXPECT_EQ(as_given.options().decoder.insertion_penalty, 0);
  EXPECT_EQ(as_given.options().frames_per_state, 4);
  EXPECT_EQ(as_given.models().front().num_states(), 4);
}

TEST(SentenceRecognizer, WordsWithKnownFramesNeedNoSearch) {
  const SignedSample sample = signed_sentence({"dog", "cat", "ball"}, 98);
  for (const bool with_language : {false, true}) {
    const RecognisedSentence found =
        trained_by_signs().recognise_spans(sample.tracks, sample.words, 0, with_language);
    ASSERT_EQ(found.text(), "dog cat ball");
    EXPECT_EQ(found.words[1].first_frame, sample.words[1].first_frame);
  }
  EXPECT_TRUE(trained_by_signs().recognise_spans(sample.tracks, {}).words.empty());
}

TEST(SentenceRecognizer, LanguageWeighsWordsWithKnownFrames) {
  // "cat" never begins a sentence.
  const SignedSample sample = signed_sentence({"cat"}, 97);
  EXPECT_EQ(trained_by_signs().recognise_spans(sample.tracks, sample.words, 0, false).text(),
            "cat");
  EXPECT_NE(trained_by_signs()
                .with_known_language_scale(1e5)
                .recognise_spans(sample.tracks, sample.words)
                .text(),
            "cat");
  EXPECT_EQ(trained_by_signs()
                .with_known_language_scale(0)
                .recognise_spans(sample.tracks, sample.words)
                .text(),
            "cat");
}

TEST(SentenceRecognizer, ScoresOnceWhatIsSearchedOften) {
  const SentenceRecognizer& r = trained_by_signs();
  const SignedSample sample = signed_sentence({"dog", "cat", "ball"}, 98);
  const ScoredSentence scored = r.score(sample.tracks);
  ConnectedDecoderOptions decoder = r.options().decoder;
  for (const double penalty : {0.0, -40.0}) {
    decoder.insertion_penalty = penalty;
    const SentenceRecognizer other = r.with_decoder(decoder);
    const RecognisedSentence found = other.recognise(scored);
    EXPECT_EQ(found.text(), other.recognise(sample.tracks).text());
    EXPECT_EQ(found.log_score, other.recognise(sample.tracks).log_score);
  }
  const MatrixD of_spans = r.score_spans(scored, sample.words);
  ASSERT_EQ(of_spans.rows(), 3);
  ASSERT_EQ(of_spans.cols(), static_cast<Eigen::Index>(r.labels().size()));
  EXPECT_EQ(r.best_of_spans(of_spans, sample.words).log_score,
            r.recognise_spans(sample.tracks, sample.words).log_score);
  // Alone, the best column is the word.
  const RecognisedSentence alone = r.best_of_spans(of_spans, sample.words, false);
  for (Eigen::Index i = 0; i < of_spans.rows(); ++i) {
    Eigen::Index best = 0;
    of_spans.row(i).maxCoeff(&best);
    EXPECT_EQ(alone.words[static_cast<std::size_t>(i)].label,
              r.labels()[static_cast<std::size_t>(best)]);
  }
  const ScoredSentence of_another{MatrixF(scored.log_emissions.leftCols(3))};
  EXPECT_THROW(r.recognise(of_another), InvalidArgument);
  EXPECT_THROW(r.score_spans(of_another, sample.words), InvalidArgument);
  EXPECT_THROW(r.best_of_spans(of_spans, {sample.words[0]}), InvalidArgument);
}

TEST(SentenceRecognizer, WordShorterThanItsStatesIsStillNamed) {
  const SignedSample sample = signed_sentence({"dog"}, 96);
  SignedWordSpan frame = sample.words[0];
  frame.last_frame = frame.first_frame + 1;
  EXPECT_EQ(trained_by_signs().recognise_spans(sample.tracks, {frame}, 0, false).text(), "dog");
}

TEST(SentenceRecognizer, GoesThroughAFile) {
  const SignedSample sample = signed_sentence({"dog", "cat"}, 95);
  for (const int order : {0, 1, 2}) {
    SentenceRecognizerOptions options = quick_options();
    options.language_order = order;
    const SentenceRecognizer recognizer = SentenceRecognizer::train(samples(), options);
    const SentenceRecognizer loaded =
        SentenceRecognizer::from_model_file(recognizer.to_model_file());
    const RecognisedSentence found = recognizer.recognise(sample.tracks);
    EXPECT_EQ(loaded.recognise(sample.tracks).log_score, found.log_score);
    EXPECT_EQ(loaded.recognise(sample.tracks).text(), found.text());
    EXPECT_EQ(loaded.language() == nullptr, order == 0);
  }
  ModelFile other = trained_by_signs().to_model_file();
  other.set_kind("word_recognizer");
  EXPECT_THROW(SentenceRecognizer::from_model_file(other), FormatError);
}

TEST(SentenceRecognizer, PossibilisticModelsFindTheSameWords) {
  SentenceRecognizerOptions options;
  options.model = SequenceModelKind::ptbhmm;
  const SentenceRecognizer recognizer = SentenceRecognizer::train(samples(), options);
  const SentenceRecognizer loaded = SentenceRecognizer::from_model_file(recognizer.to_model_file());
  for (const std::uint64_t seed : {81U, 82U, 83U}) {
    const SignedSample sample = signed_sentence({"dog", "cat", "cat", "ball"}, seed);
    const RecognisedSentence found = recognizer.recognise(sample.tracks);
    ASSERT_EQ(found.text(), "dog cat cat ball");
    for (std::size_t i = 0; i < sample.words.size(); ++i) {
      EXPECT_NEAR(found.words[i].first_frame, sample.words[i].first_frame, 3);
      EXPECT_NEAR(found.words[i].last_frame, sample.words[i].last_frame, 3);
    }
    EXPECT_EQ(recognizer.recognise_spans(sample.tracks, sample.words, 0, false).text(),
              "dog cat cat ball");
    EXPECT_EQ(loaded.recognise(sample.tracks).log_score, found.log_score);
  }
  EXPECT_THROW(SentenceRecognizer(recognizer.options(), recognizer.labels(), recognizer.models(),
                                  recognizer.final_stays(), recognizer.language()),
               InvalidArgument);  // no codebook
}

// Sentences as rows of the places of the right hand, from the head.
std::vector<SignedSample> as_rows(std::vector<SignedSample> sentences) {
  for (SignedSample& sample : sentences) {
    const MatrixF rows = (sample.tracks.middleCols(2, 2) - sample.tracks.rightCols(2)) / 100.0F;
    sample.tracks = rows;
  }
  return sentences;
}

TEST(SentenceRecognizer, TakesRowsOfFeatures) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  SentenceRecognizerOptions options = quick_options();
  options.input = SentenceInput::rows;
  const SentenceRecognizer recognizer = SentenceRecognizer::train(as_rows(samples()), options);
  SignedSample sample = as_rows({signed_sentence({"dog", "cat", "ball"}, 71)}).front();
  EXPECT_EQ(recognizer.recognise(sample.tracks).text(), "dog cat ball");
  const SentenceRecognizer loaded = SentenceRecognizer::from_model_file(recognizer.to_model_file());
  EXPECT_EQ(loaded.recognise(sample.tracks).log_score,
            recognizer.recognise(sample.tracks).log_score);
  MatrixF held = sample.tracks;  // a hand that is not seen in rest
  held.topRows(3).setConstant(nan);
  held.bottomRows(5).setConstant(nan);
  EXPECT_EQ(recognizer.recognise(held).text(), "dog cat ball");
  EXPECT_THROW(recognizer.recognise(sample.tracks, 100), InvalidArgument);
  EXPECT_THROW(recognizer.recognise(MatrixF(0, 2)), InvalidArgument);
  EXPECT_THROW(recognizer.recognise(MatrixF::Zero(20, 3)), InvalidArgument);
  EXPECT_THROW(recognizer.recognise(MatrixF::Constant(20, 2, nan)), InvalidArgument);
  sample.tracks(4, 1) = nan;
  EXPECT_THROW(recognizer.recognise(sample.tracks), InvalidArgument);
  sample.tracks(4, 1) = std::numeric_limits<float>::infinity();
  EXPECT_THROW(recognizer.recognise(sample.tracks), InvalidArgument);
  std::vector<SignedSample> bad = as_rows(samples());
  bad[1].tracks = MatrixF::Zero(bad[1].tracks.rows(), 3);
  EXPECT_THROW(SentenceRecognizer::train(bad, options), InvalidArgument);
}

TEST(SentenceRecognizer, TrainsTheSameAgain) {
  const SignedSample sample = signed_sentence({"ball", "cat"}, 94);
  EXPECT_EQ(
      SentenceRecognizer::train(samples(), quick_options()).recognise(sample.tracks).log_score,
      SentenceRecognizer::train(samples(), quick_options()).recognise(sample.tracks).log_score);
}

TEST(SentenceRecognizer, HandsMayVanishForAWhile) {
  SignedSample sample = signed_sentence({"dog", "ball"}, 93);
  sample.tracks.block(0, 0, 12, 2).setConstant(std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(trained_by_signs().recognise(sample.tracks).text(), "dog ball");
}

TEST(SentenceRecognizer, RefusesSentencesThatContradictThemselves) {
  const auto refused = [](const std::vector<SignedSample>& bad) {
    EXPECT_THROW(SentenceRecognizer::train(bad, quick_options()), InvalidArgument);
  };
  refused({});
  refused({signed_sentence({"dog", "dog"}, 1)});  // one label
  std::vector<SignedSample> bad = samples();
  bad[3].words[0].last_frame = bad[3].tracks.rows() + 1;
  refused(bad);
  try {
    SentenceRecognizer::train(bad, quick_options());
  } catch (const InvalidArgument& error) {
    EXPECT_NE(std::string(error.what()).find(bad[3].name), std::string::npos);
  }
  bad = samples();
  bad[0].words[0].first_frame = bad[0].words[0].last_frame;
  refused(bad);
  bad = samples();
  bad[2].words[0].label = "two words";
  refused(bad);
  bad = samples();
  bad[2].tracks(0, 0) = std::numeric_limits<float>::infinity();
  refused(bad);
  SignedSample all_word = signed_sentence({"dog", "cat"}, 2);
  const std::int64_t half = all_word.tracks.rows() / 2;
  all_word.words = {{"cat", 0, half}, {"dog", half, all_word.tracks.rows()}};
  refused({all_word, all_word});
  EXPECT_THROW(trained_by_signs().recognise(MatrixF(0, 6)), InvalidArgument);
  EXPECT_THROW(trained_by_signs().recognise(samples()[0].tracks, -1), InvalidArgument);
  EXPECT_THROW(trained_by_signs().recognise_spans(samples()[0].tracks, {{"", -1, 4}}),
               InvalidArgument);
  EXPECT_THROW(trained_by_signs().recognise_spans(samples()[0].tracks, {{"", 5, 9}, {"", 2, 12}}),
               InvalidArgument);
}

TEST(SentenceRecognizer, NeedsPartsThatFit) {
  const SentenceRecognizer& r = trained_by_signs();
  EXPECT_THROW(
      SentenceRecognizer(r.options(), {"a", "b"}, r.models(), r.final_stays(), r.language()),
      InvalidArgument);
  EXPECT_THROW(SentenceRecognizer(r.options(), r.labels(), r.models(), r.final_stays(), nullptr),
               InvalidArgument);
  SentenceRecognizerOptions options = r.options();
  options.features.use_left = false;
  EXPECT_THROW(SentenceRecognizer(options, r.labels(), r.models(), r.final_stays(), r.language()),
               InvalidArgument);
}

// A word that is signed in two ways, before one that lies between both.
std::vector<SignedSample> two_ways() {
  std::vector<SignedSample> sentences;
  for (int n = 0; n < 12; ++n) {
    SignedSample sample;
    sample.name = "sentence " + std::to_string(n);
    sample.group = std::to_string(n);
    sample.tracks.resize(40, 1);
    const float wave = 0.05F * static_cast<float>(n % 3);
    for (int t = 0; t < 40; ++t) {
      const bool first = t >= 5 && t < 15;
      const bool second = t >= 25 && t < 35;
      const float way = n % 2 == 0 ? 1.0F : -1.0F;
      sample.tracks(t, 0) = first ? way : second ? 0.0F : 3.0F;
      sample.tracks(t, 0) += wave + 0.02F * static_cast<float>((t * 7 + n) % 5);
    }
    sample.words = {{"both", 5, 15}, {"middle", 25, 35}};
    sentences.push_back(std::move(sample));
  }
  return sentences;
}

SentenceRecognizerOptions options_of_ways(int max_variant_frames) {
  SentenceRecognizerOptions options = quick_options();
  options.input = SentenceInput::rows;
  options.features.delta_orders = 0;
  options.max_variant_frames = max_variant_frames;
  return options;
}

TEST(SentenceRecognizer, VariantsFitAWordThatIsSignedInTwoWays) {
  const std::vector<SignedSample> sentences = two_ways();
  const SentenceRecognizer one = SentenceRecognizer::train(sentences, options_of_ways(0));
  SentenceRecognizerOptions options = options_of_ways(1000);
  options.variant_weight = 1;
  options.variant_variance = 0.1;
  const SentenceRecognizer many = SentenceRecognizer::train(sentences, options);
  EXPECT_TRUE(one.variants().empty());
  EXPECT_EQ(many.variants().size(), 24U);
  const auto score = [](const SentenceRecognizer& r, const SignedSample& sample) {
    return r.recognise_spans(sample.tracks, sample.words, 0, false).words[0].log_score;
  };
  for (const SignedSample& sample : sentences) {
    EXPECT_EQ(many.recognise(sample.tracks).text(), "both middle");
    EXPECT_GT(score(many, sample), score(one, sample) + 1);
  }
}

TEST(SentenceRecognizer, KeepsAsManyVariantsAsItMay) {
  const SentenceRecognizer some =
      SentenceRecognizer::train(two_ways(), options_of_ways(60));  // of 12 frames
  ASSERT_EQ(some.variants().size(), 10U);
  EXPECT_EQ(some.variants()[4].word, 0);
  EXPECT_EQ(some.variants()[5].word, 1);
  EXPECT_EQ(some.variants()[0].frames.rows(), 12);  // with a margin of one frame
}

TEST(SentenceRecognizer, MarginsReachBeyondWordsAndAreNotPartOfThem) {
  SentenceRecognizerOptions options = options_of_ways(1000);
  for (const int margin : {0, 3}) {
    options.margin_frames = margin;
    const SentenceRecognizer recognizer = SentenceRecognizer::train(two_ways(), options);
    EXPECT_EQ(recognizer.variants()[0].frames.rows(), 10 + 2 * margin);
    const RecognisedSentence found = recognizer.recognise(two_ways()[1].tracks);
    ASSERT_EQ(found.text(), "both middle");
    EXPECT_NEAR(found.words[0].first_frame, 5, 1);
    EXPECT_NEAR(found.words[0].last_frame, 15, 1);
  }
}

TEST(SentenceRecognizer, WordThatGoesOnKeepsItsLastFrame) {
  SentenceRecognizerOptions options = options_of_ways(1000);
  options.margin_frames = 3;
  const SentenceRecognizer recognizer = SentenceRecognizer::train(two_ways(), options);
  const MatrixF tracks = two_ways()[1].tracks;
  const RecognisedSentence begun = recognizer.recognise_begun(tracks.topRows(32), 0);
  ASSERT_EQ(begun.text(), "both middle");
  EXPECT_EQ(begun.words[1].last_frame, 32);
  const RecognisedSentence late = recognizer.recognise(tracks.bottomRows(tracks.rows() - 7));
  ASSERT_EQ(late.text(), "both middle");
  EXPECT_EQ(late.words[0].first_frame, 0);
}

TEST(SentenceRecognizer, RefusesVariantsThatDoNotFit) {
  const SentenceRecognizer& r = trained_by_signs();
  const auto refused = [&r](const std::vector<SignVariant>& variants) {
    EXPECT_THROW(SentenceRecognizer(r.options(), r.labels(), r.models(), r.final_stays(),
                                    r.language(), std::nullopt, variants),
                 InvalidArgument);
  };
  ASSERT_FALSE(r.variants().empty());
  const auto changed = [&r](auto&& change) {
    std::vector<SignVariant> variants = r.variants();
    change(variants);
    return variants;
  };
  refused(changed([](auto& v) { std::swap(v.front(), v.back()); }));
  refused(changed([](auto& v) { v.back().word = 3; }));
  refused(changed([](auto& v) { v.front().word = -1; }));
  refused(changed([](auto& v) { v.front().states[0] = 1000; }));
  refused(changed([](auto& v) { v.front().states.pop_back(); }));
  refused(changed([](auto& v) { v.front().frames.conservativeResize(Eigen::NoChange, 2); }));
  refused(changed([](auto& v) { v.front().frames(0, 0) = std::nanf(""); }));
  // Chains have a matrix of frames by frames.
  const auto lengthened = [&changed](int length) {
    return changed([length](auto& v) {
      v.back().frames = MatrixF::Zero(length, v.back().frames.cols());
      v.back().states.assign(static_cast<std::size_t>(length), 0);
    });
  };
  refused(lengthened(1001));
  std::vector<SignVariant> many = lengthened(1000);
  many.insert(many.end(), 20, many.back());
  refused(many);
}

TEST(SentenceRecognizer, RefusesFilesWhoseVariantsContradictThemselves) {
  const ModelFile good = trained_by_signs().to_model_file();
  const auto refused = [&good](const std::string& key, const VectorF& values) {
    ModelFile file = good;
    file.set_vector(key, values);
    EXPECT_THROW(SentenceRecognizer::from_model_file(file), FormatError) << key;
  };
  for (const char* key : {"variants.words", "variants.lengths", "variants.states"}) {
    const VectorF values = good.vector_f(key);
    for (const float wrong : {-1.0F, 0.5F, 1e9F}) {
      VectorF changed = values;
      changed[values.size() - 1] = wrong;
      refused(key, changed);
    }
    refused(key, values.head(values.size() - 1));
  }
}

TEST(SentenceRecognizer, NBestSentencesDifferInTheirWords) {
  const SignedSample sample = signed_sentence({"dog", "cat", "ball"}, 92);
  const std::vector<RecognisedSentence> found =
      trained_by_signs().recognise_n_best(sample.tracks, 5);
  const RecognisedSentence best = trained_by_signs().recognise(sample.tracks);
  ASSERT_GE(found.size(), 2U);
  EXPECT_EQ(found[0].text(), best.text());
  EXPECT_NEAR(found[0].log_score, best.log_score, 1e-6 * std::abs(best.log_score));
  EXPECT_EQ(found[0].words[1].first_frame, best.words[1].first_frame);
  std::set<std::string> texts;
  for (std::size_t i = 0; i < found.size(); ++i) {
    texts.insert(found[i].text());
    if (i > 0) {
      EXPECT_LE(found[i].log_score, found[i - 1].log_score);
    }
  }
  EXPECT_EQ(texts.size(), found.size());
  EXPECT_THROW(trained_by_signs().recognise_n_best(sample.tracks, 0), InvalidArgument);
}

}  // namespace
}  // namespace hri
