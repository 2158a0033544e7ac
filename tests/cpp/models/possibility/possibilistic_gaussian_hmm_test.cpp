// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/possibility/possibilistic_gaussian_hmm.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hri/core/error.hpp"
#include "models/possibilistic_testing.hpp"

namespace hri {
namespace {

using Kind = Topology::Kind;
using namespace testing_data;

constexpr int kDim = 2;

// Class c moves along a line of direction c, in steps.
MatrixF movement(int c, std::uint64_t seed) {
  MatrixF frames = noise(12, kDim, seed);
  const double angle = 1.2 * c;
  for (Eigen::Index t = 0; t < frames.rows(); ++t) {
    frames(t, 0) += static_cast<float>(0.5 * static_cast<double>(t) * std::cos(angle));
    frames(t, 1) += static_cast<float>(0.5 * static_cast<double>(t) * std::sin(angle));
  }
  return frames;
}

PossibilisticGaussianHmmSet train(int num_classes, const Topology& topology,
                                  const PossibilisticRule& rule = {}) {
  std::vector<std::vector<MatrixF>> per_class(static_cast<std::size_t>(num_classes));
  for (int c = 0; c < num_classes; ++c) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      per_class[static_cast<std::size_t>(c)].push_back(
          movement(c, 100 * static_cast<std::uint64_t>(c) + seed));
    }
  }
  GaussianMixtureHmmOptions options;
  options.topology = topology;
  options.max_iterations = 3;
  return PossibilisticGaussianHmmSet::train(per_class, options, rule);
}

// The recursion in double over dense matrices, from the models' own parameters.
std::vector<double> brute_force(const PossibilisticGaussianHmmSet& set, const MatrixF& frames) {
  const auto num_classes = static_cast<std::size_t>(set.num_classes());
  const Eigen::Index n = set.topology().num_states;
  std::vector<MatrixD> log_b(num_classes);
  double largest = 0;
  double largest_start = 0;
  for (std::size_t c = 0; c < num_classes; ++c) {
    set.models()[c].bank().log_densities(frames, &log_b[c], nullptr);
    largest = std::max(largest, set.models()[c].chain().transition().maxCoeff());
    largest_start = std::max(largest_start, set.models()[c].chain().start().maxCoeff());
  }
  const Conjunction conjunction = set.rule().conjunction;
  const auto join = [conjunction](double a, double b) {
    return conjunction == Conjunction::product ? a + b : std::min(a, b);
  };
  std::vector<double> scores;
  for (std::size_t c = 0; c < num_classes; ++c) {
    const MarkovChain& chain = set.models()[c].chain();
    VectorD phi = (chain.start() / largest_start).array().log();
    double scale = 0;
    for (Eigen::Index t = 0; t < frames.rows(); ++t) {
      double best = log_b[0].row(t).maxCoeff();
      for (const MatrixD& b : log_b) best = std::max(best, b.row(t).maxCoeff());
      VectorD b = log_b[c].row(t).transpose().array() - best;
      if (conjunction == Conjunction::min) {
        scale += b.maxCoeff();
        b.array() -= b.maxCoeff();
      }
      VectorD came = phi;
      for (Eigen::Index j = 0; t > 0 && j < n; ++j) {
        came[j] = -kInfinity;
        for (Eigen::Index i = 0; i < n; ++i)
          came[j] = std::max(came[j], join(phi[i], std::log(chain.transition()(i, j) / largest)));
      }
      for (Eigen::Index j = 0; j < n; ++j) {
        if (conjunction == Conjunction::min && b[j] < 0) came[j] *= set.rule().concentration;
        phi[j] = join(came[j], b[j]);
      }
      if (conjunction != Conjunction::min) continue;
      scale += phi.maxCoeff();
      phi.array() -= phi.maxCoeff();
    }
    scores.push_back(phi.maxCoeff() + scale);
  }
  return scores;
}

TEST(PossibilisticGaussianHmmSet, MatchesTheRecursionByBruteForce) {
  for (const Conjunction conjunction : {Conjunction::product, Conjunction::min}) {
    for (const Topology& topology :
         {Topology{Kind::left_right, 3, 1}, Topology{Kind::left_right, 12, 1},
          Topology{Kind::banded, 3, 1}, Topology{Kind::ergodic, 3, 1}}) {
      for (const int num_classes : {1, 5, 18}) {
        PossibilisticRule rule;
        rule.conjunction = conjunction;
        const auto set = train(num_classes, topology, rule);
        const MatrixF frames = movement(1, 999);
        const VectorF scores = set.log_possibilities(frames);
        const std::vector<double> expected = brute_force(set, frames);
        for (Eigen::Index c = 0; c < scores.size(); ++c) {
          const double e = expected[static_cast<std::size_t>(c)];
          ASSERT_NEAR(scores[c], e, 1e-4 * std::abs(e) + 1e-3);
          ASSERT_NEAR(set.viterbi(static_cast<int>(c), frames), e, 1e-9 * std::abs(e) + 1e-9);
        }
      }
    }
  }
}

TEST(PossibilisticGaussianHmmSet, TellsMovementsApart) {
  for (const Conjunction conjunction : {Conjunction::product, Conjunction::min}) {
    PossibilisticRule rule;
    rule.conjunction = conjunction;
    const auto set = train(5, {Kind::left_right, 3, 1}, rule);
    int right = 0;
    for (int c = 0; c < 5; ++c) {
      for (std::uint64_t seed = 7000; seed < 7020; ++seed) {
        const MatrixF frames = movement(c, seed + static_cast<std::uint64_t>(c));
        right += argmax(set.log_possibilities(frames)) == c ? 1 : 0;
      }
    }
    EXPECT_GT(right, 90);
    EXPECT_FLOAT_EQ(set.classify(movement(2, 1)).possibility.maxCoeff(), 1.0F);
  }
}

TEST(PossibilisticGaussianHmmSet, DecodesAsTheHmmDoesUnderProduct) {
  const auto set = train(3, {Kind::left_right, 4, 1});
  const MatrixF frames = movement(1, 77);
  for (int c = 0; c < 3; ++c) {
    std::vector<int> path;
    std::vector<int> of_hmm;
    set.viterbi(c, frames, &path);
    set.models()[static_cast<std::size_t>(c)].viterbi(frames, &of_hmm);
    EXPECT_EQ(path, of_hmm);
  }
  EXPECT_THROW(set.viterbi(3, frames), InvalidArgument);
  EXPECT_THROW(set.viterbi(0, MatrixF(0, kDim)), InvalidArgument);
}

TEST(PossibilisticGaussianHmmSet, ScalesANewClassInWithoutTrainingTheOthers) {
  const auto whole = train(4, {Kind::left_right, 3, 1});
  const PossibilisticGaussianHmmSet few({whole.models()[0], whole.models()[1], whole.models()[2]});
  const MatrixF frames = movement(3, 5);
  EXPECT_EQ(few.with_class(whole.models()[3]).log_possibilities(frames),
            whole.log_possibilities(frames));
}

TEST(PossibilisticGaussianHmmSet, ScoresTheSameAfterLoading) {
  const auto set = train(3, {Kind::rank_one_plus_band, 4, 1});
  ModelFile file;
  set.write(file, "g.");
  const auto loaded = PossibilisticGaussianHmmSet::read(through_bytes(file), "g.");
  const MatrixF frames = movement(2, 8);
  EXPECT_EQ(loaded.log_possibilities(frames), set.log_possibilities(frames));
  file.set_integer("g.num_classes", 4);
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "g.3.", message_of<FormatError>([&] {
                        return PossibilisticGaussianHmmSet::read(file, "g.");
                      }));
}

TEST(PossibilisticGaussianHmmSet, RefusesBadInputByName) {
  const auto set = train(2, {Kind::left_right, 3, 1});
  EXPECT_THROW(set.log_possibilities(MatrixF(0, kDim)), InvalidArgument);
  EXPECT_THROW(set.log_possibilities(MatrixF::Zero(3, kDim + 1)), InvalidArgument);
  MatrixF frames = movement(0, 1);
  frames(4, 1) = kNan;
  EXPECT_THROW(set.log_possibilities(frames), InvalidArgument);
  const auto other = train(1, {Kind::left_right, 4, 1});
  EXPECT_THROW(set.with_class(other.models().front()), InvalidArgument);
  EXPECT_THROW(PossibilisticGaussianHmmSet({}), InvalidArgument);
  PossibilisticRule rule;
  rule.concentration = 0.5;
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "concentration", message_of<InvalidArgument>([&] {
                        return PossibilisticGaussianHmmSet(set.models(), rule);
                      }));
}

}  // namespace
}  // namespace hri
