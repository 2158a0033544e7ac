// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The loops below the transforms against plain ones: the same bits for every instruction set, any
// number of rows and any length, and nothing written beyond it.
#include "signal/filter_pair.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "hri/core/random.hpp"

namespace hri::detail {
namespace {

template <class T>
std::vector<T> noise(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<T> x(count);
  for (T& v : x) v = static_cast<T>(random.normal());
  return x;
}

// One rounding for every product and every sum.
template <class T>
T weighed(const std::vector<const T*>& rows, const std::vector<T>& weights, std::size_t i) {
  volatile T sum = rows[0][i] * weights[0];
  for (std::size_t j = 1; j < rows.size(); ++j) {
    volatile T product = rows[j][i] * weights[j];
    sum = sum + product;
  }
  return sum;
}

template <class T>
void expect_the_same_sums(const PairLoops<T>& loops, const char* name) {
  const std::vector<T> values = noise<T>(400, 1);
  for (std::size_t num_rows = 2; num_rows <= 30; num_rows += 2) {
    const std::vector<T> low_weights = noise<T>(num_rows, 2);
    const std::vector<T> high_weights = noise<T>(num_rows, 3);
    std::vector<const T*> rows;
    for (std::size_t j = 0; j < num_rows; ++j) rows.push_back(values.data() + 3 * j);
    for (const std::size_t count : {0U, 1U, 3U, 4U, 7U, 8U, 15U, 16U, 31U, 63U, 64U, 65U, 200U}) {
      std::vector<T> low(count + 1, T(7));
      std::vector<T> high(count + 1, T(7));
      loops.weigh(rows.data(), low_weights.data(), high_weights.data(), static_cast<int>(num_rows),
                  static_cast<std::ptrdiff_t>(count), low.data(), high.data());
      for (std::size_t i = 0; i < count; ++i) {
        ASSERT_EQ(low[i], weighed(rows, low_weights, i)) << name << " " << num_rows << " " << count;
        ASSERT_EQ(high[i], weighed(rows, high_weights, i))
            << name << " " << num_rows << " " << count;
      }
      ASSERT_EQ(low[count], T(7)) << name;
      ASSERT_EQ(high[count], T(7)) << name;
    }
  }
}

template <class T>
void expect_dealt_and_joined(const PairLoops<T>& loops, const char* name) {
  for (const std::size_t count : {0U, 1U, 5U, 8U, 31U, 100U}) {
    const std::vector<T> x = noise<T>(2 * count, 4);
    std::vector<T> even(count + 1, T(7));
    std::vector<T> odd(count + 1, T(7));
    loops.split(x.data(), static_cast<std::ptrdiff_t>(count), even.data(), odd.data());
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_EQ(even[i], x[2 * i]) << name;
      ASSERT_EQ(odd[i], x[2 * i + 1]) << name;
    }
    ASSERT_EQ(even[count], T(7)) << name;
    ASSERT_EQ(odd[count], T(7)) << name;
    std::vector<T> back(2 * count + 1, T(7));
    loops.join(even.data(), odd.data(), static_cast<std::ptrdiff_t>(count), back.data());
    ASSERT_EQ(std::vector<T>(back.begin(), back.end() - 1), x) << name;
    ASSERT_EQ(back.back(), T(7)) << name;
  }
}

TEST(FilterPair, EveryInstructionSetGivesTheSameBits) {
  ASSERT_FALSE(all_pair_loops<float>().empty());
  for (const auto& [name, loops] : all_pair_loops<float>()) {
    expect_the_same_sums(loops, name);
    expect_dealt_and_joined(loops, name);
  }
  for (const auto& [name, loops] : all_pair_loops<double>()) {
    expect_the_same_sums(loops, name);
    expect_dealt_and_joined(loops, name);
  }
}

}  // namespace
}  // namespace hri::detail
