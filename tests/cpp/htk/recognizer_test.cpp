// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/recognizer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hri/core/error.hpp"

namespace hri::htk {
namespace {

// Models of one state whose frames lie at a, b, c; sp may be skipped.
ModelSet models_of_words() {
  std::string text = "~o <VECSIZE> 1 <USER>\n";
  const auto add = [&](const std::string& name, double mean, const std::string& entry) {
    text += "~h \"" + name + "\" <BEGINHMM> <NUMSTATES> 3 <STATE> 2 <MEAN> 1 " +
            std::to_string(mean) + " <VARIANCE> 1 1 <TRANSP> 3 " + entry +
            " 0 0.75 0.25 0 0 0 <ENDHMM>\n";
  };
  add("a", 0, "0 1 0");
  add("b", 10, "0 1 0");
  add("c", 20, "0 1 0");
  add("sp", 30, "0 0.5 0.5");
  ModelSet set;
  set.parse(text, "models");
  return set;
}

Dictionary words() {
  return Dictionary::parse("first a b sp\nfirst 0.5 b a sp\nsecond [2] c sp\nquiet [] sp a\n", "d");
}

MatrixF frames(const std::vector<float>& values) {
  return Eigen::Map<const MatrixF>(values.data(), static_cast<Eigen::Index>(values.size()), 1);
}

std::string found(const std::string& grammar, const std::vector<float>& values) {
  const Recognizer recognizer(models_of_words(), words(), WordLattice::of_grammar(grammar, "g"));
  std::string text;
  for (const RecognisedWord& word : recognizer.recognise(frames(values)).words)
    text += word.output + ":" + std::to_string(word.first_frame) + "-" +
            std::to_string(word.last_frame) + " ";
  return text;
}

TEST(Recognizer, FindsWordsOfSeveralModelsAndPronunciations) {
  const std::string any = "( { first | second } )";
  EXPECT_EQ(found(any, {0, 0, 10, 20, 20, 10, 0}), "first:0-3 2:3-5 first:5-7 ");
  EXPECT_EQ(found(any, {0, 10, 30, 30, 20, 30}), "first:0-4 2:4-6 ");
  EXPECT_EQ(found("( quiet first )", {0, 0, 10}), ":0-1 first:1-3 ");
}

TEST(Recognizer, ScoresAsTheBestPathDoes) {
  const Recognizer recognizer(models_of_words(), words(), WordLattice::of_words({"second"}));
  const RecognisedSentence sentence = recognizer.recognise(frames({20, 21}));
  EXPECT_TRUE(sentence.complete);
  // Two frames in c, out of it, past sp.
  const double expected =
      -std::log(2 * 3.14159265358979) - 0.5 + std::log(0.75) + std::log(0.25) + std::log(0.5);
  EXPECT_NEAR(sentence.log_score, expected, 1e-5);
}

TEST(Recognizer, SaysWhereNoSentenceFits) {
  const Recognizer recognizer(models_of_words(), words(),
                              WordLattice::of_words({"first", "second"}));
  EXPECT_FALSE(recognizer.recognise(frames({0, 10})).complete);
  EXPECT_TRUE(recognizer.recognise(frames({0, 10, 20})).complete);
}

TEST(Recognizer, AlignsModelsAndStatesOfWords) {
  const Recognizer recognizer(models_of_words(), words(),
                              WordLattice::of_grammar("( { first | second | quiet } )", "g"));
  const MatrixF observations = frames({0, 0, 10, 30, 20, 10, 0});
  const RecognisedSentence sentence = recognizer.recognise(observations);
  ASSERT_EQ(sentence.words.size(), 3U);
  const auto aligned = recognizer.align(observations, sentence);
  std::string text;
  for (std::size_t w = 0; w < aligned.size(); ++w) {
    double sum = 0;
    for (const AlignedModel& model : aligned[w]) {
      text += model.model + std::to_string(model.first_frame) + "-" +
              std::to_string(model.last_frame) + " ";
      sum += model.log_score;
      double of_states = 0;
      for (const AlignedState& state : model.states) {
        EXPECT_EQ(state.state, 2);
        EXPECT_EQ(state.first_frame, model.first_frame);
        EXPECT_EQ(state.last_frame, model.last_frame);
        of_states += state.log_score;
      }
      EXPECT_NEAR(model.states.empty() ? model.log_score : of_states, model.log_score, 1e-9);
    }
    const double of_entry = w == 2 ? std::log(0.5) : 0;
    EXPECT_NEAR(sum + of_entry, sentence.words[w].log_score, 1e-4) << w;
    text += "| ";
  }
  EXPECT_EQ(text, "a0-2 b2-3 sp3-4 | c4-5 sp5-5 | b5-6 a6-7 sp7-7 | ");
  EXPECT_EQ(sentence.words[2].pronunciation, 1);
  RecognisedSentence other = sentence;
  other.words[0].last_frame = 20;
  EXPECT_THROW((void)recognizer.align(observations, other), InvalidArgument);
}

TEST(Recognizer, TakesThePronunciationThatANodeNames) {
  const auto score = [](const std::string& variant) {
    const Recognizer recognizer(
        models_of_words(), words(),
        WordLattice::parse(
            "N=3 L=2\nI=0\nI=1 W=first v=" + variant + "\nI=2\nJ=0 S=0 E=1\nJ=1 S=1 E=2\n", "slf"));
    return recognizer.recognise(frames({0, 10})).log_score;
  };
  EXPECT_GT(score("1"), score("2") + 50);
  EXPECT_EQ(score("0"), score("1"));
  EXPECT_THROW(score("3"), InvalidArgument);
}

// Every word has two pronunciations whose models are the same: 4096 ways to say 12 words.
TEST(Recognizer, FindsSentencesWhateverTheNumberOfPronunciations) {
  const WordLattice any = WordLattice::of_grammar("( < low | high > )", "g");
  MatrixF observations(24, 1);
  for (Eigen::Index t = 0; t < observations.rows(); ++t)
    observations(t, 0) = (t / 2 % 2 == 0 ? 0.0F : 10.0F) + 0.125F * static_cast<float>(t);
  const auto best = [&](const std::string& dictionary) {
    const Recognizer recognizer(models_of_words(), Dictionary::parse(dictionary, "d"), any);
    return recognizer.n_best(recognizer.lattice(observations), 20);
  };
  const auto single = best("low a\nhigh b\n");
  const auto several = best("low 0.5 a\nlow a\nhigh b\nhigh [HIGH] b sp\nhigh 0.25 b b\n");
  const auto words_of = [](const RecognisedSentence& sentence) {
    std::vector<std::string> words;
    for (const RecognisedWord& word : sentence.words) words.push_back(word.word);
    return words;
  };
  ASSERT_EQ(single.size(), 20U);
  ASSERT_EQ(several.size(), 20U);
  EXPECT_EQ(single[0].words.size(), 12U);
  for (std::size_t i = 0; i < single.size(); ++i) {
    EXPECT_EQ(words_of(several[i]), words_of(single[i])) << i;
    EXPECT_NEAR(several[i].log_score, single[i].log_score, 1e-9) << i;
    double sum = 0;
    for (const RecognisedWord& word : several[i].words) {
      EXPECT_EQ(word.pronunciation, word.word == "low" ? 1 : 2);
      sum += word.log_score;
    }
    EXPECT_NEAR(sum, several[i].log_score, 1e-9);
  }
}

TEST(Recognizer, NamesThePronunciationsOfItsSentences) {
  const Recognizer recognizer(models_of_words(), words(),
                              WordLattice::of_grammar("( < first | second > )", "g"));
  const MatrixF observations = frames({0, 0, 10, 20, 30, 10, 0});
  const RecognisedSentence expected = recognizer.recognise(observations);
  const auto found = recognizer.n_best(recognizer.lattice(observations), 3);
  ASSERT_EQ(found.size(), 3U);
  ASSERT_EQ(found[0].words.size(), expected.words.size());
  for (std::size_t w = 0; w < expected.words.size(); ++w) {
    EXPECT_EQ(found[0].words[w].pronunciation, expected.words[w].pronunciation);
    EXPECT_EQ(found[0].words[w].first_frame, expected.words[w].first_frame);
    EXPECT_NEAR(found[0].words[w].log_score, expected.words[w].log_score, 1e-6);
  }
  for (std::size_t i = 1; i < found.size(); ++i)
    EXPECT_LE(found[i].log_score, found[i - 1].log_score);
  const Lattice other({{-1, 0, false}, {9, 7, false}}, {{0, 1, -1, 0}});
  EXPECT_THROW((void)recognizer.n_best(other, 3), InvalidArgument);
  EXPECT_TRUE(recognizer.n_best(Lattice({}, {}), 3).empty());
}

TEST(Recognizer, RefusesWhatDoesNotFitTogether) {
  const auto lattice = [](const std::string& word) { return WordLattice::of_words({word}); };
  EXPECT_THROW(Recognizer(models_of_words(), words(), lattice("third")), InvalidArgument);
  EXPECT_THROW(Recognizer(models_of_words(), words(), lattice("!NULL")), InvalidArgument);
  EXPECT_THROW(Recognizer(models_of_words(), Dictionary::parse("x d\n", "d"), lattice("x")),
               InvalidArgument);
  EXPECT_THROW(Recognizer(models_of_words(), Dictionary::parse("x sp sp\n", "d"), lattice("x")),
               InvalidArgument);
  const Recognizer recognizer(models_of_words(), words(), lattice("first"));
  EXPECT_THROW((void)recognizer.recognise(MatrixF::Zero(3, 2)), InvalidArgument);
  MatrixF bad = frames({0, 10});
  bad(0, 0) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW((void)recognizer.recognise(bad), InvalidArgument);
}

}  // namespace
}  // namespace hri::htk
