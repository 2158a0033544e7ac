// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Trained models depend on these sequences: they must never change.
#include "hri/core/random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace hri {
namespace {

// Worked out from the algorithm in integers and IEEE doubles, outside this library.
TEST(Random, SequencesAreFrozen) {
  Random zero(0);
  EXPECT_EQ(zero.next_u64(), 16294208416658607535ULL);
  EXPECT_EQ(zero.next_u64(), 7960286522194355700ULL);
  Random all_ones(~std::uint64_t{0});
  EXPECT_EQ(all_ones.next_u64(), 16490336266968443936ULL);
  Random uniform(42);
  EXPECT_EQ(uniform.uniform(), 0x1.7bae644c5fd6dp-1);
  EXPECT_EQ(uniform.uniform(), 0x1.477f199d93378p-3);
  EXPECT_EQ(uniform.uniform(), 0x1.1d499d5c4c3e6p-2);
  Random normal(42);
  for (const double expected : {0.8822489062222688, -0.4508498757188601, 0.1883526341159315})
    EXPECT_NEAR(normal.normal(), expected, 1e-14);
  Random below(42);
  for (const std::uint64_t expected : {7, 1, 2, 3, 0, 8, 2, 8, 3, 6, 2, 4})
    EXPECT_EQ(below.below(10), expected);
}

TEST(Random, CopiesGoOnAlike) {
  Random a(5);
  a.next_u64();
  Random b = a;
  for (int i = 0; i < 10; ++i) EXPECT_EQ(a.next_u64(), b.next_u64());
}

TEST(Random, NormalTakesTwoDrawsAndNoMore) {
  Random a(9);
  Random b(9);
  (void)a.normal();
  b.next_u64();
  b.next_u64();
  EXPECT_EQ(a.next_u64(), b.next_u64());
}

TEST(Random, UniformFillsEveryTenthEvenly) {
  constexpr int kCount = 100000;
  for (const std::uint64_t seed : {0ULL, 1ULL, 2ULL, 0xDEADBEEFULL}) {
    Random random(seed);
    std::array<int, 10> counts{};
    for (int i = 0; i < kCount; ++i) ++counts[static_cast<std::size_t>(random.uniform() * 10)];
    double chi_square = 0;
    for (const int c : counts)
      chi_square += (c - kCount / 10.0) * (c - kCount / 10.0) / (kCount / 10.0);
    EXPECT_LT(chi_square, 33.7) << seed;  // nine degrees of freedom, one time in 10^4
  }
}

TEST(Random, NormalHasTheTailsOfANormal) {
  Random random(4);
  constexpr int kCount = 100000;
  int beyond_one = 0;
  int beyond_two = 0;
  int beyond_three = 0;
  double cubes = 0;
  for (int i = 0; i < kCount; ++i) {
    const double x = random.normal();
    beyond_one += std::abs(x) > 1 ? 1 : 0;
    beyond_two += std::abs(x) > 2 ? 1 : 0;
    beyond_three += std::abs(x) > 3 ? 1 : 0;
    cubes += x * x * x;
  }
  EXPECT_NEAR(beyond_one / double{kCount}, 0.3173, 0.006);
  EXPECT_NEAR(beyond_two / double{kCount}, 0.0455, 0.003);
  EXPECT_NEAR(beyond_three / double{kCount}, 0.0027, 0.0008);
  EXPECT_NEAR(cubes / kCount, 0, 0.06);
}

TEST(Random, SeedsNextToEachOtherAreUnrelated) {
  constexpr int kCount = 20000;
  double products = 0;
  Random a(100);
  Random b(101);
  for (int i = 0; i < kCount; ++i) products += (a.uniform() - 0.5) * (b.uniform() - 0.5);
  EXPECT_NEAR(12 * products / kCount, 0, 0.03);
}

TEST(Random, BelowOneIsZeroAndBelowManyStaysBelow) {
  Random random(8);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(random.below(1), 0U);
    EXPECT_LT(random.below(1ULL << 32U), 1ULL << 32U);
  }
}

}  // namespace
}  // namespace hri
