// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What every sequence model must do, checked against all paths of short sequences.
#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "hri/core/error.hpp"
#include "hri/models/discrete_hmm.hpp"
#include "hri/models/gaussian_mixture_hmm.hpp"
#include "models/model_testing.hpp"

namespace hri {
namespace {

using Kind = Topology::Kind;
using namespace testing_data;

// Adds up, or takes the largest of, the probabilities of all paths.
struct AllPaths {
  double sum = 0;
  double best = 0;
  std::vector<int> best_path;
};

AllPaths all_paths(const VectorD& start, const MatrixD& transition, const MatrixD& b) {
  AllPaths result;
  const auto n = static_cast<int>(start.size());
  const auto num_frames = static_cast<int>(b.rows());
  const int num_paths = static_cast<int>(std::lround(std::pow(n, num_frames)));
  for (int code = 0; code < num_paths; ++code) {
    std::vector<int> path;
    for (int t = 0, rest = code; t < num_frames; ++t, rest /= n) path.push_back(rest % n);
    double p = start[path[0]] * b(0, path[0]);
    for (int t = 1; t < num_frames; ++t) {
      p *= transition(path[static_cast<std::size_t>(t) - 1], path[static_cast<std::size_t>(t)]) *
           b(t, path[static_cast<std::size_t>(t)]);
    }
    result.sum += p;
    if (p > result.best) {
      result.best = p;
      result.best_path = path;
    }
  }
  return result;
}

const std::vector<Topology> kTopologies{{Kind::left_right, 3, 1}, {Kind::left_right, 3, 2},
                                        {Kind::banded, 3, 1},     {Kind::ergodic, 3, 1},
                                        {Kind::ergodic, 1, 1},    {Kind::rank_one_plus_band, 4, 1}};

// Random rows that sum to 1, with the topology's zeros, and jumps where it has them.
MatrixD random_band(const Topology& topology, Random* random) {
  MatrixD a = MatrixD::Zero(topology.num_states, topology.num_states);
  for (int i = 0; i < topology.num_states; ++i) {
    for (int j = topology.first_next(i); j < topology.end_next(i); ++j)
      a(i, j) = 0.1 + random->uniform();
    a.row(i) /= a.row(i).sum();
  }
  return a;
}

MarkovChain random_chain(const Topology& topology, Random* random) {
  MatrixD band = random_band(topology, random);
  if (topology.kind != Kind::rank_one_plus_band) return {topology, initial_start(topology), band};
  VectorD leave(topology.num_states);
  VectorD land(topology.num_states);
  for (int i = 0; i < topology.num_states; ++i) {
    leave[i] = 0.1 + 0.5 * random->uniform();
    land[i] = 0.1 + random->uniform();
    band.row(i) *= 1 - leave[i];
  }
  return {topology, initial_start(topology), band, leave, land / land.sum()};
}

struct DiscreteCase {
  using Model = DiscreteHmm;
  using Sequence = SymbolSequence;

  static Model make(const Topology& topology, std::uint64_t seed) {
    Random random(seed);
    MatrixD emission(topology.num_states, 4);
    for (Eigen::Index i = 0; i < emission.size(); ++i) emission.data()[i] = 0.1 + random.uniform();
    for (Eigen::Index j = 0; j < emission.rows(); ++j) emission.row(j) /= emission.row(j).sum();
    return {random_chain(topology, &random), emission};
  }
  static Sequence sequence(int num_frames, std::uint64_t seed) {
    Random random(seed);
    Sequence s;
    for (int t = 0; t < num_frames; ++t) s.push_back(static_cast<std::int32_t>(random.below(4)));
    return s;
  }
  static MatrixD densities(const Model& model, const Sequence& s) {
    MatrixD b(static_cast<Eigen::Index>(s.size()), model.num_states());
    for (std::size_t t = 0; t < s.size(); ++t)
      b.row(static_cast<Eigen::Index>(t)) = model.emission().col(s[t]).transpose();
    return b;
  }
  static double exact(const Model& model, const Sequence& s) { return model.log_likelihood(s); }
  static Model train(const std::vector<Sequence>& sequences, const Topology& topology,
                     TrainingReport* report, const StopCheck& stop) {
    DiscreteHmmOptions options;
    options.topology = topology;
    options.num_symbols = 4;
    options.emission_floor = 0;
    options.should_stop = stop;
    options.tolerance = 0;
    return Model::train(sequences, options, report);
  }
};

struct GaussianCase {
  using Model = GaussianMixtureHmm;
  using Sequence = MatrixF;

  static Model make(const Topology& topology, std::uint64_t seed) {
    Random random(seed);
    const int n = topology.num_states;
    MatrixD weights = MatrixD::Constant(n, 2, 0.5);
    MatrixD means(2 * n, 2);
    for (Eigen::Index i = 0; i < means.size(); ++i) means.data()[i] = 2.0 * random.normal();
    MatrixD variances(2 * n, 2);
    for (Eigen::Index i = 0; i < variances.size(); ++i)
      variances.data()[i] = 0.5 + random.uniform();
    return {random_chain(topology, &random), MixtureBank(weights, means, variances)};
  }
  static Sequence sequence(int num_frames, std::uint64_t seed) {
    return noise(num_frames, 2, seed);
  }
  static MatrixD densities(const Model& model, const Sequence& s) {
    MatrixD b = MatrixD::Zero(s.rows(), model.num_states());
    for (Eigen::Index t = 0; t < s.rows(); ++t) {
      for (int j = 0; j < model.num_states(); ++j) {
        for (int k = 0; k < 2; ++k) {
          double p = model.bank().weights()(j, k);
          for (int d = 0; d < 2; ++d) {
            const double v = model.bank().variances()(2 * j + k, d);
            const double x = static_cast<double>(s(t, d)) - model.bank().means()(2 * j + k, d);
            p *= std::exp(-0.5 * x * x / v) / std::sqrt(2 * 3.14159265358979323846 * v);
          }
          b(t, j) += p;
        }
      }
    }
    return b;
  }
  static double exact(const Model& model, const Sequence& s) {
    return model.log_likelihood_exact(s);
  }
  static Model train(const std::vector<Sequence>& sequences, const Topology& topology,
                     TrainingReport* report, const StopCheck& stop) {
    GaussianMixtureHmmOptions options;
    options.topology = topology;
    options.num_mixtures = 2;
    options.weight_floor = 0;
    options.variance_floor = 1e-6;
    options.should_stop = stop;
    options.tolerance = 0;
    return Model::train(sequences, options, report);
  }
};

template <class T>
class SequenceModel : public ::testing::Test {};
using Cases = ::testing::Types<DiscreteCase, GaussianCase>;
TYPED_TEST_SUITE(SequenceModel, Cases);

TYPED_TEST(SequenceModel, SumsAndMaximisesOverAllPaths) {
  for (const Topology& topology : kTopologies) {
    const auto model = TypeParam::make(topology, 1);
    for (const int num_frames : {1, 2, 6}) {
      const auto s = TypeParam::sequence(num_frames, 2);
      const AllPaths expected = all_paths(model.chain().start(), model.chain().transition(),
                                          TypeParam::densities(model, s));
      EXPECT_NEAR(TypeParam::exact(model, s), std::log(expected.sum),
                  1e-12 * std::abs(std::log(expected.sum)) + 1e-13);
      EXPECT_NEAR(model.log_likelihood(s), std::log(expected.sum),
                  1e-5 * std::abs(std::log(expected.sum)) + 1e-5);
      std::vector<int> path;
      EXPECT_NEAR(model.viterbi(s, &path), std::log(expected.best),
                  1e-12 * std::abs(std::log(expected.best)) + 1e-13);
      EXPECT_EQ(path, expected.best_path);
    }
  }
}

TYPED_TEST(SequenceModel, NeverLosesLikelihoodInTraining) {
  for (const Topology& topology : kTopologies) {
    std::vector<typename TypeParam::Sequence> sequences;
    for (std::uint64_t s = 0; s < 6; ++s)
      sequences.push_back(TypeParam::sequence(20 + static_cast<int>(s) * 5, s));
    TrainingReport report;
    TypeParam::train(sequences, topology, &report, {});
    ASSERT_GE(report.log_likelihoods.size(), 2U);
    for (std::size_t i = 1; i < report.log_likelihoods.size(); ++i) {
      EXPECT_GE(report.log_likelihoods[i], report.log_likelihoods[i - 1] - 1e-6);
    }
  }
}

TYPED_TEST(SequenceModel, KeepsStructuralZerosInTraining) {
  for (const Topology& topology : kTopologies) {
    const auto model = TypeParam::train({TypeParam::sequence(30, 1), TypeParam::sequence(40, 2)},
                                        topology, nullptr, {});
    for (int i = 0; i < topology.num_states; ++i) {
      EXPECT_NEAR(model.chain().transition().row(i).sum(), 1.0, 1e-9);
      for (int j = 0; j < topology.num_states; ++j) {
        if (!topology.allows(i, j)) {
          EXPECT_EQ(model.chain().transition()(i, j), 0.0);
        }
      }
    }
  }
}

TYPED_TEST(SequenceModel, LivesOnSequencesShorterThanItsStates) {
  const Topology topology{Kind::left_right, 8, 1};
  for (const int num_frames : {1, 2, 5}) {
    const auto s = TypeParam::sequence(num_frames, 3);
    const auto model = TypeParam::train({s}, topology, nullptr, {});
    EXPECT_TRUE(std::isfinite(model.log_likelihood(s)));
    EXPECT_TRUE(std::isfinite(model.log_likelihood(TypeParam::sequence(1, 3))));
    EXPECT_TRUE(model.chain().transition().allFinite());
  }
}

TYPED_TEST(SequenceModel, TrainsOnLengthsThatDifferThirtyFold) {
  const auto model = TypeParam::train({TypeParam::sequence(3, 1), TypeParam::sequence(90, 2)},
                                      {Kind::left_right, 5, 1}, nullptr, {});
  EXPECT_TRUE(std::isfinite(model.log_likelihood(TypeParam::sequence(90, 2))));
  EXPECT_TRUE(std::isfinite(model.log_likelihood(TypeParam::sequence(3, 1))));
}

TYPED_TEST(SequenceModel, RefusesEmptyInput) {
  const auto model = TypeParam::make({Kind::left_right, 3, 1}, 1);
  EXPECT_THROW(static_cast<void>(model.log_likelihood(TypeParam::sequence(0, 1))), InvalidArgument);
  EXPECT_THROW(model.viterbi(TypeParam::sequence(0, 1)), InvalidArgument);
  EXPECT_THROW(TypeParam::train({}, {Kind::left_right, 3, 1}, nullptr, {}), InvalidArgument);
  const auto message = message_of<InvalidArgument>([] {
    TypeParam::train({TypeParam::sequence(4, 1), TypeParam::sequence(0, 1)},
                     {Kind::left_right, 3, 1}, nullptr, {});
  });
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "sequence 1 has no", message);
}

TYPED_TEST(SequenceModel, StopsWithinOneIteration) {
  int polls = 0;
  const StopCheck stop = [&polls] { return ++polls == 2; };
  EXPECT_THROW(TypeParam::train({TypeParam::sequence(40, 1)}, {Kind::ergodic, 3, 1}, nullptr, stop),
               Interrupted);
  EXPECT_EQ(polls, 2);
}

TYPED_TEST(SequenceModel, ScoresTheSameAfterLoading) {
  for (const Topology& topology : kTopologies) {
    const auto model = TypeParam::make(topology, 4);
    ModelFile file;
    model.write(file, "m.");
    const auto loaded = TypeParam::Model::read(through_bytes(file), "m.");
    const auto s = TypeParam::sequence(25, 5);
    EXPECT_EQ(loaded.log_likelihood(s), model.log_likelihood(s));
    EXPECT_EQ(loaded.viterbi(s), model.viterbi(s));
  }
}

TYPED_TEST(SequenceModel, RefusesFilesThatAreNoModel) {
  ModelFile file;
  EXPECT_THROW(TypeParam::Model::read(file, "m."), FormatError);
  TypeParam::make({Kind::left_right, 3, 1}, 1).write(file, "m.");
  file.set_matrix("m.transition",
                  MatrixD(MatrixD::Constant(3, 3, 1.0 / 3.0)));  // outside the topology
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "transition",
                      message_of<FormatError>([&] { return TypeParam::Model::read(file, "m."); }));
}

TYPED_TEST(SequenceModel, ScoresTheSameFromManyThreads) {
  const auto model = TypeParam::make({Kind::ergodic, 3, 1}, 4);
  const auto s = TypeParam::sequence(200, 5);
  const double expected = model.log_likelihood(s);
  std::vector<double> scores(4);
  std::vector<std::thread> threads;
  for (double& score : scores)
    threads.emplace_back([&model, &s, &score] { score = model.log_likelihood(s); });
  for (std::thread& t : threads) t.join();
  for (const double score : scores) EXPECT_EQ(score, expected);
}

}  // namespace
}  // namespace hri
