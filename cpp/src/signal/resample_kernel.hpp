// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The arithmetic of resample(): the products of dot(), many at a time and equal to the bit.
#pragma once

#include <cstddef>

#include "hri/core/types.hpp"

namespace hri::detail {

/// Sums that dot() has.
constexpr int kDotLanes = 16;

/// Weights by phases. Plain pointers: kernels are compiled with flags of their own.
struct PhaseTable {
  const float* weights = nullptr;
  std::ptrdiff_t taps = 0;    ///< weights of a phase
  std::ptrdiff_t stride = 0;  ///< from one phase to the next; taps and kDotLanes at least
  std::ptrdiff_t num_phases = 0;
  std::ptrdiff_t phase_step = 0;   ///< from one output to the next, below num_phases
  std::ptrdiff_t sample_step = 0;  ///< and one more where the phases begin anew
};

struct ResampleKernel {
  const char* name;
  int num_lanes;
  /// out[n] = dot(weights of the phase, samples) for n < count, of which whole num_lanes are
  /// computed. The first output has phase `phase` and samples from `x` on. Up to kDotLanes samples
  /// behind those of an output are read, not used.
  void (*filter)(const PhaseTable& table, const float* x, std::ptrdiff_t phase,
                 std::ptrdiff_t count, float* out);
};

/// That of the widest instruction set this machine has.
const ResampleKernel& resample_kernel();

/// Those of all instruction sets it has, for tests.
Span<const ResampleKernel* const> all_resample_kernels();

}  // namespace hri::detail
