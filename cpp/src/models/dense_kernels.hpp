// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The dense steps of the recursions, in double. Rows of matrices are padded to whole lanes
// (padded()), and so are the vectors unless said otherwise. Every sum is taken in the same order on
// every machine, without fused multiply-adds, so that all give the same bits.
#pragma once

#include <cstddef>

#include "hri/core/types.hpp"

namespace hri::detail {

constexpr int kLanes = 8;  // doubles

inline std::ptrdiff_t padded(std::ptrdiff_t count) {
  return (count + kLanes - 1) / kLanes * kLanes;
}

/// The rows of `matrix` padded with `filler`; empty where they are whole already, as it then serves
/// itself.
MatrixD padded_rows(const MatrixD& matrix, double filler);

/// What a step left behind.
struct Spread {
  double sum;
  double smallest;  ///< of the values above 0; +inf where there is none
};

struct DenseKernels {
  /// y[j] = sum over i of x[i] a(i, j), i ascending; y has `num_columns` values, not padded.
  void (*propagate)(const double* x, int num_rows, const double* a, std::ptrdiff_t stride,
                    int num_columns, double* y);
  /// y[j] = max over i of x[i] + a(i, j).
  void (*propagate_max)(const double* x, int num_rows, const double* a, std::ptrdiff_t stride,
                        int num_columns, double* y);
  /// y[j] *= b[j]
  Spread (*emit)(const double* b, std::ptrdiff_t count, double* y);
  /// The lowest i for which x[i] + a[i] is largest; nothing padded, count >= 1.
  int (*best_sum)(const double* x, const double* a, int count);
  /// sums(i, j) += sum over t of x(t, i) y(t, j), t ascending.
  void (*add_products)(const double* x, std::ptrdiff_t x_stride, const double* y,
                       std::ptrdiff_t y_stride, int num_frames, int num_rows,
                       std::ptrdiff_t num_columns, double* sums);
};

/// Those of the widest instruction set this machine has.
const DenseKernels& dense_kernels();

}  // namespace hri::detail
