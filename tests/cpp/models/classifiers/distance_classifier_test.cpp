// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/distance_classifier.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hri/core/error.hpp"
#include "hri/models/classifiers/distances.hpp"
#include "models/model_testing.hpp"

namespace hri {
namespace {

using namespace testing_data;

// One feature: class 0 has mean 0 and variance 1, class 1 mean 10 and variance 4; within: 2.5.
DistanceClassifier of_two_classes(ClassDistance metric) {
  MatrixF rows(4, 1);
  rows << -1, 1, 8, 12;
  return DistanceClassifier::train(rows, std::vector<int>{0, 0, 1, 1}, 2, {metric, 0.0});
}

TEST(DistanceClassifier, MatchesValuesByHand) {
  const std::vector<float> row{2.0F};
  for (const ClassDistance plain : {ClassDistance::euclidean, ClassDistance::manhattan}) {
    const VectorF values = of_two_classes(plain).decision_values(row);
    EXPECT_FLOAT_EQ(values[0], -2.0F);
    EXPECT_FLOAT_EQ(values[1], -8.0F);
  }
  const VectorF scaled = of_two_classes(ClassDistance::mahalanobis).decision_values(row);
  EXPECT_NEAR(scaled[0], -2.0 / std::sqrt(2.5), 1e-5);
  EXPECT_NEAR(scaled[1], -8.0 / std::sqrt(2.5), 1e-5);
}

TEST(DistanceClassifier, BhattacharyyaIsThatOfTwoGaussians) {
  const VectorF values =
      of_two_classes(ClassDistance::bhattacharyya).decision_values(std::vector<float>{2.0F});
  const VectorD at_row = VectorD::Constant(1, 2.0);
  const MatrixD within = MatrixD::Constant(1, 1, 2.5);
  for (int c = 0; c < 2; ++c) {
    const double distance =
        bhattacharyya_gaussian(VectorD::Constant(1, 10.0 * c),
                               MatrixD::Constant(1, 1, c == 0 ? 1.0 : 4.0), at_row, within);
    EXPECT_NEAR(values[c], -distance, 1e-5);
  }
}

TEST(DistanceClassifier, RefusesShrinkageOutOfRange) {
  const LabelledRows data = blobs(2, 4, 2.0, 1);
  for (const double shrinkage : {-0.1, 1.1, std::nan("")}) {
    EXPECT_THROW(DistanceClassifier::train(data.rows, data.classes, 2,
                                           {ClassDistance::mahalanobis, shrinkage}),
                 InvalidArgument);
  }
}

TEST(DistanceClassifier, RefusesFilesThatDoNotFit) {
  const auto message = [](const ModelFile& file) {
    return message_of<FormatError>([&] { DistanceClassifier::read(file, "m."); });
  };
  ModelFile file;
  of_two_classes(ClassDistance::bhattacharyya).write(file, "m.");
  file.set_matrix("m.covariances", MatrixD(MatrixD::Identity(2, 1)));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "covariances", message(file));
  file.set_matrix("m.covariances", MatrixD(MatrixD::Constant(3, 1, -1.0)));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "positive definite", message(file));
  file.set_integer("m.metric", 4);
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "metric' must be one of", message(file));
}

}  // namespace
}  // namespace hri
