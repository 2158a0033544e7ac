// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What is particular to Gaussian-mixture HMMs; the rest is in sequence_model_test.cpp.
#include "hri/models/hmm/gaussian_mixture_hmm.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hri/core/error.hpp"
#include "models/model_testing.hpp"

namespace hri {
namespace {

using Kind = Topology::Kind;
using namespace testing_data;

GaussianMixtureHmmOptions with_states_and_mixtures(int num_states, int num_mixtures = 1) {
  GaussianMixtureHmmOptions options;
  options.topology = {Kind::left_right, num_states, 1};
  options.num_mixtures = num_mixtures;
  return options;
}

// Three stretches of `length` frames around 0, 10 and 20.
MatrixF staircase(int length, std::uint64_t seed) {
  MatrixF frames = noise(3 * length, 2, seed);
  for (int t = 0; t < 3 * length; ++t)
    frames.row(t).array() += static_cast<float>(10 * (t / length));
  return frames;
}

TEST(GaussianMixtureHmm, LearnsTheStretchesOfASequence) {
  const auto model = GaussianMixtureHmm::train(
      {staircase(10, 1), staircase(20, 2), staircase(15, 3)}, with_states_and_mixtures(3));
  for (int j = 0; j < 3; ++j) EXPECT_NEAR(model.bank().means()(j, 0), 10.0 * j, 0.6);
  std::vector<int> path;
  model.viterbi(staircase(5, 4), &path);
  EXPECT_EQ(path, (std::vector<int>{0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2}));
}

TEST(GaussianMixtureHmm, TellsWordsApart) {
  const auto up =
      GaussianMixtureHmm::train({staircase(10, 1), staircase(12, 2)}, with_states_and_mixtures(3));
  const auto down = GaussianMixtureHmm::train({staircase(10, 1).colwise().reverse()},
                                              with_states_and_mixtures(3));
  EXPECT_GT(up.log_likelihood(staircase(8, 5)), down.log_likelihood(staircase(8, 5)));
}

TEST(GaussianMixtureHmm, LivesOnConstantFrames) {
  const MatrixF constant = MatrixF::Constant(12, 3, 1.5F);
  const auto model = GaussianMixtureHmm::train({constant}, with_states_and_mixtures(4, 2));
  EXPECT_TRUE(std::isfinite(model.log_likelihood(constant)));
  EXPECT_TRUE(std::isfinite(model.log_likelihood(noise(5, 3, 1))));
}

TEST(GaussianMixtureHmm, LivesOnFewerFramesThanComponents) {
  const auto model = GaussianMixtureHmm::train({noise(3, 2, 1)}, with_states_and_mixtures(2, 8));
  EXPECT_TRUE(std::isfinite(model.log_likelihood(noise(10, 2, 2))));
  EXPECT_GT(model.bank().weights().minCoeff(), 0.0);
  EXPECT_NEAR(model.bank().weights().row(0).sum(), 1.0, 1e-12);
}

TEST(GaussianMixtureHmm, SurvivesFramesFarFromEveryState) {
  // In floats the densities underflow by hundreds of orders of magnitude; sums fall back to logs.
  const auto model = GaussianMixtureHmm::train({staircase(10, 1)}, with_states_and_mixtures(3));
  MatrixF frames = staircase(4, 2);
  frames.row(6).setConstant(5000.0F);
  EXPECT_TRUE(std::isfinite(model.log_likelihood(frames)));
  EXPECT_NEAR(model.log_likelihood(frames), model.log_likelihood_exact(frames),
              1e-5 * std::abs(model.log_likelihood_exact(frames)));
}

TEST(GaussianMixtureHmm, ReachesStatesThatLookImpossibleAtFirst) {
  // State 0 is 100 deviations away from the frames, yet the only way in: the sum must not lose it
  // to underflow.
  MatrixD means(2, 1);
  means << 100, 0;
  MatrixD transition(2, 2);
  transition << 0.5, 0.5, 0, 1;
  const GaussianMixtureHmm model(
      MarkovChain({Kind::left_right, 2, 1}, VectorD::Unit(2, 0), transition),
      MixtureBank(MatrixD::Ones(2, 1), means, MatrixD::Ones(2, 1)));
  const double log_2pi = std::log(2 * 3.14159265358979323846);
  // Two frames at 0: leaving at once dominates by exp(5000), log(0.5) - 0.5 100^2 - log(2 pi).
  EXPECT_NEAR(model.log_likelihood_exact(MatrixF::Zero(2, 1)), std::log(0.5) - 5000.0 - log_2pi,
              1e-9);
}

TEST(GaussianMixtureHmm, ScoresInFloatAsInDouble) {
  const auto model = GaussianMixtureHmm::train({noise(200, 39, 1), noise(150, 39, 2)},
                                               with_states_and_mixtures(8, 3));
  const MatrixF frames = noise(80, 39, 3);
  EXPECT_NEAR(model.log_likelihood(frames) / model.log_likelihood_exact(frames), 1.0, 1e-5);
}

TEST(GaussianMixtureHmm, RepeatsForOneSeed) {
  GaussianMixtureHmmOptions options = with_states_and_mixtures(3, 2);
  options.topology.kind = Kind::ergodic;
  options.seed = 5;
  const std::vector<MatrixF> sequences{noise(60, 2, 1), noise(70, 2, 2, 1.0)};
  const auto a = GaussianMixtureHmm::train(sequences, options);
  EXPECT_EQ(a.bank().means(), GaussianMixtureHmm::train(sequences, options).bank().means());
  options.seed = 6;
  EXPECT_NE(a.bank().means(), GaussianMixtureHmm::train(sequences, options).bank().means());
}

TEST(GaussianMixtureHmm, RefusesFramesByPlace) {
  std::vector<MatrixF> sequences{noise(6, 2, 1), noise(6, 2, 2)};
  const auto model = GaussianMixtureHmm::train(sequences, with_states_and_mixtures(2));
  sequences[1](3, 1) = kNan;
  const auto refused = [](const auto& action) { return message_of<InvalidArgument>(action); };
  EXPECT_PRED_FORMAT2(
      ::testing::IsSubstring, "sequence 1 is not finite at row 3, column 1",
      refused([&] { return GaussianMixtureHmm::train(sequences, with_states_and_mixtures(2)); }));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "row 3, column 1",
                      refused([&] { return model.log_likelihood(sequences[1]); }));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "row 3, column 1",
                      refused([&] { return model.viterbi(sequences[1]); }));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "3 columns, the model has 2",
                      refused([&] { return model.log_likelihood(noise(4, 3, 1)); }));
  sequences[1] = noise(6, 3, 1);
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "sequence 1 has 3 columns", refused([&] {
                        return GaussianMixtureHmm::train(sequences, with_states_and_mixtures(2));
                      }));
}

TEST(GaussianMixtureHmm, RefusesOptionsOutOfRangeByName) {
  const auto refused = [](const GaussianMixtureHmmOptions& o) {
    return message_of<InvalidArgument>(
        [&] { return GaussianMixtureHmm::train({noise(5, 2, 1)}, o); });
  };
  GaussianMixtureHmmOptions options = with_states_and_mixtures(2, 0);
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "num_mixtures", refused(options));
  options = with_states_and_mixtures(2);
  options.max_iterations = 0;
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "max_iterations", refused(options));
  options = with_states_and_mixtures(2);
  options.variance_floor = 0;
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "variance_floor", refused(options));
  options = with_states_and_mixtures(2, 4);
  options.weight_floor = 0.5;
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "weight_floor", refused(options));
}

TEST(GaussianMixtureHmm, RefusesParametersThatAreNoModel) {
  const Topology topology{Kind::left_right, 2, 1};
  const MixtureBank bank(MatrixD::Ones(2, 1), MatrixD::Zero(2, 1), MatrixD::Ones(2, 1));
  const MatrixD good = initial_transition(topology);
  EXPECT_NO_THROW(GaussianMixtureHmm(MarkovChain(topology, initial_start(topology), good), bank));
  EXPECT_THROW(MarkovChain(topology, VectorD::Ones(2), good), InvalidArgument);
  EXPECT_THROW(MarkovChain(topology, initial_start(topology), MatrixD::Ones(2, 2)),
               InvalidArgument);
  EXPECT_THROW(MarkovChain(topology, initial_start(topology), MatrixD::Ones(3, 3)),
               InvalidArgument);
  const MixtureBank three(MatrixD::Ones(3, 1), MatrixD::Zero(3, 1), MatrixD::Ones(3, 1));
  EXPECT_THROW(GaussianMixtureHmm(MarkovChain(topology, initial_start(topology), good), three),
               InvalidArgument);
}

TEST(GaussianMixtureHmm, SharesOneVarianceWhereItIsTied) {
  GaussianMixtureHmmOptions options = with_states_and_mixtures(3, 2);
  options.tied_variance = true;
  options.tolerance = 0;
  TrainingReport report;
  const std::vector<MatrixF> sequences{staircase(10, 1), staircase(20, 2), staircase(15, 3)};
  const MatrixD variances =
      GaussianMixtureHmm::train(sequences, options, &report).bank().variances();
  for (Eigen::Index r = 1; r < variances.rows(); ++r) EXPECT_EQ(variances.row(r), variances.row(0));
  EXPECT_NEAR(variances(0, 0), 1.0, 0.5);
  for (std::size_t i = 1; i < report.log_likelihoods.size(); ++i)
    EXPECT_GE(report.log_likelihoods[i], report.log_likelihoods[i - 1] - 1e-6);
}

TEST(GaussianMixtureHmm, CountsImaginedFramesOfEveryGaussian) {
  GaussianMixtureHmmOptions options = with_states_and_mixtures(2, 3);
  options.weight_prior = 1e9;
  const auto model = GaussianMixtureHmm::train({staircase(10, 1)}, options);
  EXPECT_LT((model.bank().weights().array() - 1.0 / 3).abs().maxCoeff(), 1e-6);
  options.weight_prior = -1;
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "weight_prior", message_of<InvalidArgument>([&] {
                        return GaussianMixtureHmm::train({staircase(10, 1)}, options);
                      }));
}

TEST(GaussianMixtureHmm, BeginsFromClustersWhereStatesHaveNoOrder) {
  for (const Kind kind : {Kind::ergodic, Kind::banded, Kind::rank_one_plus_band}) {
    GaussianMixtureHmmOptions options = with_states_and_mixtures(3);
    options.topology.kind = kind;
    options.max_iterations = 1;
    const auto model = GaussianMixtureHmm::train({staircase(30, 1), staircase(40, 2)}, options);
    std::vector<double> means{model.bank().means()(0, 0), model.bank().means()(1, 0),
                              model.bank().means()(2, 0)};
    std::sort(means.begin(), means.end());
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(means[j], 10.0 * static_cast<double>(j), 1.0);
  }
}

TEST(GaussianMixtureHmm, StaysANumberWhereDensitiesVanish) {
  const auto model = GaussianMixtureHmm::train({staircase(10, 1)}, with_states_and_mixtures(3));
  MatrixF frames = staircase(4, 2);
  frames.row(6).setConstant(3e38F);  // its square is no float
  EXPECT_EQ(model.log_likelihood(frames), -kInfinity);
  EXPECT_TRUE(std::isfinite(model.log_likelihood_exact(frames)));
  EXPECT_TRUE(model.posterior(frames).allFinite());
}

TEST(GaussianMixtureHmm, RefusesFilesByTheFieldThatIsWrong) {
  ModelFile file;
  GaussianMixtureHmm::train({staircase(10, 1)}, with_states_and_mixtures(3, 2)).write(file, "m.");
  const auto refused = [&](const char* field, const MatrixD& values) {
    ModelFile bad = file;
    bad.set_matrix(field, values);
    return message_of<FormatError>([&] { return GaussianMixtureHmm::read(bad, "m."); });
  };
  EXPECT_EQ(refused("m.means", MatrixD(MatrixD::Zero(6, 2))), "nothing thrown");
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "'m.means'",
                      refused("m.means", MatrixD(MatrixD::Zero(5, 2))));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "'m.variances'",
                      refused("m.means", MatrixD(MatrixD::Zero(6, 3))));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "'m.variances'",
                      refused("m.variances", MatrixD(MatrixD::Zero(6, 2))));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "'m.weights'",
                      refused("m.weights", MatrixD(MatrixD::Ones(3, 2))));
}

TEST(GaussianMixtureHmm, DoesNotDependOnTheUnitOfItsFeatures) {
  std::vector<MatrixF> sequences;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    sequences.push_back(noise(30, 2, seed));
    sequences.back().topRows(15).array() += 4;
  }
  GaussianMixtureHmmOptions options;
  options.topology.num_states = 2;
  const GaussianMixtureHmm usual = GaussianMixtureHmm::train(sequences, options);
  const double unit = 1e-6;
  std::vector<MatrixF> small;
  for (const MatrixF& s : sequences) small.push_back(s * static_cast<float>(unit));
  const MixtureBank bank = GaussianMixtureHmm::train(small, options).bank();
  const MatrixD ratio = bank.variances().array() / (usual.bank().variances().array() * unit * unit);
  EXPECT_NEAR(ratio.minCoeff(), 1, 1e-3);
  EXPECT_NEAR(ratio.maxCoeff(), 1, 1e-3);
  // A constant feature keeps its floor beside one that varies, and where none does.
  for (MatrixF& s : sequences) s.col(1).setConstant(0.1F);
  EXPECT_EQ(GaussianMixtureHmm::train(sequences, options).bank().variances().minCoeff(), 1e-10);
  for (MatrixF& s : sequences) s.setConstant(0.1F);
  EXPECT_EQ(GaussianMixtureHmm::train(sequences, options).bank().variances().maxCoeff(), 1e-10);
}

}  // namespace
}  // namespace hri
