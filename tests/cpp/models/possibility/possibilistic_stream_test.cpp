// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/possibility/possibilistic_stream.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "hri/core/error.hpp"
#include "models/possibilistic_testing.hpp"

namespace hri {
namespace {

using Kind = Topology::Kind;
using namespace testing_data;

VectorF scores_of(const PossibilisticHmmStream& stream) {
  VectorF scores(stream.num_classes());
  stream.log_possibilities({scores.data(), static_cast<std::size_t>(scores.size())});
  return scores;
}

TEST(PossibilisticHmmStream, EqualsTheSetAfterEverySymbol) {
  for (const Conjunction conjunction : {Conjunction::product, Conjunction::min, Conjunction::max}) {
    for (const Topology& topology :
         {Topology{Kind::left_right, 4, 1}, Topology{Kind::left_right, 20, 1},
          Topology{Kind::banded, 5, 2}, Topology{Kind::ergodic, 3, 1},
          Topology{Kind::rank_one_plus_band, 5, 1}}) {
      for (const std::size_t num_classes : {1U, 10U, 40U}) {
        PossibilisticRule rule;
        rule.conjunction = conjunction;
        const PossibilisticHmmSet set(random_models(num_classes, topology), rule);
        PossibilisticHmmStream stream(set);
        EXPECT_EQ(scores_of(stream), VectorF::Zero(set.num_classes()));
        SymbolSequence so_far;
        for (const std::int32_t symbol : word(1, 3)) {
          stream.push(symbol);
          so_far.push_back(symbol);
          ASSERT_EQ(scores_of(stream), set.log_possibilities(so_far));
        }
        EXPECT_EQ(stream.num_frames(), static_cast<std::int64_t>(so_far.size()));
        stream.reset();
        stream.push(2);
        EXPECT_EQ(scores_of(stream), set.log_possibilities(SymbolSequence{2}));
      }
    }
  }
}

TEST(PossibilisticHmmStream, RanksWhatIsPossible) {
  const auto set = PossibilisticHmmSet::train(words(20, 1), with(Conjunction::product));
  PossibilisticHmmStream stream(set);
  for (const std::int32_t symbol : word(2, 9)) stream.push(symbol);
  const VectorF scores = scores_of(stream);
  const std::vector<int> best = stream.nbest(3);
  ASSERT_EQ(best.size(), 3U);
  EXPECT_EQ(best.front(), 2);
  EXPECT_GE(scores[best[0]], scores[best[1]]);
  EXPECT_GE(scores[best[1]], scores[best[2]]);
  EXPECT_EQ(stream.nbest(100).size(), 4U);
  EXPECT_THROW(static_cast<void>(stream.nbest(0)), InvalidArgument);
}

TEST(PossibilisticHmmStream, DropsWhatFallsOutOfTheBeamAndKeepsTheRest) {
  // 100 classes of which the first four are words; a word drops nearly all the others.
  std::vector<DiscreteHmm> models =
      PossibilisticHmmSet::train(words(20, 1), with(Conjunction::product)).models();
  const std::vector<DiscreteHmm> others = random_models(96, {Kind::left_right, 3, 1});
  models.insert(models.end(), others.begin(), others.end());
  const PossibilisticHmmSet set(models);
  HmmStreamOptions options;
  options.beam = 10;
  PossibilisticHmmStream pruned(set, options);
  for (int c = 0; c < kNumClasses; ++c) {
    for (std::uint64_t seed = 70; seed < 80; ++seed) {
      pruned.reset();
      EXPECT_EQ(pruned.num_active(), 100);
      const SymbolSequence s = word(c, seed);
      for (const std::int32_t symbol : s) pruned.push(symbol);
      const VectorF whole = set.log_possibilities(s);
      const VectorF kept = scores_of(pruned);
      EXPECT_LT(pruned.num_active(), 50);
      EXPECT_EQ(argmax(kept), argmax(whole));
      int num_kept = 0;
      for (Eigen::Index i = 0; i < kept.size(); ++i) {
        if (kept[i] == -std::numeric_limits<float>::infinity()) continue;
        EXPECT_EQ(kept[i], whole[i]);
        ++num_kept;
      }
      EXPECT_EQ(num_kept, pruned.num_active());
    }
  }
}

TEST(PossibilisticHmmStream, RefusesBadSymbolsAndStaysAsItWas) {
  const auto set = PossibilisticHmmSet::train(words(5, 1), with(Conjunction::product));
  PossibilisticHmmStream stream(set);
  stream.push(1);
  const VectorF before = scores_of(stream);
  EXPECT_THROW(stream.push(kNumSymbols), InvalidArgument);
  EXPECT_THROW(stream.push(-1), InvalidArgument);
  EXPECT_EQ(scores_of(stream), before);
  EXPECT_EQ(stream.num_frames(), 1);
  HmmStreamOptions options;
  options.beam = 0;
  EXPECT_THROW(PossibilisticHmmStream(set, options), InvalidArgument);
}

TEST(PossibilisticHmmStream, OutlivesItsSet) {
  PossibilisticHmmStream stream = [] {
    const auto set = PossibilisticHmmSet::train(words(5, 1), with(Conjunction::product));
    return PossibilisticHmmStream(set);
  }();
  stream.push(0);
  EXPECT_TRUE(scores_of(stream).allFinite());
}

}  // namespace
}  // namespace hri
