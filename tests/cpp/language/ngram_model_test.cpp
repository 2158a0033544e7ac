// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/language/ngram_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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

const std::vector<Sentence> kTiny{{"a", "b"}, {"a", "b"}, {"a", "c"}, {"b"}};

double backoff(const NGramModel& model, const std::vector<std::string>& history) {
  std::vector<int> numbers;
  for (const std::string& h : history) numbers.push_back(model.index_of(h));
  return std::exp(model.log_backoff(numbers));
}

// By hand. Counts: <s> a 3, <s> b 1, a b 2, a c 1, b </s> 3, c </s> 1.
TEST(NGramModel, IsKneserNeysFormula) {
  const NGramModel model = NGramModel::train(kTiny, {2, NGramSmoothing::kneser_ney});
  // Of bigrams 3 were seen once and 1 twice: D = 3 / (3 + 2) = 0.6. Words were seen behind a 1, b
  // 2, c 1, </s> 2 others, 6 in all: D = 2 / (2 + 4) = 1/3, the share of all 4 is 1/3 * 4/6 = 2/9.
  EXPECT_NEAR(probability(model, {}, "a"), (1 - 1.0 / 3) / 6 + 2.0 / 9 / 4, 1e-12);
  EXPECT_NEAR(probability(model, {}, "b"), 1.0 / 3, 1e-12);
  EXPECT_NEAR(probability(model, {}, "c"), 1.0 / 6, 1e-12);
  EXPECT_NEAR(probability(model, {}, "</s>"), 1.0 / 3, 1e-12);
  EXPECT_NEAR(probability(model, {"a"}, "b"), (2 - 0.6) / 3 + 0.6 * 2 / 3 / 3, 1e-12);
  EXPECT_NEAR(probability(model, {"a"}, "c"), (1 - 0.6) / 3 + 0.6 * 2 / 3 / 6, 1e-12);
  EXPECT_NEAR(probability(model, {"a"}, "a"), 0.6 * 2 / 3 / 6, 1e-12);
  EXPECT_NEAR(probability(model, {"<s>"}, "a"), (3 - 0.6) / 4 + 0.6 * 2 / 4 / 6, 1e-12);
  EXPECT_NEAR(probability(model, {"<s>"}, "</s>"), 0.6 * 2 / 4 / 3, 1e-12);
  EXPECT_NEAR(probability(model, {"b"}, "</s>"), (3 - 0.6) / 3 + 0.6 / 3 / 3, 1e-12);
  EXPECT_NEAR(backoff(model, {"a"}), 0.4, 1e-12);
  EXPECT_NEAR(backoff(model, {"<s>"}), 0.3, 1e-12);
  EXPECT_NEAR(backoff(model, {"b"}), 0.2, 1e-12);
  EXPECT_NEAR(backoff(model, {"c"}), 0.6, 1e-12);
}

// By hand. Of three words: <s> a b 2, <s> a c 1, a b </s> 2, a c </s> 1, <s> b </s> 1.
TEST(NGramModel, CountsContextsInEveryOrderButTheHighest) {
  const NGramModel model = NGramModel::train(kTiny, {3, NGramSmoothing::kneser_ney});
  // Bigrams count what stands before them, b </s> 2 and the others 1; those from <s> their own, 3
  // and 1. Four were seen once and one twice: D = 4 / (4 + 2) = 2/3. Of trigrams D = 3 / (3 + 4).
  EXPECT_NEAR(probability(model, {"a"}, "b"), (1 - 2.0 / 3) / 2 + 2.0 / 3 / 3, 1e-12);
  EXPECT_NEAR(probability(model, {"a"}, "c"), (1 - 2.0 / 3) / 2 + 2.0 / 3 / 6, 1e-12);
  EXPECT_NEAR(probability(model, {"<s>"}, "a"), (3 - 2.0 / 3) / 4 + 2.0 / 3 * 2 / 4 / 6, 1e-12);
  EXPECT_NEAR(probability(model, {"b"}, "</s>"), (2 - 2.0 / 3) / 2 + 2.0 / 3 / 2 / 3, 1e-12);
  EXPECT_NEAR(probability(model, {"<s>", "a"}, "b"), 40.0 / 63, 1e-12);
  EXPECT_NEAR(probability(model, {"<s>", "a"}, "c"), 17.0 / 63, 1e-12);
  EXPECT_NEAR(probability(model, {"<s>", "a"}, "a"), 2.0 / 7 * (2.0 / 3 / 6), 1e-12);
  EXPECT_NEAR(backoff(model, {"<s>", "a"}), 2.0 / 7, 1e-12);
  EXPECT_NEAR(backoff(model, {"a", "b"}), 3.0 / 14, 1e-12);
  EXPECT_NEAR(backoff(model, {"a"}), 2.0 / 3, 1e-12);
}

// Where no n-gram was seen twice, or none once, a half is taken.
TEST(NGramModel, DiscountsAHalfWhereCountsOfCountsGiveNone) {
  const NGramModel once = NGramModel::train({{"a"}}, {2, NGramSmoothing::kneser_ney});
  EXPECT_NEAR(probability(once, {}, "a"), 0.5, 1e-12);
  EXPECT_NEAR(probability(once, {"<s>"}, "a"), 0.5 + 0.5 * 0.5, 1e-12);
  EXPECT_NEAR(backoff(once, {"<s>"}), 0.5, 1e-12);
  const NGramModel twice = NGramModel::train({{"a"}, {"a"}}, {2, NGramSmoothing::kneser_ney});
  EXPECT_NEAR(probability(twice, {"<s>"}, "a"), 1.5 / 2 + 0.25 * 0.5, 1e-12);
  EXPECT_NEAR(backoff(twice, {"<s>"}), 0.25, 1e-12);
  const NGramModel thrice =
      NGramModel::train({{"a"}, {"a"}, {"a"}}, {2, NGramSmoothing::kneser_ney});
  EXPECT_NEAR(backoff(thrice, {"<s>"}), 0.5 / 3, 1e-12);
}

// By hand: 11 words and ends of 4 kinds, a 3, b 3, c 1, </s> 4.
TEST(NGramModel, IsWittenBellsFormulaInEveryOrder) {
  const NGramModel model = NGramModel::train(kTiny, {3, NGramSmoothing::witten_bell});
  EXPECT_NEAR(probability(model, {}, "a"), 4.0 / 15, 1e-12);
  EXPECT_NEAR(probability(model, {}, "c"), 2.0 / 15, 1e-12);
  EXPECT_NEAR(probability(model, {}, "</s>"), 5.0 / 15, 1e-12);
  EXPECT_NEAR(probability(model, {"a"}, "b"), 38.0 / 75, 1e-12);
  EXPECT_NEAR(probability(model, {"<s>"}, "a"), (3 + 2 * 4.0 / 15) / 6, 1e-12);
  EXPECT_NEAR(probability(model, {"<s>", "a"}, "b"), 226.0 / 375, 1e-12);
  EXPECT_NEAR(probability(model, {"<s>", "a"}, "a"), 0.4 * 0.4 * 4 / 15, 1e-12);
  EXPECT_NEAR(backoff(model, {"a"}), 2.0 / 5, 1e-12);
  EXPECT_NEAR(backoff(model, {"<s>", "a"}), 2.0 / 5, 1e-12);
  EXPECT_NEAR(backoff(model, {"b", "</s>"}), 1, 0);  // nothing follows the end
  // A word more: the share 4/15 is for 5 then.
  const NGramModel more = NGramModel::train(kTiny, {1, NGramSmoothing::witten_bell}, {"d"});
  EXPECT_NEAR(probability(more, {}, "d"), 4.0 / 75, 1e-12);
  EXPECT_NEAR(probability(more, {}, "a"), 3.0 / 15 + 4.0 / 75, 1e-12);
}

TEST(NGramModel, HasWhatWasSeen) {
  const NGramModel model = NGramModel::train(kTiny, {3, NGramSmoothing::kneser_ney});
  EXPECT_EQ(model.num_ngrams(1), 5);  // <s> and </s>, too
  EXPECT_EQ(model.num_ngrams(2), 6);
  EXPECT_EQ(model.num_ngrams(3), 5);
  EXPECT_THROW((void)model.num_ngrams(0), InvalidArgument);
  EXPECT_THROW((void)model.num_ngrams(4), InvalidArgument);
  const int a = model.index_of("a");
  const int b = model.index_of("b");
  const int c = model.index_of("c");
  using History = std::vector<int>;
  EXPECT_TRUE(model.has(History{}, a));
  EXPECT_TRUE(model.has(History{a}, b));
  EXPECT_FALSE(model.has(History{b}, a));
  EXPECT_TRUE(model.has(History{model.start(), a}, c));
  EXPECT_FALSE(model.has(History{a, a}, b));
  EXPECT_FALSE(model.has(History{model.start(), model.start(), a}, b));
  EXPECT_EQ(model.log_backoff(History{}), 0);
  EXPECT_EQ(model.log_backoff(History{a, a}), 0);
  EXPECT_EQ(model.log_backoff(History{model.start(), a, b}), 0);
}

TEST(NGramModel, TakesAsMuchOfAHistoryAsItKnows) {
  const NGramModel model = NGramModel::train(kTiny, {3, NGramSmoothing::kneser_ney});
  const auto log_p = [&](const std::vector<int>& history, const char* word) {
    return model.log_probability(history, model.index_of(word));
  };
  const int a = model.index_of("a");
  const int c = model.index_of("c");
  const int start = model.start();
  // The last two words count.
  EXPECT_EQ(log_p({c, c, start, a}, "b"), log_p({start, a}, "b"));
  EXPECT_NE(log_p({start, a}, "b"), log_p({a}, "b"));
  // An unknown word ends it.
  EXPECT_EQ(log_p({start, -1, a}, "b"), log_p({a}, "b"));
  EXPECT_EQ(log_p({start, a, -1}, "b"), log_p({}, "b"));
  // A history that was not seen costs nothing, one that was its back-off weight.
  EXPECT_EQ(log_p({c, a}, "b"), log_p({a}, "b"));
  EXPECT_NEAR(log_p({start, a}, "a"), std::log(2.0 / 7 * 2 / 3 / 6), 1e-12);
}

TEST(NGramModel, MeasuresItsFitByEveryWordAndEnd) {
  const NGramModel model = NGramModel::train(kTiny, {2, NGramSmoothing::kneser_ney});
  // a 0.65, b 0.6, </s> 13/15; then nowhere, and b without a history 1/3, </s> 13/15.
  const NGramFit fit = model.fit_of({{"a", "b"}, {"nowhere", "b"}});
  const double expected = 0.65 * 0.6 * 13 / 15 * (1.0 / 3) * 13 / 15;
  EXPECT_NEAR(fit.log_probability, std::log(expected), 1e-12);
  EXPECT_EQ(fit.num_words, 5);
  EXPECT_EQ(fit.num_unknown, 1);
  EXPECT_NEAR(fit.perplexity(), std::pow(expected, -1.0 / 5), 1e-12);
  EXPECT_EQ(NGramFit{}.perplexity(), 0);
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
