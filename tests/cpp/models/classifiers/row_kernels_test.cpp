// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/classifiers/row_kernels.hpp"

#include <gtest/gtest.h>

#include "hri/core/kernels.hpp"
#include "models/model_testing.hpp"

namespace hri::detail {
namespace {

using namespace testing_data;

constexpr Eigen::Index kNumRows = 21;  // not a multiple of any number of rows at a time
constexpr Eigen::Index kStride = 5;    // places behind every row

// The orders of sums that row_kernels.hpp states.
float squared_distance_of(const float* a, const float* b, Eigen::Index dim) {
  float sum = 0;
  for (Eigen::Index d = 0; d < dim; ++d) sum += (a[d] - b[d]) * (a[d] - b[d]);
  return sum;
}

float product_of(const float* a, const float* b, Eigen::Index dim) {
  float sums[4] = {};
  Eigen::Index d = 0;
  for (; d + 4 <= dim; d += 4) {
    for (int j = 0; j < 4; ++j) sums[j] += a[d + j] * b[d + j];
  }
  float sum = (sums[0] + sums[2]) + (sums[1] + sums[3]);
  for (; d < dim; ++d) sum += a[d] * b[d];
  return sum;
}

float squared_norm_of(const float* a, Eigen::Index dim) {
  float sums[8] = {};
  Eigen::Index d = 0;
  for (; d + 8 <= dim; d += 8) {
    for (int j = 0; j < 8; ++j) sums[j] += a[d + j] * a[d + j];
  }
  for (int j = 0; j < 4; ++j) sums[j] += sums[j + 4];
  for (; d + 4 <= dim; d += 4) {
    for (int j = 0; j < 4; ++j) sums[j] += a[d + j] * a[d + j];
  }
  float sum = (sums[0] + sums[2]) + (sums[1] + sums[3]);
  for (; d < dim; ++d) sum += a[d] * a[d];
  return sum;
}

TEST(RowKernels, EverySetAddsInTheOrderStated) {
  ASSERT_FALSE(all_row_kernels().empty());
  EXPECT_EQ(&row_kernels(), all_row_kernels()[all_row_kernels().size() - 1]);
  for (const Eigen::Index size : {1, 10, 32, 33, 100}) {
    for (const Eigen::Index dim : {1, 3, 4, 7, 8, 15, 16, 17, 40, 203}) {
      const MatrixF rows = noise(size, dim, 1, 3.0);
      const MatrixF x = noise(kNumRows, dim + kStride, 2);
      const RowTable table(rows);
      EXPECT_EQ(table.matrix(), rows);
      const Eigen::Index stride = x.cols();
      for (const RowKernels* kernels : all_row_kernels()) {
        SCOPED_TRACE(::testing::Message() << kernels->name << ", " << size << " rows of " << dim);
        MatrixF distances(kNumRows, table.padded_rows());
        MatrixF dots(kNumRows, table.padded_rows());
        MatrixF products(kNumRows, table.padded_rows());
        kernels->squared_distances(x.data(), stride, kNumRows, table.layout(), 0,
                                   table.padded_rows(), distances.data(), distances.cols());
        kernels->dots(x.data(), stride, kNumRows, table.layout(), dots.data(), dots.cols());
        kernels->project(x.data(), stride, kNumRows, table.layout(), products.data(),
                         products.cols());
        for (Eigen::Index r = 0; r < kNumRows; ++r) {
          const float* row = x.row(r).data();
          ASSERT_EQ(kernels->squared_norm(row, dim), squared_norm_of(row, dim));
          for (Eigen::Index k = 0; k < size; ++k) {
            const float* known = rows.row(k).data();
            ASSERT_EQ(distances(r, k), squared_distance_of(row, known, dim)) << r << ", " << k;
            ASSERT_EQ(dots(r, k), dot(row, known, static_cast<int>(dim))) << r << ", " << k;
            ASSERT_EQ(products(r, k), product_of(row, known, dim)) << r << ", " << k;
          }
        }
      }
    }
  }
}

TEST(RowKernels, MeasuresAPartOfTheTable) {
  const MatrixF rows = noise(130, 9, 3);
  const MatrixF x = noise(kNumRows, 9, 4);
  const RowTable table(rows);
  for (const RowKernels* kernels : all_row_kernels()) {
    MatrixF distances = MatrixF::Constant(kNumRows, 65, -1.0F);
    kernels->squared_distances(x.data(), 9, kNumRows, table.layout(), 64, 64, distances.data(), 65);
    for (Eigen::Index r = 0; r < kNumRows; ++r) {
      for (Eigen::Index k = 0; k < 64; ++k) {
        ASSERT_EQ(distances(r, k),
                  squared_distance_of(x.row(r).data(), rows.row(64 + k).data(), 9));
      }
      ASSERT_EQ(distances(r, 64), -1.0F) << kernels->name;
    }
  }
}

TEST(RowKernels, FindsTheFirstBelow) {
  for (const RowKernels* kernels : all_row_kernels()) {
    for (std::ptrdiff_t count = 0; count < 70; ++count) {
      std::vector<float> values(static_cast<std::size_t>(count) + 1, 2.0F);
      values.back() = 0.0F;  // beyond the end
      EXPECT_EQ(kernels->first_below(values.data(), 0, count, 2.0F), count) << kernels->name;
      for (std::ptrdiff_t at = 0; at < count; ++at) {
        values[static_cast<std::size_t>(at)] = 1.0F;
        EXPECT_EQ(kernels->first_below(values.data(), 0, count, 2.0F), at) << kernels->name;
        EXPECT_EQ(kernels->first_below(values.data(), at, count, 2.0F), at) << kernels->name;
        EXPECT_EQ(kernels->first_below(values.data(), at + 1, count, 2.0F), count);
        values[static_cast<std::size_t>(at)] = 2.0F;
      }
    }
  }
}

}  // namespace
}  // namespace hri::detail
