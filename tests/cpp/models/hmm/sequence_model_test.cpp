// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What every sequence model must do: scores against all paths of short sequences, and what must not
// change them. Training is in sequence_training_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <thread>
#include <utility>

#include "hri/core/error.hpp"
#include "models/sequence_model_cases.hpp"

namespace hri {
namespace {

using namespace testing_data;

template <class T>
class SequenceModel : public ::testing::Test {};
using Cases = ::testing::Types<DiscreteCase, GaussianCase, PossibilisticCase>;
TYPED_TEST_SUITE(SequenceModel, Cases);

// Relative, but for values around 0.
void expect_close(double actual, double expected, double tolerance) {
  EXPECT_NEAR(actual, expected, tolerance * std::max(1.0, std::abs(expected)));
}

template <class Case>
void expect_over_all_paths(const typename Case::Model& model, const typename Case::Sequence& s) {
  const AllPaths expected =
      all_paths(Case::start(model), Case::transition(model), Case::densities(model, s));
  expect_close(model.log_likelihood_exact(s), std::log(Case::over_all(expected)), 1e-12);
  expect_close(model.log_likelihood(s), std::log(Case::over_all(expected)), 1e-5);
  std::vector<int> path;
  expect_close(model.viterbi(s, &path), std::log(expected.best), 1e-12);
  EXPECT_EQ(path, expected.best_path);
  if constexpr (Case::kProbabilistic) {
    EXPECT_LT((model.posterior(s) - expected.posterior).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TYPED_TEST(SequenceModel, SumsAndMaximisesOverAllPathsOfAllShortSequences) {
  const int letters = TypeParam::kNumLetters;
  for (const Topology& topology : kTopologies) {
    const auto model = TypeParam::make(topology, 1);
    for (int length = 1; length <= 3; ++length) {
      const int count = static_cast<int>(std::lround(std::pow(letters, length)));
      for (int code = 0; code < count; ++code) {
        std::vector<int> word;
        for (int t = 0, rest = code; t < length; ++t, rest /= letters)
          word.push_back(rest % letters);
        expect_over_all_paths<TypeParam>(model, TypeParam::spell(word));
      }
    }
  }
}

TYPED_TEST(SequenceModel, SumsAndMaximisesOverAllPathsOfLongerSequences) {
  for (const Topology& topology : kTopologies) {
    if (topology.num_states > 4) continue;
    for (std::uint64_t seed = 0; seed < 5; ++seed)
      expect_over_all_paths<TypeParam>(TypeParam::make(topology, seed),
                                       TypeParam::sequence(6, seed + 10));
  }
}

std::vector<int> identity(int n) {
  std::vector<int> order;
  for (int i = 0; i < n; ++i) order.push_back(i);
  return order;
}

TYPED_TEST(SequenceModel, ScoresAStructureAsItsWholeMatrix) {
  const std::vector<Topology> structured{
      {Kind::left_right, 7, 1}, {Kind::left_right, 17, 3},
      {Kind::left_right, 1, 1}, {Kind::banded, 9, 1},
      {Kind::banded, 20, 4},    {Kind::rank_one_plus_band, 12, 2},
      {Kind::banded, 5, 4096},  {Kind::rank_one_plus_band, 1, 1},
      {Kind::left_right, 70, 1}};
  for (const Topology& topology : structured) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      const auto model = TypeParam::make(topology, seed);
      const auto dense =
          TypeParam::permuted(model, as_ergodic(model.chain()), identity(topology.num_states));
      for (const int num_frames : {1, 2, 80, 300}) {
        const auto s = TypeParam::sequence(num_frames, seed + 20);
        expect_close(model.log_likelihood(s), dense.log_likelihood(s), TypeParam::kRounding);
        expect_close(model.log_likelihood_exact(s), dense.log_likelihood_exact(s), 1e-12);
        std::vector<int> path;
        std::vector<int> dense_path;
        expect_close(model.viterbi(s, &path), dense.viterbi(s, &dense_path), 1e-12);
        EXPECT_EQ(path, dense_path);
        if constexpr (TypeParam::kProbabilistic) {
          EXPECT_LT((model.posterior(s) - dense.posterior(s)).cwiseAbs().maxCoeff(), 1e-10);
        }
      }
    }
  }
}

TYPED_TEST(SequenceModel, NamesOfStatesChangeNothing) {
  const std::vector<int> order{3, 0, 4, 2, 1};
  const auto of = [&](const VectorD& v) { return permuted_rows(v, order); };
  const Topology ergodic{Kind::ergodic, 5, 1};
  const Topology jumping{Kind::rank_one_plus_band, 5, 1};
  const auto model = TypeParam::make(ergodic, 6);
  MatrixD transition = permuted_rows(model.chain().transition(), order);
  transition = permuted_rows(MatrixD(transition.transpose()), order).transpose().eval();
  const auto other =
      TypeParam::permuted(model, {ergodic, of(model.chain().start()), transition}, order);
  Random random(3);
  const VectorD land = random_chain(jumping, &random).land();
  const MarkovChain jumps{jumping, model.chain().start(), MatrixD::Zero(5, 5), VectorD::Ones(5),
                          land};
  const auto loose = TypeParam::permuted(model, jumps, identity(5));
  const auto other_loose = TypeParam::permuted(
      model, {jumping, of(jumps.start()), jumps.band(), jumps.leave(), of(land)}, order);
  for (const int num_frames : {1, 40}) {
    const auto s = TypeParam::sequence(num_frames, 8);
    for (const auto& [a, b] : {std::pair(&model, &other), std::pair(&loose, &other_loose)}) {
      expect_close(a->log_likelihood(s), b->log_likelihood(s), 1e-6);
      expect_close(a->log_likelihood_exact(s), b->log_likelihood_exact(s), 1e-12);
      std::vector<int> path;
      std::vector<int> renamed;
      expect_close(a->viterbi(s, &path), b->viterbi(s, &renamed), 1e-12);
      for (std::size_t t = 0; t < path.size(); ++t)
        EXPECT_EQ(path[t], order[static_cast<std::size_t>(renamed[t])]);
    }
  }
}

TYPED_TEST(SequenceModel, IsSureOfItselfAndFiniteOnLongSequences) {
  for (const Topology& topology : kTopologies) {
    const auto model = TypeParam::make(topology, 2);
    const auto s = TypeParam::sequence(3000, 3);
    ASSERT_TRUE(std::isfinite(model.log_likelihood(s)));
    expect_close(model.log_likelihood(s), model.log_likelihood_exact(s),
                 std::max(1e-5, TypeParam::kRounding));
    EXPECT_LE(model.viterbi(s), model.log_likelihood_exact(s) + 1e-9);
    if constexpr (TypeParam::kProbabilistic) {
      const MatrixD posterior = model.posterior(s);
      EXPECT_TRUE(posterior.allFinite());
      EXPECT_LT((posterior.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-9);
    }
  }
}

TYPED_TEST(SequenceModel, RefusesEmptyInput) {
  const auto model = TypeParam::make({Kind::left_right, 3, 1}, 1);
  const auto none = TypeParam::sequence(0, 1);
  EXPECT_THROW(static_cast<void>(model.log_likelihood(none)), InvalidArgument);
  EXPECT_THROW(static_cast<void>(model.log_likelihood_exact(none)), InvalidArgument);
  EXPECT_THROW(model.viterbi(none), InvalidArgument);
  if constexpr (TypeParam::kProbabilistic) {
    EXPECT_THROW(static_cast<void>(model.posterior(none)), InvalidArgument);
  }
}

TYPED_TEST(SequenceModel, IsTheSameToTheBitAfterLoading) {
  for (const Topology& topology : kTopologies) {
    const auto model = TypeParam::make(topology, 4);
    ModelFile file;
    model.write(file, "m.");
    const auto loaded = TypeParam::Model::read(through_bytes(file), "m.");
    const auto s = TypeParam::sequence(25, 5);
    EXPECT_EQ(loaded.log_likelihood(s), model.log_likelihood(s));
    EXPECT_EQ(loaded.viterbi(s), model.viterbi(s));
    EXPECT_EQ(loaded.chain().transition(), model.chain().transition());
    EXPECT_EQ(TypeParam::emissions(loaded), TypeParam::emissions(model));
  }
}

TYPED_TEST(SequenceModel, RefusesFilesThatAreNoModel) {
  ModelFile file;
  EXPECT_THROW(TypeParam::Model::read(file, "m."), FormatError);
  TypeParam::make({Kind::left_right, 3, 1}, 1).write(file, "m.");
  file.set_matrix(std::string("m.") + TypeParam::kTransitionField,
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
