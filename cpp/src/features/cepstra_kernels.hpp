// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The steps from frames to cepstra, for frames side by side (signal/lanes.hpp), once for every
// instruction set. Every lane is worked on as if it were alone, without fused multiply-adds, so
// that all sets give the same bits.
#pragma once

#include <cstddef>
#include <vector>

namespace hri::detail {

/// What is done to a frame before its spectrum.
struct FrameTable {
  int length = 0;
  int fft_size = 0;
  const float* window = nullptr;
  float pre_emphasis = 0;
};

/// Weights of filters over the bins of a power spectrum.
struct FilterTable {
  int num_filters = 0;
  int num_bins = 0;
  const float* weights = nullptr;  ///< (num_filters, num_bins)
  const int* supports = nullptr;   ///< first bin and the one past the last, of every filter
};

struct CepstraKernels {
  const char* name;
  int num_lanes;
  /// Pre-emphasis and window. `samples` has length + 1 rows, the first being what came before the
  /// frame; `out` has fft_size rows, zero beyond the frame.
  void (*condition)(const FrameTable& table, const float* samples, float* out);
  /// Logarithm of what every filter lets through, at least log(floor); floor is a normal number.
  void (*log_energies)(const FilterTable& table, float floor, const float* power, float* out);
  /// Row r of `out` is the sum over c of matrix(r, c) times row c of `in`.
  void (*project)(const float* matrix, int num_rows, int num_columns, const float* in, float* out);
};

/// Those of the widest instruction set this machine has; num_lanes is hri::num_lanes().
const CepstraKernels& cepstra_kernels();

/// Those of all instruction sets it has, for tests.
std::vector<const CepstraKernels*> all_cepstra_kernels();

}  // namespace hri::detail
