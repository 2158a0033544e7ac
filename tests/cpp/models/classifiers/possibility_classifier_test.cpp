// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/possibility_classifier.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "models/model_testing.hpp"

namespace hri {
namespace {

using namespace testing_data;

TEST(PossibilityClassifier, DividesDensitiesByTheLargest) {
  MatrixF rows(4, 1);
  rows << -1, 1, 3, 5;  // variance 1 about 0 and 4
  const auto model = PossibilityClassifier::train(rows, std::vector<int>{0, 0, 1, 1}, 2,
                                                  {CovarianceKind::full, 0.0});
  const Possibilities found = model.classify(std::vector<float>{1.0F});
  const double other = std::exp(-0.5 * (9.0 - 1.0));
  EXPECT_FLOAT_EQ(found.possibility[0], 1.0F);
  EXPECT_NEAR(found.possibility[1], other, 1e-6);
  EXPECT_NEAR(found.necessity[0], 1.0 - other, 1e-6);
  EXPECT_EQ(found.necessity[1], 0.0F);
  EXPECT_NEAR(model.decision_values(std::vector<float>{1.0F})[1], std::log(other), 1e-5);
}

TEST(PossibilityClassifier, BetweenClassesNothingIsNecessary) {
  MatrixF rows(4, 1);
  rows << -1, 1, 3, 5;
  const auto model = PossibilityClassifier::train(rows, std::vector<int>{0, 0, 1, 1}, 2,
                                                  {CovarianceKind::full, 0.0});
  const Possibilities found = model.classify(std::vector<float>{2.0F});
  EXPECT_NEAR(found.necessity.maxCoeff(), 0.0, 1e-6);
}

TEST(PossibilityClassifier, IgnoresHowOftenAClassWasTrained) {
  MatrixF rows(6, 1);
  rows << -1, 1, -1, 1, 3, 5;
  const auto model = PossibilityClassifier::train(rows, std::vector<int>{0, 0, 0, 0, 1, 1}, 2,
                                                  {CovarianceKind::full, 0.0});
  EXPECT_NEAR(model.decision_values(std::vector<float>{2.0F}).minCoeff(), 0.0, 1e-6);
}

TEST(PossibilityClassifier, KnowsNothingOfARowBeyondAllDensities) {
  const LabelledRows data = blobs(3, 20, 5.0, 1);
  const PossibilityClassifier model = PossibilityClassifier::train(data.rows, data.classes, 3, {});
  for (const float value : {1e20F, -3e38F}) {
    const std::vector<float> row(3, value);
    EXPECT_EQ(model.decision_values(row), VectorF::Zero(3)) << value;
  }
  EXPECT_EQ(model.classify(std::vector<float>(3, 1e20F)).possibility, VectorF::Ones(3));
}

}  // namespace
}  // namespace hri
