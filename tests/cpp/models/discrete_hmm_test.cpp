// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What is particular to discrete HMMs; the rest is in sequence_model_test.cpp.
#include "hri/models/discrete_hmm.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace hri
