// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What is particular to discrete HMMs; the rest is in sequence_model_test.cpp.
#include "hri/models/hmm/discrete_hmm.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hri/core/error.hpp"
#include "models/model_testing.hpp"

namespace hri {
namespace {

using Kind = Topology::Kind;
using namespace testing_data;

DiscreteHmmOptions with_states(int num_states, int num_symbols) {
  DiscreteHmmOptions options;
  options.topology = {Kind::left_right, num_states, 1};
  options.num_symbols = num_symbols;
  return options;
}

TEST(DiscreteHmm, LearnsWhichSymbolBelongsToWhichState) {
  const std::vector<SymbolSequence> sequences{
      {0, 0, 0, 1, 1, 2, 2}, {0, 0, 1, 1, 1, 2, 2, 2}, {0, 1, 2}};
  const DiscreteHmm model = DiscreteHmm::train(sequences, with_states(3, 3));
  for (int j = 0; j < 3; ++j) EXPECT_GT(model.emission()(j, j), 0.99);
  std::vector<int> path;
  model.viterbi(sequences[0], &path);
  EXPECT_EQ(path, (std::vector<int>{0, 0, 0, 1, 1, 2, 2}));
}

TEST(DiscreteHmm, KeepsAFloorForSymbolsItNeverSaw) {
  const DiscreteHmm model = DiscreteHmm::train({{0, 1, 0, 1}}, with_states(2, 10));
  EXPECT_TRUE(std::isfinite(model.log_likelihood(SymbolSequence{9, 9, 9})));
  EXPECT_GT(model.emission().minCoeff(), 0.5e-4);
}

TEST(DiscreteHmm, SaysMinusInfinityForTheImpossible) {
  MatrixD emission(2, 2);
  emission << 1, 0, 0, 1;
  const Topology topology{Kind::left_right, 2, 1};
  const DiscreteHmm model(MarkovChain::initial(topology), emission);
  EXPECT_EQ(model.log_likelihood(SymbolSequence{1, 0}), -kInfinity);
  std::vector<int> path{7};
  EXPECT_EQ(model.viterbi(SymbolSequence{1, 0}, &path), -kInfinity);
  EXPECT_TRUE(path.empty());
}

TEST(DiscreteHmm, RefusesSymbolsByPlace) {
  const auto refused = [](const auto& action) { return message_of<InvalidArgument>(action); };
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "sequence 1: symbol 3 at position 2", refused([] {
                        return DiscreteHmm::train({{0, 1}, {0, 1, 3}}, with_states(2, 3));
                      }));
  const DiscreteHmm model = DiscreteHmm::train({{0, 1, 2}}, with_states(2, 3));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "symbol -1 at position 1", refused([&] {
                        return model.log_likelihood(SymbolSequence{0, -1});
                      }));
}

TEST(DiscreteHmm, RefusesOptionsOutOfRangeByName) {
  const auto refused = [](const DiscreteHmmOptions& o) {
    return message_of<InvalidArgument>([&] { return DiscreteHmm::train({{0, 1}}, o); });
  };
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "num_symbols", refused(with_states(2, 0)));
  DiscreteHmmOptions options = with_states(2, 4);
  options.emission_floor = 0.3;
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "emission_floor", refused(options));
  options = with_states(2, 4);
  options.tolerance = -1;
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "tolerance", refused(options));
}

TEST(DiscreteHmm, RefusesEmissionsThatAreNoDistribution) {
  const Topology topology{Kind::left_right, 2, 1};
  const VectorD start = initial_start(topology);
  const MatrixD transition = initial_transition(topology);
  EXPECT_THROW(DiscreteHmm(MarkovChain(topology, start, transition), MatrixD::Ones(2, 3)),
               InvalidArgument);
  EXPECT_THROW(DiscreteHmm(MarkovChain(topology, start, transition), MatrixD::Ones(3, 1)),
               InvalidArgument);
}

// A left-right word whose states soon have next to no share, and symbols of every likelihood.
DiscreteHmm sharp(const Topology& topology, double floor, double unseen = 0) {
  const int n = topology.num_states;
  MatrixD emission = MatrixD::Constant(n, n + 1, floor);
  for (int j = 0; j < n; ++j) {
    emission(j, n) = unseen;
    emission(j, j) = 0;
    emission(j, j) = 1 - emission.row(j).sum();
  }
  return {MarkovChain::initial(topology), emission};
}

SymbolSequence stairs(int num_states, int length) {
  SymbolSequence s;
  for (int t = 0; t < length; ++t) s.push_back(t * num_states / length);
  return s;
}

const std::vector<Topology> kStructures{
    {Kind::left_right, 6, 1}, {Kind::left_right, 30, 2},        {Kind::banded, 20, 1},
    {Kind::ergodic, 13, 1},   {Kind::rank_one_plus_band, 9, 1},
};

TEST(DiscreteHmm, LosesNothingToUnderflow) {
  for (const Topology& topology : kStructures) {
    // 1e-30: within hundreds of frames beyond double, within thousands beyond long double. 1e-60 is
    // below what double begins with.
    for (const double floor : {0.0, 1e-4, 1e-15, 1e-30, 1e-60, 1e-300}) {
      const DiscreteHmm model = sharp(topology, floor);
      for (const int length : {2, 50, 400, 3000}) {
        SymbolSequence s = stairs(topology.num_states, length);
        for (int turn = 0; turn < 2; ++turn) {
          const double exact = model.log_likelihood_exact(s);
          if (exact == -kInfinity) {
            EXPECT_EQ(model.log_likelihood(s), exact);
          } else {
            EXPECT_NEAR(model.log_likelihood(s), exact, 1e-9 * std::abs(exact));
          }
          std::reverse(s.begin(), s.end());  // the worst there is for a left-right model
        }
      }
    }
  }
}

TEST(DiscreteHmm, FindsPosteriorsInLogsAsByScaling) {
  for (const Topology& topology : kStructures) {
    const DiscreteHmm model = sharp(topology, 1e-4);
    // A symbol that never comes, but is too unlikely for scaled probabilities.
    const DiscreteHmm in_logs = sharp(topology, 1e-4, 1e-200);
    for (const int length : {2, 30, 500}) {
      SymbolSequence s = stairs(topology.num_states, length);
      for (int turn = 0; turn < 2; ++turn) {
        const MatrixD expected = in_logs.posterior(s);
        EXPECT_LT((model.posterior(s) - expected).cwiseAbs().maxCoeff(), 1e-9);
        EXPECT_LT((expected.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-9);
        DiscreteHmmOptions options;
        options.emission_floor = 0;
        options.max_iterations = 1;
        const MarkovChain a = model.retrain({s}, options).chain();
        const MarkovChain b = in_logs.retrain({s}, options).chain();
        EXPECT_LT((a.transition() - b.transition()).cwiseAbs().maxCoeff(), 1e-9);
        std::reverse(s.begin(), s.end());
      }
    }
  }
}

TEST(DiscreteHmm, GivesEverySymbolItsFloorAndTheRestItsShare) {
  DiscreteHmmOptions options = with_states(2, 10);
  options.emission_floor = 0.01;
  TrainingReport report;
  options.tolerance = 0;
  const DiscreteHmm model = DiscreteHmm::train({{0, 1, 0, 1, 2, 3, 3}}, options, &report);
  EXPECT_DOUBLE_EQ(model.emission().minCoeff(), 0.01);
  EXPECT_LT((model.emission().rowwise().sum().array() - 1).abs().maxCoeff(), 1e-12);
  // The floor is part of what is maximised, so that the likelihood still never falls.
  for (std::size_t i = 1; i < report.log_likelihoods.size(); ++i)
    EXPECT_GE(report.log_likelihoods[i], report.log_likelihoods[i - 1] - 1e-9);
}

TEST(DiscreteHmm, CountsImaginedSymbols) {
  DiscreteHmmOptions options = with_states(1, 3);
  options.emission_floor = 0;
  options.emission_prior = 2;
  options.max_iterations = 1;
  const DiscreteHmm model = DiscreteHmm::train({{0, 0, 0, 1}}, options);
  EXPECT_NEAR(model.emission()(0, 0), 5.0 / 10, 1e-12);
  EXPECT_NEAR(model.emission()(0, 1), 3.0 / 10, 1e-12);
  EXPECT_NEAR(model.emission()(0, 2), 2.0 / 10, 1e-12);
  options.emission_prior = std::numeric_limits<double>::quiet_NaN();
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "emission_prior", message_of<InvalidArgument>([&] {
                        return DiscreteHmm::train({{0, 1}}, options);
                      }));
}

TEST(DiscreteHmm, HasNoPosteriorsOfTheImpossible) {
  MatrixD emission(2, 2);
  emission << 1, 0, 0, 1;
  const DiscreteHmm model(MarkovChain::initial({Kind::left_right, 2, 1}), emission);
  const SymbolSequence impossible{1, 0};
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "impossible",
                      message_of<InvalidArgument>([&] { return model.posterior(impossible); }));
  // Training passes over what it cannot explain.
  DiscreteHmmOptions options;
  options.emission_floor = 0;
  TrainingReport report;
  const DiscreteHmm next = model.retrain({impossible, {0, 0, 1}}, options, &report);
  EXPECT_EQ(report.log_likelihoods.front(), -kInfinity);
  EXPECT_EQ(next.emission(), emission);
  EXPECT_NEAR(next.chain().transition()(0, 0), 0.5, 1e-12);
}

}  // namespace
}  // namespace hri
