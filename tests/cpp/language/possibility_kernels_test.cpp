// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "language/possibility_kernels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "models/model_testing.hpp"

namespace hri::detail {
namespace {

TEST(PossibilityKernels, GiveTheSameBitsAsPlainLoopsOnEveryInstructionSet) {
  const MatrixF table = testing_data::noise(60, 400, 1);
  for (const PossibilityKernels* kernels : all_possibility_kernels()) {
    for (const std::ptrdiff_t size : {16, 32, 48, 64, 96, 112, 208, 384}) {
      for (const std::ptrdiff_t num_rows : {0, 1, 2, 7, 40}) {
        std::vector<const float*> rows;
        for (std::ptrdiff_t r = 0; r < num_rows; ++r)
          rows.push_back(table.row(r * 7 % 60).data() + r % 13);
        // Guards beyond the last value show a store too many.
        std::vector<float> found(static_cast<std::size_t>(size) + 16, -7);
        std::vector<float> expected = found;
        for (std::ptrdiff_t j = 0; j < size; ++j) {
          float sum = 0;
          for (const float* row : rows) sum += row[j];
          expected[static_cast<std::size_t>(j)] = sum;
        }
        kernels->add_rows(rows.data(), num_rows, size, found.data());
        EXPECT_EQ(found, expected) << num_rows << " rows of " << size;
      }
    }
  }
}

TEST(PossibilityKernels, CountWhatUpperBoundFinds) {
  const MatrixF noise = testing_data::noise(1, 4096, 2);
  for (const PossibilityKernels* kernels : all_possibility_kernels()) {
    for (const std::size_t size : {0, 1, 15, 16, 17, 127, 128, 129, 500, 4095}) {
      std::vector<float> values(noise.data(), noise.data() + size);
      std::sort(values.begin(), values.end());
      std::vector<float> wanted = values;
      wanted.insert(wanted.end(), noise.data(), noise.data() + 100);
      wanted.insert(wanted.end(), {-1e30F, 1e30F});
      std::vector<float> padded = values;
      while (padded.size() % kRowFloats != 0)
        padded.push_back(std::numeric_limits<float>::infinity());
      for (const float x : wanted) {
        EXPECT_EQ(
            kernels->count_up_to(padded.data(), static_cast<std::ptrdiff_t>(padded.size()), x),
            std::upper_bound(values.begin(), values.end(), x) - values.begin());
      }
    }
  }
}

}  // namespace
}  // namespace hri::detail
