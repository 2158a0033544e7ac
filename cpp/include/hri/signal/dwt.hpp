// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Discrete wavelet transform of signals and its inverse (thesis section 6.2.2), equal to
// PyWavelets.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/signal/wavelet.hpp"

namespace hri {

/// What stands beyond the ends of x = (a b c d), by PyWavelets' names:
///   symmetric        d c b a | a b c d | d c b a
///   zero             0 0 0 0 | a b c d | 0 0 0 0
///   constant         a a a a | a b c d | d d d d
///   periodic         a b c d | a b c d | a b c d
///   reflect            d c b | a b c d | c b a
///   periodization    as periodic, but with the fewest coefficients: half the length, rounded up
///   (the thesis's padding)
///   smooth           the straight lines through the first two and the last two samples
///   antisymmetric   -d-c-b-a | a b c d |-d-c-b-a
///   antireflect      the signal turned about its end: 2a-c 2a-b | a b c d | 2d-c 2d-b
enum class Border : std::uint8_t {
  symmetric,
  zero,
  constant,
  periodic,
  reflect,
  periodization,
  smooth,
  antisymmetric,
  antireflect
};
constexpr auto enum_names(Border) {
  return std::array{"symmetric",     "zero",   "constant",      "periodic",   "reflect",
                    "periodization", "smooth", "antisymmetric", "antireflect"};
}

/// Coefficients of one level: (n + taps - 1) / 2, or (n + 1) / 2 for periodization.
HRI_API std::size_t dwt_length(std::size_t num_samples, std::size_t num_taps, Border border);
/// Samples that one level of coefficients gives: 2 n - taps + 2 (at least 0), or 2 n.
HRI_API std::size_t idwt_length(std::size_t num_coefficients, std::size_t num_taps, Border border);
/// Levels until the border reaches every coefficient: floor(log2(n / (taps - 1))), at least 0.
HRI_API int max_dwt_level(std::size_t num_samples, std::size_t num_taps);

/// One level: `approx` and `detail` have dwt_length() values. T is float or double; sums are taken
/// in T. Filters have one even length of at most 128 taps. Throws InvalidArgument for an empty
/// signal and for lengths that do not fit.
template <class T>
HRI_API void dwt(Span<const T> x, const Wavelet& wavelet, Border border, Span<T> approx,
                 Span<T> detail);

/// The inverse of one level: `x` has idwt_length() values, of which a signal of odd length takes
/// one less.
template <class T>
HRI_API void idwt(Span<const T> approx, Span<const T> detail, const Wavelet& wavelet, Border border,
                  Span<T> x);

/// Lengths of the coefficients of several levels as PyWavelets orders them: approximation, then
/// details from coarse to fine. Throws InvalidArgument for levels outside 1..62.
HRI_API std::vector<std::size_t> wavedec_lengths(std::size_t num_samples, std::size_t num_taps,
                                                 Border border, int num_levels);
/// Several levels into `bands` of wavedec_lengths(). Allocates nothing once the thread has
/// transformed a signal of this length.
template <class T>
HRI_API void wavedec(Span<const T> x, const Wavelet& wavelet, Border border,
                     Span<const Span<T>> bands);
/// The inverse, into `x`: at most the idwt_length() of the finest details. Throws InvalidArgument
/// for coefficients that no signal has.
template <class T>
HRI_API void waverec(Span<const Span<const T>> bands, const Wavelet& wavelet, Border border,
                     Span<T> x);

/// The same with vectors.
template <class T>
struct WaveletDecomposition {
  std::vector<std::vector<T>> coefficients;
  std::size_t num_samples = 0;  ///< length of the signal, to which waverec cuts
};
template <class T>
HRI_API WaveletDecomposition<T> wavedec(Span<const T> x, const Wavelet& wavelet, Border border,
                                        int num_levels);
template <class T>
HRI_API std::vector<T> waverec(const WaveletDecomposition<T>& decomposition, const Wavelet& wavelet,
                               Border border);

}  // namespace hri
