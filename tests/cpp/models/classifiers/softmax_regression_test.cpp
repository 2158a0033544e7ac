// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/softmax_regression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri {
namespace {

struct Points {
  MatrixF rows;
  std::vector<int> classes;
};

// Clouds around the corners of a triangle, the third column constant.
Points clouds(int num_classes, std::uint64_t seed) {
  constexpr int kPerClass = 40;
  Points points;
  points.rows.resize(num_classes * kPerClass, 3);
  Random random(seed);
  for (int i = 0; i < num_classes * kPerClass; ++i) {
    const int label = i % num_classes;
    const double angle = 2.0 * label;
    points.rows(i, 0) = static_cast<float>(30 + 4 * std::cos(angle) + random.normal());
    points.rows(i, 1) = static_cast<float>(0.01 * (4 * std::sin(angle) + random.normal()));
    points.rows(i, 2) = 7;
    points.classes.push_back(label);
  }
  return points;
}

int best_of(const VectorF& scores) {
  Eigen::Index best = 0;
  scores.maxCoeff(&best);
  return static_cast<int>(best);
}

double share_right(const SoftmaxRegression& model, const Points& points) {
  int right = 0;
  for (Eigen::Index r = 0; r < points.rows.rows(); ++r) {
    right += best_of(model.scores(row_span(points.rows, r))) ==
                     points.classes[static_cast<std::size_t>(r)]
                 ? 1
                 : 0;
  }
  return right / static_cast<double>(points.rows.rows());
}

SoftmaxRegressionOptions penalty(double value) {
  SoftmaxRegressionOptions options;
  options.penalty = value;
  return options;
}

TEST(SoftmaxRegression, TellsClassesOfAnyScaleApart) {
  const Points points = clouds(3, 1);
  const SoftmaxRegression model =
      SoftmaxRegression::train(points.rows, points.classes, 3, penalty(1));
  EXPECT_GT(share_right(model, clouds(3, 2)), 0.95);
}

TEST(SoftmaxRegression, TheGradientVanishes) {
  const Points points = clouds(3, 3);
  const SoftmaxRegression model =
      SoftmaxRegression::train(points.rows, points.classes, 3, penalty(5));
  // Without a penalty on the bias, probabilities of a class add up to how often it was seen.
  VectorD sums = VectorD::Zero(3);
  for (Eigen::Index r = 0; r < points.rows.rows(); ++r) {
    const VectorD scores = model.scores(row_span(points.rows, r)).cast<double>();
    const VectorD powers = (scores.array() - scores.maxCoeff()).exp();
    sums += powers / powers.sum();
  }
  for (const double sum : sums) EXPECT_NEAR(sum, 40, 0.1);
}

TEST(SoftmaxRegression, AStrongerPenaltyTellsLess) {
  const Points points = clouds(2, 4);
  const auto margin = [&](double value) {
    const VectorF scores = SoftmaxRegression::train(points.rows, points.classes, 2, penalty(value))
                               .scores(row_span(points.rows, 0));
    return scores[0] - scores[1];
  };
  EXPECT_GT(margin(1), 2 * margin(100));
  EXPECT_GT(margin(1000), 0);
}

TEST(SoftmaxRegression, AClassIsAddedBesideTheOthers) {
  const Points points = clouds(3, 5);
  Points two;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index r = 0; r < points.rows.rows(); ++r) {
    if (points.classes[static_cast<std::size_t>(r)] == 1) continue;
    kept.push_back(r);
    two.classes.push_back(points.classes[static_cast<std::size_t>(r)] == 0 ? 0 : 1);
  }
  two.rows = points.rows(kept, Eigen::all);
  const SoftmaxRegression model = SoftmaxRegression::train(two.rows, two.classes, 2, penalty(1));
  MatrixF means = MatrixF::Zero(2, 3);
  for (Eigen::Index r = 0; r < two.rows.rows(); ++r)
    means.row(two.classes[static_cast<std::size_t>(r)]) += two.rows.row(r) / 40;
  MatrixF few(3, 3);
  for (Eigen::Index i = 0; i < 3; ++i) few.row(i) = points.rows.row(1 + 3 * i);
  const SoftmaxRegression more = model.with_class(1, few, means, 40, penalty(1));
  ASSERT_EQ(more.num_classes(), 3);
  EXPECT_GT(share_right(more, clouds(3, 6)), 0.9);
  const VectorF before = model.scores(row_span(points.rows, 0));
  const VectorF after = more.scores(row_span(points.rows, 0));
  EXPECT_EQ(after[0], before[0]);
  EXPECT_EQ(after[2], before[1]);
  EXPECT_EQ(more.without_class(1).scores(row_span(points.rows, 0)), before);
}

TEST(SoftmaxRegression, FollowsRowsThatMove) {
  const Points points = clouds(3, 7);
  const SoftmaxRegression model =
      SoftmaxRegression::train(points.rows, points.classes, 3, penalty(1));
  const std::vector<float> shift{0.5F, -0.02F, 0};
  std::vector<float> row(3);
  for (std::size_t c = 0; c < 3; ++c)
    row[c] = points.rows(0, static_cast<Eigen::Index>(c)) + shift[c];
  EXPECT_TRUE(
      model.moved(shift).scores(row).isApprox(model.scores(row_span(points.rows, 0)), 1e-4F));
}

TEST(SoftmaxRegression, LoadsWhatItSavedToTheBit) {
  const Points points = clouds(3, 8);
  const SoftmaxRegression model =
      SoftmaxRegression::train(points.rows, points.classes, 3, penalty(1));
  ModelFile file;
  model.write(file, "x.");
  EXPECT_EQ(SoftmaxRegression::read(file, "x.").scores(row_span(points.rows, 0)),
            model.scores(row_span(points.rows, 0)));
  file.set_vector("x.bias", VectorF(VectorF::Zero(2)));
  EXPECT_THROW(SoftmaxRegression::read(file, "x."), FormatError);
}

TEST(SoftmaxRegression, IsMadeOfWeights) {
  MatrixF weights(2, 3);
  weights << 1, 2, 3, -1, 0, 1;
  VectorF bias(2);
  bias << 0.5F, -0.5F;
  const VectorF row = VectorF::Ones(3);
  const SoftmaxRegression model = SoftmaxRegression::of(weights, bias);
  EXPECT_EQ(model.scores({row.data(), 3}), weights * row + bias);
  EXPECT_THROW(SoftmaxRegression::of(weights, row), InvalidArgument);
  weights(1, 1) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(SoftmaxRegression::of(weights, bias), InvalidArgument);
}

TEST(SoftmaxRegression, RefusesBadInput) {
  const Points points = clouds(2, 9);
  EXPECT_THROW(SoftmaxRegression::train(points.rows, points.classes, 3, {}), InvalidArgument);
  EXPECT_THROW(SoftmaxRegression::train(points.rows, points.classes, 2, penalty(0)),
               InvalidArgument);
  MatrixF bad = points.rows;
  bad(3, 1) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(SoftmaxRegression::train(bad, points.classes, 2, {}), InvalidArgument);
  const SoftmaxRegression model = SoftmaxRegression::train(points.rows, points.classes, 2, {});
  const std::vector<float> short_row{1, 2};
  EXPECT_THROW((void)model.scores(short_row), InvalidArgument);
  EXPECT_THROW(model.with_class(0, MatrixF(0, 3), points.rows, 1, {}), InvalidArgument);
  EXPECT_THROW(model.with_class(0, bad, points.rows, 1, {}), InvalidArgument);
  EXPECT_THROW(model.with_class(3, points.rows, points.rows, 1, {}), InvalidArgument);
  EXPECT_THROW(model.without_class(2), InvalidArgument);
  EXPECT_THROW(SoftmaxRegression::train(points.rows, points.classes, 2, {}, [] { return true; }),
               Interrupted);
}

TEST(SoftmaxRegression, DoesNotDependOnTheUnitOfItsFeatures) {
  const Points train = clouds(3, 1);
  Points test = clouds(3, 2);
  const double usual =
      share_right(SoftmaxRegression::train(train.rows, train.classes, 3, {}, {}), test);
  EXPECT_GT(usual, 0.9);
  test.rows *= 1e-7F;
  const auto model = SoftmaxRegression::train(train.rows * 1e-7F, train.classes, 3, {}, {});
  EXPECT_NEAR(share_right(model, test), usual, 0.02);
}

}  // namespace
}  // namespace hri
