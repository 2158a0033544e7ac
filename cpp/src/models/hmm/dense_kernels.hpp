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

/// One sequence through a left-right chain without skips, of kLanes states at most, in logs. Rows
/// of frames hold kLanes values.
struct LogPass {
  const double* const* chain = nullptr;  ///< MarkovChain::by_one()
  const double* log_b = nullptr;         ///< log densities, padded with 0
  std::ptrdiff_t num_frames = 0;
  double* alpha = nullptr;  ///< log P(frames 0 to t, state); the caller sets the first row
  std::ptrdiff_t alpha_stride = kLanes;  ///< 0: the last row is all that is kept
  double* after = nullptr;  ///< log P(frames from t on | state before t), but for t = 0
  double* beta = nullptr;   ///< log P(frames from t + 1 on | state); the caller sets the last row
};

/// Passes that are taken side by side, as each step has to wait for the one before.
constexpr int kLogPasses = 4;

/// Expected counts of one sequence, by the state that a step leaves.
struct StepSums {
  double stay[kLanes];
  double go[kLanes];
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
  /// log_forward_step() and log_backward_step() for all frames of `count` passes, 1..kLogPasses.
  void (*forward_logs)(const LogPass* passes, int count);
  void (*backward_logs)(const LogPass* passes, int count);
  /// Posteriors of the states into `gamma`, kLanes values a frame, and sums over frames of what
  /// times a_ij is the expected number of steps. False where that wants other arithmetic.
  bool (*posteriors)(const LogPass& pass, double total, double* gamma, StepSums* sums);
  /// out[j] = log(x[j]) + offset where x[j] is a normal number above 0, and anything elsewhere.
  void (*logarithms)(const double* x, double offset, std::ptrdiff_t count, double* out);
};

/// Those of the widest instruction set this machine has.
const DenseKernels& dense_kernels();

/// Those of all instruction sets it has, for tests.
Span<const DenseKernels* const> all_dense_kernels();

}  // namespace hri::detail
