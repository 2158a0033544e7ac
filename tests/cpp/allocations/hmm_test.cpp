// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Scoring with HMMs allocates nothing once the thread has done it before.
#include <gtest/gtest.h>

#include "allocations/allocation_counter.hpp"
#include "hri/models/hmm/hmm_stream.hpp"
#include "models/sequence_model_cases.hpp"

namespace hri {
namespace {

using namespace testing_data;

TEST(AllocationCounter, SeesWhatIsAllocated) {
  EXPECT_EQ(allocations_of([] {}), 0);
  std::vector<double> values;
  EXPECT_GE(allocations_of([&] { values.resize(1000); }), 1);
  MatrixD matrix;
  EXPECT_GE(allocations_of([&] { matrix = MatrixD::Ones(40, 40); }), 1);
  detail::PaddedMatrix padded;
  EXPECT_GE(allocations_of([&] { padded = detail::PaddedMatrix(4, 4, 0); }), 1);
}

template <class T>
class Scoring : public ::testing::Test {};
using Cases = ::testing::Types<DiscreteCase, GaussianCase>;
TYPED_TEST_SUITE(Scoring, Cases);

TYPED_TEST(Scoring, AllocatesNothingTheSecondTime) {
  for (const Topology& topology : kTopologies) {
    const auto model = TypeParam::make(topology, 1);
    // Long enough for every kind of arithmetic.
    const auto s = TypeParam::sequence(3000, 2);
    const auto shorter = TypeParam::sequence(70, 3);
    std::vector<int> path;
    path.reserve(3000);
    double total = 0;
    const auto score = [&](const auto& sequence) {
      total += model.log_likelihood(sequence);
      total += model.log_likelihood_exact(sequence);
      total += model.viterbi(sequence, &path);
      total += model.viterbi(sequence);
    };
    score(s);
    EXPECT_EQ(allocations_of([&] { score(s); }), 0);
    EXPECT_EQ(allocations_of([&] { score(shorter); }), 0);
    EXPECT_EQ(allocations_of([&] { score(s); }), 0);
    EXPECT_TRUE(std::isfinite(total));
  }
}

TYPED_TEST(Scoring, AllocatesForFramesOnceNotOneByOne) {
  for (const Topology& topology : kTopologies) {
    const auto model = TypeParam::make(topology, 1);
    const auto allocations = [&model](int num_frames) {
      const auto s = TypeParam::sequence(num_frames, 2);
      MatrixD posteriors;
      const auto states = [&] {
        EXPECT_TRUE(std::isfinite(model.forward_backward(s).log_likelihood));
        EXPECT_TRUE(std::isfinite(model.state_posteriors(s, &posteriors)));
      };
      states();
      return allocations_of(states);
    };
    // Long sequences may want other arithmetic, with buffers of its own.
    EXPECT_LE(allocations(3000), allocations(3) + 10);
  }
}

TEST(Streams, AllocateNothingAtAll) {
  std::vector<DiscreteHmm> discrete;
  std::vector<GaussianMixtureHmm> gaussian;
  for (const Topology& topology : kTopologies) {
    discrete.push_back(DiscreteCase::make(topology, 1));
    gaussian.push_back(GaussianCase::make(topology, 1));
  }
  HmmStreamOptions options;
  options.beam = 1000;
  DiscreteHmmStream symbols(discrete, options);
  GaussianMixtureHmmStream frames(gaussian, options);
  const SymbolSequence s = DiscreteCase::sequence(3000, 2);
  const MatrixF f = GaussianCase::sequence(3000, 2);
  frames.push(row_span(f, 0));  // the bank's scratch is the thread's
  frames.reset();
  std::vector<double> scores(discrete.size());
  EXPECT_EQ(allocations_of([&] {
              for (std::size_t t = 0; t < s.size(); ++t) {
                symbols.push(s[t]);
                symbols.log_likelihoods(scores);
                frames.push(row_span(f, static_cast<Eigen::Index>(t)));
                frames.log_likelihoods(scores);
              }
              symbols.reset();
              frames.reset();
            }),
            0);
}

TEST(MixtureBank, WritesDensitiesWithoutAllocating) {
  const MixtureBank bank = GaussianCase::make({Kind::ergodic, 5, 1}, 1).bank();
  const MatrixF frames = GaussianCase::sequence(100, 1);
  MatrixF densities(100, 5);
  std::vector<double> exact(500);
  const auto write = [&] {
    bank.log_densities(frames, densities);
    bank.log_densities(frames, exact.data());
  };
  write();
  EXPECT_EQ(allocations_of(write), 0);
}

}  // namespace
}  // namespace hri
