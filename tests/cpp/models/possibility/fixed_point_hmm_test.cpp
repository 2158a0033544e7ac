// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/possibility/fixed_point_hmm.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "hri/core/error.hpp"
#include "models/possibilistic_testing.hpp"
#include "models/possibility/possibility_tables.hpp"

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

// Probabilities as far apart as can be, many of them 0, at least one of them not.
VectorD extreme_distribution(Eigen::Index size, Random* random) {
  VectorD values = VectorD::Zero(size);
  for (double& v : values) {
    const double kind = random->uniform();
    if (kind > 0.3) v = std::exp(-(kind > 0.5 ? 2.0 : 60.0) * random->uniform());
  }
  const auto sure = static_cast<Eigen::Index>(random->below(static_cast<std::uint64_t>(size)));
  values[sure] += 0.01;
  return values / values.sum();
}

DiscreteHmm extreme_model(const Topology& topology, Random* random) {
  const int n = topology.num_states;
  MatrixD band = MatrixD::Zero(n, n);
  VectorD leave = VectorD::Zero(n);
  const bool jumps = topology.kind == Kind::rank_one_plus_band;
  const bool leaves = random->uniform() < 0.5;
  for (int i = 0; i < n; ++i) {
    const int first = topology.first_next(i);
    const int count = topology.end_next(i) - first;
    band.row(i).segment(first, count) = extreme_distribution(count, random).transpose();
    if (jumps && leaves) leave[i] = std::floor(3 * random->uniform()) / 2;
    band.row(i) *= 1 - leave[i];
  }
  MatrixD emission(n, kNumSymbols);
  for (int j = 0; j < n; ++j)
    emission.row(j) = extreme_distribution(kNumSymbols, random).transpose();
  const VectorD start = extreme_distribution(n, random);
  if (!jumps) return {{topology, start, band}, emission};
  return {{topology, start, band, leave, extreme_distribution(n, random)}, emission};
}

// Sums of table entries along all paths, in 64 bits: nothing is shifted and nothing falls.
constexpr std::int64_t kNever = -1000000000;

VectorD best_sums(const PossibilisticHmmSet& set, double units, const SymbolSequence& s) {
  const auto entry = [units](double p) {
    const std::int64_t e = detail::from_log<std::int16_t>(std::log(p), units);
    return e == detail::Bounds16::kImpossible ? kNever : e;
  };
  const auto chains = detail::possibility_chains(set.models());
  VectorD best(set.num_classes());
  for (int c = 0; c < set.num_classes(); ++c) {
    const detail::PossibilityChain& chain = chains[static_cast<std::size_t>(c)];
    const MatrixD emission = set.emission(c);
    const int n = set.num_states();
    std::vector<std::int64_t> phi(static_cast<std::size_t>(n), kNever);
    for (std::size_t t = 0; t < s.size(); ++t) {
      std::vector<std::int64_t> next(phi.size(), kNever);
      for (int j = 0; j < n; ++j) {
        std::int64_t came = t == 0 ? entry(chain.start[j]) : kNever;
        for (int i = 0; t > 0 && i < n; ++i) {
          std::int64_t step = entry(chain.band(i, j));
          if (chain.leave.size() > 0)
            step = std::max(step, entry(chain.leave[i]) + entry(chain.land[j]));
          came = std::max(came, phi[static_cast<std::size_t>(i)] + step);
        }
        next[static_cast<std::size_t>(j)] = std::max(kNever, came + entry(emission(j, s[t])));
      }
      phi = next;
    }
    const std::int64_t top = *std::max_element(phi.begin(), phi.end());
    best[c] = top > kNever / 2 ? static_cast<double>(top) : -kInfinity;
  }
  return best;
}

TEST(FixedPointHmmSet, LosesNothingWhileAllFallsIntoItsRangeAndNeverFindsMore) {
  Random random(5);
  int num_exact = 0;
  int num_impossible = 0;
  for (const Topology& topology :
       {Topology{Kind::left_right, 4, 1}, Topology{Kind::left_right, 12, 1},
        Topology{Kind::left_right, 50, 1}, Topology{Kind::left_right, 4, 2},
        Topology{Kind::banded, 5, 1}, Topology{Kind::banded, 6, 2}, Topology{Kind::ergodic, 4, 1},
        Topology{Kind::rank_one_plus_band, 6, 1}, Topology{Kind::rank_one_plus_band, 7, 2}}) {
    for (const int num_classes : {1, 2, 3, 5, 20, 70}) {
      for (int repeat = 0; repeat < 5; ++repeat) {
        std::vector<DiscreteHmm> models;
        for (int c = 0; c < num_classes; ++c) models.push_back(extreme_model(topology, &random));
        const PossibilisticHmmSet set(models);
        const FixedPointHmmSet fixed(set);
        for (const std::size_t length : {1U, 2U, 3U, 6U, 11U}) {
          SymbolSequence s(length);
          for (auto& symbol : s) symbol = static_cast<std::int32_t>(random.below(kNumSymbols));
          const VectorD expected = best_sums(set, fixed.units(), s);
          const VectorF scores = fixed.log_possibilities(s);
          for (Eigen::Index c = 0; c < scores.size(); ++c) {
            const double found = std::round(static_cast<double>(scores[c]) * fixed.units());
            ASSERT_LE(found, expected[c]);
            num_impossible += expected[c] == -kInfinity ? 1 : 0;
            using detail::Bounds16;
            constexpr int kRange = Bounds16::kBest - Bounds16::kFloor - 2 * Bounds16::kLargestShift;
            if (!(expected[c] > -kRange)) continue;
            ASSERT_EQ(found, expected[c]);
            ++num_exact;
          }
        }
      }
    }
  }
  EXPECT_GT(num_exact, 5000);
  EXPECT_GT(num_impossible, 500);
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

TEST(FixedPointHmmSet, TakesNoPathThroughStatesThatOnlyFillUp) {
  // Twelve states in 32 lanes. Symbol 1 is impossible, also where the chain is at its end before
  // anything was shifted.
  const Topology topology{Kind::left_right, 12, 1};
  MatrixD emission = MatrixD::Zero(12, 2);
  emission.col(0).setOnes();
  const MarkovChain chain{topology, VectorD::Unit(12, 11), initial_transition(topology, 0.75)};
  const FixedPointHmmSet fixed(PossibilisticHmmSet({{chain, emission}}));
  EXPECT_TRUE(std::isfinite(fixed.log_possibilities(SymbolSequence{0, 0})[0]));
  EXPECT_EQ(fixed.log_possibilities(SymbolSequence{0, 1})[0],
            -std::numeric_limits<float>::infinity());
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
