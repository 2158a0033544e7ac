// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/possibility/possibilistic_hmm.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "hri/core/error.hpp"
#include "models/possibilistic_testing.hpp"

namespace hri {
namespace {

using Kind = Topology::Kind;
using namespace testing_data;

double accuracy(const PossibilisticHmmSet& set, std::uint64_t seed) {
  int right = 0;
  int total = 0;
  const auto test = words(25, seed);
  for (int c = 0; c < kNumClasses; ++c) {
    for (const SymbolSequence& s : test[static_cast<std::size_t>(c)]) {
      right += argmax(set.log_possibilities(s)) == c ? 1 : 0;
      ++total;
    }
  }
  return static_cast<double>(right) / total;
}

// The recursion over a dense matrix, in plain possibilities: no logs, no band.
double brute_force(const PossibilisticHmmSet& set, int c, const SymbolSequence& s) {
  const int n = set.num_states();
  const Conjunction conjunction = set.rule().conjunction;
  const bool conditioned = conjunction == Conjunction::min && set.rule().conditioned;
  const auto join = [conjunction](double a, double b) {
    if (conjunction == Conjunction::product) return a * b;
    return conjunction == Conjunction::min ? std::min(a, b) : std::max(a, b);
  };
  const MatrixD transition = set.transition(c);
  const MatrixD emission = set.emission(c);
  VectorD phi = set.start(c);
  double log_scale = 0;
  const auto condition = [&log_scale](VectorD* v) {
    log_scale += std::log(v->maxCoeff());
    *v /= v->maxCoeff();
  };
  for (std::size_t t = 0; t < s.size(); ++t) {
    VectorD came = phi;
    for (int j = 0; t > 0 && j < n; ++j) {
      came[j] = 0;
      for (int i = 0; i < n; ++i) {
        // A transition that does not exist joins nothing, also under max.
        if (set.topology().allows(i, j))
          came[j] = std::max(came[j], join(phi[i], transition(i, j)));
      }
    }
    VectorD b = emission.col(s[t]);
    if (conditioned) condition(&b);
    for (int j = 0; j < n; ++j) {
      if (conditioned && b[j] < 1) came[j] = std::pow(came[j], set.rule().concentration);
      phi[j] = join(came[j], b[j]);
    }
    if (conditioned) condition(&phi);
  }
  return std::log(phi.maxCoeff()) + log_scale;
}

// Every structure and rule, on sets of so many classes that each layout is used.
TEST(PossibilisticHmmSet, MatchesTheRecursionByBruteForce) {
  for (const Conjunction conjunction : {Conjunction::product, Conjunction::min, Conjunction::max}) {
    for (const Topology& topology :
         {Topology{Kind::left_right, 4, 1}, Topology{Kind::left_right, 37, 1},
          Topology{Kind::left_right, 4, 2}, Topology{Kind::banded, 4, 1},
          Topology{Kind::banded, 5, 2}, Topology{Kind::ergodic, 3, 1},
          Topology{Kind::rank_one_plus_band, 5, 1}}) {
      for (const bool conditioned : {false, true}) {
        for (const std::size_t num_classes : {1U, 3U, 4U, 20U, 40U}) {
          const std::vector<DiscreteHmm> models = random_models(num_classes, topology);
          const PossibilisticHmmSet set(models, {conjunction, conditioned, 1.5});
          for (const std::size_t length : {1U, 2U, 9U}) {
            SymbolSequence s = word(1, 99);
            s.resize(length);
            const VectorF scores = set.log_possibilities(s);
            const VectorD exact = set.log_possibilities_exact(s);
            for (int c = 0; c < set.num_classes(); c += 3) {
              const double expected = brute_force(set, c, s);
              ASSERT_NEAR(exact[c], expected, 1e-12 * std::abs(expected) + 1e-12);
              ASSERT_NEAR(scores[c], expected, 1e-5 * std::abs(expected) + 1e-5);
              ASSERT_NEAR(set.viterbi(c, s), expected, 1e-12 * std::abs(expected) + 1e-12);
            }
          }
        }
      }
    }
  }
}

TEST(PossibilisticHmmSet, ScalesEverythingOverAllClassesAndStates) {
  const auto set = PossibilisticHmmSet::train(words(8, 1), with(Conjunction::product));
  const auto largest = [&set](const auto& part) {
    double result = 0;
    for (int c = 0; c < kNumClasses; ++c) result = std::max(result, part(c).maxCoeff());
    return result;
  };
  EXPECT_DOUBLE_EQ(largest([&](int c) { return set.start(c); }), 1.0);
  EXPECT_DOUBLE_EQ(largest([&](int c) { return set.transition(c); }), 1.0);
  for (int o = 0; o < kNumSymbols; ++o)
    EXPECT_DOUBLE_EQ(largest([&](int c) { return VectorD(set.emission(c).col(o)); }), 1.0);
}

TEST(PossibilisticHmmSet, TakesClassesMoreWithoutTrainingTheOthersAgain) {
  const auto all = words(8, 1);
  const PossibilisticHmmOptions options = with(Conjunction::product);
  const auto few = PossibilisticHmmSet::train({all[0], all[1], all[2]}, options);
  const auto more = few.with_class(all[3], options);
  const auto whole = PossibilisticHmmSet::train(all, options);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(more.models()[static_cast<std::size_t>(c)].emission(),
              few.models()[static_cast<std::size_t>(c)].emission());
  }
  const SymbolSequence s = word(3, 50);
  EXPECT_EQ(more.log_possibilities(s), whole.log_possibilities(s));
  PossibilisticHmmOptions other = options;
  other.topology.num_states = 2;
  EXPECT_THROW(few.with_class(all[3], other), InvalidArgument);
}

TEST(PossibilisticHmmSet, GivesPossibilityAndNecessityOfEachClass) {
  const auto set = PossibilisticHmmSet::train(words(20, 1), with(Conjunction::product));
  const SymbolSequence s = word(2, 60);
  const VectorF logs = set.log_possibilities(s);
  const Possibilities p = set.classify(s);
  EXPECT_FLOAT_EQ(p.possibility[2], 1.0F);
  for (int c = 0; c < kNumClasses; ++c)
    EXPECT_NEAR(p.possibility[c], std::exp(logs[c] - logs.maxCoeff()), 1e-6);
  EXPECT_GT(p.necessity[2], 0.0F);
  EXPECT_FLOAT_EQ(p.necessity[0], 0.0F);
}

TEST(PossibilisticHmmSet, TellsWordsApartByProductAndMin) {
  EXPECT_GT(accuracy(PossibilisticHmmSet::train(words(20, 1), with(Conjunction::product)), 5000),
            0.95);
  EXPECT_GT(accuracy(PossibilisticHmmSet::train(words(20, 1), with(Conjunction::min)), 5000), 0.9);
}

TEST(PossibilisticHmmSet, GainsFromConditioningTheMinimum) {
  PossibilisticHmmOptions plain = with(Conjunction::min);
  plain.rule.conditioned = false;
  const double without = accuracy(PossibilisticHmmSet::train(words(20, 1), plain), 5000);
  EXPECT_LT(without,
            accuracy(PossibilisticHmmSet::train(words(20, 1), with(Conjunction::min)), 5000));
}

TEST(PossibilisticHmmSet, ScoresAllClassesAlikeByTheLiteralMaximum) {
  // Eq. 4.11 to the letter: one transition of possibility 1 saturates phi, so that recognition is a
  // guess.
  const auto set = PossibilisticHmmSet::train(words(20, 1), with(Conjunction::max));
  for (int c = 0; c < kNumClasses; ++c) {
    for (std::uint64_t seed = 5000; seed < 5020; ++seed) {
      EXPECT_EQ(set.log_possibilities(word(c, seed)), VectorF::Zero(kNumClasses));
    }
  }
  EXPECT_DOUBLE_EQ(accuracy(set, 5000), 1.0 / kNumClasses);
}

TEST(PossibilisticHmmSet, ConvertsTrainedHmms) {
  std::vector<DiscreteHmm> models;
  for (const auto& sequences : words(20, 1)) {
    DiscreteHmmOptions options;
    options.topology = {Kind::left_right, 3, 1};
    options.num_symbols = kNumSymbols;
    models.push_back(DiscreteHmm::train(sequences, options));
  }
  EXPECT_GT(accuracy(PossibilisticHmmSet(models), 5000), 0.95);
  const Topology other{Kind::left_right, 2, 1};
  models.emplace_back(MarkovChain::initial(other),
                      MatrixD::Constant(2, kNumSymbols, 1.0 / kNumSymbols));
  EXPECT_THROW(PossibilisticHmmSet{models}, InvalidArgument);
  EXPECT_THROW(PossibilisticHmmSet(std::vector<DiscreteHmm>{}), InvalidArgument);
}

TEST(PossibilisticHmmSet, FindsTheMostPossiblePath) {
  const auto set = PossibilisticHmmSet::train(words(20, 1), with(Conjunction::product));
  std::vector<int> path;
  const SymbolSequence s{0, 0, 0, 1, 1, 2, 2, 2};
  const double score = set.viterbi(0, s, &path);
  EXPECT_EQ(path, (std::vector<int>{0, 0, 0, 1, 1, 2, 2, 2}));
  EXPECT_NEAR(score, set.log_possibilities(s)[0], 1e-5);
  EXPECT_THROW(set.viterbi(kNumClasses, s), InvalidArgument);
}

TEST(PossibilisticHmmSet, LivesOnOneSequencePerClassAndOnShortOnes) {
  const auto one = PossibilisticHmmSet::train(words(1, 1), with(Conjunction::product));
  EXPECT_TRUE(one.log_possibilities(word(2, 7)).allFinite());
  const auto brief = PossibilisticHmmSet::train(
      {{{0}}, {{1, 2}}}, with(Conjunction::product, {Kind::left_right, 8, 1}));
  EXPECT_EQ(argmax(brief.log_possibilities(SymbolSequence{0})), 0);
  EXPECT_EQ(argmax(brief.log_possibilities(SymbolSequence{1, 2})), 1);
}

TEST(PossibilisticHmmSet, RefusesBadInputByName) {
  const auto refused = [](const auto& action) { return message_of<InvalidArgument>(action); };
  auto data = words(3, 1);
  const auto set = PossibilisticHmmSet::train(data, with(Conjunction::product));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "symbol 6 at position 1", refused([&] {
                        return set.log_possibilities(SymbolSequence{0, 6});
                      }));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "empty",
                      refused([&] { return set.log_possibilities(SymbolSequence{}); }));
  data[2].clear();
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "class 2 has no sequence", refused([&] {
                        return PossibilisticHmmSet::train(data, with(Conjunction::product));
                      }));
  data[2].push_back({0, 7});
  EXPECT_PRED_FORMAT2(
      ::testing::IsSubstring, "class 2, sequence 0: symbol 7 at position 1",
      refused([&] { return PossibilisticHmmSet::train(data, with(Conjunction::product)); }));
  EXPECT_THROW(PossibilisticHmmSet::train({}, with(Conjunction::product)), InvalidArgument);
}

TEST(PossibilisticHmmSet, StopsWhenAsked) {
  PossibilisticHmmOptions options = with(Conjunction::product);
  options.should_stop = [] { return true; };
  EXPECT_THROW(PossibilisticHmmSet::train(words(3, 1), options), Interrupted);
}

TEST(PossibilisticHmmSet, ScoresTheSameAfterLoadingAndFromManyThreads) {
  for (const Conjunction conjunction : {Conjunction::product, Conjunction::min, Conjunction::max}) {
    const auto set = PossibilisticHmmSet::train(words(5, 1), with(conjunction));
    ModelFile file;
    set.write(file, "p.");
    const auto loaded = PossibilisticHmmSet::read(through_bytes(file), "p.");
    EXPECT_EQ(loaded.rule().conjunction, conjunction);
    const SymbolSequence s = word(1, 77);
    const VectorF expected = set.log_possibilities(s);
    EXPECT_EQ(loaded.log_possibilities(s), expected);
    std::vector<VectorF> scores(4);
    std::vector<std::thread> threads;
    for (VectorF& v : scores)
      threads.emplace_back([&set, &s, &v] { v = set.log_possibilities(s); });
    for (std::thread& t : threads) t.join();
    for (const VectorF& v : scores) EXPECT_EQ(v, expected);
  }
}

TEST(PossibilisticHmmSet, RefusesFilesThatAreNoSet) {
  ModelFile file;
  PossibilisticHmmSet::train(words(5, 1), with(Conjunction::product)).write(file, "p.");
  const auto refused = [](const ModelFile& f) {
    return message_of<FormatError>([&f] { return PossibilisticHmmSet::read(f, "p."); });
  };
  ModelFile bad = file;
  bad.set_integer("p.conjunction", 9);
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "conjunction", refused(bad));
  bad = file;
  bad.set_integer("p.num_classes", 1000000000);
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "p.4.topology", refused(bad));
  bad = file;
  bad.set_matrix("p.1.emission", MatrixD(MatrixD::Constant(3, kNumSymbols, 1.5)));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "p.1.emission", refused(bad));
}

}  // namespace
}  // namespace hri
