// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Forward and backward possibilities of states, against all paths.
#include "hri/models/possibility/state_possibilities.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hri/core/error.hpp"
#include "hri/models/possibility/possibilistic_gaussian_hmm.hpp"
#include "models/possibilistic_testing.hpp"
#include "models/sequence_model_cases.hpp"

namespace hri {
namespace {

using namespace testing_data;

PossibilisticRule rule_of(Conjunction conjunction, bool conditioned = false,
                          double concentration = 1) {
  return {conjunction, conditioned, concentration};
}

std::vector<DiscreteHmm> classes_of(const Topology& topology, std::uint64_t count) {
  std::vector<DiscreteHmm> models;
  for (std::uint64_t c = 0; c < count; ++c) models.push_back(DiscreteCase::make(topology, c));
  return models;
}

// One class in plain possibilities.
struct PlainClass {
  VectorD start;
  MatrixD transition;
  MatrixD b;  // emissions, a row a frame
  Conjunction conjunction;

  PlainClass(const PossibilisticHmmSet& set, int c, const SymbolSequence& s)
      : start(set.start(c)),
        transition(set.transition(c)),
        b(static_cast<Eigen::Index>(s.size()), set.num_states()),
        conjunction(set.rule().conjunction) {
    for (std::size_t t = 0; t < s.size(); ++t)
      b.row(static_cast<Eigen::Index>(t)) = set.emission(c).col(s[t]).transpose();
  }
  double join(double x, double y) const {
    return conjunction == Conjunction::product ? x * y : std::min(x, y);
  }
};

// The best over all paths, by frame and state: of the paths up to it, of those from it on, and of
// whole paths through it.
struct BestPaths {
  MatrixD before;
  MatrixD after;
  MatrixD through;
};

BestPaths best_paths(const PlainClass& c) {
  const Eigen::Index n = c.b.cols();
  const Eigen::Index num_frames = c.b.rows();
  BestPaths best{MatrixD::Zero(num_frames, n), MatrixD::Zero(num_frames, n),
                 MatrixD::Zero(num_frames, n)};
  const auto num_paths = std::lround(std::pow(n, num_frames));
  std::vector<Eigen::Index> path(static_cast<std::size_t>(num_frames));
  const auto raise = [](double* to, double value) { *to = std::max(*to, value); };
  for (long code = 0; code < num_paths; ++code) {
    long rest = code;
    for (Eigen::Index& state : path) {
      state = rest % n;
      rest /= n;
    }
    const auto state = [&path](Eigen::Index t) { return path[static_cast<std::size_t>(t)]; };
    const auto stretch = [&](Eigen::Index first, Eigen::Index end, double value) {
      for (Eigen::Index t = first; t < end; ++t) {
        const double came = t == 0 ? c.start[state(0)] : c.transition(state(t - 1), state(t));
        value = c.join(value, c.join(came, c.b(t, state(t))));
      }
      return value;
    };
    for (Eigen::Index t = 0; t < num_frames; ++t) {
      raise(&best.before(t, state(t)), stretch(0, t + 1, 1));
      raise(&best.after(t, state(t)), stretch(t + 1, num_frames, 1));
      raise(&best.through(t, state(t)), stretch(0, num_frames, 1));
    }
  }
  return best;
}

// Relative; Eigen's exp of -inf is not quite 0.
bool close(const MatrixD& found, const MatrixD& expected) {
  return ((found.array() - expected.array()).abs() <= 1e-12 * expected.array() + 1e-300).all();
}

TEST(StatePossibilities, AreThoseOfTheBestOfAllPaths) {
  for (const Conjunction conjunction : {Conjunction::product, Conjunction::min}) {
    for (const Topology& topology : kTopologies) {
      if (topology.num_states > 4) continue;
      for (const std::uint64_t num_classes : {1U, 3U}) {
        const PossibilisticHmmSet set(classes_of(topology, num_classes), rule_of(conjunction));
        for (const int length : {1, 2, 5}) {
          const SymbolSequence s = DiscreteCase::sequence(length, 7);
          const int c = set.num_classes() - 1;
          const BestPaths expected = best_paths({set, c, s});
          const StatePossibilities found = set.state_possibilities(c, s);
          ASSERT_TRUE(close(found.log_forward.array().exp(), expected.before));
          ASSERT_TRUE(close(found.log_backward.array().exp(), expected.after));
          const double whole = expected.through.maxCoeff();
          EXPECT_NEAR(found.log_possibility, std::log(whole), 1e-12);
          ASSERT_TRUE(close(found.possibility, expected.through / whole));
        }
      }
    }
  }
}

// Eq. 4.17 is the first frame.
TEST(StatePossibilities, MeetAtThePossibilityOfTheWholeInEveryFrame) {
  for (const Conjunction conjunction : {Conjunction::product, Conjunction::min}) {
    for (const Topology& topology : kTopologies) {
      const PossibilisticHmmSet set(classes_of(topology, 4), rule_of(conjunction));
      const SymbolSequence s = DiscreteCase::sequence(1000, 8);
      for (int c = 0; c < set.num_classes(); ++c) {
        std::vector<int> path;
        const double score = set.viterbi(c, s, &path);
        const StatePossibilities found = set.state_possibilities(c, s);
        const double tolerance = 1e-12 * std::abs(score);
        EXPECT_NEAR(found.log_possibility, score, tolerance);
        const MatrixD met = conjunction == Conjunction::product
                                ? MatrixD(found.log_forward + found.log_backward)
                                : found.log_forward.cwiseMin(found.log_backward);
        EXPECT_LT((met.rowwise().maxCoeff().array() - score).abs().maxCoeff(), tolerance);
        EXPECT_EQ(found.possibility.rowwise().maxCoeff(), VectorD::Ones(1000));
        for (std::size_t t = 0; t < path.size(); ++t)
          ASSERT_NEAR(found.possibility(static_cast<Eigen::Index>(t), path[t]), 1, 1e-9);
      }
    }
  }
}

TEST(StatePossibilities, LeaveNecessaryWhatNoOtherStateCanBe) {
  const PossibilisticHmmSet set(classes_of({Kind::left_right, 3, 1}, 3));
  const SymbolSequence s = DiscreteCase::sequence(30, 9);
  const StatePossibilities found = set.state_possibilities(1, s);
  for (Eigen::Index t = 0; t < 30; ++t) {
    for (Eigen::Index i = 0; i < 3; ++i) {
      double other = 0;
      for (Eigen::Index j = 0; j < 3; ++j) {
        if (j != i) other = std::max(other, found.possibility(t, j));
      }
      EXPECT_NEAR(found.necessity(t, i), 1 - other, 1e-15);
    }
  }
  // A left-right model begins in its first state.
  EXPECT_EQ(found.necessity(0, 0), 1);
  EXPECT_EQ(found.possibility(0, 1), 0);
  const PossibilisticHmmSet one_state(classes_of({Kind::ergodic, 1, 1}, 2));
  EXPECT_EQ(one_state.state_possibilities(0, s).necessity, MatrixD::Ones(30, 1));
}

// Every frame of a conditioned minimum divides by the best, whichever path it is on.
MatrixD best_through_conditioned(PlainClass c) {
  const Eigen::Index n = c.b.cols();
  const Eigen::Index num_frames = c.b.rows();
  c.b.array().colwise() /= c.b.rowwise().maxCoeff().array();
  VectorD taken(num_frames);
  VectorD phi;
  for (Eigen::Index t = 0; t < num_frames; ++t) {
    VectorD came = c.start;
    for (Eigen::Index j = 0; t > 0 && j < n; ++j)
      came[j] = phi.cwiseMin(c.transition.col(j)).maxCoeff();
    phi = came.cwiseMin(c.b.row(t).transpose());
    taken[t] = phi.maxCoeff();
    phi /= taken[t];
  }
  MatrixD through = MatrixD::Zero(num_frames, n);
  const auto num_paths = std::lround(std::pow(n, num_frames));
  std::vector<Eigen::Index> path(static_cast<std::size_t>(num_frames));
  for (long code = 0; code < num_paths; ++code) {
    long rest = code;
    for (Eigen::Index& state : path) {
      state = rest % n;
      rest /= n;
    }
    double value = 1;
    for (Eigen::Index t = 0; t < num_frames; ++t) {
      const Eigen::Index j = path[static_cast<std::size_t>(t)];
      value = t == 0 ? c.start[j]
                     : std::min(value, c.transition(path[static_cast<std::size_t>(t) - 1], j));
      value = std::min(value, c.b(t, j)) / taken[t];
    }
    for (Eigen::Index t = 0; t < num_frames; ++t) {
      double& best = through(t, path[static_cast<std::size_t>(t)]);
      best = std::max(best, value);
    }
  }
  return through;
}

TEST(StatePossibilities, FollowAConditionedMinimum) {
  for (const Topology& topology : kTopologies) {
    if (topology.num_states > 4) continue;
    const PossibilisticHmmSet set(classes_of(topology, 3), rule_of(Conjunction::min, true));
    for (const int length : {1, 2, 6}) {
      const SymbolSequence s = DiscreteCase::sequence(length, 10);
      const StatePossibilities found = set.state_possibilities(1, s);
      EXPECT_TRUE(close(found.possibility, best_through_conditioned({set, 1, s})));
      EXPECT_EQ(found.log_possibility, set.viterbi(1, s));
      EXPECT_EQ(found.log_forward.rowwise().maxCoeff(), VectorD::Zero(length));
    }
  }
  const PossibilisticHmmSet raised(classes_of({Kind::left_right, 3, 1}, 2),
                                   rule_of(Conjunction::min, true, 1.5));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "concentration", message_of<InvalidArgument>([&] {
                        return raised.state_possibilities(0, SymbolSequence{0, 1});
                      }));
}

// The thesis to the letter: every state is fully possible in every frame, whatever was seen.
TEST(StatePossibilities, SayNothingUnderTheLiteralMax) {
  const PossibilisticHmmSet set(classes_of({Kind::ergodic, 3, 1}, 3), rule_of(Conjunction::max));
  for (const std::uint64_t seed : {1U, 2U}) {
    const StatePossibilities found = set.state_possibilities(2, DiscreteCase::sequence(20, seed));
    EXPECT_EQ(found.log_backward, MatrixD::Zero(20, 3));
    EXPECT_EQ(found.possibility, MatrixD::Ones(20, 3));
    EXPECT_EQ(found.necessity, MatrixD::Zero(20, 3));
  }
}

TEST(StatePossibilities, KnowNothingOfTheImpossible) {
  MatrixD emission(2, 3);
  emission << 1, 0, 0, 0, 1, 0;  // no class ever shows symbol 2
  const DiscreteHmm model(MarkovChain::initial({Kind::left_right, 2, 1}), emission);
  for (const Conjunction conjunction : {Conjunction::product, Conjunction::min}) {
    for (const bool conditioned : {false, true}) {
      const PossibilisticHmmSet set({model, model}, rule_of(conjunction, conditioned));
      for (const SymbolSequence& s : {SymbolSequence{0, 1, 0}, SymbolSequence{0, 2, 1}}) {
        const StatePossibilities found = set.state_possibilities(0, s);
        EXPECT_EQ(found.log_possibility, -kInfinity);
        EXPECT_EQ(found.possibility, MatrixD::Ones(3, 2));
        EXPECT_EQ(found.necessity, MatrixD::Zero(3, 2));
        EXPECT_FALSE(found.log_forward.array().isNaN().any());
        EXPECT_FALSE(found.log_backward.array().isNaN().any());
      }
    }
  }
}

TEST(StatePossibilities, RefuseWhatDecodingRefuses) {
  const PossibilisticHmmSet set(classes_of({Kind::left_right, 3, 1}, 2));
  const SymbolSequence s{0, 1, 2};
  for (const int c : {-1, 2}) {
    EXPECT_THROW(static_cast<void>(set.state_possibilities(c, s)), InvalidArgument);
  }
  EXPECT_THROW(static_cast<void>(set.state_possibilities(0, SymbolSequence())), InvalidArgument);
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "position 1", message_of<InvalidArgument>([&] {
                        return set.state_possibilities(0, SymbolSequence{0, 4});
                      }));
}

// Frames: the densities of the models over the largest of all classes and states.
TEST(StatePossibilities, OfFramesAreThoseOfTheirDensities) {
  for (const Conjunction conjunction : {Conjunction::product, Conjunction::min}) {
    for (const Topology& topology :
         {Topology{Kind::left_right, 3, 1}, Topology{Kind::rank_one_plus_band, 4, 1}}) {
      std::vector<GaussianMixtureHmm> models;
      std::vector<DiscreteHmm> chains;  // for the possibilities of starts and transitions
      for (std::uint64_t c = 0; c < 3; ++c) {
        models.push_back(GaussianCase::make(topology, c));
        chains.emplace_back(models.back().chain(), MatrixD::Constant(topology.num_states, 2, 0.5));
      }
      const PossibilisticGaussianHmmSet set(models, rule_of(conjunction));
      const MatrixF frames = GaussianCase::sequence(5, 11);
      PlainClass plain(PossibilisticHmmSet(chains, rule_of(conjunction)), 1, {0, 0, 0, 0, 0});
      VectorD largest = VectorD::Zero(5);
      for (const GaussianMixtureHmm& m : models)
        largest = largest.cwiseMax(GaussianCase::densities(m, frames).rowwise().maxCoeff());
      plain.b = GaussianCase::densities(models[1], frames);
      plain.b.array().colwise() /= largest.array();
      const BestPaths expected = best_paths(plain);
      const StatePossibilities found = set.state_possibilities(1, frames);
      const double whole = expected.through.maxCoeff();
      EXPECT_NEAR(found.log_possibility, set.viterbi(1, frames), 1e-12);
      EXPECT_LT((found.possibility - expected.through / whole).cwiseAbs().maxCoeff(), 1e-11);
      EXPECT_LT((found.log_backward.array().exp() - expected.after.array()).abs().maxCoeff(),
                1e-11);
    }
  }
}

TEST(StatePossibilities, RefuseFramesThatDecodingRefuses) {
  const PossibilisticGaussianHmmSet set({GaussianCase::make({Kind::left_right, 3, 1}, 1)});
  MatrixF frames = GaussianCase::sequence(4, 2);
  EXPECT_THROW(static_cast<void>(set.state_possibilities(1, frames)), InvalidArgument);
  EXPECT_THROW(static_cast<void>(set.state_possibilities(0, frames.leftCols(1))), InvalidArgument);
  EXPECT_THROW(set.viterbi(0, frames.leftCols(1)), InvalidArgument);
  EXPECT_THROW(static_cast<void>(set.state_possibilities(0, frames.topRows(0))), InvalidArgument);
  frames(2, 1) = std::nanf("");
  EXPECT_THROW(static_cast<void>(set.state_possibilities(0, frames)), InvalidArgument);
}

}  // namespace
}  // namespace hri
