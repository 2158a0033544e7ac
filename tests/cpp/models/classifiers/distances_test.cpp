// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/distances.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hri/core/error.hpp"
#include "models/model_testing.hpp"

namespace hri {
namespace {

using namespace testing_data;

using Row = std::vector<float>;

TEST(Distance, MatchesValuesByHand) {
  EXPECT_DOUBLE_EQ(distance(Distance::euclidean, Row{0, 3}, Row{4, 0}), 5.0);
  EXPECT_DOUBLE_EQ(distance(Distance::manhattan, Row{0, 3}, Row{4, 0}), 7.0);
  EXPECT_DOUBLE_EQ(distance(Distance::cosine, Row{0, 3}, Row{4, 0}), 1.0);
  EXPECT_NEAR(distance(Distance::cosine, Row{1, 1}, Row{2, 2}), 0.0, 1e-15);
  EXPECT_NEAR(distance(Distance::bhattacharyya, Row{1, 1}, Row{1, 3}),
              -std::log(std::sqrt(0.125) + std::sqrt(0.375)), 1e-12);
}

TEST(Distance, MeetsEdgeInputs) {
  EXPECT_EQ(distance(Distance::euclidean, Row{}, Row{}), 0.0);
  EXPECT_EQ(distance(Distance::cosine, Row{0, 0}, Row{1, 2}), 1.0);
  EXPECT_EQ(distance(Distance::bhattacharyya, Row{0.1F, 0.2F}, Row{0.1F, 0.2F}), 0.0);
  EXPECT_EQ(distance(Distance::bhattacharyya, Row{1, 0}, Row{0, 1}), kInfinity);
  EXPECT_TRUE(std::isnan(distance(Distance::euclidean, Row{kNan}, Row{1})));
}

TEST(Distance, RefusesWhatItCannotCompare) {
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "a has 1 values, b has 2",
                      message_of<InvalidArgument>([] {
                        distance(Distance::euclidean, Row{1}, Row{1, 2});
                      }));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "index 1", message_of<InvalidArgument>([] {
                        distance(Distance::bhattacharyya, Row{1, -1}, Row{1, 2});
                      }));
  EXPECT_THROW(distance(Distance::bhattacharyya, Row{0, 0}, Row{1, 2}), InvalidArgument);
}

TEST(BhattacharyyaGaussian, MatchesTheScalarFormula) {
  // Variances 1 and 4, means 0 and 3: 1/8 9 / 2.5 + 1/2 log(2.5 / sqrt(4)).
  const VectorD a = VectorD::Constant(1, 0.0);
  const VectorD b = VectorD::Constant(1, 3.0);
  const double d =
      bhattacharyya_gaussian(a, MatrixD::Constant(1, 1, 1.0), b, MatrixD::Constant(1, 1, 4.0));
  EXPECT_NEAR(d, 0.125 * 9 / 2.5 + 0.5 * std::log(2.5 / 2.0), 1e-12);
}

TEST(BhattacharyyaGaussian, RefusesWhatIsNoCovariance) {
  const VectorD mean = VectorD::Zero(2);
  const MatrixD good = MatrixD::Identity(2, 2);
  EXPECT_NEAR(bhattacharyya_gaussian(mean, good, mean, good), 0.0, 1e-15);
  EXPECT_THROW(bhattacharyya_gaussian(mean, good, mean, MatrixD::Zero(2, 2)), InvalidArgument);
  EXPECT_THROW(bhattacharyya_gaussian(mean, good, VectorD::Zero(3), good), InvalidArgument);
}

}  // namespace
}  // namespace hri
