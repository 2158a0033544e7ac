// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/normal_kernels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace hri::detail {
namespace {

TEST(NormalKernels, GiveWhatNormalsGiveOneByOne) {
  for (const std::size_t count : {0, 1, 7, 64, 65, 10000}) {
    Random random(count);
    Random one_by_one(count);
    std::vector<double> found(count + 1, -7.0);
    fill_normals(&random, {found.data(), count});
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_NEAR(found[i], one_by_one.normal(), 1e-14) << i << " of " << count;
    EXPECT_EQ(found.back(), -7.0);
    EXPECT_EQ(random.next_u64(), one_by_one.next_u64()) << "draws of " << count;
  }
}

TEST(NormalKernels, GiveTheSameBitsOnEveryInstructionSet) {
  // The ends of both ranges, and whole eighths of a turn.
  std::vector<double> u{1.0, 0x1.0p-53, 0.5, 0.25, 0.75, 1 - 0x1.0p-53, 0.1, 0.9};
  std::vector<double> v{0.0, 1 - 0x1.0p-53, 0.125, 0.25, 0.375, 0.5, 0.625, 0.875};
  Random random(3);
  for (int i = 0; i < 8 * 1000; ++i) {
    u.push_back(1 - random.uniform());
    v.push_back(random.uniform());
  }
  const auto count = static_cast<std::ptrdiff_t>(u.size());
  std::vector<double> first;
  for (const NormalKernels* kernels : all_normal_kernels()) {
    std::vector<double> found(u.size());
    kernels->box_muller(u.data(), v.data(), count, found.data());
    if (first.empty()) first = found;
    EXPECT_EQ(found, first);
    for (std::size_t i = 0; i < u.size(); ++i) {
      const double expected = std::sqrt(-2 * std::log(u[i])) * std::cos(2 * std::acos(-1.0) * v[i]);
      EXPECT_NEAR(found[i], expected, 1e-14) << u[i] << " " << v[i];
    }
  }
}

}  // namespace
}  // namespace hri::detail
