// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Signals side by side: against the library's transform of one signal, and all instruction sets
// against each other.
#include "signal/lane_kernels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"
#include "hri/signal/fft.hpp"
#include "hri/signal/lanes.hpp"

namespace hri {
namespace {

std::vector<std::vector<float>> noises(std::size_t count, std::size_t length) {
  Random random(length);
  std::vector<std::vector<float>> signals(count, std::vector<float>(length));
  for (auto& signal : signals) {
    for (float& v : signal) v = static_cast<float>(random.normal());
  }
  return signals;
}

std::vector<const float*> places(const std::vector<std::vector<float>>& signals) {
  std::vector<const float*> result;
  for (const auto& signal : signals) result.push_back(signal.data());
  return result;
}

// Spectra by one set of kernels, put one after another.
std::vector<std::vector<float>> spectra(const detail::LaneKernels& kernels,
                                        const std::vector<std::vector<float>>& signals) {
  const auto lanes = static_cast<std::size_t>(kernels.num_lanes);
  const std::size_t size = signals.front().size();
  const detail::LaneFftPlan plan(static_cast<int>(size));
  const std::size_t bins = size / 2 + 1;
  LaneBuffer rows(size * lanes);
  LaneBuffer power(bins * lanes);
  std::vector<std::vector<float>> result;
  for (std::size_t first = 0; first < signals.size(); first += lanes) {
    kernels.interleave(places(signals).data() + first, static_cast<std::ptrdiff_t>(size),
                       rows.data());
    kernels.power_spectra({plan.half, plan.twiddles.data(), plan.split.data(), plan.order.data()},
                          rows.data(), power.data());
    for (std::size_t l = 0; l < lanes; ++l) {
      result.emplace_back(bins);
      for (std::size_t k = 0; k < bins; ++k) result.back()[k] = power[k * lanes + l];
    }
  }
  return result;
}

TEST(LaneKernels, GiveTheBitsOfEachOther) {
  for (const std::size_t size : {2U, 4U, 8U, 16U, 32U, 64U, 128U, 256U, 512U, 2048U}) {
    const auto signals = noises(16, size);
    const auto expected = spectra(*detail::all_lane_kernels()[0], signals);
    for (const detail::LaneKernels* kernels : detail::all_lane_kernels())
      EXPECT_EQ(spectra(*kernels, signals), expected) << kernels->name << ", " << size;
  }
}

TEST(LaneKernels, InterleaveAnyCount) {
  for (const detail::LaneKernels* kernels : detail::all_lane_kernels()) {
    const auto lanes = static_cast<std::size_t>(kernels->num_lanes);
    for (const std::size_t count : {1U, 7U, 16U, 35U}) {
      const auto signals = noises(lanes, count);
      std::vector<float> out(count * lanes);
      kernels->interleave(places(signals).data(), static_cast<std::ptrdiff_t>(count), out.data());
      for (std::size_t i = 0; i < out.size(); ++i)
        ASSERT_EQ(out[i], signals[i % lanes][i / lanes]) << kernels->name << ", " << count;
    }
  }
}

TEST(PowerSpectra, EqualThoseOfTheLibrary) {
  const auto lanes = static_cast<std::size_t>(num_lanes());
  // 30 and 400 are no powers of two: there the library does it all.
  for (const std::size_t size : {2U, 4U, 8U, 30U, 64U, 128U, 400U, 512U, 1024U, 65536U}) {
    const auto signals = noises(lanes, size);
    const RealFft fft(static_cast<int>(size));
    const auto bins = static_cast<std::size_t>(fft.num_bins());
    LaneBuffer rows(size * lanes);
    LaneBuffer power(bins * lanes);
    interleave(Span<const float* const>(places(signals)), size, {rows.data(), rows.size()});
    fft.power_spectra({rows.data(), rows.size()}, {power.data(), power.size()});
    std::vector<float> expected(bins);
    for (std::size_t l = 0; l < lanes; ++l) {
      fft.power_spectrum(signals[l], expected);
      const float largest = *std::max_element(expected.begin(), expected.end());
      for (std::size_t k = 0; k < bins; ++k)
        ASSERT_NEAR(power[k * lanes + l], expected[k], 2e-6F * largest) << size << ", bin " << k;
    }
  }
}

TEST(PowerSpectra, RefuseBuffersThatDoNotFit) {
  LaneBuffer rows(64);
  const RealFft fft(512);
  EXPECT_THROW(fft.power_spectra({rows.data(), 64}, {rows.data(), 64}), InvalidArgument);
  const std::vector<const float*> signals(3, rows.data());
  EXPECT_THROW(interleave(Span<const float* const>(signals), 4, {rows.data(), 64}),
               InvalidArgument);
}

}  // namespace
}  // namespace hri
