// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/hmm/few_samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri {
namespace {

Topology left_right(int num_states) {
  Topology topology;
  topology.num_states = num_states;
  return topology;
}

// One Gaussian a state, of one feature.
GaussianMixtureHmm model(const std::vector<double>& means, double variance) {
  const auto n = static_cast<Eigen::Index>(means.size());
  MatrixD rows(n, 1);
  for (Eigen::Index j = 0; j < n; ++j) rows(j, 0) = means[static_cast<std::size_t>(j)];
  return {MarkovChain::initial(left_right(static_cast<int>(n))),
          MixtureBank(MatrixD::Ones(n, 1), rows, MatrixD::Constant(n, 1, variance))};
}

MatrixF column(const std::vector<float>& values) {
  return Eigen::Map<const MatrixF>(values.data(), static_cast<Eigen::Index>(values.size()), 1);
}

FewSampleOptions of(int num_recordings) {
  FewSampleOptions options;
  options.num_recordings = num_recordings;
  return options;
}

TEST(FewSamples, VariancesAreDrawnToThoseKnown) {
  const std::vector<GaussianMixtureHmm> known{model({-2}, 1), model({2}, 3)};  // 2 in the mean
  const std::vector<MatrixF> heard{column({5, 7, 5}), column({7, 6})};  // mean 6, variance 0.8
  for (const int n : {1, 2, 5}) {
    const MixtureBank bank = train_few(known, heard, of(n)).bank();
    EXPECT_NEAR(bank.means()(0, 0), 6, 1e-9);
    EXPECT_NEAR(bank.variances()(0, 0), (2 * 2 + n * 0.8) / (2 + n), 1e-9);
  }
}

TEST(FewSamples, OneShortSequenceIsEnough) {
  const std::vector<GaussianMixtureHmm> known{model({-5, 0, 5, 9}, 0.5)};
  const GaussianMixtureHmm found = train_few(known, {column({1, 2})}, of(1));
  EXPECT_TRUE(std::isfinite(found.log_likelihood(column({1, 2}))));
  EXPECT_GT(found.log_likelihood(column({1, 2})), known[0].log_likelihood(column({1, 2})));
}

TEST(FewSamples, ManyRecordingsSpeakForThemselves) {
  const std::vector<GaussianMixtureHmm> known{model({-2}, 1), model({2}, 1)};
  const MixtureBank bank = train_few(known, {column({5, 7, 5, 7, 6})}, of(1000000)).bank();
  EXPECT_NEAR(bank.means()(0, 0), 6, 1e-4);
  EXPECT_NEAR(bank.variances()(0, 0), 0.8, 1e-4);
}

TEST(FewSamples, SpreadOfAMixtureCountsAsThatOfItsState) {
  MatrixD weights(1, 2);
  weights << 0.25, 0.75;
  MatrixD means(2, 1);
  means << -3, 1;  // mean 0, variance 3 between
  const GaussianMixtureHmm mixed(MarkovChain::initial(left_right(1)),
                                 {weights, means, MatrixD::Constant(2, 1, 0.5)});
  const std::vector<MatrixF> heard{column({5, 7, 5}), column({7, 6})};
  const MixtureBank found = train_few({mixed, model({4}, 3.5)}, heard, of(3)).bank();
  const MixtureBank expected = train_few({model({0}, 3.5), model({4}, 3.5)}, heard, of(3)).bank();
  EXPECT_NEAR(found.means()(0, 0), expected.means()(0, 0), 1e-9);
  EXPECT_NEAR(found.variances()(0, 0), expected.variances()(0, 0), 1e-9);
}

TEST(FewSamples, StatesFollowTheSequence) {
  const std::vector<GaussianMixtureHmm> known{model({-5, 0, 5}, 0.5), model({5, -5, 0}, 0.5)};
  Random random(3);
  std::vector<MatrixF> heard;
  for (int take = 0; take < 3; ++take) {
    MatrixF frames(24, 1);
    for (Eigen::Index t = 0; t < 24; ++t) {
      const float level = t < 4 ? 5.0F : (t < 18 ? 0.0F : -5.0F);  // of unequal lengths
      frames(t, 0) = level + static_cast<float>(0.5 * random.normal());
    }
    heard.push_back(frames);
  }
  const GaussianMixtureHmm found = train_few(known, heard, of(3));
  EXPECT_NEAR(found.bank().means()(0, 0), 5, 0.5);
  EXPECT_NEAR(found.bank().means()(1, 0), 0, 0.5);
  EXPECT_NEAR(found.bank().means()(2, 0), -5, 0.5);
  for (const GaussianMixtureHmm& other : known)
    EXPECT_GT(found.log_likelihood(heard[0]), other.log_likelihood(heard[0]) + 20);
}

DiscreteHmm emitter(const std::vector<double>& emission) {
  return {
      MarkovChain::initial(left_right(1)),
      Eigen::Map<const MatrixD>(emission.data(), 1, static_cast<Eigen::Index>(emission.size()))};
}

TEST(FewSamples, SymbolsBringThoseThatOccurWithThem) {
  // Symbols 0 and 1 are emitted by one known state, 2 and 3 by another.
  const std::vector<DiscreteHmm> known{emitter({0.5, 0.5, 0, 0}), emitter({0, 0, 0.75, 0.25})};
  const std::vector<SymbolSequence> heard{{0, 0, 0}, {0, 2}};
  const MatrixD emission = train_few(known, heard, 0.0, of(5)).emission();
  const double own = 5.0 / 15;  // what is heard of 0 is 0.8, of 2 is 0.2
  EXPECT_NEAR(emission(0, 0), own * 0.8 + (1 - own) * 0.8 * 0.5, 1e-9);
  EXPECT_NEAR(emission(0, 1), (1 - own) * 0.8 * 0.5, 1e-9);
  EXPECT_NEAR(emission(0, 2), own * 0.2 + (1 - own) * 0.2 * 0.75, 1e-9);
  EXPECT_NEAR(emission(0, 3), (1 - own) * 0.2 * 0.25, 1e-9);
  const MatrixD floored = train_few({known[0]}, {{0, 0}}, 0.1, of(1)).emission();
  EXPECT_NEAR(floored.sum(), 1, 1e-12);
  EXPECT_GT(floored.minCoeff(), 0.05);
}

TEST(FewSamples, BadInputIsRefused) {
  const std::vector<GaussianMixtureHmm> known{model({0, 1}, 1)};
  const std::vector<MatrixF> heard{column({0, 1, 2})};
  EXPECT_THROW((void)train_few(std::vector<GaussianMixtureHmm>{}, heard, of(1)), InvalidArgument);
  EXPECT_THROW((void)train_few(known, std::vector<MatrixF>{}, of(1)), InvalidArgument);
  EXPECT_THROW((void)train_few(known, {MatrixF::Zero(3, 2)}, of(1)), InvalidArgument);
  EXPECT_THROW((void)train_few(known, heard, of(0)), InvalidArgument);
  EXPECT_THROW((void)train_few({known[0], model({0}, 1)}, heard, of(1)), InvalidArgument);
  EXPECT_THROW(
      (void)train_few(known, {column({0, std::numeric_limits<float>::quiet_NaN()})}, of(1)),
      InvalidArgument);
  EXPECT_THROW((void)train_few({emitter({0.5, 0.5})}, {{0, 2}}, 0.0, of(1)), InvalidArgument);
  FewSampleOptions stopped;
  stopped.should_stop = [] { return true; };
  EXPECT_THROW((void)train_few(known, heard, stopped), Interrupted);
}

}  // namespace
}  // namespace hri
