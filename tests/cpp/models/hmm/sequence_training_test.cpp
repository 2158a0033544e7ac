// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What the training of every sequence model must do.
#include <gtest/gtest.h>

#include <cmath>

#include "hri/core/error.hpp"
#include "models/sequence_model_cases.hpp"

namespace hri {
namespace {

using namespace testing_data;

template <class T>
class SequenceTraining : public ::testing::Test {};
using TrainingCases = ::testing::Types<DiscreteCase, GaussianCase>;
TYPED_TEST_SUITE(SequenceTraining, TrainingCases);

template <class Case>
std::vector<typename Case::Sequence> several() {
  std::vector<typename Case::Sequence> sequences;
  for (std::uint64_t s = 0; s < 6; ++s)
    sequences.push_back(Case::sequence(20 + static_cast<int>(s) * 5, s));
  return sequences;
}

TYPED_TEST(SequenceTraining, NeverLosesLikelihood) {
  for (const Topology& topology : kTopologies) {
    TrainingReport report;
    const auto sequences = several<TypeParam>();
    const auto model = TypeParam::train(sequences, topology, &report, {});
    ASSERT_GE(report.log_likelihoods.size(), 2U);
    for (std::size_t i = 1; i < report.log_likelihoods.size(); ++i)
      EXPECT_GE(report.log_likelihoods[i], report.log_likelihoods[i - 1] - 1e-6);
    double reached = 0;
    for (const auto& s : sequences) reached += model.log_likelihood_exact(s);
    EXPECT_GE(reached, report.log_likelihoods.back() - 1e-6);
  }
}

// One step against expected counts from all paths.
TYPED_TEST(SequenceTraining, EstimatesTransitionsFromAllPaths) {
  for (const Topology& topology : kTopologies) {
    if (topology.num_states > 4) continue;
    const auto model = TypeParam::make(topology, 5);
    const MarkovChain& chain = model.chain();
    MatrixD band = MatrixD::Zero(topology.num_states, topology.num_states);
    VectorD leave = VectorD::Zero(topology.num_states);
    VectorD land = leave;
    std::vector<typename TypeParam::Sequence> sequences;
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      const auto s = sequences.emplace_back(TypeParam::sequence(5, seed + 30));
      const MatrixD b = TypeParam::densities(model, s);
      const double total = all_paths(chain.start(), chain.transition(), b).sum;
      for (int t = 0; t + 1 < 5; ++t) {
        for (int i = 0; i < topology.num_states; ++i) {
          for (int j = 0; j < topology.num_states; ++j) {
            // Only paths through i and j at t.
            MatrixD through = b;
            through.row(t).setZero();
            through.row(t + 1).setZero();
            through(t, i) = b(t, i);
            through(t + 1, j) = b(t + 1, j);
            if (!(chain.transition()(i, j) > 0)) continue;
            const double count = all_paths(chain.start(), chain.transition(), through).sum / total;
            band(i, j) += count * chain.band()(i, j) / chain.transition()(i, j);
            if (!chain.jumps()) continue;
            const double jumped =
                count * chain.leave()[i] * chain.land()[j] / chain.transition()(i, j);
            leave[i] += jumped;
            land[j] += jumped;
          }
        }
      }
    }
    auto options = TypeParam::options(topology);
    options.max_iterations = 1;
    const MarkovChain next = model.retrain(sequences, options).chain();
    for (int i = 0; i < topology.num_states; ++i) {
      const double sum = band.row(i).sum() + leave[i];
      EXPECT_LT((next.band().row(i) - band.row(i) / sum).cwiseAbs().maxCoeff(), 1e-11);
      if (chain.jumps()) {
        EXPECT_NEAR(next.leave()[i], leave[i] / sum, 1e-11);
        EXPECT_NEAR(next.land()[i], land[i] / land.sum(), 1e-11);
      }
    }
  }
}

TYPED_TEST(SequenceTraining, KeepsStructuralZeros) {
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

TYPED_TEST(SequenceTraining, LeavesStatesItNeverVisitedAsTheyWere) {
  const auto model = TypeParam::make({Kind::left_right, 6, 1}, 3);
  auto options = TypeParam::options(model.chain().topology());
  options.max_iterations = 3;
  const auto next = model.retrain({TypeParam::sequence(2, 1), TypeParam::sequence(2, 2)}, options);
  const MatrixD before = TypeParam::emissions(model);
  const MatrixD after = TypeParam::emissions(next);
  const Eigen::Index unvisited = before.rows() / 6 * 4;
  EXPECT_EQ(after.bottomRows(unvisited), before.bottomRows(unvisited));
  EXPECT_NE(after, before);
  EXPECT_EQ(next.chain().transition().bottomRows(4), model.chain().transition().bottomRows(4));
}

TYPED_TEST(SequenceTraining, LivesOnOneShortSequence) {
  std::vector<Topology> topologies = kTopologies;
  topologies.push_back({Kind::left_right, 8, 1});
  for (const Topology& topology : topologies) {
    for (const int num_frames : {1, 2, 5}) {
      const auto s = TypeParam::sequence(num_frames, 3);
      const auto model = TypeParam::train({s}, topology, nullptr, {});
      EXPECT_TRUE(std::isfinite(model.log_likelihood(s)));
      EXPECT_FALSE(std::isnan(model.log_likelihood(TypeParam::sequence(50, 4))));
      EXPECT_TRUE(model.chain().transition().allFinite());
      EXPECT_TRUE(TypeParam::emissions(model).allFinite());
    }
  }
}

TYPED_TEST(SequenceTraining, LearnsFromLengthsThatDifferThirtyFold) {
  const auto model = TypeParam::train({TypeParam::sequence(3, 1), TypeParam::sequence(90, 2)},
                                      {Kind::left_right, 5, 1}, nullptr, {});
  EXPECT_TRUE(std::isfinite(model.log_likelihood(TypeParam::sequence(90, 2))));
  EXPECT_TRUE(std::isfinite(model.log_likelihood(TypeParam::sequence(3, 1))));
}

TYPED_TEST(SequenceTraining, RefusesEmptyInput) {
  EXPECT_THROW(TypeParam::train({}, {Kind::left_right, 3, 1}, nullptr, {}), InvalidArgument);
  const auto message = message_of<InvalidArgument>([] {
    TypeParam::train({TypeParam::sequence(4, 1), TypeParam::sequence(0, 1)},
                     {Kind::left_right, 3, 1}, nullptr, {});
  });
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "sequence 1 has no", message);
}

TYPED_TEST(SequenceTraining, StopsBeforeTheNextSequence) {
  int polls = 0;
  const StopCheck stop = [&polls] { return ++polls == 2; };
  const auto model = TypeParam::make({Kind::ergodic, 3, 1}, 1);
  auto options = TypeParam::options(model.chain().topology());
  options.should_stop = stop;
  EXPECT_THROW(static_cast<void>(model.retrain(
                   {TypeParam::sequence(40, 1), TypeParam::sequence(40, 2)}, options)),
               Interrupted);
  EXPECT_EQ(polls, 2);
  EXPECT_THROW(TypeParam::train({TypeParam::sequence(40, 1)}, {Kind::ergodic, 3, 1}, nullptr,
                                [] { return true; }),
               Interrupted);
}

TYPED_TEST(SequenceTraining, KeepsTransitionsThatAreFixed) {
  for (const Topology& topology : kTopologies) {
    const auto model = TypeParam::make(topology, 2);
    auto options = TypeParam::options(topology);
    options.train_transitions = false;
    options.transition_prior = 3;
    TrainingReport report;
    const auto next = model.retrain(several<TypeParam>(), options, &report);
    EXPECT_EQ(next.chain().transition(), model.chain().transition());
    EXPECT_EQ(next.chain().start(), model.chain().start());
    EXPECT_NE(TypeParam::emissions(next), TypeParam::emissions(model));
    for (std::size_t i = 1; i < report.log_likelihoods.size(); ++i)
      EXPECT_GE(report.log_likelihoods[i], report.log_likelihoods[i - 1] - 1e-6);
  }
}

TYPED_TEST(SequenceTraining, ImaginedTransitionsDrawTowardsEqualOnes) {
  for (const Topology& topology : kTopologies) {
    auto options = TypeParam::options(topology);
    options.max_iterations = 1;
    const auto model = TypeParam::make(topology, 2);
    const auto sequences = several<TypeParam>();
    options.transition_prior = 1e12;
    const MarkovChain drawn = model.retrain(sequences, options).chain();
    for (int i = 0; i < topology.num_states; ++i) {
      const int reach = topology.end_next(i) - topology.first_next(i) + (drawn.jumps() ? 1 : 0);
      for (int j = topology.first_next(i); j < topology.end_next(i); ++j)
        EXPECT_NEAR(drawn.band()(i, j), 1.0 / reach, 1e-6);
    }
    options.transition_prior = -1;
    EXPECT_PRED_FORMAT2(
        ::testing::IsSubstring, "transition_prior",
        message_of<InvalidArgument>([&] { return model.retrain(sequences, options); }));
  }
}

}  // namespace
}  // namespace hri
