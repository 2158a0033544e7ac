// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The arithmetic of the wavelet transforms: two weighted sums of the same rows of values. Rows are
// the even and odd samples of a signal shifted against each other, lines of a picture, or
// coefficients, so that one loop serves both directions in one and two dimensions. Sums run in the
// order of the rows and nothing is fused: every instruction set gives the same bits.
#pragma once

#include <array>
#include <cstddef>

#include "hri/core/types.hpp"
#include "hri/signal/wavelet.hpp"

namespace hri::detail {

/// Longest filter of the transforms.
constexpr std::size_t kMaxTaps = 128;

/// Plain pointers throughout: the loops are compiled with flags of their own.
template <class T>
struct PairLoops {
  /// low[i] = sum_j low_weights[j] rows[j][i] and the same with high, for i < count; num_rows is
  /// even, outputs do not overlap inputs.
  void (*weigh)(const T* const* rows, const T* low_weights, const T* high_weights, int num_rows,
                std::ptrdiff_t count, T* low, T* high);
  /// even[i] = x[2 i], odd[i] = x[2 i + 1].
  void (*split)(const T* x, std::ptrdiff_t count, T* even, T* odd);
  /// x[2 i] = even[i], x[2 i + 1] = odd[i].
  void (*join)(const T* even, const T* odd, std::ptrdiff_t count, T* x);
};

/// The loops for the best instruction set of this machine; T is float or double.
template <class T>
const PairLoops<T>& pair_loops();

template <class T>
struct NamedPairLoops {
  const char* name;
  PairLoops<T> loops;
};
/// Those that this machine can run, the best ones last.
template <class T>
Span<const NamedPairLoops<T>> all_pair_loops();

/// Two filters as weights of rows.
template <class T>
struct FilterPair {
  std::array<T, kMaxTaps> low;
  std::array<T, kMaxTaps> high;
  std::ptrdiff_t num_taps = 0;
};

/// Analysis: weight i belongs to the sample i places after the first one that an output reads.
template <class T>
FilterPair<T> analysis_filters(const Wavelet& wavelet);

/// Synthesis of two samples side by side, even and odd, each from num_taps / 2 coefficients of both
/// bands: weights 2 u and 2 u + 1 belong to the approximation and the detail u places after the
/// first ones read; `low` gives the even sample, `high` the odd one.
template <class T>
FilterPair<T> synthesis_filters(const Wavelet& wavelet);

}  // namespace hri::detail
