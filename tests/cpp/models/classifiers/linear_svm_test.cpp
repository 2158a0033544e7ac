// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/linear_svm.hpp"

#include <gtest/gtest.h>

#include <array>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"
#include "models/model_testing.hpp"

namespace hri {
namespace {

using namespace testing_data;

TEST(LinearSvm, FindsTheKnownSolutionOfTwoPoints) {
  // One feature, rows -1 and +1, bias feature 1: by symmetry the bias is 0, and w minimises
  // w^2 / 2 + 2 C (1 - w)^2, so w = 4 C / (1 + 4 C).
  MatrixF rows(2, 1);
  rows << -1, 1;
  LinearSvmOptions options;
  options.cost = 0.5;
  options.tolerance = 1e-6;
  const LinearSvm model = LinearSvm::train(rows, std::vector<int>{0, 1}, 2, options);
  EXPECT_NEAR(model.weights()(1, 0), 2.0 / 3.0, 1e-5);
  EXPECT_NEAR(model.weights()(0, 0), -2.0 / 3.0, 1e-5);
  EXPECT_NEAR(model.biases()[1], 0.0, 1e-5);
}

TEST(LinearSvm, CountsRowsOfNoClassAgainstAll) {
  // The rows of two classes differ in their second feature only; the first separates both from rows
  // of no class.
  MatrixF rows(4, 2);
  rows << 1, 1, 1, -1, -1, 1, -1, -1;
  const LinearSvm model = LinearSvm::train(rows, std::vector<int>{0, 1, -1, -1}, 2, {});
  for (const Eigen::Index none : {2, 3})
    EXPECT_LT(model.decision_values({rows.row(none).data(), 2}).maxCoeff(), -0.5F);
  EXPECT_GT(model.decision_values({rows.row(0).data(), 2})[0], 0.3F);
  EXPECT_GT(model.decision_values({rows.row(1).data(), 2})[1], 0.3F);
  EXPECT_THROW(LinearSvm::train(rows, std::vector<int>{0, 1, -2, -1}, 2, {}), InvalidArgument);
  EXPECT_THROW(LinearSvm::train(rows, std::vector<int>{0, 0, -1, -1}, 2, {}), InvalidArgument);
}

// Rows longer than they are many are separated by their products with one another, made in blocks
// of 32 rows. Zeros behind them change nothing but that.
TEST(LinearSvm, FindsTheSamePlanesForWideRows) {
  Random random(5);
  MatrixF rows(70, 6);
  std::vector<int> classes;
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    classes.push_back(static_cast<int>(r % 4) - 1);
    for (Eigen::Index c = 0; c < 6; ++c)
      rows(r, c) = static_cast<float>(random.uniform()) + (c == classes.back() ? 1.0F : 0.0F);
  }
  MatrixF wide = MatrixF::Zero(70, 80);
  wide.leftCols(6) = rows;
  LinearSvmOptions options;
  options.tolerance = 1e-5;
  const LinearSvm narrow_model = LinearSvm::train(rows, classes, 3, options);
  const LinearSvm wide_model = LinearSvm::train(wide, classes, 3, options);
  EXPECT_LT((narrow_model.weights() - wide_model.weights().leftCols(6)).cwiseAbs().maxCoeff(),
            1e-3F);
  EXPECT_EQ(wide_model.weights().rightCols(74).cwiseAbs().maxCoeff(), 0);
  EXPECT_LT((narrow_model.biases() - wide_model.biases()).cwiseAbs().maxCoeff(), 1e-3F);
}

TEST(LinearSvm, MovesPlanesNoFurtherThanANewClassAsksFor) {
  ModelFile file;
  MatrixF planes(2, 2);
  planes << 4, 0, -4, 0;
  file.set_matrix("weights", planes);
  file.set_vector("biases", VectorF(VectorF::Zero(2)));
  const LinearSvm before = LinearSvm::read(file, "");
  // The new class lies where plane 0 says yes and plane 1 says no.
  MatrixF rows(3, 2);
  rows << 1, 0, -1, 0, 1, 2;
  const LinearSvm after = before.with_class(1, rows, std::vector<int>{0, 2, 1}, {});
  ASSERT_EQ(after.num_classes(), 3);
  EXPECT_EQ(after.weights().row(2), before.weights().row(1));
  EXPECT_NE(after.weights().row(0), before.weights().row(0));
  for (Eigen::Index r = 0; r < 3; ++r) {
    Eigen::Index best = 0;
    after.decision_values({rows.row(r).data(), 2}).maxCoeff(&best);
    EXPECT_EQ(best, (std::array<Eigen::Index, 3>{0, 2, 1}[static_cast<std::size_t>(r)]));
  }
  EXPECT_THROW((void)before.with_class(3, rows, std::vector<int>{0, 2, 1}, {}), InvalidArgument);
  EXPECT_THROW((void)before.with_class(1, rows, std::vector<int>{0, 2, 2}, {}), InvalidArgument);
  EXPECT_THROW((void)before.with_class(1, MatrixF::Ones(3, 3), std::vector<int>{0, 2, 1}, {}),
               InvalidArgument);
}

TEST(LinearSvm, RepeatsForOneSeed) {
  const LabelledRows data = blobs(3, 20, 2.0, 1);
  const LinearSvm a = LinearSvm::train(data.rows, data.classes, 3, {});
  const LinearSvm b = LinearSvm::train(data.rows, data.classes, 3, {});
  EXPECT_EQ(a.weights(), b.weights());
}

TEST(LinearSvm, StopsWhenAsked) {
  const LabelledRows data = blobs(3, 20, 2.0, 1);
  LinearSvmOptions options;
  options.should_stop = [] { return true; };
  EXPECT_THROW(LinearSvm::train(data.rows, data.classes, 3, options), Interrupted);
}

TEST(LinearSvm, RefusesOptionsOutOfRange) {
  const LabelledRows data = blobs(2, 4, 2.0, 1);
  for (double LinearSvmOptions::*field :
       {&LinearSvmOptions::cost, &LinearSvmOptions::bias_feature, &LinearSvmOptions::tolerance}) {
    LinearSvmOptions options;
    options.*field = 0;
    EXPECT_THROW(LinearSvm::train(data.rows, data.classes, 2, options), InvalidArgument);
  }
}

TEST(LinearSvm, RefusesFilesThatDoNotFit) {
  ModelFile file;
  file.set_matrix("weights", MatrixF::Ones(3, 2));
  file.set_vector("biases", VectorF(VectorF::Ones(2)));
  EXPECT_THROW(LinearSvm::read(file, ""), FormatError);
}

}  // namespace
}  // namespace hri
