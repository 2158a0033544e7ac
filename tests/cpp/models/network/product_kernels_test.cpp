// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/network/product_kernels.hpp"

#include <gtest/gtest.h>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri::detail {
namespace {

MatrixF random_matrix(int rows, int cols, std::uint64_t seed) {
  Random random(seed);
  MatrixF result(rows, cols);
  for (Eigen::Index i = 0; i < result.size(); ++i)
    result.data()[i] = static_cast<float>(random.normal());
  return result;
}

TEST(ProductKernels, AreThoseOfEigenAndEqualOnAllSets) {
  for (const int rows : {1, 3, 4, 9}) {
    for (const int columns : {8, 24, 40, 56}) {
      const MatrixF a = random_matrix(rows, 17, 1);
      const MatrixF b = random_matrix(17, columns, 2);
      const MatrixF bias = random_matrix(1, columns, 3);
      MatrixF first;
      for (const ProductKernels* kernels : all_product_kernels()) {
        MatrixF c(rows, columns);
        kernels->multiply(a.data(), b.data(), bias.data(), rows, 17, columns, c.data());
        if (first.size() == 0) first = c;
        EXPECT_EQ(c, first);
        const MatrixF expected = (a * b).rowwise() + bias.row(0);
        EXPECT_LT((c - expected).cwiseAbs().maxCoeff(), 1e-5F);
      }
    }
  }
}

TEST(ProductKernels, RefuseWhatDoesNotFit) {
  MatrixF c;
  EXPECT_THROW(multiply(MatrixF::Ones(2, 3), MatrixF::Ones(4, 8), &c), InvalidArgument);
  EXPECT_THROW(multiply(MatrixF::Ones(2, 3), MatrixF::Ones(3, 9), &c), InvalidArgument);
  EXPECT_THROW(multiply(MatrixF::Ones(2, 3), MatrixF::Ones(3, 8), VectorF::Ones(7), &c),
               InvalidArgument);
}

}  // namespace
}  // namespace hri::detail
