// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/codebook/nearest_codeword.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "models/model_testing.hpp"

namespace hri::detail {
namespace {

using namespace testing_data;

struct Case {
  const char* name;
  MatrixF centroids;
  MatrixF rows;
};

// Whole numbers: many codewords are exactly as near as others.
MatrixF rounded(const MatrixF& values) { return values.array().round().matrix(); }

// Inputs on which a score of x.c alone would go wrong, beside plain ones.
std::vector<Case> cases(int size, int dim) {
  const MatrixF c = noise(size, dim, 1);
  const MatrixF x = noise(75, dim, 2);
  MatrixF outlier = c;
  outlier.row(size / 2).setConstant(1e6F);
  MatrixF halves = c;  // two clouds far apart: no middle brings both close
  for (int k = 0; k < size; k += 2) halves.row(k).array() += 1e4F;
  MatrixF moved = x;
  for (int r = 0; r < 75; r += 3) moved.row(r).array() += 1e4F;
  return {{"noise", c, x},
          {"ties", rounded(c), rounded(x)},
          {"offset", noise(size, dim, 1, 1e4), noise(75, dim, 2, 1e4)},
          {"alike but for rounding", c.row(0).replicate(size, 1) + 1e-6F * c, x},
          {"outlier", outlier, x},
          {"two clouds", halves, moved},
          {"tiny", c * 1e-22F, x * 1e-22F},
          {"sums overflow", c * 1e19F, x * 1e19F},
          {"differences overflow", c * 1e38F, x * 1e38F}};
}

std::int32_t by_definition(const MatrixF& centroids, const float* row) {
  std::int32_t best = 0;
  float nearest = std::numeric_limits<float>::infinity();
  for (int k = 0; k < centroids.rows(); ++k) {
    const float distance =
        squared_distance(row, centroids.row(k).data(), static_cast<int>(centroids.cols()));
    if (distance < nearest) {
      nearest = distance;
      best = k;
    }
  }
  return best;
}

TEST(NearestCodeword, IsTheSameByEveryInstructionSet) {
  ASSERT_FALSE(all_codeword_kernels().empty());
  EXPECT_EQ(&codeword_kernels(), all_codeword_kernels().end() - 1);
  for (const int size : {1, 7, 8, 33, 100}) {
    for (const int dim : {1, 13, 39, 512, 513}) {
      for (const Case& c : cases(size, dim)) {
        const CodewordTable table(c.centroids);
        for (const CodewordKernels& named : all_codeword_kernels()) {
          std::vector<std::int32_t> found(static_cast<std::size_t>(c.rows.rows()), -1);
          named.find_nearest(c.rows.data(), dim, c.rows.rows(), table.layout(), found.data(), 1);
          for (Eigen::Index r = 0; r < c.rows.rows(); ++r) {
            ASSERT_EQ(found[static_cast<std::size_t>(r)],
                      by_definition(c.centroids, c.rows.row(r).data()))
                << named.name << ", " << c.name << ", " << size << " codewords of " << dim
                << ", row " << r;
          }
        }
      }
    }
  }
}

TEST(NearestCodeword, TakesRowsAndPlacesApart) {
  const MatrixF centroids = noise(20, 5, 3);
  const CodewordTable table(centroids);
  const MatrixF wide = noise(40, 9, 4);
  for (const CodewordKernels& named : all_codeword_kernels()) {
    std::vector<std::int32_t> found(120, -1);
    named.find_nearest(wide.data() + 2, 9, 40, table.layout(), found.data(), 3);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const float* row = wide.data() + i / 3 * 9 + 2;
      EXPECT_EQ(found[i], i % 3 == 0 ? by_definition(centroids, row) : -1) << named.name;
    }
  }
}

TEST(NearestCodeword, DistancesRoundAfterEveryStep) {
  // 1 + 2^-12 squared is 1 + 2^-11 + 2^-24, half a unit above the float below: alone it rounds to
  // even, in a fused sum with 2^-24 it would not.
  const float a[] = {0x1p-12F, 1.0F + 0x1p-12F};
  const float zero[] = {0.0F, 0.0F};
  EXPECT_EQ(squared_distance(a, zero, 2), 1.0F + 0x1p-11F);
}

TEST(NearestCodeword, AddsRowsToTheirCells) {
  for (const int dim : {1, 4, 13, 39}) {
    const MatrixF centroids = noise(3, dim, 5);
    const MatrixF rows = noise(30, dim + 2, 6);
    CellSums expected{MatrixD::Zero(3, dim), VectorD::Zero(3), VectorD::Zero(3)};
    std::vector<std::int32_t> cells;
    for (int r = 0; r < 30; ++r) {
      const int k = r % 2 * 2;
      cells.push_back(k);
      expected.sums.row(k) += rows.row(r).head(dim).cast<double>();
      expected.counts[k] += 1;
      expected.distortions[k] +=
          static_cast<double>(squared_distance(rows.row(r).data(), centroids.row(k).data(), dim));
    }
    for (const CodewordKernels& named : all_codeword_kernels()) {
      CellSums sums{MatrixD::Zero(3, dim), VectorD::Zero(3), VectorD::Zero(3)};
      named.add(rows.data(), dim + 2, 30, centroids.data(), dim, cells.data(), sums.sums.data(),
                sums.counts.data(), sums.distortions.data());
      EXPECT_EQ(sums.sums, expected.sums) << named.name;
      EXPECT_EQ(sums.counts, expected.counts) << named.name;
      EXPECT_EQ(sums.distortions, expected.distortions) << named.name;
    }
    CellSums sums{MatrixD::Zero(3, dim), VectorD::Zero(3), VectorD::Zero(3)};
    add_to_cells(rows.data(), dim + 2, 30, centroids, cells.data(), &sums);
    EXPECT_EQ(sums.sums, expected.sums);
  }
}

}  // namespace
}  // namespace hri::detail
