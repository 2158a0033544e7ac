// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The convolution behind ConvNetwork. Every sum is taken in the same order on every machine,
// without fused multiply-adds, so that all give the same bits.
#pragma once

#include <cstddef>

#include "hri/core/types.hpp"

namespace hri::detail {

/// Output channels that are computed side by side; weights and maps are padded to whole panels.
constexpr int kPanel = 24;

/// What one panel of a layer is computed from.
struct ConvPanel {
  Span<const std::ptrdiff_t> places;  ///< of every output, where its first input begins
  Span<const std::ptrdiff_t> taps;    ///< of every tap of the kernel, how far its input lies on
  int in_channels;
  const float* weights;  ///< shape (taps, in_channels, kPanel)
  const float* bias;     ///< shape (kPanel,)
  float slope;
  float floor;
};

struct ConvKernels {
  /// out[p * out_stride + c] = max(leaky(bias[c] + sum over taps k and channels i, both ascending,
  /// of in[places[p] + taps[k] + i] weights(k, i, c)), floor)
  void (*convolve)(const ConvPanel& panel, const float* in, std::ptrdiff_t out_stride, float* out);
};

/// Those of the widest instruction set this machine has.
const ConvKernels& conv_kernels();

/// Those of all instruction sets it has, for tests.
Span<const ConvKernels* const> all_conv_kernels();

}  // namespace hri::detail
