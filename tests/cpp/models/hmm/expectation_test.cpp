// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/hmm/expectation.hpp"

#include <gtest/gtest.h>

#include "hri/core/error.hpp"
#include "models/hmm/dense_kernels.hpp"
#include "models/hmm/log_steps.hpp"
#include "models/model_testing.hpp"

namespace hri::detail {
namespace {

using namespace testing_data;

// A left-right model whose states lie `apart` from each other: far ones make some sums vanish, so
// that single steps and passes have to take them again in logs.
GaussianMixtureHmm model_of(int num_states, int num_mixtures, double apart) {
  const Topology topology{Topology::Kind::left_right, num_states, 1};
  const int rows = num_states * num_mixtures;
  MatrixD means = noise(rows, 3, 20).cast<double>();
  for (int r = 0; r < rows; ++r) means.row(r).array() += apart * (r / num_mixtures);
  return {MarkovChain::initial(topology),
          MixtureBank(MatrixD::Constant(num_states, num_mixtures, 1.0 / num_mixtures), means,
                      MatrixD::Constant(rows, 3, 0.5))};
}

std::vector<MatrixF> sequences(int num_states, double apart) {
  std::vector<MatrixF> result;
  std::uint64_t seed = 30;
  for (const int length : {40, 1, 7, 2, 90, 13, 3}) {
    result.push_back(noise(length, 3, ++seed));
    for (int t = 0; t < length; ++t)
      result.back().row(t).array() += static_cast<float>(apart * (t * num_states / length));
  }
  result.push_back(result.front().colwise().reverse());  // the wrong way round
  return result;
}

struct Expected {
  ChainCounts counts;
  MixtureAccumulator accumulator;
  double total = 0;
  explicit Expected(const GaussianMixtureHmm& model)
      : counts(model.num_states()),
        accumulator(model.num_states(), model.bank().num_mixtures(), model.dim()) {}
};

void expect_equal(const Expected& a, const Expected& b, const std::string& name) {
  EXPECT_EQ(a.total, b.total) << name;
  EXPECT_EQ(a.counts.start, b.counts.start) << name;
  EXPECT_EQ(a.counts.band, b.counts.band) << name;
  EXPECT_EQ(a.accumulator.counts(), b.accumulator.counts()) << name;
  EXPECT_EQ(a.accumulator.sums(), b.accumulator.sums()) << name;
  EXPECT_EQ(a.accumulator.squares(), b.accumulator.squares()) << name;
}

TEST(Expectation, OfSequencesSideBySideHasTheBitsOfOneAfterTheOther) {
  for (const double apart : {0.0, 2.0, 12.0, 60.0}) {
    for (const int num_states : {1, 2, 5, 8, 9}) {
      for (const int num_mixtures : {1, 3}) {
        const GaussianMixtureHmm model = model_of(num_states, num_mixtures, apart);
        Expected found(model);
        Expected plain(model);
        const std::vector<MatrixF> all = sequences(num_states, apart);
        found.total = add_expectations(model, all, {}, &found.counts, &found.accumulator);
        for (const MatrixF& frames : all) {
          MatrixD densities;
          MatrixD shares;
          MatrixD gamma(frames.rows(), num_states);
          model.bank().log_densities(frames, &densities, &shares);
          plain.total += forward_backward(model.chain(), rows_of(densities), gamma.data(),
                                          num_states, &plain.counts);
          plain.accumulator.add(frames, gamma, shares);
        }
        expect_equal(found, plain,
                     std::to_string(num_states) + " states, " + std::to_string(num_mixtures) +
                         " components, apart by " + std::to_string(apart));
      }
    }
  }
}

TEST(Expectation, LikelihoodsOfModelsSideBySideAreThoseOfEach) {
  std::vector<GaussianMixtureHmm> models;
  for (const double apart : {1.0, 50.0}) {
    for (const int num_states : {8, 3, 8, 12, 1, 5, 8})
      models.push_back(model_of(num_states, 1, apart));
  }
  for (const MatrixF& frames : sequences(8, 3)) {
    const VectorF found = log_likelihoods(models, frames);
    for (std::size_t c = 0; c < models.size(); ++c) {
      EXPECT_EQ(found[static_cast<Eigen::Index>(c)],
                static_cast<float>(models[c].log_likelihood(frames)))
          << c;
    }
  }
}

TEST(Expectation, StopsBeforeASequenceWhenAsked) {
  const GaussianMixtureHmm model = model_of(3, 1, 2);
  Expected found(model);
  int polls = 0;
  EXPECT_THROW(
      add_expectations(
          model, sequences(3, 2), [&] { return ++polls == 6; }, &found.counts, &found.accumulator),
      Interrupted);
  EXPECT_EQ(polls, 6);
}

// States so unlikely beside others that their sums vanish, and as likely as their neighbours.
TEST(LogPass, GivesTheBitsOfSingleStepsWhereSumsVanish) {
  constexpr int kStates = 6;
  const MarkovChain chain = MarkovChain::initial({Topology::Kind::left_right, kStates, 1});
  const ByOneRows rows = chain.by_one();
  Random random(40);
  for (const std::ptrdiff_t length : {2, 5, 30, 200}) {
    PaddedMatrix log_b(length, kLanes, 0);
    for (std::ptrdiff_t t = 0; t < length; ++t) {
      for (int j = 0; j < kStates; ++j) log_b.row(t)[j] = -600.0 * (random.below(3) == 0) - j;
    }
    PaddedMatrix alpha(length, kLanes, -kInfinity);
    PaddedMatrix after(length, kLanes, -kInfinity);
    PaddedMatrix beta(length, kLanes, -kInfinity);
    std::copy_n(log_b.row(0), kStates, alpha.row(0));
    std::fill_n(beta.row(length - 1), kStates, 0.0);
    const LogPass pass{rows.data(), log_b.row(0), length,     alpha.row(0),
                       kLanes,      after.row(0), beta.row(0)};
    dense_kernels().forward_logs(&pass, 1);
    dense_kernels().backward_logs(&pass, 1);
    AlignedVector scratch(2 * kLanes);
    AlignedVector step(kLanes);
    for (std::ptrdiff_t t = 1; t < length; ++t) {
      log_forward_step(chain, alpha.row(t - 1), scratch.data(), step.data());
      for (int j = 0; j < kStates; ++j) EXPECT_EQ(alpha.row(t)[j], step[j] + log_b.row(t)[j]);
      log_backward_step(chain, after.row(t), scratch.data(), step.data());
      for (int j = 0; j < kStates; ++j) {
        EXPECT_EQ(after.row(t)[j], log_b.row(t)[j] + beta.row(t)[j]);
        EXPECT_EQ(beta.row(t - 1)[j], step[j]);
      }
    }
  }
}

// The same passes by every instruction set.
TEST(LogPass, HasTheSameBitsOnEveryInstructionSet) {
  const GaussianMixtureHmm model = model_of(7, 1, 9);
  const ByOneRows chain = model.chain().by_one();
  for (const MatrixF& frames : sequences(7, 9)) {
    PaddedMatrix log_b(frames.rows(), kLanes, 0);
    MatrixD densities;
    model.bank().log_densities(frames, &densities, nullptr);
    for (Eigen::Index t = 0; t < frames.rows(); ++t)
      std::copy_n(densities.data() + t * 7, 7, log_b.row(t));
    std::vector<std::vector<double>> results;
    for (const DenseKernels* kernels : all_dense_kernels()) {
      const auto room = [&] { return PaddedMatrix(frames.rows(), kLanes, -kInfinity); };
      PaddedMatrix alpha = room();
      PaddedMatrix after = room();
      PaddedMatrix beta = room();
      PaddedMatrix gamma = room();
      alpha.row(0)[0] = log_b.row(0)[0];
      std::fill_n(beta.row(frames.rows() - 1), 7, 0.0);
      const LogPass pass{chain.data(), log_b.row(0), frames.rows(), alpha.row(0),
                         kLanes,       after.row(0), beta.row(0)};
      kernels->forward_logs(&pass, 1);
      kernels->backward_logs(&pass, 1);
      StepSums sums{};
      kernels->posteriors(pass, alpha.row(frames.rows() - 1)[6], gamma.row(0), &sums);
      std::vector<double>& result = results.emplace_back();
      const std::ptrdiff_t size = frames.rows() * kLanes;
      result.insert(result.end(), alpha.row(0), alpha.row(0) + size);
      result.insert(result.end(), beta.row(0), beta.row(0) + size);
      result.insert(result.end(), gamma.row(0), gamma.row(0) + size);
      result.insert(result.end(), sums.stay, sums.stay + kLanes);
      result.insert(result.end(), sums.go, sums.go + kLanes);
    }
    for (const auto& result : results) EXPECT_EQ(result, results.front());
  }
}

}  // namespace
}  // namespace hri::detail
