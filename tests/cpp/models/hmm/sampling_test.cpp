// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/hmm/sampling.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "hri/core/error.hpp"

namespace hri {
namespace {

DiscreteHmm two_states() {
  Topology topology;
  topology.kind = Topology::Kind::ergodic;
  topology.num_states = 2;
  VectorD start(2);
  start << 0.25, 0.75;
  MatrixD transition(2, 2);
  transition << 0.9, 0.1, 0.3, 0.7;
  MatrixD emission(2, 3);
  emission << 1, 0, 0, 0, 0.5, 0.5;
  return {MarkovChain(topology, start, transition), emission};
}

TEST(Sample, FollowsStartTransitionsAndEmissions) {
  const int count = 20000;
  const SampledSymbols drawn = sample(two_states(), count, 3);
  int stays = 0;
  int in_first = 0;
  for (std::size_t t = 0; t < drawn.states.size(); ++t) {
    EXPECT_EQ(drawn.states[t] == 0, drawn.symbols[t] == 0);
    if (t + 1 == drawn.states.size() || drawn.states[t] != 0) continue;
    ++in_first;
    stays += drawn.states[t + 1] == 0 ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(in_first) / count, 0.75, 0.02);  // the stationary distribution
  EXPECT_NEAR(static_cast<double>(stays) / in_first, 0.9, 0.01);
  int started_in_first = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed)
    started_in_first += sample(two_states(), 1, seed).states[0] == 0 ? 1 : 0;
  EXPECT_NEAR(started_in_first / 4000.0, 0.25, 0.03);
}

TEST(Sample, IsTheSameForTheSameSeed) {
  const SampledSymbols a = sample(two_states(), 50, 1);
  EXPECT_EQ(a.symbols, sample(two_states(), 50, 1).symbols);
  EXPECT_NE(a.symbols, sample(two_states(), 50, 2).symbols);
  EXPECT_TRUE(sample(two_states(), 0, 1).symbols.empty());
  EXPECT_THROW(sample(two_states(), -1, 1), InvalidArgument);
}

TEST(Sample, OfFramesHasTheMomentsOfTheMixture) {
  MatrixD weights(2, 2);
  weights << 0.5, 0.5, 1, 0;
  MatrixD means(4, 1);
  means << -2, 2, 10, 99;
  const MatrixD variances = MatrixD::Constant(4, 1, 0.25);
  const GaussianMixtureHmm model(two_states().chain(), MixtureBank(weights, means, variances));
  const SampledFrames drawn = sample(model, 20000, 5);
  double sum = 0;
  double squares = 0;
  int count = 0;
  for (Eigen::Index t = 0; t < drawn.frames.rows(); ++t) {
    const double x = drawn.frames(t, 0);
    if (drawn.states[static_cast<std::size_t>(t)] != 0) {
      EXPECT_NEAR(x, 10, 4);  // eight deviations
      continue;
    }
    sum += x;
    squares += x * x;
    ++count;
  }
  EXPECT_NEAR(sum / count, 0, 0.06);
  EXPECT_NEAR(squares / count, 4.25, 0.06);
}

}  // namespace
}  // namespace hri
