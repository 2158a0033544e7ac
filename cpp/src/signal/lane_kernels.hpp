// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What is done to signals side by side, once for every instruction set. Every lane is worked on as
// if it were alone, without fused multiply-adds, so that all sets give the same bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hri/core/types.hpp"

namespace hri::detail {

/// Tables of a real FFT of 2 * half values, half a power of two.
struct LaneFftPlan {
  explicit LaneFftPlan(int size);

  int half = 0;                     ///< size of the complex transform within
  std::vector<float> twiddles;      ///< by passes and butterflies: w, w^2, w^3
  std::vector<float> split;         ///< exp(-2 pi i k / size), k = 0 .. half / 2
  std::vector<std::int32_t> order;  ///< where the transform leaves bin k
};

/// What the kernels see of a plan. Plain pointers: kernels are compiled with flags of their own,
/// and calls to functions of other headers would stay calls.
struct LaneFftTables {
  int half = 0;
  const float* twiddles = nullptr;
  const float* split = nullptr;
  const std::int32_t* order = nullptr;
};

struct LaneKernels {
  const char* name;
  int num_lanes;
  /// The first `count` values of every signal, side by side.
  void (*interleave)(const float* const* signals, std::ptrdiff_t count, float* out);
  /// Power spectra (half + 1 rows) of 2 * half rows, which are used up. Rows begin at cache lines.
  void (*power_spectra)(const LaneFftTables& tables, float* rows, float* power);
};

/// Those of the widest instruction set this machine has.
const LaneKernels& lane_kernels();

/// Those of all instruction sets it has, for tests.
Span<const LaneKernels* const> all_lane_kernels();

}  // namespace hri::detail
