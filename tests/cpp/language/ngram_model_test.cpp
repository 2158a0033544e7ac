// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/language/ngram_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hri/core/error.hpp"

namespace hri {
namespace {

const std::vector<Sentence> kTraining{{"go", "left"},
                                      {"go", "right"},
                                      {"go", "left", "stop"},
                                      {"stop"},
                                      {},
                                      {"turn", "left", "go", "right", "stop"}};

std::vector<NGramOptions> all_options() {
  std::vector<NGramOptions> all;
  for (int order = 1; order <= 3; ++order) {
    for (const auto smoothing : {NGramSmoothing::witten_bell, NGramSmoothing::kneser_ney})
      all.push_back({order, smoothing});
  }
  return all;
}

double probability(const NGramModel& model, const std::vector<std::string>& history,
                   const std::string& word) {
  std::vector<int> numbers;
  for (const std::string& h : history) numbers.push_back(model.index_of(h));
  return std::exp(model.log_probability(numbers, model.index_of(word)));
}

double sum_over_words(const NGramModel& model, const std::vector<int>& history) {
  double sum = 0;
  for (int w = 0; w < static_cast<int>(model.words().size()); ++w)
    sum += std::exp(model.log_probability(history, w));
  return sum;
}

std::string refusal_of_arpa(const std::string& text) {
  try {
    NGramModel::parse(text, "commands.arpa");
  } catch (const FormatError& error) {
    return error.what();
  }
  return "nothing thrown";
}

std::string arpa(const std::string& unigrams, const std::string& counts = "ngram 1=3\n") {
  return "\\data\\\n" + counts + "\n\\1-grams:\n" + unigrams + "\n\\end\\\n";
}
constexpr const char* kUnigrams = "-99 <s> -0.5\n-0.3 </s>\n-0.3 go -0.2\n";

TEST(NGramModel, GivesEveryHistoryProbabilitiesThatSumToOne) {
  for (const NGramOptions& options : all_options()) {
    const NGramModel model = NGramModel::train(kTraining, options, {"never"});
    for (int first = 0; first < static_cast<int>(model.words().size()); ++first) {
      EXPECT_NEAR(sum_over_words(model, {first}), 1, 1e-12);
      for (int second = 2; second < static_cast<int>(model.words().size()); ++second)
        EXPECT_NEAR(sum_over_words(model, {first, second}), 1, 1e-12);
    }
  }
}

TEST(NGramModel, IsWittenBellsFormula) {
  const NGramModel model = NGramModel::train(kTraining, {2, NGramSmoothing::witten_bell});
  // 19 words and ends, of 6 kinds, all of them seen.
  const double left = (3 + 6.0 / 6) / (19 + 6);
  EXPECT_NEAR(probability(model, {}, "left"), left, 1e-12);
  // After "go": left, right, left, right.
  EXPECT_NEAR(probability(model, {"go"}, "left"), (2 + 2 * left) / (4 + 2), 1e-12);
  const double turn = (1 + 6.0 / 6) / (19 + 6);
  EXPECT_NEAR(probability(model, {"go"}, "turn"), 2 * turn / (4 + 2), 1e-12);
}

TEST(NGramModel, KnowsWordsOfTheVocabularyThatWereNotSeen) {
  for (const NGramOptions& options : all_options()) {
    const NGramModel model = NGramModel::train(kTraining, options, {"never"});
    EXPECT_GT(probability(model, {"go"}, "never"), 0);
    EXPECT_LT(probability(model, {"go"}, "never"), probability(model, {"go"}, "left"));
    EXPECT_EQ(model.index_of("nowhere"), -1);
  }
}

TEST(NGramModel, FitsItsOwnSentencesBetterThanOthers) {
  for (const NGramOptions& options : all_options()) {
    if (options.order == 1) continue;
    const NGramModel model = NGramModel::train(kTraining, options);
    const NGramFit own = model.fit_of(kTraining);
    EXPECT_EQ(own.num_words, 19);
    const NGramFit other = model.fit_of({{"left", "left", "turn"}, {"right", "go", "nowhere"}});
    EXPECT_EQ(other.num_unknown, 1);
    EXPECT_EQ(other.num_words, 7);
    EXPECT_LT(own.perplexity(), other.perplexity());
  }
}

TEST(NGramModel, ReadsWhatItWroteToTheBit) {
  for (const NGramOptions& options : all_options()) {
    const NGramModel model = NGramModel::train(kTraining, options);
    const NGramModel read = NGramModel::parse(model.to_arpa(), "round trip");
    EXPECT_EQ(read.to_arpa(), model.to_arpa());
    EXPECT_EQ(read.order(), options.order);
    EXPECT_EQ(read.fit_of(kTraining).log_probability, model.fit_of(kTraining).log_probability);
  }
}

TEST(NGramModel, ReadsFilesOfOtherPrograms) {
  const NGramModel model = NGramModel::parse(
      "made by another program\r\n\r\n\\data\\\r\nngram 1 = 4\r\nngram  2=1\r\n\r\n\\1-grams:\r\n"
      "-99\t<s>\t-0.30103\r\n-1\t</s>\r\n-0.5\tgo\t-0.1\r\n-2 <unk>\r\n\r\n\\2-grams:\r\n"
      "-0.25\t<s> go\r\n\r\n\\end\\\r\n",
      "other.arpa");
  EXPECT_EQ(model.num_ngrams(2), 1);
  EXPECT_NEAR(probability(model, {"<s>"}, "go"), std::pow(10, -0.25), 1e-12);
  EXPECT_NEAR(probability(model, {"<s>"}, "</s>"), std::pow(10, -1.30103), 1e-12);
  EXPECT_NEAR(probability(model, {"go"}, "anything"), std::pow(10, -2.1), 1e-12);
}

TEST(NGramModel, WritesFilesOfOtherProgramsByteForByte) {
  // Layout and digits of SRILM: no back-off where there is none, a free line in front.
  const std::string text =
      "\n\\data\\\nngram 1=4\nngram 2=3\n\n\\1-grams:\n-0.4771213\t</s>\n-99\t<s>\t-0.30103\n"
      "-0.4771213\tstop\t-0.1760913\n-0.50\tgo\n\n\\2-grams:\n-0.1760913\t<s> stop\n-0.60206\t"
      "<s> go\n-0.1249387\tgo </s>\n\n\\end\\\n";
  EXPECT_EQ(NGramModel::parse(text, "srilm.arpa").to_arpa(), text);
}

TEST(NGramModel, RefusesDamagedFilesByNameAndLine) {
  EXPECT_EQ(refusal_of_arpa(arpa(kUnigrams)), "nothing thrown");
  EXPECT_EQ(refusal_of_arpa(""), "commands.arpa: line 0: has no \\data\\");
  EXPECT_EQ(refusal_of_arpa(arpa(kUnigrams, "ngram 1=4\n")),
            "commands.arpa: line 9: there are 3 1-grams above, \\data\\ says 4");
  EXPECT_EQ(refusal_of_arpa(arpa(kUnigrams, "ngram 1=999999999999\n")),
            "commands.arpa: line 9: there are 3 1-grams above, \\data\\ says 999999999999");
  EXPECT_EQ(refusal_of_arpa(arpa(kUnigrams, "ngram 1=-3\n")),
            "commands.arpa: line 2: '-3' is no count");
  EXPECT_EQ(refusal_of_arpa(arpa(kUnigrams, "ngram 2=3\n")),
            "commands.arpa: line 2: expected 'ngram 1=...'");
  EXPECT_EQ(refusal_of_arpa(arpa(std::string(kUnigrams) + "-1 go\n")),
            "commands.arpa: line 8: an n-gram stands here again");
  EXPECT_EQ(refusal_of_arpa(arpa(std::string(kUnigrams) + "0.5 left\n")),
            "commands.arpa: line 8: a probability is above 1: 0.5");
  for (const char* number : {"nan", "-inf", "1e999", "-0.1x", "left"}) {
    EXPECT_EQ(refusal_of_arpa(arpa(std::string(kUnigrams) + number + " left\n")),
              "commands.arpa: line 8: '" + std::string(number) + "' is no number of an n-gram");
  }
  EXPECT_EQ(refusal_of_arpa(arpa(std::string(kUnigrams) + "-1 \xff\n")),
            "commands.arpa: line 8: a word is not UTF-8");
  EXPECT_EQ(refusal_of_arpa(arpa("-1 </s>\n", "ngram 1=1\n")),
            "commands.arpa: line 7: has no unigram <s>");
  EXPECT_EQ(refusal_of_arpa(arpa(std::string(kUnigrams) + "\\2-grams:\n-1 go left\n",
                                 "ngram 1=3\nngram 2=1\n")),
            "commands.arpa: line 10: 'left' is no unigram");
  EXPECT_EQ(refusal_of_arpa("\\data\\\nngram 1=3\n\\1-grams:\n" + std::string(kUnigrams)),
            "commands.arpa: line 6: has no \\end\\ here");
}

TEST(NGramModel, RefusesWordsThatNoFileCouldHold) {
  for (const char* word : {"", "two words", "<s>", "</s>", "<unk>", "\xc3"})
    EXPECT_THROW(NGramModel::train({{"go", word}}), InvalidArgument);
  EXPECT_THROW(NGramModel::train({}), InvalidArgument);
  EXPECT_THROW(NGramModel::train(kTraining, {0}), InvalidArgument);
  EXPECT_THROW(NGramModel::train(kTraining, {7}), InvalidArgument);
}

TEST(NGramModel, RefusesNumbersOfNoWord) {
  const NGramModel model = NGramModel::train(kTraining);
  const std::vector<int> history{99};
  EXPECT_THROW((void)model.log_probability(history, 1), InvalidArgument);
  EXPECT_THROW((void)model.log_probability({}, 99), InvalidArgument);
  EXPECT_EQ(model.log_probability({}, -1), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(model.log_probability({}, model.start()), -std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace hri
