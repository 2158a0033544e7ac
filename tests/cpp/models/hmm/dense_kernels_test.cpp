// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/hmm/dense_kernels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "models/model_testing.hpp"

namespace hri::detail {
namespace {

using namespace testing_data;

const std::vector<int> kSizes{1, 2, 5, 7, 8, 9, 16, 31, 40, 63, 64, 65, 130};

AlignedVector random_values(int count, std::uint64_t seed) {
  Random random(seed);
  AlignedVector values(static_cast<std::size_t>(padded(count)), 0.0);
  // A few are 0, as in chains; others far apart, so that the order of a sum can be seen.
  for (int i = 0; i < count; ++i) {
    values[static_cast<std::size_t>(i)] =
        random.below(7) == 0 ? 0.0 : std::exp(4 * random.normal());
  }
  return values;
}

PaddedMatrix random_matrix(int num_rows, int num_columns, std::uint64_t seed) {
  PaddedMatrix matrix(num_rows, num_columns, 0);
  for (int i = 0; i < num_rows; ++i) {
    const AlignedVector row = random_values(num_columns, seed + static_cast<std::uint64_t>(i));
    std::copy(row.begin(), row.end(), matrix.row(i));
  }
  return matrix;
}

// Plain loops, in the order the header promises.
TEST(DenseKernels, GiveTheSameBitsAsPlainLoopsOnEveryInstructionSet) {
  for (const DenseKernels* kernels : all_dense_kernels()) {
    for (const int n : kSizes) {
      const AlignedVector x = random_values(n, 1);
      const PaddedMatrix a = random_matrix(n, n, 100);
      // Guards beyond the last value show a store too many.
      std::vector<double> y(static_cast<std::size_t>(n) + 8, -7.0);
      std::vector<double> expected = y;
      std::vector<double> top = y;
      for (int j = 0; j < n; ++j) {
        double sum = 0;
        double best = -kInfinity;
        for (int i = 0; i < n; ++i) {
          const volatile double product = x[static_cast<std::size_t>(i)] * a.row(i)[j];  // unfused
          sum += product;
          best = std::max(best, x[static_cast<std::size_t>(i)] + a.row(i)[j]);
        }
        expected[static_cast<std::size_t>(j)] = sum;
        top[static_cast<std::size_t>(j)] = best;
      }
      kernels->propagate(x.data(), n, a.row(0), a.stride(), n, y.data());
      EXPECT_EQ(y, expected) << n;
      kernels->propagate_max(x.data(), n, a.row(0), a.stride(), n, y.data());
      EXPECT_EQ(y, top) << n;
      int best = 0;
      for (int i = 1; i < n; ++i) {
        const auto at = static_cast<std::size_t>(i);
        if (x[at] + a.row(0)[i] > x[static_cast<std::size_t>(best)] + a.row(0)[best]) best = i;
      }
      EXPECT_EQ(kernels->best_sum(x.data(), a.row(0), n), best);
    }
  }
}

TEST(DenseKernels, FindTheLowestOfEqualSums) {
  const std::vector<double> zero(20, 0.0);
  std::vector<double> values(20, 1.0);
  values[3] = values[17] = 2.0;
  const std::vector<double> impossible(20, -kInfinity);
  for (const DenseKernels* kernels : all_dense_kernels()) {
    EXPECT_EQ(kernels->best_sum(values.data(), zero.data(), 20), 3);
    EXPECT_EQ(kernels->best_sum(zero.data(), impossible.data(), 20), 0);
  }
}

TEST(DenseKernels, StepAndEmitAlikeOnEveryInstructionSet) {
  const Span<const DenseKernels* const> all = all_dense_kernels();
  for (const int n : kSizes) {
    const AlignedVector x = random_values(n, 1);
    const AlignedVector b = random_values(n, 2);
    AlignedVector go = random_values(n, 3);
    const AlignedVector stay = random_values(n, 4);
    go[0] = 0;
    const std::ptrdiff_t count = padded(n);
    AlignedVector first = x;
    const Spread emitted = all[0]->emit(b.data(), count, first.data());
    double sum = 0;
    double smallest = kInfinity;
    for (int j = 0; j < n; ++j) {
      const auto at = static_cast<std::size_t>(j);
      EXPECT_EQ(first[at], x[at] * b[at]);
      sum += first[at];
      if (first[at] > 0) smallest = std::min(smallest, first[at]);
    }
    EXPECT_NEAR(emitted.sum, sum, 1e-13 * sum);
    EXPECT_EQ(emitted.smallest, smallest);
    AlignedVector stepped(x.size());
    const Spread after =
        all[0]->step_by_one(x.data(), go.data(), stay.data(), b.data(), count, stepped.data());
    for (std::size_t j = 0; j < static_cast<std::size_t>(n); ++j) {
      const volatile double went = j == 0 ? 0.0 : x[j - 1] * go[j];
      const volatile double stayed = x[j] * stay[j];
      EXPECT_EQ(stepped[j], (went + stayed) * b[j]);
    }
    for (const DenseKernels* kernels : all) {
      AlignedVector y = x;
      const Spread spread = kernels->emit(b.data(), count, y.data());
      EXPECT_EQ(spread.sum, emitted.sum);
      EXPECT_EQ(spread.smallest, emitted.smallest);
      const Spread step =
          kernels->step_by_one(x.data(), go.data(), stay.data(), b.data(), count, y.data());
      EXPECT_EQ(y, stepped);
      EXPECT_EQ(step.sum, after.sum);
      EXPECT_EQ(step.smallest, after.smallest);
    }
  }
}

TEST(DenseKernels, AddProductsOfFramesInOrder) {
  for (const DenseKernels* kernels : all_dense_kernels()) {
    for (const int n : kSizes) {
      const PaddedMatrix x = random_matrix(9, n, 10);
      const PaddedMatrix y = random_matrix(9, n, 30);
      PaddedMatrix sums = random_matrix(n, n, 50);
      const PaddedMatrix before = sums;
      kernels->add_products(x.row(0), x.stride(), y.row(0), y.stride(), 9, n, sums.stride(),
                            sums.row(0));
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          double sum = before.row(i)[j];
          for (int t = 0; t < 9; ++t) {
            const volatile double product = x.row(t)[i] * y.row(t)[j];
            sum += product;
          }
          ASSERT_EQ(sums.row(i)[j], sum);
        }
      }
    }
  }
}

TEST(DenseKernels, TakeExponentialsAndLogarithmsToTheLastPlaces) {
  constexpr int kCount = 20000;
  Random random(5);
  AlignedVector logs(kCount);
  AlignedVector values(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    const double reach = i % 3 == 0 ? 700 : (i % 3 == 1 ? 10 : 0.01);
    logs[i] = reach * (2 * random.uniform() - 1);
    values[i] = i % 2 == 0 ? std::exp(-600 * random.uniform()) : 0.5 + random.uniform();
  }
  const Span<const DenseKernels* const> all = all_dense_kernels();
  AlignedVector exponentials(kCount);
  AlignedVector logarithms(kCount);
  all[0]->exponentials(logs.data(), 0, kCount, exponentials.data());
  all[0]->logarithms(values.data(), 0, kCount, logarithms.data());
  for (std::size_t i = 0; i < kCount; ++i) {
    ASSERT_NEAR(exponentials[i] / std::exp(logs[i]), 1.0, 5e-16);
    ASSERT_NEAR(logarithms[i], std::log(values[i]), 5e-16 * std::abs(std::log(values[i])));
  }
  for (const DenseKernels* kernels : all) {
    AlignedVector out(kCount);
    kernels->exponentials(logs.data(), 0, kCount, out.data());
    EXPECT_EQ(out, exponentials);
    kernels->logarithms(values.data(), 0, kCount, out.data());
    EXPECT_EQ(out, logarithms);
    EXPECT_EQ(kernels->largest(logs.data(), kCount), *std::max_element(logs.begin(), logs.end()));
    const AlignedVector edges{-kInfinity, -1e300, -709, 0, 1, -1, 709, -700};
    kernels->exponentials(edges.data(), 0, kLanes, out.data());
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(out[i], 0.0);
    EXPECT_EQ(out[3], 1.0);
    kernels->exponentials(edges.data(), 1, kLanes, out.data());
    EXPECT_EQ(out[4], 1.0);
    const AlignedVector ones(kLanes, 1.0);
    kernels->logarithms(ones.data(), -3, kLanes, out.data());
    EXPECT_EQ(out[0], -3.0);
  }
}

}  // namespace
}  // namespace hri::detail
