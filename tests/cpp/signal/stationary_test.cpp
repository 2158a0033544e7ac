// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/stationary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri {
namespace {

std::vector<double> noise(std::size_t count) {
  Random random(7);
  std::vector<double> x(count);
  for (double& v : x) v = random.normal();
  return x;
}

TEST(StationaryTransform, OfHaarIsSumsAndDifferencesOfNeighbours) {
  const std::vector<double> x = {1, 2, 4, 8};
  MatrixD approximations(1, 4);
  MatrixD details(1, 4);
  swt<double>(x, wavelet("haar"), approximations, details);
  const double root = std::sqrt(0.5);
  for (Eigen::Index i = 0; i < 4; ++i) {
    const double here = x[static_cast<std::size_t>(i)];
    const double next = x[static_cast<std::size_t>((i + 1) % 4)];
    EXPECT_NEAR(approximations(0, i), root * (here + next), 1e-12);
    EXPECT_NEAR(details(0, i), root * (here - next), 1e-12);
  }
}

TEST(StationaryTransform, ComesBack) {
  for (const char* name : {"haar", "db4", "bior2.2", "coif5"}) {
    const std::vector<double> x = noise(96);
    MatrixD approximations(5, 96);
    MatrixD details(5, 96);
    swt<double>(x, wavelet(name), approximations, details);
    std::vector<double> back(96);
    const VectorD top = approximations.row(4);
    iswt<double>({top.data(), 96}, details, wavelet(name), back);
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(back[i], x[i], 1e-10) << name;
  }
}

TEST(StationaryTransform, RefusesLevelsThatTheLengthDoesNotHave) {
  EXPECT_EQ(max_swt_level(0), 0);
  EXPECT_EQ(max_swt_level(96), 5);
  const std::vector<double> x = noise(12);
  for (const Eigen::Index levels : {0, 3}) {
    MatrixD approximations(levels, 12);
    MatrixD details(levels, 12);
    EXPECT_THROW(swt<double>(x, wavelet("db2"), approximations, details), InvalidArgument);
  }
}

}  // namespace
}  // namespace hri
