// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/hmm/gaussian_mixture.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hri/core/error.hpp"
#include "models/model_testing.hpp"

namespace hri {
namespace {

using namespace testing_data;

GaussianMixtureOptions with_mixtures(int num_mixtures) {
  GaussianMixtureOptions options;
  options.num_mixtures = num_mixtures;
  return options;
}

TEST(GaussianMixture, MatchesOneGaussianByHand) {
  MatrixF rows(4, 1);
  rows << -1, 1, -1, 1;
  const GaussianMixture model = GaussianMixture::train(rows, with_mixtures(1));
  const double expected = -0.5 * (std::log(2 * 3.14159265358979323846) + 1.0);
  EXPECT_NEAR(model.log_likelihood(rows), 4 * expected, 1e-5);
}

TEST(GaussianMixture, NeverLosesLikelihoodInTraining) {
  TrainingReport report;
  GaussianMixtureOptions options = with_mixtures(5);
  options.tolerance = 0;
  GaussianMixture::train(blobs(4, 50, 5.0, 1).rows, options, &report);
  ASSERT_GE(report.log_likelihoods.size(), 3U);
  for (std::size_t i = 1; i < report.log_likelihoods.size(); ++i) {
    EXPECT_GE(report.log_likelihoods[i], report.log_likelihoods[i - 1] - 1e-6);
  }
}

TEST(GaussianMixture, KnowsItsOwnDataFromOthers) {
  const GaussianMixture model =
      GaussianMixture::train(blobs(3, 60, 10.0, 1).rows, with_mixtures(3));
  const MatrixF own = blobs(3, 20, 10.0, 2).rows;
  EXPECT_GT(model.log_likelihood(own), model.log_likelihood(noise(60, 3, 3)));
  EXPECT_EQ(model.log_likelihood(MatrixF(0, 3)), 0.0);
}

TEST(GaussianMixture, LivesOnConstantAndScarceRows) {
  EXPECT_TRUE(std::isfinite(GaussianMixture::train(MatrixF::Constant(6, 2, 1.0F), with_mixtures(3))
                                .log_likelihood(noise(4, 2, 1))));
  EXPECT_TRUE(std::isfinite(
      GaussianMixture::train(noise(1, 2, 1), with_mixtures(16)).log_likelihood(noise(4, 2, 1))));
}

TEST(GaussianMixture, RefusesBadInputByName) {
  MatrixF rows = noise(5, 2, 1);
  EXPECT_THROW(GaussianMixture::train(rows, with_mixtures(0)), InvalidArgument);
  EXPECT_THROW(GaussianMixture::train(MatrixF(0, 2), with_mixtures(1)), InvalidArgument);
  rows(4, 0) = kNan;
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "row 4, column 0", message_of<InvalidArgument>([&] {
                        return GaussianMixture::train(rows, with_mixtures(1));
                      }));
}

TEST(MixtureBank, RefusesWhatIsNoMixture) {
  const MatrixD one = MatrixD::Ones(1, 1);
  EXPECT_NO_THROW(MixtureBank(one, one, one));
  EXPECT_THROW(MixtureBank(0.5 * one, one, one), InvalidArgument);
  EXPECT_THROW(MixtureBank(one, one, 0.0 * one), InvalidArgument);
  EXPECT_THROW(MixtureBank(one, one * std::nan(""), one), InvalidArgument);
  EXPECT_THROW(MixtureBank(one, MatrixD::Ones(2, 1), MatrixD::Ones(2, 1)), InvalidArgument);
}

TEST(MixtureBank, ScoresEveryWidthInFloatAsInDouble) {
  for (const int num_states : {1, 5, 16, 19}) {
    for (const int num_mixtures : {1, 2, 7}) {
      for (const int dim : {1, 15, 16, 39, 40}) {
        const int rows = num_states * num_mixtures;
        const MixtureBank bank(MatrixD::Constant(num_states, num_mixtures, 1.0 / num_mixtures),
                               noise(rows, dim, 1).cast<double>(),
                               noise(rows, dim, 2).cast<double>().cwiseAbs().array() + 0.5);
        const MatrixF frames = noise(7, dim, 3);
        MatrixF scores(7, num_states);
        bank.log_densities(frames, scores);
        MatrixD exact;
        bank.log_densities(frames, &exact, nullptr);
        const MatrixD error = (scores.cast<double>() - exact)
                                  .cwiseQuotient(exact.cwiseAbs().array().max(1.0).matrix());
        EXPECT_LT(error.cwiseAbs().maxCoeff(), 1e-5)
            << num_states << " " << num_mixtures << " " << dim;
      }
    }
  }
}

// A component of weight 0, and frames so far away that nothing but the best component counts.
TEST(MixtureBank, SharesDensitiesAmongComponentsAsTheySay) {
  for (const int num_mixtures : {2, 3, 16}) {
    constexpr int kStates = 3;
    constexpr int kDim = 5;
    const int rows = kStates * num_mixtures;
    MatrixD weights = MatrixD::Constant(kStates, num_mixtures, 1.0 / (num_mixtures - 1));
    weights.col(1).setZero();
    const MatrixD means = noise(rows, kDim, 1).cast<double>();
    const MatrixD variances = noise(rows, kDim, 2).cast<double>().cwiseAbs().array() + 0.5;
    const MixtureBank bank(weights, means, variances);
    MatrixF frames = noise(9, kDim, 3);
    frames.row(4) *= 1000;
    MatrixD densities;
    MatrixD shares;
    bank.log_densities(frames, &densities, &shares);
    for (int t = 0; t < frames.rows(); ++t) {
      for (int j = 0; j < kStates; ++j) {
        const auto own = shares.row(t).segment(j * num_mixtures, num_mixtures);
        EXPECT_NEAR(own.sum(), 1, 1e-14);
        EXPECT_EQ(own[1], 0);
        for (int c = 0; c < num_mixtures; ++c) {
          if (c == 1) continue;
          const int r = j * num_mixtures + c;
          const auto off = (frames.row(t).cast<double>() - means.row(r)).array();
          const double log_density =
              std::log(weights(j, c)) -
              0.5 * ((off.square() / variances.row(r).array()).sum() +
                     (variances.row(r).array() * 2 * 3.14159265358979323846).log().sum());
          EXPECT_NEAR(own[c], std::exp(log_density - densities(t, j)), 1e-9) << t << " " << r;
        }
      }
    }
  }
}

TEST(GaussianMixture, RefusesFilesOfSeveralStates) {
  ModelFile file;
  MixtureBank(MatrixD::Ones(2, 1), MatrixD::Zero(2, 1), MatrixD::Ones(2, 1)).write(file, "g.");
  EXPECT_THROW(GaussianMixture::read(file, "g."), FormatError);
  file.set_matrix("g.variances", MatrixD(MatrixD::Zero(2, 1)));
  EXPECT_THROW(MixtureBank::read(file, "g."), FormatError);
}

}  // namespace
}  // namespace hri
