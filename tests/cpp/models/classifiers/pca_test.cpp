// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/classifiers/pca.hpp"

#include <gtest/gtest.h>

#include "hri/core/error.hpp"
#include "models/model_testing.hpp"

namespace hri {
namespace {

using namespace testing_data;

TEST(Pca, FindsTheLongAxis) {
  MatrixF rows = noise(400, 3, 1);
  rows.col(1) *= 10.0F;
  rows.rowwise() += Eigen::RowVector3f(1, 2, 3);
  const Pca pca = Pca::train(rows, 2);
  EXPECT_EQ(pca.num_components(), 2);
  EXPECT_GT(pca.components()(0, 1), 0.99F);  // positive by the sign rule
  EXPECT_GT(pca.variances()[0], 50.0F);
  EXPECT_GT(pca.variances()[0], pca.variances()[1]);
}

TEST(Pca, GivesOrthonormalComponentsAndTheirVariances) {
  for (const Eigen::Index num_rows : {50, 8}) {  // more and fewer rows than columns
    const MatrixF rows = noise(num_rows, 20, 2);
    const Pca pca = Pca::train(rows, 20);
    EXPECT_EQ(pca.num_components(), num_rows == 50 ? 20 : 7);
    const MatrixF gram = pca.components() * pca.components().transpose();
    EXPECT_LT((gram - MatrixF::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff(), 1e-5F);
    const MatrixF scores = pca.transform(rows);
    const VectorF variances =
        scores.colwise().squaredNorm().transpose() / static_cast<float>(num_rows - 1);
    EXPECT_LT((variances - pca.variances()).cwiseAbs().maxCoeff(), 1e-4F);
    EXPECT_LT(scores.colwise().mean().cwiseAbs().maxCoeff(), 1e-5F);
  }
}

TEST(Pca, LivesOnOneRowAndOnRowsAllAlike) {
  for (const Eigen::Index num_rows : {1, 5}) {
    const Pca pca = Pca::train(MatrixF::Constant(num_rows, 3, 4.0F), 3);
    EXPECT_EQ(pca.num_components(), 1);
    EXPECT_FLOAT_EQ(pca.components().row(0).norm(), 1.0F);
    EXPECT_EQ(pca.transform(MatrixF::Constant(2, 3, 4.0F)), MatrixF::Zero(2, 1));
  }
}

TEST(Pca, RefusesBadInputByName) {
  MatrixF rows = noise(4, 2, 3);
  EXPECT_THROW(Pca::train(rows, 0), InvalidArgument);
  EXPECT_THROW(Pca::train(MatrixF(0, 2), 1), InvalidArgument);
  const Pca pca = Pca::train(rows, 1);
  EXPECT_PRED_FORMAT2(
      ::testing::IsSubstring, "rows have 3 columns, the model has 2",
      message_of<InvalidArgument>([&] { return pca.transform(MatrixF::Zero(1, 3)); }));
  rows(2, 1) = kNan;
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "row 2, column 1",
                      message_of<InvalidArgument>([&] { Pca::train(rows, 1); }));
  EXPECT_THROW(static_cast<void>(pca.transform(rows)), InvalidArgument);
}

TEST(Pca, TransformsTheSameAfterLoading) {
  const MatrixF rows = noise(30, 5, 4);
  const Pca pca = Pca::train(rows, 3);
  ModelFile file;
  pca.write(file, "pca.");
  EXPECT_EQ(Pca::read(through_bytes(file), "pca.").transform(rows), pca.transform(rows));
  file.set_vector("pca.mean", VectorF(VectorF::Zero(4)));
  EXPECT_THROW(Pca::read(file, "pca."), FormatError);
}

}  // namespace
}  // namespace hri
