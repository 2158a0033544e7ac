// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/gaussian_bayes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hri/core/error.hpp"
#include "models/model_testing.hpp"

namespace hri {
namespace {

using namespace testing_data;

TEST(GaussianBayes, MatchesTheDensityByHand) {
  // One feature: class 0 at -1 and 1 (mean 0, variance 1), class 1 at 8 and 12 (mean 10, variance
  // 4).
  MatrixF rows(4, 1);
  rows << -1, 1, 8, 12;
  const GaussianBayes model =
      GaussianBayes::train(rows, std::vector<int>{0, 0, 1, 1}, 2, {CovarianceKind::full, 0.0});
  const VectorF densities = model.log_densities(std::vector<float>{2.0F});
  const double log_2pi = std::log(2 * 3.14159265358979323846);
  EXPECT_NEAR(densities[0], -0.5 * (log_2pi + 4.0), 1e-5);
  EXPECT_NEAR(densities[1], -0.5 * (log_2pi + std::log(4.0) + 16.0), 1e-5);
  EXPECT_NEAR(model.decision_values(std::vector<float>{2.0F})[0], densities[0] + std::log(0.5),
              1e-5);
}

TEST(GaussianBayes, SharesOneCovariance) {
  MatrixF rows(4, 1);
  rows << -1, 1, 8, 12;  // pooled variance (1 + 1 + 4 + 4) / 4
  const GaussianBayes model =
      GaussianBayes::train(rows, std::vector<int>{0, 0, 1, 1}, 2, {CovarianceKind::shared, 0.0});
  const VectorF densities = model.log_densities(std::vector<float>{5.0F});
  EXPECT_NEAR(densities[0], densities[1], 1e-5);  // half way
  EXPECT_NEAR(model.log_densities(std::vector<float>{0.0F})[0],
              -0.5 * std::log(2 * 3.14159265358979 * 2.5), 1e-5);
}

TEST(GaussianBayes, GivesAClassOfOneRowTheSharedSpread) {
  MatrixF rows(5, 1);
  rows << -1, 1, 9, 11, 30;
  const GaussianBayes model =
      GaussianBayes::train(rows, std::vector<int>{0, 0, 1, 1, 2}, 3, {CovarianceKind::full, 0.0});
  EXPECT_EQ(argmax(model.log_densities(std::vector<float>{28.0F})), 2);
  EXPECT_GT(model.log_densities(std::vector<float>{28.0F})[2], -20.0F);
}

TEST(GaussianBayes, RefusesShrinkageOutOfRange) {
  const LabelledRows data = blobs(2, 4, 2.0, 1);
  for (const double shrinkage : {-0.1, 1.1, std::nan("")}) {
    EXPECT_THROW(
        GaussianBayes::train(data.rows, data.classes, 2, {CovarianceKind::full, shrinkage}),
        InvalidArgument);
  }
}

TEST(GaussianBayes, RefusesFilesWithoutACovariance) {
  const LabelledRows data = blobs(2, 4, 2.0, 1);
  ModelFile file;
  GaussianBayes::train(data.rows, data.classes, 2, {}).write(file, "");
  file.set_matrix("covariances", MatrixD(-MatrixD::Identity(3, 3)));
  const std::string message = message_of<FormatError>([&] { GaussianBayes::read(file, ""); });
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "covariances", message);
}

TEST(GaussianBayes, DoesNotDependOnTheUnitOfItsFeatures) {
  const LabelledRows train = blobs(3, 30, 4.0, 1);
  const LabelledRows test = blobs(3, 30, 4.0, 2);
  const GaussianBayes plain = GaussianBayes::train(train.rows, train.classes, 3, {});
  for (const float unit : {1e-5F, 1e-7F, 1e-9F}) {
    const GaussianBayes model = GaussianBayes::train(train.rows * unit, train.classes, 3, {});
    const MatrixF found = model.decision_values(ConstMatrixRefF(test.rows * unit));
    const MatrixF expected = plain.decision_values(ConstMatrixRefF(test.rows));
    for (Eigen::Index r = 0; r < found.rows(); ++r) {
      const VectorF row = (found.row(r).array() - found(r, 0)).transpose();
      const VectorF wanted = (expected.row(r).array() - expected(r, 0)).transpose();
      EXPECT_LT((row - wanted).cwiseAbs().maxCoeff(), 0.05F * (1 + wanted.cwiseAbs().maxCoeff()))
          << unit;
    }
  }
}

}  // namespace
}  // namespace hri
