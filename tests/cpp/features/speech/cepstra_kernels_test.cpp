// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "features/speech/cepstra_kernels.hpp"

#include <gtest/gtest.h>

#include <cfloat>
#include <cmath>
#include <limits>

#include "hri/core/random.hpp"
#include "hri/signal/lanes.hpp"

namespace hri {
namespace {

using Kernels = detail::CepstraKernels;

// log_energies of one filter of one bin: the logarithm itself.
std::vector<float> logarithms(const Kernels& kernels, const std::vector<float>& x, float floor) {
  const float weight = 1;
  const std::vector<int> support = {0, 1};
  const detail::FilterTable table{1, 1, &weight, support.data()};
  const auto lanes = static_cast<std::size_t>(kernels.num_lanes);
  std::vector<float> result(x.size());
  for (std::size_t i = 0; i + lanes <= x.size(); i += lanes)
    kernels.log_energies(table, floor, x.data() + i, result.data() + i);
  return result;
}

TEST(CepstraKernels, LogarithmsAreRightToTheLastBits) {
  std::vector<float> x;
  Random random(3);
  for (int i = 0; i < 160000; ++i)
    x.push_back(static_cast<float>(std::exp(-23 + 111 * random.uniform())));
  for (int i = 0; i < 16000; ++i) x.push_back(static_cast<float>(0.5 + 1.5 * random.uniform()));
  for (const Kernels* kernels : detail::all_cepstra_kernels()) {
    const std::vector<float> found = logarithms(*kernels, x, 1e-10F);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double expected = std::log(static_cast<double>(x[i]));
      ASSERT_NEAR(found[i], expected, 2.5e-7 * std::abs(expected)) << kernels->name << ": " << x[i];
    }
  }
}

TEST(CepstraKernels, LogarithmsStayFinite) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  std::vector<float> x = {0, -1, -kInf, std::nanf(""), 1e-30F, 1e-10F, FLT_MAX, kInf};
  x.insert(x.end(), x.begin(), x.end());
  for (const Kernels* kernels : detail::all_cepstra_kernels()) {
    const std::vector<float> found = logarithms(*kernels, x, 1e-10F);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(found[i], std::log(1e-10), 1e-5) << i;
    for (std::size_t i = 6; i < 8; ++i) EXPECT_NEAR(found[i], std::log(FLT_MAX), 1e-4) << i;
  }
}

TEST(CepstraKernels, GiveTheBitsOfEachOther) {
  constexpr int kBins = 65;
  constexpr int kFilters = 9;
  Random random(5);
  const auto noise = [&](std::size_t count) {
    std::vector<float> x(count);
    for (float& v : x) v = static_cast<float>(std::abs(random.normal()));
    return x;
  };
  const std::vector<float> weights = noise(kBins * kFilters);
  const std::vector<float> matrix = noise(7 * kFilters);
  std::vector<int> supports;
  for (int i = 0; i < kFilters; ++i) supports.insert(supports.end(), {i, i + 6 * i + 1});
  const std::vector<float> samples = noise(51);
  const std::vector<float> window = noise(50);
  const std::vector<float> power = noise(kBins);
  std::vector<float> expected;
  for (const Kernels* kernels : detail::all_cepstra_kernels()) {
    const auto lanes = static_cast<std::size_t>(kernels->num_lanes);
    // Every lane with values of its own, a power of two apart, so that lanes cannot be mixed up.
    const auto spread = [&](const std::vector<float>& x) {
      LaneBuffer rows;
      for (const float v : x) {
        for (std::size_t l = 0; l < lanes; ++l) rows.push_back(std::ldexp(v, static_cast<int>(l)));
      }
      return rows;
    };
    LaneBuffer frame(64 * lanes);
    LaneBuffer logs(kFilters * lanes);
    LaneBuffer cepstra(7 * lanes);
    const LaneBuffer input = spread(samples);
    LaneBuffer energy(lanes);
    detail::FrameTable table;
    table.length = 50;
    table.num_rows = 64;
    table.window = window.data();
    table.pre_emphasis = 0.97F;
    kernels->condition(table, input.data(), frame.data(), energy.data());
    kernels->log_energies({kFilters, kBins, weights.data(), supports.data()}, 1e-10F,
                          spread(power).data(), logs.data());
    kernels->project(matrix.data(), 7, kFilters, 1.5F, logs.data(), cepstra.data());
    std::vector<float> found;
    for (const LaneBuffer* rows : {&frame, &logs, &cepstra, &energy}) {
      for (std::size_t i = 0; i < rows->size(); ++i) {
        if (i % lanes < 4) found.push_back((*rows)[i]);
      }
    }
    if (expected.empty()) expected = found;
    EXPECT_EQ(found, expected) << kernels->name;
    for (std::size_t n = 0; n < 64; ++n) {
      const float plain = n < 50 ? window[n] * (samples[n + 1] - 0.97F * samples[n]) : 0.0F;
      ASSERT_NEAR(frame[n * lanes + 2], 4 * plain, 1e-5F) << n;
    }
  }
}

}  // namespace
}  // namespace hri
