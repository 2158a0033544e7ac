// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The steps of the recursions in vectors of double. Rows of matrices are padded to whole lanes
// (PaddedMatrix), and so are the vectors unless said otherwise. Every sum is taken in the same
// order on every machine, without fused multiply-adds, so that all give the same bits.
#pragma once

#include <cstddef>

#include "hri/core/types.hpp"
#include "hri/models/hmm/markov_chain.hpp"

namespace hri::detail {

struct DenseKernels {
  /// y[j] = sum over i of x[i] a(i, j), i ascending; y has `num_columns` values, not padded.
  void (*propagate)(const double* x, int num_rows, const double* a, std::ptrdiff_t stride,
                    int num_columns, double* y);
  /// y[j] = max over i of x[i] + a(i, j).
  void (*propagate_max)(const double* x, int num_rows, const double* a, std::ptrdiff_t stride,
                        int num_columns, double* y);
  /// y[j] *= b[j]
  Spread (*emit)(const double* b, std::ptrdiff_t count, double* y);
  /// y[j] = (x[j - 1] go[j] + x[j] stay[j]) b[j], go[0] being 0
  Spread (*step_by_one)(const double* x, const double* go, const double* stay, const double* b,
                        std::ptrdiff_t count, double* y);
  /// The lowest i for which x[i] + a[i] is largest; nothing padded, count >= 1.
  int (*best_sum)(const double* x, const double* a, int count);
  /// sums(i, j) += sum over t of x(t, i) y(t, j), t ascending.
  void (*add_products)(const double* x, std::ptrdiff_t x_stride, const double* y,
                       std::ptrdiff_t y_stride, int num_frames, int num_rows,
                       std::ptrdiff_t num_columns, double* sums);
  /// The largest of `count` values, padded.
  double (*largest)(const double* x, std::ptrdiff_t count);
  /// out[j] = exp(x[j] - offset), 0 where that is below 1e-307; at most exp(709).
  void (*exponentials)(const double* x, double offset, std::ptrdiff_t count, double* out);
  /// out[j] = log(x[j]) + offset where x[j] is a normal number above 0, and anything elsewhere.
  void (*logarithms)(const double* x, double offset, std::ptrdiff_t count, double* out);
};

/// Those of the widest instruction set this machine has.
const DenseKernels& dense_kernels();

/// Those of all instruction sets it has, for tests.
Span<const DenseKernels* const> all_dense_kernels();

}  // namespace hri::detail
