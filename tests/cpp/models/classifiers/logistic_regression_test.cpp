// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/logistic_regression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri {
namespace {

struct Data {
  MatrixD rows;
  std::vector<int> yes;
  std::vector<double> weights;
};

// Answers drawn from known log odds, 2 x0 - 0.5 x1 + 1, with columns of very different size.
Data drawn(int count) {
  Random random(5);
  Data data{MatrixD(count, 3), {}, std::vector<double>(static_cast<std::size_t>(count), 1.0)};
  for (int i = 0; i < count; ++i) {
    data.rows(i, 0) = random.normal();
    data.rows(i, 1) = 100 + 10 * random.normal();
    data.rows(i, 2) = 7;
    const double odds = 2 * data.rows(i, 0) - 0.05 * (data.rows(i, 1) - 100) + 1;
    data.yes.push_back(random.uniform() < 1 / (1 + std::exp(-odds)) ? 1 : 0);
  }
  return data;
}

LogisticRegression train(const Data& data, double penalty) {
  LogisticRegressionOptions options;
  options.penalty = penalty;
  return LogisticRegression::train(data.rows, data.yes, data.weights, options);
}

TEST(LogisticRegression, FindsTheOddsThatAnswersWereDrawnFrom) {
  const LogisticRegression model = train(drawn(20000), 1e-3);
  EXPECT_NEAR(model.weights()[0], 2, 0.1);
  EXPECT_NEAR(model.weights()[1], -0.05, 0.01);
  EXPECT_EQ(model.weights()[2], 0);  // a constant column separates nothing
  const std::vector<double> row{0, 100, 7};
  EXPECT_NEAR(model.log_odds(row), 1, 0.1);
}

// At the optimum no slope is left: checked against the loss written out, by differences.
TEST(LogisticRegression, StopsWhereTheLossIsLeast) {
  Data data = drawn(200);
  for (std::size_t i = 0; i < data.weights.size(); ++i) data.weights[i] = i % 2 == 0 ? 3.0 : 0.5;
  const LogisticRegression model = train(data, 1e-6);
  const auto loss = [&](double step, int column) {
    double sum = 0;
    for (Eigen::Index i = 0; i < data.rows.rows(); ++i) {
      double odds = model.bias() + data.rows.row(i).dot(model.weights());
      odds += step * (column < 0 ? 1.0 : data.rows(i, column));
      const auto at = static_cast<std::size_t>(i);
      sum += data.weights[at] * std::log1p(std::exp(data.yes[at] != 0 ? -odds : odds));
    }
    return sum;
  };
  for (const int column : {-1, 0, 1}) {
    const double h = column == 1 ? 1e-6 : 1e-4;
    EXPECT_NEAR((loss(h, column) - loss(-h, column)) / (2 * h), 0, 2e-3) << column;
  }
}

TEST(LogisticRegression, PenaltyHoldsWeightsWhereClassesAreFarApart) {
  Data data = drawn(100);
  for (Eigen::Index i = 0; i < 100; ++i)
    data.yes[static_cast<std::size_t>(i)] = data.rows(i, 0) > 0 ? 1 : 0;
  const double loose = train(data, 0.1).weights()[0];
  const double tight = train(data, 100).weights()[0];
  EXPECT_TRUE(std::isfinite(loose));
  EXPECT_GT(loose, 2 * tight);
  EXPECT_GT(tight, 0);
}

TEST(LogisticRegression, ReadsBackToTheBit) {
  const LogisticRegression model = train(drawn(100), 1);
  ModelFile file;
  model.write(file, "odds.");
  const LogisticRegression again = LogisticRegression::read(file, "odds.");
  EXPECT_EQ(again.weights(), model.weights());
  EXPECT_EQ(again.bias(), model.bias());
}

TEST(LogisticRegression, RefusesWhatItCannotLearnFrom) {
  const Data good = drawn(10);
  Data data = good;
  data.rows(3, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(train(data, 1), InvalidArgument);
  data = good;
  data.yes.assign(10, 1);
  EXPECT_THROW(train(data, 1), InvalidArgument);
  data = good;
  data.weights[2] = 0;
  EXPECT_THROW(train(data, 1), InvalidArgument);
  data = good;
  data.weights.pop_back();
  EXPECT_THROW(train(data, 1), InvalidArgument);
  EXPECT_THROW(train(good, 0), InvalidArgument);
  const std::vector<double> narrow{1, 2};
  EXPECT_THROW(static_cast<void>(train(good, 1).log_odds(narrow)), InvalidArgument);
}

}  // namespace
}  // namespace hri
