// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The steps from frames to cepstra, for frames side by side (signal/lanes.hpp), once for every
// instruction set. Every lane is worked on as if it were alone, without fused multiply-adds, so
// that all sets give the same bits.
#pragma once

#include <cstddef>

#include "hri/core/types.hpp"

namespace hri::detail {

/// What is done to a frame before its spectrum.
struct FrameTable {
  int length = 0;
  int num_rows = 0;               ///< to be written: the frame and zeros behind it
  const float* window = nullptr;  ///< times the scale of the samples
  float pre_emphasis = 0;
  bool begins_anew = false;  ///< what came before the frame is thought to equal its beginning
  bool remove_dc = false;
  float energy_scale = 1;  ///< square of the scale of the samples
  float energy_floor = 1e-10F;
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
  /// Mean, pre-emphasis and window. `samples` has length + 1 rows, the first being what came before
  /// the frame. The log energy before pre-emphasis goes to `log_energy` (one row; null: not
  /// wanted).
  void (*condition)(const FrameTable& table, const float* samples, float* out, float* log_energy);
  /// Square roots in place.
  void (*take_roots)(int num_rows, float* rows);
  /// Logarithm of what every filter lets through, at least log(floor); floor is a normal number.
  void (*log_energies)(const FilterTable& table, float floor, const float* power, float* out);
  /// Row r of `out` is the sum over c of matrix(r, c) times row c of `in`, which counts as `lowest`
  /// where it is below.
  void (*project)(const float* matrix, int num_rows, int num_columns, float lowest, const float* in,
                  float* out);
};

/// Those of the widest instruction set this machine has; num_lanes is hri::num_lanes().
const CepstraKernels& cepstra_kernels();

/// Those of all instruction sets it has, for tests.
Span<const CepstraKernels* const> all_cepstra_kernels();

}  // namespace hri::detail
