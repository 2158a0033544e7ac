// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "signal/lane_kernels.hpp"

#include <cmath>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/signal/lanes.hpp"

#define HRI_KERNEL_FILE "signal/lane_kernels.inc"
#include "core/foreach_instruction_set.inc"

namespace hri::detail {
namespace {

constexpr double kTwoPi = 6.283185307179586476925;

void append_root(double turns, std::vector<float>* out) {
  out->push_back(static_cast<float>(std::cos(kTwoPi * turns)));
  out->push_back(static_cast<float>(-std::sin(kTwoPi * turns)));
}

// Bins of the block at `place`: first, first + step, ...
void place_bins(int place, int size, int first, int step, std::vector<std::int32_t>* order) {
  if (size == 1) {
    (*order)[static_cast<std::size_t>(first)] = place;
    return;
  }
  const int blocks = size == 2 ? 2 : 4;
  for (int b = 0; b < blocks; ++b)
    place_bins(place + b * size / blocks, size / blocks, first + b * step, step * blocks, order);
}

}  // namespace

LaneFftPlan::LaneFftPlan(int size) : half(size / 2), order(static_cast<std::size_t>(size / 2)) {
  for (int block = half; block > 4; block /= 4) {
    for (int k = 0; k < block / 4; ++k) {
      for (int power = 1; power <= 3; ++power)
        append_root(static_cast<double>(power) * k / block, &twiddles);
    }
  }
  for (int k = 0; k <= half / 2; ++k) append_root(static_cast<double>(k) / size, &split);
  place_bins(0, half, 0, 1, &order);
}

Span<const LaneKernels* const> all_lane_kernels() {
  static constexpr const LaneKernels* kAll[] = {HRI_EVERY_SET(&, kKernels)};
  return runnable(kAll);
}

const LaneKernels& lane_kernels() {
  static const LaneKernels& kernels = *widest(all_lane_kernels());
  return kernels;
}

}  // namespace hri::detail

namespace hri {

int num_lanes() { return detail::lane_kernels().num_lanes; }

void interleave(Span<const float* const> signals, std::size_t count, Span<float> out) {
  const detail::LaneKernels& kernels = detail::lane_kernels();
  const auto lanes = static_cast<std::size_t>(kernels.num_lanes);
  require(signals.size() == lanes, "signals must be num_lanes()");
  require(out.size() == count * lanes, "out must have count * num_lanes() values");
  kernels.interleave(signals.data(), static_cast<std::ptrdiff_t>(count), out.data());
}

}  // namespace hri
