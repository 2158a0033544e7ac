// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Training by the best path against counting by hand: every path is tried, in plain probabilities.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "models/possibilistic_testing.hpp"

namespace hri {
namespace {

using Kind = Topology::Kind;
using testing_data::kNumSymbols;

std::vector<SymbolSequence> drawn(int count, int shortest, int longest, std::uint64_t seed) {
  Random random(seed);
  std::vector<SymbolSequence> sequences(static_cast<std::size_t>(count));
  for (SymbolSequence& s : sequences) {
    const auto length =
        shortest +
        static_cast<int>(random.below(static_cast<std::uint64_t>(longest - shortest + 1)));
    for (int t = 0; t < length; ++t) {
      // A drift from low symbols to high ones, so that left-right models have something to learn.
      const int near = t * (kNumSymbols - 1) / longest + static_cast<int>(random.below(3)) - 1;
      s.push_back(std::clamp(near, 0, kNumSymbols - 1));
    }
  }
  return sequences;
}

// Of all paths the most probable, and its probability.
double best_of_all_paths(const DiscreteHmm& model, const SymbolSequence& s,
                         std::vector<int>* path) {
  const auto n = static_cast<std::size_t>(model.num_states());
  std::size_t num_paths = 1;
  for (std::size_t t = 0; t < s.size(); ++t) num_paths *= n;
  double best = 0;
  std::vector<int> tried(s.size());
  for (std::size_t number = 0; number < num_paths; ++number) {
    std::size_t rest = number;
    for (int& state : tried) {
      state = static_cast<int>(rest % n);
      rest /= n;
    }
    double p = model.chain().start()[tried[0]];
    for (std::size_t t = 0; t < s.size(); ++t) {
      if (t > 0) p *= model.chain().transition()(tried[t - 1], tried[t]);
      p *= model.emission()(tried[t], s[t]);
    }
    if (p <= best) continue;
    best = p;
    *path = tried;
  }
  return best;
}

struct Counted {
  VectorD start;
  MatrixD transition, emission;
  double log_likelihood = 0;
};

// What one iteration makes of a model. Of a step within the band of a model with jumps, the share
// of the band counts there, the rest as a jump.
Counted counted(const std::vector<SymbolSequence>& sequences, const DiscreteHmm& model,
                double emission_floor) {
  const Topology& topology = model.chain().topology();
  const int n = model.num_states();
  const bool jumps = topology.kind == Kind::rank_one_plus_band;
  MatrixD emitted = MatrixD::Constant(n, model.num_symbols(), 1e-9);
  MatrixD band = MatrixD::Zero(n, n);
  VectorD leave = VectorD::Constant(n, jumps ? 1 : 0);
  VectorD land = leave;
  // Every transition was seen once before.
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const int step = j - i;
      const bool near = topology.kind == Kind::ergodic ||
                        (step <= topology.max_jump &&
                         step >= (topology.kind == Kind::left_right ? 0 : -topology.max_jump));
      if (near) band(i, j) = 1;
    }
  }
  Counted result{VectorD::Zero(n), {}, model.emission(), 0};
  std::vector<bool> visited(static_cast<std::size_t>(n), false);
  for (const SymbolSequence& s : sequences) {
    std::vector<int> path;
    result.log_likelihood += std::log(best_of_all_paths(model, s, &path));
    result.start[path[0]] += 1.0 / static_cast<double>(sequences.size());
    for (std::size_t t = 0; t < s.size(); ++t) {
      emitted(path[t], s[t]) += 1;
      visited[static_cast<std::size_t>(path[t])] = true;
      if (t == 0) continue;
      const int i = path[t - 1];
      const int j = path[t];
      const double share =
          jumps ? model.chain().band()(i, j) / model.chain().transition()(i, j) : 1;
      band(i, j) += share;
      leave[i] += 1 - share;
      land[j] += 1 - share;
    }
  }
  const VectorD left = band.rowwise().sum() + leave;
  result.transition = MatrixD(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      result.transition(i, j) = band(i, j) / left[i];
      if (jumps) result.transition(i, j) += leave[i] / left[i] * land[j] / land.sum();
    }
    // A state that was not visited emits what it did.
    VectorD shares = visited[static_cast<std::size_t>(i)]
                         ? VectorD(emitted.row(i).transpose() / emitted.row(i).sum())
                         : VectorD(model.emission().row(i).transpose());
    for (double& share : shares) share = std::max(share, emission_floor);
    result.emission.row(i) = shares.transpose() / shares.sum();
  }
  return result;
}

PossibilisticHmmOptions by_best_path(const Topology& topology, int max_iterations,
                                     double tolerance) {
  PossibilisticHmmOptions options;
  options.topology = topology;
  options.num_symbols = kNumSymbols;
  options.training = PossibilisticTraining::best_path;
  options.max_iterations = max_iterations;
  options.tolerance = tolerance;
  options.emission_floor = 0.01;
  options.seed = 3;
  return options;
}

const std::vector<Topology> kTopologies{{Kind::left_right, 3, 1},
                                        {Kind::left_right, 4, 2},
                                        {Kind::banded, 4, 1},
                                        {Kind::ergodic, 3, 1},
                                        {Kind::rank_one_plus_band, 4, 1}};

// One iteration of Baum-Welch from what every model starts from.
DiscreteHmm first_model(const std::vector<SymbolSequence>& sequences,
                        const PossibilisticHmmOptions& options) {
  DiscreteHmmOptions all_paths;
  all_paths.topology = options.topology;
  all_paths.num_symbols = options.num_symbols;
  all_paths.emission_floor = options.emission_floor;
  all_paths.seed = options.seed;
  all_paths.max_iterations = 1;
  return DiscreteHmm::train(sequences, all_paths);
}

TEST(BestPathTraining, CountsWhatTheBestOfAllPathsPasses) {
  for (const Topology& topology : kTopologies) {
    const auto sequences = drawn(6, 2, 6, 11);
    DiscreteHmm before = first_model(sequences, by_best_path(topology, 1, 0));
    std::vector<double> log_likelihoods;
    for (int iterations = 1; iterations <= 4; ++iterations) {
      std::vector<TrainingReport> reports;
      const auto set =
          PossibilisticHmmSet::train({sequences}, by_best_path(topology, iterations, 0), &reports);
      const DiscreteHmm& found = set.models()[0];
      const Counted expected = counted(sequences, before, 0.01);
      log_likelihoods.push_back(expected.log_likelihood);
      EXPECT_LT((found.chain().start() - expected.start).cwiseAbs().maxCoeff(), 1e-9);
      EXPECT_LT((found.chain().transition() - expected.transition).cwiseAbs().maxCoeff(), 1e-9)
          << static_cast<int>(topology.kind) << " after " << iterations;
      EXPECT_LT((found.emission() - expected.emission).cwiseAbs().maxCoeff(), 1e-9)
          << static_cast<int>(topology.kind) << " after " << iterations;
      ASSERT_EQ(reports[0].log_likelihoods.size(), static_cast<std::size_t>(iterations));
      for (std::size_t i = 0; i < log_likelihoods.size(); ++i)
        EXPECT_NEAR(reports[0].log_likelihoods[i], log_likelihoods[i], 1e-9);
      EXPECT_FALSE(reports[0].converged);
      before = found;
    }
  }
}

// States that no path reaches, and states that one frame reaches.
TEST(BestPathTraining, KeepsTheEmissionsOfStatesThatNoPathReaches) {
  const Topology topology{Kind::left_right, 4, 1};
  const std::vector<SymbolSequence> sequences{{0, 1}, {0, 3}, {2}};
  const auto options = by_best_path(topology, 1, 0);
  const DiscreteHmm before = first_model(sequences, options);
  const DiscreteHmm found = PossibilisticHmmSet::train({sequences}, options).models()[0];
  const Counted expected = counted(sequences, before, 0.01);
  EXPECT_LT((found.emission() - expected.emission).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((found.chain().transition() - expected.transition).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_DOUBLE_EQ(found.chain().transition()(2, 2), 0.5);
  EXPECT_DOUBLE_EQ(found.chain().transition()(3, 3), 1);
}

// It stops after the first iteration in which no parameter moves by the tolerance.
TEST(BestPathTraining, StopsWhenNoParameterMoves) {
  for (const Topology& topology : kTopologies) {
    for (const std::uint64_t seed : {11U, 12U, 13U}) {
      const auto sequences = drawn(6, 2, 5, seed);
      for (const double tolerance : {0.2, 0.05, 1e-6}) {
        std::vector<TrainingReport> reports;
        const auto options = by_best_path(topology, 30, tolerance);
        const auto set = PossibilisticHmmSet::train({sequences}, options, &reports);
        DiscreteHmm model = first_model(sequences, options);
        std::size_t iterations = 0;
        double moved = 1;
        while (iterations < 30 && !(moved < tolerance)) {
          const DiscreteHmm next =
              PossibilisticHmmSet::train({sequences},
                                         by_best_path(topology, static_cast<int>(++iterations), 0))
                  .models()[0];
          const auto& a = next.chain();
          const auto& b = model.chain();
          moved = std::max({(a.start() - b.start()).cwiseAbs().maxCoeff(),
                            (a.transition() - b.transition()).cwiseAbs().maxCoeff(),
                            (next.emission() - model.emission()).cwiseAbs().maxCoeff()});
          model = next;
        }
        EXPECT_EQ(reports[0].log_likelihoods.size(), iterations);
        EXPECT_EQ(reports[0].converged, moved < tolerance);
        EXPECT_EQ(set.models()[0].emission(), model.emission());
      }
    }
  }
}

// The path that viterbi() gives is worth the score that it gives.
TEST(BestPathTraining, GivesPathsThatAreWorthTheirScore) {
  for (const Topology& topology : kTopologies) {
    for (const Conjunction conjunction : {Conjunction::product, Conjunction::min}) {
      PossibilisticRule rule;
      rule.conjunction = conjunction;
      rule.conditioned = false;
      const PossibilisticHmmSet set(testing_data::random_models(3, topology), rule);
      for (std::uint64_t seed = 1; seed < 6; ++seed) {
        SymbolSequence s = testing_data::word(1, seed);
        s.resize(7);
        std::vector<int> path;
        const double score = set.viterbi(2, s, &path);
        ASSERT_EQ(path.size(), s.size());
        const auto join = [&](double a, double b) {
          return conjunction == Conjunction::product ? a * b : std::min(a, b);
        };
        double worth = set.start(2)[path[0]];
        for (std::size_t t = 0; t < s.size(); ++t) {
          if (t > 0) worth = join(worth, set.transition(2)(path[t - 1], path[t]));
          worth = join(worth, set.emission(2)(path[t], s[t]));
        }
        EXPECT_NEAR(std::log(worth), score, 1e-12 * std::abs(score));
      }
    }
  }
}

}  // namespace
}  // namespace hri
