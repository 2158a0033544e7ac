// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/fixed_point_hmm.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hri/core/error.hpp"
#include "models/possibilistic_testing.hpp"

namespace hri {
namespace {

using Kind = Topology::Kind;
using namespace testing_data;

// Rounding is at most half a step for each of the two tables that a frame reads.
double most_rounding(const FixedPointHmmSet& fixed, std::size_t num_frames) {
  return static_cast<double>(num_frames + 1) / fixed.units();
}

TEST(FixedPointHmmSet, ScoresLikeTheSetButForRounding) {
  for (const Topology& topology :
       {Topology{Kind::left_right, 4, 1}, Topology{Kind::left_right, 40, 1},
        Topology{Kind::left_right, 150, 1}, Topology{Kind::left_right, 6, 2},
        Topology{Kind::banded, 5, 1}, Topology{Kind::banded, 5, 2}, Topology{Kind::ergodic, 4, 1},
        Topology{Kind::rank_one_plus_band, 6, 1}}) {
    for (const std::size_t num_classes : {1U, 5U, 20U, 40U}) {
      const PossibilisticHmmSet set(random_models(num_classes, topology));
      const FixedPointHmmSet fixed(set);
      EXPECT_GE(fixed.units(), 64);
      for (const std::size_t length : {1U, 2U, 5U, 30U}) {
        Random random(length);
        SymbolSequence s;
        for (std::size_t t = 0; t < length; ++t)
          s.push_back(static_cast<std::int32_t>(random.below(kNumSymbols)));
        const VectorF scores = set.log_possibilities(s);
        const VectorF rounded = fixed.log_possibilities(s);
        ASSERT_EQ(rounded.size(), scores.size());
        for (Eigen::Index c = 0; c < scores.size(); ++c)
          ASSERT_NEAR(rounded[c], scores[c], most_rounding(fixed, length) + 1e-4);
      }
    }
  }
}

TEST(FixedPointHmmSet, DecidesLikeTheSet) {
  const auto set = PossibilisticHmmSet::train(words(20, 1), with(Conjunction::product));
  const FixedPointHmmSet fixed(set);
  for (int c = 0; c < kNumClasses; ++c) {
    for (std::uint64_t seed = 5000; seed < 5050; ++seed) {
      const SymbolSequence s = word(c, seed);
      EXPECT_EQ(argmax(fixed.log_possibilities(s)), argmax(set.log_possibilities(s)));
    }
  }
}

TEST(FixedPointHmmSet, HoldsLongSequencesInSixteenBits) {
  const auto set = PossibilisticHmmSet::train(words(20, 1), with(Conjunction::product));
  const FixedPointHmmSet fixed(set);
  // Class 0 said very slowly.
  SymbolSequence s(21000, 0);
  std::fill(s.begin() + 7000, s.begin() + 14000, 1);
  std::fill(s.begin() + 14000, s.end(), 2);
  const float score = set.log_possibilities(s)[0];
  ASSERT_LT(score * fixed.units(), -40000.0);  // far beyond the range
  EXPECT_NEAR(fixed.log_possibilities(s)[0], score, most_rounding(fixed, s.size()));
}

TEST(FixedPointHmmSet, KnowsTheImpossible) {
  // Class 0 emits symbol 0 alone, class 1 symbol 1 alone.
  MatrixD zero = MatrixD::Zero(3, 2);
  zero.col(0).setOnes();
  MatrixD one = MatrixD::Zero(3, 2);
  one.col(1).setOnes();
  const MarkovChain chain = MarkovChain::initial({Kind::left_right, 3, 1});
  const FixedPointHmmSet fixed(PossibilisticHmmSet({{chain, zero}, {chain, one}}));
  const VectorF scores = fixed.log_possibilities(SymbolSequence(500, 0));
  EXPECT_NEAR(scores[0], 0.0F, 500.0F);
  EXPECT_TRUE(std::isfinite(scores[0]));
  EXPECT_EQ(scores[1], -std::numeric_limits<float>::infinity());
  const VectorF mixed = fixed.log_possibilities(SymbolSequence{0, 0, 1, 0});
  EXPECT_EQ(mixed.maxCoeff(), -std::numeric_limits<float>::infinity());
}

TEST(FixedPointHmmSet, RefusesBadInputByName) {
  const auto refused = [](const auto& action) { return message_of<InvalidArgument>(action); };
  EXPECT_PRED_FORMAT2(
      ::testing::IsSubstring, "product", refused([] {
        FixedPointHmmSet(PossibilisticHmmSet::train(words(3, 1), with(Conjunction::min)));
      }));
  const FixedPointHmmSet fixed(PossibilisticHmmSet::train(words(3, 1), with(Conjunction::product)));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "symbol 6 at position 1", refused([&] {
                        return fixed.log_possibilities(SymbolSequence{0, 6});
                      }));
  EXPECT_THROW(fixed.log_possibilities(SymbolSequence{}), InvalidArgument);
  std::vector<float> small(1);
  const SymbolSequence s{0, 1};
  EXPECT_THROW(fixed.log_possibilities(s, small), InvalidArgument);
}

}  // namespace
}  // namespace hri
