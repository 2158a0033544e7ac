// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Distances of a frame from many Gaussians at once, one Gaussian a lane, and their mixtures. The
// columns of a Gaussian are summed in the same order whatever the instruction set, without fused
// multiply-adds, so that all give the same bits.
#pragma once

#include <cstddef>

#include "hri/core/types.hpp"

namespace hri::detail {

/// Means and precisions of Gaussians, by columns: value d of Gaussian r at d * stride + r. Rows are
/// padded to `stride`, a multiple of 8 Gaussians.
template <class T>
struct GaussianColumns {
  const T* means = nullptr;
  const T* precisions = nullptr;
  std::ptrdiff_t stride = 0;
  int dim = 0;
};

struct MixtureKernels {
  /// out[r] = sum over d of (x[d] - mean)^2 precision, for `stride` Gaussians. With 16 columns of
  /// float or 8 of double a part, the sum of those beyond whole parts, in order, is added to the
  /// sums of every 16th or 8th column, which are added in pairs: l and l + 8, l and l + 4...
  void (*distances_f)(const float* x, const GaussianColumns<float>& table, float* out);
  void (*distances)(const double* x, const GaussianColumns<double>& table, double* out);
  /// out[j] = log of the sum of the exponentials of the `num_mixtures` components of state j, which
  /// lie side by side; minus infinity where none is finite. Both lists have room for a multiple of
  /// 8 values, and are overwritten. To two units in the last place.
  void (*log_sums)(float* components, int num_states, int num_mixtures, float* scratch, float* out);
};

/// Those of the widest instruction set this machine has.
const MixtureKernels& mixture_kernels();

/// Those of all instruction sets it has, for tests.
Span<const MixtureKernels* const> all_mixture_kernels();

}  // namespace hri::detail
